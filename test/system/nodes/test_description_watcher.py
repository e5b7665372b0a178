# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""description_watcher beside robot_state_publisher: files are saved, and the topic follows."""

import signal

import pytest
import rclpy
from rclpy.node import Node
from std_msgs.msg import String
from support.ros_processes import PATIENCE
from support.running_programs import Program

from amr_description.ros.qos import LATCHED
from amr_description.ros.service_calls import wait_until

ROBOT = '<robot name="{}"><link name="base"/></robot>\n'
XACRO = """<robot xmlns:xacro="http://ros.org/wiki/xacro" name="$(arg name)">
  <xacro:arg name="name" default="cart"/>
  <xacro:include filename="parts.xacro"/>
  <xacro:part/>
</robot>
"""
PARTS = """<robot xmlns:xacro="http://ros.org/wiki/xacro">
  <xacro:macro name="part"><link name="{}"/></xacro:macro>
</robot>
"""


@pytest.fixture(scope='module')
def heard():
    """The descriptions that were published, and a wait for a text in the last one."""
    rclpy.init(args=[])
    node = Node('test_description_watcher')
    texts = []
    node.create_subscription(String, 'robot_description', lambda m: texts.append(m.data), LATCHED)

    def has(text):
        wait_until(node, lambda: (texts and text in texts[-1]) or None, timeout=PATIENCE)
        assert text in texts[-1]
        return texts

    yield has
    node.destroy_node()
    rclpy.try_shutdown()


@pytest.fixture
def watched(tmp_path, heard):
    """Run both nodes for a file, with its arguments; yield the watcher."""
    programs = []

    def watch(file, *arguments):
        programs.append(Program.module('robot_state_publisher', str(file), *arguments))
        programs.append(Program.module('description_watcher', str(file), *arguments))
        return programs[-1]

    yield watch
    for program in programs:
        assert program.end(signal.SIGINT) == 0


def test_a_saved_file_is_shown_and_a_broken_one_is_said(tmp_path, watched, heard):
    file = tmp_path / 'one.urdf'
    file.write_text(ROBOT.format('first'))
    watcher = watched(file)
    heard('first')
    watcher.expect('watching')
    file.write_text(ROBOT.format('second'))
    heard('second')
    watcher.expect(r'one\.urdf was saved: the robot is as it says now')
    file.write_text(ROBOT.format('third')[:-15])
    watcher.expect(r'the description stays as it was: .*one\.urdf')
    file.unlink()
    watcher.expect(r'the description stays as it was: .*one\.urdf')
    new = tmp_path / 'new'
    new.write_text(ROBOT.format('fourth'))
    new.rename(file)  # as editors save
    texts = heard('fourth')
    assert not any('third' in text for text in texts)


def test_a_file_that_is_included_counts_and_arguments_are_kept(tmp_path, watched, heard):
    (tmp_path / 'parts.xacro').write_text(PARTS.format('base'))
    (tmp_path / 'cart.urdf.xacro').write_text(XACRO)
    watcher = watched(tmp_path / 'cart.urdf.xacro', 'name:=mine')
    heard('<link name="base"/>')
    watcher.expect('watching')
    (tmp_path / 'parts.xacro').write_text(PARTS.format('wheel'))
    texts = heard('<link name="wheel"/>')
    assert 'name="mine"' in texts[-1]


@pytest.mark.parametrize(
    ('words', 'said', 'code'),
    [((), 'it watches a file', 2), (('nowhere.urdf',), r'nowhere\.urdf', 1)],
)
def test_without_a_file_to_watch_it_ends_with_one_line(words, said, code):
    with Program.module('description_watcher', *words) as program:
        program.expect(said)
        assert program.end() == code
