# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Graphs, clocks and commands of a healthy simulated robot, to be changed by a fault each."""

from amr_description.clock import NANOSECONDS
from amr_description.doctor.observations import Observations
from amr_description.doctor.observations.clock import Clock, ClockTick, TimeSource
from amr_description.doctor.observations.commands import (
    CommandSeen,
    ObservedCommands,
    ObservedCommandTopic,
    ObservedDrive,
)
from amr_description.doctor.observations.graph import (
    GraphNode,
    ObservedEndpoint,
    ObservedGraph,
    ObservedQos,
    ObservedTopic,
    STAMPED_TWIST,
)

CLOCK = 'rosgraph_msgs/msg/Clock'
SCAN = 'sensor_msgs/msg/LaserScan'
ODOM = 'nav_msgs/msg/Odometry'
STRING = 'std_msgs/msg/String'
NOW = 1_800_000_000 * NANOSECONDS
"""Of the system clock."""
START = 20 * NANOSECONDS
"""Of simulated time, at NOW."""
MS = 1_000_000
DRIVE = '/diff_drive_controller'
COMMANDS = f'{DRIVE}/cmd_vel'
RESUME = (
    'ros2 service call /mujoco_sim/set_simulation_state '
    'simulation_interfaces/srv/SetSimulationState "{state: {state: 1}}"'
)


def end(node, type_name=STRING, **options):
    """A publisher or a subscription."""
    return ObservedEndpoint(node=node, type_name=type_name, **options)


def topic(name, publishers=(), subscriptions=()):
    """A topic with its ends; a name alone stands for a node with a String."""
    both = (
        tuple(end(each) if isinstance(each, str) else each for each in ends)
        for ends in (publishers, subscriptions)
    )
    first, second = both
    return ObservedTopic(name=name, publishers=first, subscriptions=second)


def node(name, *, use_sim_time=True, **options):
    """A node."""
    return GraphNode(name=name, use_sim_time=use_sim_time, **options)


TOPICS = (
    topic(
        '/clock',
        [end('/mujoco_sim', CLOCK)],
        [end(DRIVE, CLOCK, qos=ObservedQos(is_reliable=False)), end('/slam', CLOCK)],
    ),
    topic(
        '/scan',
        [end('/mujoco_sim', SCAN)],
        [end('/slam', SCAN, qos=ObservedQos(is_reliable=False))],
    ),
    topic('/odom', [end(DRIVE, ODOM)], [end('/slam', ODOM)]),
    topic('/map', [end('/slam', qos=ObservedQos(is_transient_local=True))], []),
    topic(COMMANDS, [], [end(DRIVE, STAMPED_TWIST)]),
    topic('/initialpose', [], [end('/slam', 'geometry_msgs/msg/PoseWithCovarianceStamped')]),
)
NODES = (node('/mujoco_sim', use_sim_time=False), node(DRIVE), node('/slam'))


def graph(*more, nodes=NODES, but=()):
    """The graph of the robot, with further topics, or others of the same names."""
    names = {*but, *(each.name for each in more)}
    kept = tuple(each for each in TOPICS if each.name not in names)
    return ObservedGraph(topics=(*kept, *more), nodes=tuple(nodes))


def ticks(count=20, *, period=50 * MS, factor=1.0, start=START):
    """So many messages on /clock."""
    return tuple(
        ClockTick(start + round(i * period * factor), NOW + i * period) for i in range(count)
    )


def source(factor=1.0, **options):
    """The simulator."""
    fields = {
        'node': '/mujoco_sim',
        'resume': RESUME,
        'asked_factor': factor,
        'speed_parameter': 'real_time_factor',
    }
    return TimeSource(**fields | options)


def clock(**options):
    """The clock of the robot."""
    fields = {
        'publishers': ('/mujoco_sim',),
        'ticks': ticks(),
        'seconds': 1.0,
        'sources': (source(),),
    }
    return Clock(**fields | options)


def command(at=0, **options):
    """A command that came ``at`` ms."""
    fields = {
        'publisher': '/navigator',
        'age': 10 * MS,
        'is_simulated': True,
        'linear': (0.3, 0.0),
    }
    return CommandSeen(received=NOW + at * MS, **fields | options)


def each_100_ms(count=10, **options):
    """So many commands."""
    return tuple(command(i * 100, **options) for i in range(count))


def commands(*seen, publishers=('/navigator',), locks=(), **drive):
    """The commands for the robot's drive."""
    fields = {
        'node': DRIVE,
        'topics': (COMMANDS,),
        'timeout': 0.5,
        'limits': (('linear.x', -1.0, 1.0), ('angular.z', -2.0, 2.0)),
    }
    return ObservedCommands(
        topics=(
            ObservedCommandTopic(
                name=COMMANDS, publishers=publishers, subscriptions=(DRIVE,), seen=tuple(seen)
            ),
        ),
        drives=(ObservedDrive(**fields | drive),),
        locks=locks,
        seconds=2.5,
    )


def robot(**sections):
    """All that is observed of the robot; sections take the place of its own."""
    healthy = {'graph': graph(), 'clock': clock(), 'commands': commands(*each_100_ms())}
    return Observations(**healthy | sections)
