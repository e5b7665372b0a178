# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The numbers of tf2_monitor, and how it writes them."""

import pytest

from amr_description.clock import NANOSECONDS
from amr_description.tf2_ros.statistics import DelayStatistics, TransformStatistics

NOW = 1_000 * NANOSECONDS


def test_delays_are_of_the_last_thousand():
    delays = DelayStatistics()
    assert (delays.average, delays.maximum, delays.frequency) == (0.0, 0.0, 0.0)
    delays.add(NOW, 100.0)
    assert delays.frequency == 0.0
    for tick in range(1000):
        delays.add(NOW + tick * NANOSECONDS // 50, 0.25)
    assert delays.average == delays.maximum == 0.25
    assert delays.frequency == pytest.approx(50.0)


def test_a_stamp_of_the_future_is_not_late():
    delays = DelayStatistics()
    delays.add(NOW, -1.0)
    assert (delays.average, delays.maximum) == (-1.0, 0.0)


@pytest.fixture
def statistics():
    """odom -> base at 10 Hz, 0.25 s late, and a laser on it, said 1000 s ago."""
    made = TransformStatistics()
    made.add_message('/tf_static', [('laser', 0)], NOW, static=True)
    for tick in range(11):
        now = NOW + tick * NANOSECONDS // 10
        made.add_message('/tf', [('base', now - NANOSECONDS // 4)], now, static=False)
        made.add_chain_delay(now - NANOSECONDS // 2, now)
    return made


NODES = {'/tf': ['/ekf'], '/tf_static': ['/a', '/b', '/c', '/d']}


def test_all_frames_are_reported_in_the_lines_of_tf2_monitor(statistics):
    assert statistics.report(NODES).splitlines() == [
        '',
        '',
        '',
        'RESULTS: for all Frames',
        '',
        'Frames:',
        'Frame: base, published by /ekf, Average Delay: 0.25, Max Delay: 0.25, Frequency: 10 Hz',
        'Frame: laser, published by /a or /b or /c or 1 more, Average Delay: 0, Max Delay: 0, '
        'Frequency: 0 Hz',
        '',
        'All Broadcasters:',
        'Node: /ekf 10 Hz, Average Delay: 0.25 Max Delay: 0.25',
        'Node: /a or /b or /c or 1 more 0 Hz, Average Delay: 0 Max Delay: 0',
    ]


def test_a_chain_is_reported_with_its_frames_and_its_delay(statistics):
    lines = statistics.report({}, ['odom', 'base']).splitlines()
    assert lines[3:6] == [
        'RESULTS: for odom to base',
        'Chain is: odom -> base',
        'Net delay     avg = 0.5: max = 0.5',
    ]
    frames = [line for line in lines if line.startswith('Frame: ')]
    assert len(frames) == 1
    assert frames[0].startswith('Frame: base, published by <no authority available>, Average')


def test_a_static_chain_is_not_late():
    statistics = TransformStatistics()
    statistics.add_chain_delay(0, NOW)
    assert 'avg = 0: max = 0' in statistics.report({}, ['base', 'laser'])


def test_another_clock_is_reported():
    statistics = TransformStatistics()
    statistics.add_message(
        '/tf', [('base', 5 * NANOSECONDS)], 1_700_000_000 * NANOSECONDS, static=False
    )
    assert statistics.report({}).endswith('add --ros-args -p use_sim_time:=true')
