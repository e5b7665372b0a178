# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Made-up observations of a robot with which Nav2 and slam_toolbox find nothing wrong."""

from dataclasses import replace
import math

from amr_description.clock import NANOSECONDS
from amr_description.model.frames import Transform
from amr_description.navigation.contract.observations import (
    Body,
    ContractEndpoint,
    ContractObservations,
    ContractTopic,
    GRID_TYPE,
    MapSeen,
    ODOMETRY_TYPE,
    OdometrySeen,
    Phase,
    POSE_TYPE,
    RangeCounts,
    SCAN_TYPE,
    ScanGeometry,
    ScanSeen,
    Tick,
    TransformSeen,
    TWIST_TYPE,
)

MS = NANOSECONDS // 1000
START = 100 * NANOSECONDS
"""Simulated, of the first message."""
WALL = 1_800_000_000 * NANOSECONDS
"""On the system clock, of its reception."""
LAG = MS
"""Of every message on its way."""
CLOCK, TF, GRID = 'rosgraph_msgs/msg/Clock', 'tf2_msgs/msg/TFMessage', GRID_TYPE
GEOMETRY = ScanGeometry(-math.pi, math.pi - math.radians(1.0), math.radians(1.0), 0.1, 12.0, 360)
VARIANCES = (0.001, 0.001, 0.01, 0.001, 0.01)


def received(stamp):
    return WALL + stamp - START + LAG


def instants(period, seconds=2.0):
    return range(START, START + round(seconds * NANOSECONDS), period)


def ticks(period=10 * MS, factor=1.0):
    """The clock, from before the first message until after the last."""
    times = range(START - 10 * MS, START + 2 * NANOSECONDS + 50 * MS, period)
    return tuple(Tick(t, WALL + round((t - START) / factor)) for t in times)


def moving(parent='odom', child='base_footprint', period=20 * MS, sequence=1):
    return tuple(
        TransformSeen(parent, child, t, received(t), sequence=sequence + place)
        for place, t in enumerate(instants(period))
    )


def static(parent, child, x=0.0):
    return TransformSeen(parent, child, 0, WALL - NANOSECONDS, True, Transform((x, 0.0, 0.0)))


STATIC = (static('base_footprint', 'base_link'), static('base_link', 'lidar_link', 0.1))


def odometry(period=20 * MS, speed=0.5, turn=0.0, seconds=2.0, **changes):
    """A straight way, in the direction of 1 rad."""
    found = []
    for t in instants(period, seconds):
        way = speed * (t - START) / NANOSECONDS
        pose = (way * math.cos(1.0), way * math.sin(1.0), 1.0)
        each = OdometrySeen(
            t, received(t), 'odom', 'base_footprint', *pose, (speed, 0.0), turn, VARIANCES
        )
        found.append(replace(each, **changes))
    return tuple(found)


def scans(period=100 * MS, geometry=GEOMETRY, frame='lidar_link', **changes):
    counts = RangeCounts(hits=geometry.count - 10, infinite=10)
    return tuple(
        replace(ScanSeen(t, received(t), frame, geometry, counts, wait=0), **changes)
        for t in instants(period)
    )


def phase(linear, angular, top=None, brakes=0.6):
    """From rest to speed in 1 s, held for 1 s; it stands ``brakes`` s after the last command."""
    found = []
    top = max(linear, angular) if top is None else top
    way = 0.0
    ceased = START + 2 * NANOSECONDS
    for t in instants(20 * MS, 6.0):
        after = (t - ceased) / NANOSECONDS
        ratio = min(1.0, (t - START) / NANOSECONDS) if after < 0 else float(after < brakes)
        speed = top * ratio
        way += speed * 0.02 if linear else 0.0
        velocity = ((speed, 0.0), 0.0) if linear else ((0.0, 0.0), speed)
        found.append(
            OdometrySeen(
                t, received(t), 'odom', 'base_footprint', way, 0.0, 0.0, *velocity, VARIANCES
            )
        )
    return Phase(linear, angular, START, ceased, tuple(found))


def topic(name, type_name, publisher='', subscriber='', **qos):
    publishers = (ContractEndpoint(publisher, type_name, **qos),) if publisher else ()
    subscriptions = (ContractEndpoint(subscriber, type_name),) if subscriber else ()
    return ContractTopic(name, publishers, subscriptions)


def good_robot(**changes):
    """A robot that is driven, localised, and has Nav2 and slam_toolbox beside it."""
    grid = topic('/map', GRID, '/map_server', is_latched=True)
    transforms = sorted(
        (*STATIC, *moving(), *moving('base_link', 'wheel', 10 * MS), *moving('map', 'odom')),
        key=lambda each: each.received,
    )
    seen = ContractObservations(
        clock=topic('/clock', CLOCK, '/sim'),
        tf=topic('/tf', TF, '/drive'),
        odom=topic('/odom', ODOMETRY_TYPE, '/drive'),
        scan=topic('/scan', SCAN_TYPE, '/sim'),
        cmd_vel=topic('/cmd_vel', TWIST_TYPE, '/velocity_smoother', '/drive'),
        map=grid,
        initial_pose=topic('/initialpose', POSE_TYPE, subscriber='/amcl'),
        seconds=2.0,
        ticks=ticks(),
        transforms=tuple(transforms),
        odometry=odometry(),
        scans=scans(),
        map_seen=MapSeen('map', 100, 80, 0.05, 8000),
        body=Body(frozenset({'wheel'}), 0.2, ((0.2, 0.1), (-0.2, 0.1), (-0.2, -0.1), (0.2, -0.1))),
        use_sim_time={'/drive': True, '/robot_state_publisher': True},
        parameters={
            '/slam_toolbox': {'max_laser_range': 12.0},
            '/local_costmap/local_costmap': {'robot_radius': 0.22, 'footprint': '[]'},
        },
        drive=(phase(0.5, 0.0), phase(0.0, 2.0)),
    )
    return replace(seen, **changes)
