# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The stack `navigation`, the mux and other machines: what can be typed here is typed."""

import re

import pytest
from support import shells
from support.doc_pages import Page, ROOT
from support.shells import line_of

TEXT = ''.join(Page(name).text for name in ('navigation.md', 'localisation.md', 'nav2.md'))
CHAPTERS = dict(re.findall(r'^## (.*?)\n(.*?)(?=^## |\Z)', TEXT, re.DOTALL | re.MULTILINE))
STACK = CHAPTERS['The stack `navigation`']
BETWEEN = CHAPTERS['Between planner and wheels']
DRIVE = CHAPTERS['Drive to a pose']
ELSEWHERE = CHAPTERS['Nav2 and slam_toolbox on another machine']


@pytest.fixture
def terminal(tmp_path):
    """A function that opens a new terminal for one who reads a chapter."""
    return lambda book: shells.newcomer(f'source scripts/activate\n{book}', tmp_path)


def x(shell):
    """The robot's x on /odom, m."""
    shell.type('ros2 topic echo --once --field pose.pose.position.x /odom')
    return float(shell.see(r'\n(-?[\d.e-]+)\r?\n---')[1])


@pytest.mark.long  # as system/navigation/test_navigation_stack.py, but typed
def test_the_stack_comes_up_and_commands_of_nav2s_type_drive_it(terminal):
    with terminal(STACK) as robot, terminal(BETWEEN) as planner:
        robot.type(f'{line_of(STACK, "scripts/run navigation")} viewer:=false')
        robot.see(r'ready in \d+\.\d s')
        planner.type(line_of(BETWEEN, 'ros2 topic pub --rate 10'))
        planner.see(r'publishing #30')
        planner.see(re.escape(shells.PROMPT))
        assert x(planner) > 0.3
        planner.book = STACK
        planner.run('ros2 topic pub --once /goal_pose')
        robot.see('Goal succeeded')
        assert x(planner) == pytest.approx(2.0, abs=0.15)
        robot.interrupt()


@pytest.mark.long  # as system/navigation/test_navigator.py, but typed
def test_goals_are_sent_by_hand_and_by_a_program(terminal):
    with terminal(STACK) as robot, terminal(DRIVE) as person:
        robot.type(f'{line_of(STACK, "scripts/run navigation")} viewer:=false')
        robot.see(r'ready in \d+\.\d s')
        person.type(line_of(DRIVE, 'ros2 action send_goal'))
        person.see(r'distance_remaining: \d')
        person.see('Goal finished with status: SUCCEEDED')
        person.see(re.escape(shells.PROMPT))
        assert abs(x(person) - 1.5) < 0.1
        person.type(line_of(DRIVE, 'python examples/send_goal.py'))
        person.see(r'\d m left')
        person.see(r'\nthere\r?\n')
        person.see(re.escape(shells.PROMPT))
        assert abs(x(person) + 1.0) < 0.1
        robot.interrupt()


def test_the_mux_starts_beside_any_robot(terminal):
    with terminal(BETWEEN) as mux:
        mux.start('ros2 run twist_mux twist_mux')
        mux.see("Topic handler 'locks.emergency_stop' subscribed to topic 'emergency_stop'")
        mux.interrupt()


def test_what_is_typed_elsewhere_is_what_the_stack_says():
    source = (ROOT / 'amr_description/bringup/stacks/navigation.py').read_text(encoding='utf-8')
    said = ' '.join(source.replace('\\\\\n', ' ').split())
    lines = re.findall(r'^(ros2 launch (?:nav2|slam)\S+ .*)$', ELSEWHERE, re.MULTILINE)
    assert [line for line in lines if line in said or 'bringup_launch' in line] == lines
    assert len(lines) >= 2
    for file in ('nav2_params.yaml', 'mapper_params_online_async.yaml'):
        assert f'](../config/{file})' in ELSEWHERE


def test_what_the_tables_say_is_in_the_files():
    text = (ROOT / 'config/twist_mux.yaml').read_text(encoding='utf-8')
    rows = re.findall(r'^\| (?:input|lock) `(\w+)` \| `/(\w+)` \| (\d+) \|', BETWEEN, re.MULTILINE)
    assert len(rows) == text.count('priority: ')
    for name, topic, priority in rows:
        assert re.search(
            rf'{name}:\n\s+topic: {topic}\n\s+timeout: .*\n\s+priority: {priority}\n', text
        )
