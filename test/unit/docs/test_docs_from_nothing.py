# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""docs/robot_from_nothing.md and docs/debug_your_code.md: their files are a robot, and a fault."""

import shlex
import sys

from support.doc_pages import install, Page
from support.shells import line_of
import yaml

from amr_description.cli.main import main

NOTHING, DEBUG = Page('robot_from_nothing.md'), Page('debug_your_code.md')
CONTROLLER = Page('write_your_own_controller.md')


def test_two_files_are_a_robot_that_drives_sees_and_opens_its_gripper(
    tmp_path, monkeypatch, capsys
):
    """The last block, with the goal of the line for a shell."""
    for name, language in (('pickbot.urdf.xacro', 'xml'), ('pickbot.yaml', 'yaml')):
        (tmp_path / name).write_text(NOTHING.blocks(language)[0])
    monkeypatch.chdir(tmp_path)
    command, *words = shlex.split(line_of(NOTHING.text, 'check_urdf'))
    assert main(command, [*words, '--strict']) == 0
    assert '\n    passed\n' in capsys.readouterr().out
    (block,) = NOTHING.blocks('python')
    *_, action, _kind, goal = shlex.split(line_of(NOTHING.text, 'ros2 action send_goal'))
    assert f"send_goal('{action}'" in block
    assert yaml.safe_load(goal) == NOTHING.run(block)['opening']


def test_a_fault_in_a_controller_is_said_as_the_page_says_and_a_breakpoint_stops(
    tmp_path, monkeypatch, capsys
):
    stops = []
    monkeypatch.setattr(sys, 'breakpointhook', lambda: stops.append(True))
    (spinner,) = [block for block in CONTROLLER.blocks('yaml') if 'my_module/MyClass' in block]
    (tmp_path / 'spinner.yaml').write_text(DEBUG.blocks('yaml')[0] + spinner)
    monkeypatch.chdir(tmp_path)
    module = CONTROLLER.blocks('python')[0]
    install(tmp_path, monkeypatch, my_module=module.replace('angle.value)', 'angle.valu)'))
    (block,) = DEBUG.blocks('python')
    DEBUG.run(block)
    assert DEBUG.blocks('text')[0].strip() in capsys.readouterr().out
    (tmp_path / 'my_package/my_module.py').write_text(
        module.replace(
            '        self._output.send', '        breakpoint()\n        self._output.send'
        )
    )
    monkeypatch.delitem(sys.modules, 'my_package.my_module')
    DEBUG.run(block)
    assert len(stops) == 100
