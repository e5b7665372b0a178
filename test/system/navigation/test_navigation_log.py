# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A drive as Nav2 hears it: at each scan's stamp the transform map → lidar is known, with no
extrapolation; stamps and clock rise; odometry is that of TF.
"""

from contextlib import ExitStack
from copy import deepcopy
from dataclasses import replace
from itertools import islice

import pytest
from rclpy.time import Time
from support.navigation_log import NavigationLog
from support.paths import ROOT
from support.ros_processes import running
from support.warehouse_tour import tour

from amr_description.ros.messages import nanoseconds
from amr_description.tf2_ros.buffer import Buffer
from amr_description.tf2_ros.listener import TransformListener

URDF = ROOT / 'urdf' / 'amr_sensors.urdf.xacro'
PERIOD = 100_000_000
"""ns between scans."""
PIECES, MANY_PIECES = 40, 200
"""Tenths of a second."""

pytest_plugins = ['amr_description.testing.fixtures']


@pytest.fixture(scope='module')
def kept():
    return {}


@pytest.fixture
def log(kept, simulation):
    """The log of one drive, for all tests."""
    if not kept:
        sim = simulation(URDF, world='warehouse')
        kept['log'] = recorded(sim, PIECES)
    return deepcopy(kept['log'])


def recorded(sim, pieces):
    """Drive with the truth as localisation; in lock-step, so that nothing depends on the load."""
    log, ros = NavigationLog(), ['--ros-args', '-p', 'use_sim_time:=true']
    with ExitStack() as stack:
        stack.enter_context(running('robot_state_publisher', str(URDF), *ros, until='Robot'))
        stack.enter_context(running('truth_localizer', *ros, until='map -> odom'))
        buffer = Buffer()
        TransformListener(buffer, sim.node)

        def works():
            sim.run(0.1)
            return buffer.can_transform('map', 'lidar_link', Time())

        sim.wait(works, 'map -> lidar_link')
        stack.enter_context(log.recording(sim.node))
        heard = ('scans', 'odometry', 'clock', 'transforms', 'static_transforms')

        def is_heard():
            sim.run(0.1)
            return all(getattr(log, name) for name in heard)

        sim.wait(is_heard, 'all topics')
        # To 30 ms after a scan: a cycle of 10 ms after that of odometry, which follows the scan's.
        sim.run(0.13 - sim.time % 0.1)
        start = round(sim.time * 1e9)
        for _ in islice(tour(sim), pieces):
            scan = round(sim.time * 1e9) - 30_000_000
            # Scan by scan: queues are short, and keep what came last.
            sim.wait(lambda scan=scan: log.is_complete_at(scan), f'all of the instant {scan} ns')
    for messages in (log.scans, log.odometry):  # those before are of the beginning
        messages[:] = [each for each in messages if nanoseconds(each.header.stamp) > start]
    return log


def test_a_drive_has_no_faults(log):
    has_no_faults(log, PIECES)


@pytest.mark.long
def test_a_longer_drive_has_no_faults(simulation):
    has_no_faults(recorded(simulation(URDF, world='warehouse'), MANY_PIECES), MANY_PIECES)


def has_no_faults(log, pieces):
    assert list(log.faults(PERIOD)) == []
    assert len(log.scans) == pieces - 1
    # Of the five of a step that come at once, a subscriber of depth 1 may hear the last one only.
    assert len(log.odometry) >= len(log.scans)
    assert len(log.transforms) > 10 * len(log.scans)


def test_odometry_that_stops_is_a_fault_of_each_later_scan(log):
    middle = log.scans[len(log.scans) // 2].header.stamp
    end = Time.from_msg(middle).nanoseconds
    log.transforms = [each for each in log.transforms if each.child != 'base_footprint'
                      or each.time < end]  # fmt: skip
    faults = [fault for fault in log.faults(PERIOD) if fault.startswith('scan of')]
    assert len(faults) == len(log.scans) - len(log.scans) // 2
    assert 'extrapolation' in faults[0]


def test_a_localizer_that_is_late_is_a_fault(log):
    late = [replace(each, time=each.time - 10**12) if each.parent == 'map' else each
            for each in log.transforms]  # fmt: skip
    log.transforms = late
    assert len([fault for fault in log.faults(PERIOD) if 'extrapolation' in fault]) == len(
        log.scans
    )


def test_a_lost_scan_and_a_clock_that_goes_back_are_faults(log):
    del log.scans[5]
    log.clock.append(log.clock[0])
    faults = list(log.faults(PERIOD))
    assert sum(fault.startswith('scan of') for fault in faults) == 1
    assert sum(fault.startswith('clock of') for fault in faults) == 1


def test_a_frame_with_two_parents_and_a_stamp_that_comes_twice_are_faults(log):
    odometry = next(each for each in log.transforms if each.child == 'base_footprint')
    log.transforms.append(odometry)
    log.static_transforms.append(replace(log.static_transforms[0], parent='nowhere'))
    faults = list(log.faults(PERIOD))
    assert any(fault.startswith('base_footprint of') for fault in faults)
    assert any('nowhere' in fault for fault in faults)
