# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Rules about velocity commands: commands that have the fault, and ones that have not."""

from dataclasses import replace
import math

import pytest
from support.doctor_graphs import (
    clock,
    command,
    COMMANDS,
    commands,
    DRIVE,
    each_100_ms,
    MS,
    NOW,
    robot,
    ticks,
)

from amr_description.clock import NANOSECONDS
from amr_description.doctor.observations.commands import StopLock
from amr_description.doctor.rules import commands as rules

BOTH = ('/navigator', '/teleop')
SLOW = tuple(command(i * 1000) for i in range(3))
FIGHT = tuple(
    each
    for i in range(5)
    for each in (command(i * 100), command(i * 100 + 50, publisher='/teleop', linear=(-0.3, 0.0)))
)
HELD = tuple(
    replace(each, linear=(0.0, 0.0)) if each.publisher == '/teleop' else each for each in FIGHT
)

FAULTS = {
    'engaged_stop': (
        commands(locks=(StopLock(topic='/emergency_stop', holders=('/viewer',), is_locked=True),)),
        '/emergency_stop is true, published by /viewer',
        "ros2 topic pub --once /emergency_stop std_msgs/msg/Bool '{data: false}'",
    ),
    'commands_not_finite': (
        commands(*each_100_ms(9), command(900, linear=(math.nan, 0.0))),
        f'1 of 10 commands on {COMMANDS} by /navigator are no numbers',
        'send 0.0 instead',
    ),
    'commands_of_another_clock': (
        commands(*each_100_ms(age=20 * NANOSECONDS - NOW)),
        f'/navigator stamps commands on {COMMANDS} 1.8e+09 s ahead of /clock',
        'ros2 param set /navigator use_sim_time true',
    ),
    'commands_of_another_clock of a real robot': (
        commands(*each_100_ms(age=NOW, is_simulated=False)),
        'behind the system clock',
        'ros2 param set /navigator use_sim_time false',
    ),
    'commands_too_old': (
        commands(*each_100_ms(age=730 * MS)),
        f'on {COMMANDS} are stamped 0.73 s ago or more, and {DRIVE} takes none older than 0.5 s',
        f'set cmd_vel_timeout: 0.9 in {DRIVE}',
    ),
    'contending_commands': (
        commands(*FIGHT, publishers=BOTH),
        f'2 publishers command {DRIVE} on {COMMANDS} at once: /navigator, /teleop',
        f'-r cmd_vel_out:={COMMANDS}',
    ),
    'commands_too_seldom': (
        commands(*SLOW),
        f'sends a command on {COMMANDS} every 1 s, and {DRIVE} brakes 0.5 s after each',
        f'ros2 topic pub --rate 4, or a timer of 250 ms; or set cmd_vel_timeout: 2 in {DRIVE}',
    ),
    'commands_beyond_limits': (
        commands(*each_100_ms(linear=(1.5, 0.0))),
        f'commands linear.x 1.5 m/s on {COMMANDS}, and {DRIVE} is limited to 1 m/s',
        f'command 1 m/s at most, or set linear.x.max_velocity: 1.5 in {DRIVE}',
    ),
    'commands_beyond_limits backwards': (
        commands(*each_100_ms(linear=(0.0, 0.0), angular=-3.0)),
        f'commands angular.z -3 rad/s on {COMMANDS}, and {DRIVE} is limited to -2 rad/s',
        f'set angular.z.min_velocity: -3 in {DRIVE}',
    ),
}


def found(seen):
    return [finding for rule in rules.RULES for finding in rule(seen)]


@pytest.mark.parametrize('fault', FAULTS)
def test_a_fault_is_found_and_nothing_else(fault):
    seen, what, fix = FAULTS[fault]
    (finding,) = found(robot(commands=seen))
    assert finding.rule == fault.split()[0]
    assert what in finding.what
    assert fix in finding.fix


HEALTHY = {
    'commands': commands(*each_100_ms()),
    'none at all': commands(),
    'a lock that is released': commands(
        locks=(StopLock(topic='/emergency_stop', holders=('/viewer',), is_locked=False),)
    ),
    'no stamps': commands(*each_100_ms(age=None)),
    'some that are late': commands(*each_100_ms(9), command(900, age=730 * MS)),
    'late ones for a drive without a time-out': commands(*each_100_ms(age=730 * MS), timeout=0.0),
    'seldom ones for a drive without a time-out': commands(*SLOW, timeout=0.0),
    'seldom ones, for standing': commands(
        *(command(i * 1000, linear=(0.0, 0.0)) for i in range(3))
    ),
    'a drive whose time-out is not known': commands(*SLOW, timeout=None),
    'two publishers, of which one is silent': commands(*each_100_ms(), publishers=BOTH),
    'two, one after the other': commands(
        *each_100_ms(3), *(command(1000 + i * 100, publisher='/teleop') for i in range(3))
    ),
    'one that holds the robot at rest': commands(*HELD, publishers=BOTH),
    'one that holds the robot at rest, and was heard first': commands(
        *(replace(each, received=each.received + 2000 * MS) for each in HELD[1::2]),
        *(replace(each, received=each.received + 2000 * MS) for each in HELD[::2]),
        publishers=BOTH,
    ),
    'a peak above the limit': commands(*each_100_ms(9), command(900, linear=(1.5, 0.0))),
    'a drive without limits': commands(*each_100_ms(linear=(9.0, 0.0)), limits=()),
}


@pytest.mark.parametrize('case', HEALTHY)
def test_what_looks_like_a_fault_and_is_none(case):
    assert found(robot(commands=HEALTHY[case])) == []


def test_seldom_goes_by_simulated_time():
    """At factor 0.2 a second is 0.2 s of the controller's time."""
    slow = clock(ticks=ticks(factor=0.2))
    assert found(robot(commands=commands(*SLOW), clock=slow)) == []


def test_commands_that_no_drive_takes_are_not_judged():
    """A mux may be between, whose time-out is its own."""
    assert found(robot(commands=commands(*SLOW, *FIGHT, topics=('/elsewhere',)))) == []


def test_a_fix_names_no_node_whose_name_is_not_known():
    seen = commands(*each_100_ms(age=20 * NANOSECONDS - NOW), publishers=('a node',))
    (finding,) = found(robot(commands=seen))
    assert finding.fix.startswith('ros2 param set NODE use_sim_time true')
