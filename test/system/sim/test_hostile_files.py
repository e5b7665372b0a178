# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A request names a file of somebody else: nothing of it runs, and the clock goes on.

What a xacro file of the user's own may do, it does in a child, which ends.
"""

import os
import re
import signal
import time

import pytest
import rclpy
from rclpy.node import Node
from rosgraph_msgs.msg import Clock
from simulation_interfaces.msg import Result
from simulation_interfaces.srv import DeleteEntity, GetEntities, LoadWorld, SpawnEntity
from support.needs import need
from support.ros_processes import PATIENCE
from support.running_programs import Program

from amr_description.ros.qos import CLOCK
from amr_description.ros.service_calls import call, wait_until
from amr_description.sim.spawning import SpawnCode

SERVICES = '/mujoco_sim'
OTHER = 65534
SILENCE = 10.0
"""s of the clock, on a busy machine."""
ENDLESS = '<robot name="${9**9**9}" xmlns:xacro="http://www.ros.org/wiki/xacro"/>'
COMMANDS = """<robot name="evil" xmlns:xacro="http://www.ros.org/wiki/xacro">
<xacro:property name="g" value="${{(x for x in [1]).gi_frame.f_back.f_back.f_builtins}}"/>
<link name="${{g['open']('{path}', 'w').write('ran') or 'a'}}"/></robot>"""


class Client(Node):
    """Asks, and notes how long the clock was silent meanwhile."""

    def __init__(self):
        super().__init__('client')
        self.last, self.longest = 0.0, 0.0
        self.create_subscription(Clock, '/clock', self.hear, CLOCK)

    def hear(self, _):
        now = time.monotonic()
        if self.last:
            self.longest = max(self.longest, now - self.last)
        self.last = now

    def ask(self, service_type, name, **fields):
        request = service_type.Request(**fields)
        return call(self, service_type, f'{SERVICES}/{name}', request, timeout=2 * PATIENCE)

    def refused(self, **fields):
        """Return why an entity is not spawned."""
        self.longest = 0.0
        result = self.ask(SpawnEntity, 'spawn_entity', **fields).result
        assert result.result == SpawnCode.NO_RESOURCE, result
        assert self.ask(GetEntities, 'get_entities').entities == []
        assert self.longest < SILENCE
        return result.error_message


@pytest.fixture(scope='module')
def client():
    rclpy.init(args=[])
    with Program.module('mujoco_sim') as program:
        program.expect('waiting for robots')
        node = Client()
        assert wait_until(node, lambda: node.last or None, timeout=2 * PATIENCE)
        yield node
        node.destroy_node()
        rclpy.try_shutdown()
        began = time.monotonic()
        assert program.end(signal.SIGINT) == 0
        assert time.monotonic() - began < 5.0


@pytest.fixture
def write(open_path):
    """Write a file that all may read, as those in the folders of pytest may not be."""

    def write(text, name='robot.urdf.xacro', owner=None):
        path = open_path / name
        path.write_text(text)
        if owner is not None:
            need(os.geteuid() == 0, 'only root can give files to another user; run it as root')
            os.chown(path, owner, owner)
        return str(path)

    return write


@pytest.mark.long
def test_an_expression_without_end_is_ended(client, write):
    reason = client.refused(uri=write(ENDLESS))
    # After 10 s of a processor; where others leave it less than a sixth of one, after a minute.
    assert re.search('no end after (10|60) s; does an expression of it end[?]', reason)


def test_a_xacro_file_of_another_user_is_not_run(client, write, tmp_path):
    path = write(COMMANDS.format(path=tmp_path / 'ran'), owner=OTHER)
    reason = client.refused(uri=path)
    assert f'{path} is not taken from a request: {path} belongs to the user {OTHER};' in reason
    assert 'create -file' in reason
    assert not (tmp_path / 'ran').exists()


@pytest.mark.parametrize('uri', ['{}', 'file://{}', '{}?a=1'])
def test_nor_one_that_everybody_may_write_to(client, write, tmp_path, uri):
    path = write(COMMANDS.format(path=tmp_path / 'ran'))
    os.chmod(path, 0o666)
    assert f'others may write to {path}' in client.refused(uri=uri.format(path))
    assert not (tmp_path / 'ran').exists()


@pytest.mark.parametrize('make', [os.mkfifo, lambda path: os.symlink('/dev/zero', path)])
@pytest.mark.parametrize('suffix', ['.urdf', '.urdf.xacro'])
def test_a_pipe_or_a_device_holds_nobody_up(client, tmp_path, make, suffix):
    path = tmp_path / f'robot{suffix}'
    make(path)
    assert 'is no regular file' in client.refused(uri=str(path))


def test_a_world_of_another_user_is_not_loaded(client, write):
    path = write('<mujoco/>', 'world.xml', owner=OTHER)
    result = client.ask(LoadWorld, 'load_world', uri=path).result
    assert result.result != Result.RESULT_OK
    assert f'belongs to the user {OTHER}' in result.error_message


def test_an_own_file_is_expanded_with_its_arguments(client, write):
    path = write(
        '<robot name="$(arg name)" xmlns:xacro="http://www.ros.org/wiki/xacro">'
        '<xacro:arg name="name" default="nobody"/><link name="a"/></robot>'
    )
    spawned = client.ask(SpawnEntity, 'spawn_entity', uri=f'{path}?name=one')
    assert spawned.result.result == Result.RESULT_OK, spawned.result.error_message
    assert spawned.entity_name == 'one'
    assert (
        client.ask(DeleteEntity, 'delete_entity', entity='one').result.result == Result.RESULT_OK
    )
