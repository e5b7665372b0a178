# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Every command line of the documentation is typed by a test, letter for letter.

A test that types a page names the page in its file, and the beginning of the line as a string:
``shell.run('ros2 topic list')``. A line that stands on several pages is typed once.
"""

import ast
from functools import cache
import re

from support.doc_pages import Page, ROOT

FRONT, CONTRIBUTING = '../README.md', '../CONTRIBUTING.md'
NAMES = [FRONT, CONTRIBUTING, *sorted(path.name for path in (ROOT / 'docs').glob('*.md'))]
FENCE = re.compile(r'^ *```(\S*)$')
# Lines that no test types as they stand -> the test that does what they do, or why none can.
ELSEWHERE = {
    ('../README.md', 'scripts/test'): 'it would run the tests in the tests',
    ('../CONTRIBUTING.md', 'python -m pytest test/unit'): 'it would run the tests in the tests',
    ('../CONTRIBUTING.md', 'scripts/setup'): 'test/tooling/test_setup.py',
    ('bags.md', 'ros2 launch amr_description simulation record:='): (
        'test/unit/bringup/test_bringup_simulation.py'
    ),
    ('test_your_robot.md', 'python -m pytest --ros-bag'): (
        'test/system/testing/test_testing_failures.py'
    ),
    ('benchmarks.md', 'scripts/bench'): 'test/ros/benchmarks/test_parts.py',
    **{
        ('legged_robots.md', line): 'test/unit/simulation/test_walk.py'  # in one process
        for line in ('python', 'ros2 launch', 'PYTHONPATH=examples ros2 launch')
    },
    ('learning.md', 'python examples/learn_to_drive.py'): (
        'test/unit/base/test_gym.py'  # learns for three generations
    ),
    ('learning.md', "python -m pip install 'amr-description[gym]'"): (
        'test/system/docs/test_docs_pip_without_ros.py'  # without the extra
    ),
    ('install.md', 'scripts/setup'): 'test/tooling/test_setup.py',
    **{
        (page, f'scripts/run navigation {words}'): 'test/unit/bringup/test_bringup_navigation.py'
        for page, words in (
            ('navigation.md', 'urdf:='),
            ('nav2.md', 'navigator:=false map:=none'),
            ('nav2.md', 'map:=none'),
            ('your_own_planner.md', 'navigator_params:='),
        )
    },
    ('nav2.md', 'ros2 run amr_description check_navigation'): (
        'test/system/docs/test_docs_check_navigation.py'  # types whatever is in that block
    ),
    ('localisation.md', 'ros2 run amr_description scan_localizer'): (
        'test/ros/navigation/test_scan_localizer.py'
    ),
    ('localisation.md', 'ros2 run amr_description truth_localizer'): (
        'test/system/navigation/test_navigation_stack.py'
    ),
    ('localisation.md', 'ros2 run teleop_twist_keyboard'): 'test/system/nodes/test_teleop.py',
    ('nav2.md', 'ros2 launch nav2_bringup'): 'on another machine, with Nav2',
    ('nav2.md', 'ros2 topic pub -1 /goal_pose'): 'on another machine, with Nav2',
    ('nav2.md', 'ros2 launch slam_toolbox'): 'on another machine, with slam_toolbox',
    ('nav2.md', 'ros2 run nav2_map_server map_saver_cli'): 'on another machine, with slam_toolbox',
    **{
        ('robot_from_nothing.md', line): 'test/unit/docs/test_docs_from_nothing.py'
        for line in ('check_urdf', 'ros2 launch', 'ros2 action send_goal')
    },
    ('ros2_control.md', 'ros2 launch amr_description mock'): (
        'test/system/bringup/test_bringup_runs.py'
    ),
    ('sensors.md', 'ros2 launch amr_description simulation urdf:=rover.urdf.xacro bridge:='): (
        'test/system/sim/test_sensors_of_public_robots.py'
    ),
    ('simulator.md', 'scripts/run world:=my_world.xml'): 'test/unit/docs/test_docs_pages.py',
    ('tutorial.md', 'ros2 run amr_description listener'): (
        'test/system/docs/test_tutorial.py'  # with the name of the package beside it
    ),
    ('two_machines.md', 'scripts/run simulation --discovery'): (
        'test/system/docs/test_docs_machines.py'
    ),
    ('two_machines.md', 'ROS_DOMAIN_ID=1'): (
        'test/system/docs/test_docs_machines.py'  # puts the variable before the line
    ),
    ('stacks.md', 'ros2 launch amr_description teleop'): (
        'test/system/nodes/test_teleop_stack.py'
    ),
    ('controllers.md', 'ros2 run controller_manager spawner mecanum'): (
        'test/system/control/test_spawner.py'
    ),
    ('write_your_own_hardware.md', 'ros2 launch amr_description serial port:=/dev/ttyUSB0'): (
        'with a board on that port'
    ),
    ('write_your_own_hardware.md', 'ros2 run amr_description motor_board'): (
        'test/system/docs/test_docs_by_hand.py'  # with a port of its own
    ),
    ('your_own_robot.md', 'colcon test'): 'test/system/docs/test_walk_ci_engineer.py',
}


def fenced(page):
    """Yield (number of its first line, language, lines) of each block of a page."""
    language, begin, lines = None, 0, []
    for number, line in enumerate(page.text.splitlines(), 1):
        fence = FENCE.match(line)
        if fence and language is None:
            language, begin, lines = fence[1], number + 1, []
        elif fence:
            yield begin, language, lines
            language = None
        elif language is not None:
            lines.append(line)


def commands(page):
    """Yield (number, line) of each command line; one that goes on below is one."""
    for begin, language, lines in fenced(page):
        if language not in ('bash', 'console'):
            continue
        text = ''
        for number, line in enumerate(lines, begin):
            if language == 'console' and not text and not line.startswith('$ '):
                continue
            text += line.strip().removeprefix('$ ')
            if text.endswith('\\'):
                text = text.removesuffix('\\')
            elif text:
                yield number, ' '.join(re.sub(r'\s+#\s.*', '', text).split())
                text = ''


@cache
def texts_of_tests():
    """For each file of test/system that names a page: its names of pages, its other strings."""
    found = []
    for path in sorted((ROOT / 'test/system').rglob('test_*.py')):
        text = path.read_text(encoding='utf-8')
        if '.md' in text:
            strings = {
                ' '.join(node.value.replace('\\\n', ' ').split())
                + '\n' * node.value.endswith('\n')
                for node in ast.walk(ast.parse(text))
                if isinstance(node, ast.Constant) and isinstance(node.value, str)
            }
            found.append((strings & {*NAMES}, {each for each in strings if len(each) > 7}))
    return found


def chapters(page):
    """The command lines of each chapter of a page: tests read some pages by chapters."""
    heads = [n for n, line in enumerate(page.text.splitlines(), 1) if line.startswith('## ')]
    found = {}
    for number, line in commands(page):
        found.setdefault(sum(head < number for head in heads), []).append(line)
    return list(found.values())


def typed_lines(name):
    """The lines of a page that its tests type: the first that begins as a string of theirs."""
    typed = {'source scripts/activate', GO}  # arguments of support.shells
    for pages, strings in texts_of_tests():
        for lines in chapters(Page(name)) if name in pages else ():
            for string in strings:
                typed |= {next((line for line in lines if f'{line}\n'.startswith(string)), '')}
                typed |= {line for line in lines if line in string}
    return typed


GO = 'cd examples/rover'


def is_elsewhere(name, line):
    return any(name == page and line.startswith(begin) for page, begin in ELSEWHERE)


def test_every_block_says_what_it_is():
    assert [
        f'{name}:{begin - 1}'
        for name in NAMES
        for begin, language, _ in fenced(Page(name))
        if not language
    ] == []


def test_every_line_is_typed():
    """A line that stands on several pages is typed of one of them."""
    typed = set().union(*map(typed_lines, NAMES))
    assert [
        f'{name}:{number}: {line}'
        for name in NAMES
        for number, line in commands(Page(name))
        if line not in typed and not is_elsewhere(name, line)
    ] == []


def test_commands_in_the_sentences_of_the_front_page_are_those_of_other_pages():
    """Where they are typed."""
    sentences = re.sub(r'^(```.*?```$|\|.*?$)', '', Page(FRONT).text, flags=re.M | re.S)
    named = r'`(ros2 doctor|(?:ros2 (?:bag|launch|run)|python -m pytest) [^`]+)`'
    found = re.findall(named, sentences)
    others = {line for name in NAMES if name != FRONT for _, line in commands(Page(name))}
    assert [line for line in found if line not in others] == []
    assert len(found) == 6


def test_what_is_not_typed_has_a_reason():
    typed = set().union(*map(typed_lines, NAMES))
    for (name, begin), reason in ELSEWHERE.items():
        lines = [line for _, line in commands(Page(name)) if line.startswith(begin)]
        assert lines, (name, begin)
        assert not {*lines} <= typed, (name, begin)
        assert (ROOT / reason).is_file() or not reason.startswith('test/'), reason


def test_a_line_that_nobody_types_is_found(tmp_path):
    page = Page('README.md')
    page.text = '```bash\nros2 run a \\\n  --b  # why\n\n```\n```console\n$ c d\nsaid\n```\n'
    assert [*commands(page)] == [(3, 'ros2 run a --b'), (7, 'c d')]
