# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``check_navigation`` on the shipped robot: all holds, and what the program does besides."""

import json
import signal

from fixtures.bringup.running import Bringup
from geometry_msgs.msg import Twist
import pytest
import rclpy
from rclpy.node import Node
from support.paths import ROOT
from support.running_programs import Program

from amr_description.navigation.contract.rules import RULES

MACHINE = {'time.real_time_factor', 'tf.at_scans', 'scan.age'}
"""It is what the machine gives."""
LONG = ('--duration', '120')
"""On a busy machine; it ends as soon as all is known."""

TELEOP = ('--ros-args', '-r', 'cmd_vel:=/cmd_vel_teleop')
"""An input of twist_mux on which nobody publishes; on /cmd_vel the navigator does."""


def check(*options):
    return Program.module('check_navigation', *options)


def report(*options):
    """Its exit code is 0, or 1 as only the machine was too slow."""
    with check('--json', *LONG, *options) as program:
        code = program.end()
        text = program.output
    data = json.loads(text[text.index('{\n') : text.rindex('}') + 1])
    found = {each['name']: each for each in data['findings'] if each['name'] not in MACHINE}
    assert data['holds'] == (code == 0)
    assert len(data['findings']) == len(RULES)
    return found


def by_verdict(found, verdict):
    return {name: each['found'] for name, each in found.items() if each['verdict'] == verdict}


@pytest.fixture(scope='module')
def stack(tmp_path_factory):
    folder = tmp_path_factory.mktemp('stack')
    own = {'AMENT_PREFIX_PATH': str(ROOT / 'install' / 'amr_description')}
    with Bringup(folder, 'navigation', **own) as up:
        up.expect('ready in')
        yield up


def test_every_demand_holds_for_the_stack_navigation(stack):
    found = report('--drive', *TELEOP)
    assert by_verdict(found, 'failed') == {}
    assert {*by_verdict(found, 'not checked')} == {'slam.max_laser_range', 'costmap.footprint'}
    assert found['cmd_vel.listener']['found'] == '/twist_mux on /cmd_vel_teleop'
    assert 'reach 0.345 m from base_link' in found['costmap.footprint']['found']


def test_all_but_the_command_topic_holds_for_the_robot_itself(stack):
    """Of the simulation alone: its wheels take stamped commands, elsewhere than Nav2 publishes."""
    with check(*LONG, '--ros-args', '-r', 'cmd_vel:=/nowhere') as program:
        assert program.end() == 1
        lines = program.output.split('\n')
    failed = [e for e in lines if e.startswith('FAILED') and e.split()[1] not in MACHINE]
    assert len(failed) == 1, failed
    assert 'nobody subscribes to /nowhere' in failed[0]
    assert '/diff_drive_controller on /diff_drive_controller/cmd_vel' in failed[0]
    (last,) = [e for e in lines if ' demands in ' in e]
    assert last.startswith(f'{len(RULES)} demands in ')


def test_a_namespace_without_a_robot(stack):
    with check('--duration', '1', '--ros-args', '-r', '__ns:=/nobody') as program:
        assert program.end() == 1
        assert 'nobody publishes /nobody/scan' in program.output
        assert 'nothing came on /nobody/odom, /nobody/scan' in program.output


def test_it_does_not_fight_over_the_robot(stack):
    rclpy.init(args=[])
    try:
        rival = Node('rival')  # it answers no services, as nobody spins it
        rival.create_publisher(Twist, '/cmd_vel_teleop', 1)
        with check(*LONG, '--drive', *TELEOP) as program:
            assert program.end() == 2
            assert 'FATAL' in program.output
            assert '--drive: /rival publishes commands on /cmd_vel_teleop' in program.output
            assert 'passed' not in program.output
        rival.destroy_node()
    finally:
        rclpy.try_shutdown()


def test_ctrl_c_while_it_waits(stack):
    with check(*LONG, '--ros-args', '-r', '__ns:=/nobody') as program:
        program.expect(r'waiting for /nobody/odom \(0 of 20\), /nobody/scan \(0 of 20\)')
        assert program.end(signal.SIGINT) == 130
        assert 'Traceback' not in program.output


@pytest.mark.parametrize(
    ('words', 'text'),
    [
        (['--duration', '-1'], "'-1' is not a positive number of seconds"),
        (['--duration', 'long'], "'long' is not a positive number of seconds"),
        (['--fast'], 'unrecognized arguments: --fast'),
    ],
)
def test_wrong_options(words, text):
    with check(*words) as program:
        assert program.end() == 2
        assert text in program.output
