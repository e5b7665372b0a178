# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Rules about time: clocks that have the fault, and ones that have not."""

from dataclasses import replace

import pytest
from support.doctor_graphs import (
    CLOCK,
    clock,
    DRIVE,
    end,
    graph,
    MS,
    node,
    NODES,
    NOW,
    ODOM,
    RESUME,
    robot,
    source,
    START,
    ticks,
    topic,
)

from amr_description.clock import NANOSECONDS
from amr_description.doctor.observations.clock import ClockTick, StampSeen
from amr_description.doctor.rules import clock as rules

HOUR = 3600 * NANOSECONDS


def found(seen):
    return [finding for rule in rules.RULES for finding in rule(seen)]


def stamp(lead=-10 * MS, *, of=START, name='/scan'):
    """A message that is stamped ``lead`` ahead of a clock, and received at NOW."""
    return StampSeen(topic=name, publishers=('/lidar',), stamp=of + lead, received=NOW, time=START)


REAL = graph(
    nodes=[node('/drive', use_sim_time=False), node('/slam', use_sim_time=False)], but=['/clock']
)
WAITING = graph(topic('/clock', [], [end('/slam', CLOCK)]))
FORTH = ticks()
BACK = (*FORTH, *(ClockTick(t.time - NANOSECONDS // 2, t.received + NANOSECONDS) for t in FORTH))
LATE = replace(stamp(), time=None, stamp=NOW - HOUR)

FAULTS = {
    'two_clocks': (
        {
            'clock': clock(publishers=('/mujoco_sim', '/rosbag2_player')),
            'graph': graph(
                topic(
                    '/clock',
                    [end('/mujoco_sim', CLOCK), end('/rosbag2_player', CLOCK)],
                    [end('/slam', CLOCK)],
                )
            ),
        },
        '2 publishers of /clock: /mujoco_sim, /rosbag2_player',
        'end all but one',
    ),
    'no_clock': (
        {'clock': clock(publishers=(), ticks=()), 'graph': WAITING},
        f'use_sim_time is true in {DRIVE}, /slam, and nobody publishes /clock',
        f'ros2 param set {DRIVE} use_sim_time false',
    ),
    'clock_goes_back': (
        {'clock': clock(ticks=BACK)},
        '/clock goes back from 20.9 s to 19.5 s; it is published by /mujoco_sim',
        'without --loop',
    ),
    'mixed_use_sim_time': (
        {
            'graph': graph(
                topic('/odom', [end('/ekf', ODOM)], [end('/slam', ODOM)]),
                nodes=[*NODES, node('/ekf', use_sim_time=False)],
            )
        },
        'use_sim_time is false in /ekf, though /mujoco_sim publishes /clock and 2 other nodes use',
        'ros2 param set /ekf use_sim_time true',
    ),
    'stamps_of_another_clock': (
        {'clock': clock(stamps=(stamp(), stamp(of=NOW)))},
        '/lidar stamps /scan by the system clock, but /clock is at 20 s',
        'ros2 param set /lidar use_sim_time true',
    ),
    'stamps_of_another_clock that is neither': (
        {'clock': clock(stamps=(stamp(HOUR), stamp(HOUR, name='/points')))},
        '/lidar stamps /scan, /points 3.6e+03 s ahead of /clock',
        'self.get_clock().now()',
    ),
    'stamps_of_another_clock of a real robot': (
        {'clock': clock(publishers=(), ticks=(), stamps=(LATE,)), 'graph': REAL},
        '/lidar stamps /scan 3.6e+03 s behind of the system clock here',
        'chronyc makestep',
    ),
    'stamps_of_another_clock of a bag of long ago': (
        {
            'clock': clock(
                publishers=(), ticks=(), stamps=(replace(LATE, publishers=('/rosbag2_player',)),)
            ),
            'graph': REAL,
        },
        '/rosbag2_player stamps /scan 3.6e+03 s behind of the system clock here',
        'play the bag with --clock 100, and start what hears it with -p use_sim_time:=true',
    ),
    'stamps_of_another_clock of a bag': (
        {
            'clock': clock(publishers=(), ticks=(), stamps=(replace(stamp(), time=None),)),
            'graph': REAL,
        },
        '/lidar stamps /scan 20 s, a simulated time, but nobody publishes /clock',
        'ros2 param set /lidar use_sim_time false, or play its bag with --clock',
    ),
    'standing_clock': (
        {'clock': clock(ticks=ticks(factor=0.0))},
        '/clock stands still at 20 s',
        RESUME,
    ),
    'standing_clock that is silent': (
        {'clock': clock(ticks=(), seconds=2.0, sources=())},
        'nothing comes on /clock from /mujoco_sim',
        'let /mujoco_sim go on',
    ),
    'slow_simulation': (
        {'clock': clock(ticks=ticks(factor=0.31), sources=(source(report='physics 80%'),))},
        'the real-time factor is 0.31 instead of 1; /mujoco_sim: physics 80%',
        'ros2 param set /mujoco_sim real_time_factor 0.27, or simulate less',
    ),
}


@pytest.mark.parametrize('fault', FAULTS)
def test_a_fault_is_found_and_nothing_else(fault):
    sections, what, fix = FAULTS[fault]
    (finding,) = found(robot(**sections))
    assert finding.rule == fault.split()[0]
    assert what in finding.what
    assert fix in finding.fix


HEALTHY = {
    'a simulated robot': {},
    'a real robot': {
        'clock': clock(publishers=(), ticks=(), sources=(), stamps=(replace(LATE, stamp=NOW),)),
        'graph': REAL,
    },
    'a clock that nobody follows yet': {
        'clock': clock(publishers=(), ticks=()),
        'graph': graph(but=['/clock']),
    },
    'a clock of which nothing was heard yet': {'clock': clock(ticks=(), seconds=0.2)},
    'a reset': {'clock': clock(ticks=(*ticks(), *ticks(start=0)))},
    'stamps of zero': {'clock': clock(stamps=(stamp(0, of=0),))},
    'a node on the system clock that stamps nothing': {
        'graph': graph(nodes=[*NODES, node('/web', use_sim_time=False)])
    },
    'one that follows /clock by a subscription of its own': {
        'graph': graph(
            topic('/clock', [end('/mujoco_sim', CLOCK)], [end('/viewer', CLOCK)]),
            topic('/odom', [end(DRIVE, ODOM)], [end('/viewer', ODOM)]),
            nodes=[*NODES, node('/viewer', use_sim_time=False)],
        )
    },
    'bridges and recorders, which pass on stamps as they are': {
        'graph': graph(
            topic('/odom', [end('/ros_gz_bridge_2', ODOM)], [end('/rosbag2_recorder', ODOM)]),
            nodes=[
                *NODES,
                node('/ros_gz_bridge_2', use_sim_time=False),
                node('/rosbag2_recorder', use_sim_time=False),
            ],
        )
    },
    'a simulator that was started again, after it was killed': {
        'clock': clock(publishers=('/mujoco_sim', '/mujoco_sim'))
    },
    'as fast as possible': {'clock': clock(ticks=ticks(factor=9.0), sources=(source(0.0),))},
    'a factor of another simulator': {'clock': clock(ticks=ticks(factor=0.1), sources=())},
    'a factor that is kept': {'clock': clock(ticks=ticks(factor=0.2), sources=(source(0.2),))},
    'too short a time for a factor': {'clock': clock(ticks=ticks(3, period=MS, factor=0.1))},
}


@pytest.mark.parametrize('case', HEALTHY)
def test_what_looks_like_a_fault_and_is_none(case):
    assert found(robot(**HEALTHY[case])) == []
