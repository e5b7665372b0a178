# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What is heard of real topics, good and broken ones, by real DDS."""

import time

from geometry_msgs.msg import TwistStamped
import pytest
import rclpy
from rclpy.node import Node
from rosgraph_msgs.msg import Clock
from std_msgs.msg import String
from support.contract_graph import (
    clock,
    MS,
    Nodes,
    Plan,
    Robot,
    START,
    transforms,
)
from tf2_msgs.msg import TFMessage

from amr_description.navigation.contract.findings import CheckVerdict
from amr_description.navigation.contract.frame_rules import TF_TIMEOUT
from amr_description.navigation.contract.observations import ContractFrames
from amr_description.navigation.contract.rules import examine
from amr_description.navigation.ros.contract.collector import Collector
from amr_description.ros.service_calls import wait_until

LOCK_STEP = 'time.real_time_factor'
"""It is what the machine gives."""


@pytest.fixture
def collector():
    rclpy.init(args=[])
    node = Node('check_navigation')
    try:
        yield Collector(node, ContractFrames(), is_stamped=False)
    finally:
        node.destroy_node()  # else it stays in the graph, for the tests that come
        rclpy.try_shutdown()


@pytest.fixture
def nodes():
    made = Nodes()
    yield made
    made.end()


def findings(collector):
    """Each demand's finding, once all nodes have answered and no scan can still be looked up."""
    last = time.time_ns()

    def is_known():
        collector.awaited()
        seen = collector.observations()
        has_all = '/robot' in seen.use_sim_time and seen.body is not None
        return has_all and seen.ended > last + TF_TIMEOUT

    wait_until(collector.node, lambda: is_known() or None, of_message=True)
    found = {each.name: each for each in examine(collector.observations())}
    found.pop(LOCK_STEP)
    return found


def failed(found):
    return {name for name, each in found.items() if each.verdict is CheckVerdict.FAILED}


def test_a_good_robot(collector, nodes):
    Robot(collector, nodes).run(1.0)
    found = findings(collector)
    assert failed(found) == set()
    unknown = {name for name, each in found.items() if each.verdict is CheckVerdict.NOT_CHECKED}
    assert unknown == {
        'odom.twist',
        'slam.max_laser_range',
        'drive.linear',
        'drive.angular',
        'drive.braking',
        'drive.progress',
        'costmap.footprint',
        'map.initial_pose',
        'map.to_odom',
    }
    assert found['clock.rate'].found == '100.0 Hz by /simulator'
    assert found['tf.rate'].found == '50.0 Hz of 50 transforms'
    assert found['scan.published'].found == '10 scans of /robot, reliable'
    assert found['map.published'].found == "3 x 2 cells of 0.05 m in 'map' by /robot"
    assert found['scan.ranges'].found == 'of 3600 ranges 3500 are hits, 100 +inf'


BROKEN = {
    'clock.rate': (Plan(tick=20), {'clock.rate'}, '50.0 Hz'),
    'tf.rate': (Plan(tf_period=100, odom_period=50), {'tf.rate'}, '10.0 Hz'),
    'tf.order': (
        Plan(tf_repeats=True),
        {'tf.order', 'tf.rate', 'tf.at_scans'},
        'not later than the one before',
    ),
    'tf.frames': (
        Plan(static=(('base_footprint', 'laser'),)),
        {'tf.frames'},
        'no base_link; there are',
    ),
    'odom.qos': (Plan(odom_is_reliable=False), {'odom.qos'}, '/robot publishes by best effort'),
    'odom.qos of another type': (
        Plan(odom_type=String),
        {'odom.qos'},
        '/robot publishes std_msgs/msg/String',
    ),
    'odom.rate': (Plan(odom_period=100), {'odom.rate'}, '10.0 Hz'),
    'odom.frames': (Plan(child_frame='wheel'), {'odom.frames'}, "'odom' → 'wheel'"),
    'odom.covariance': (Plan(variance=0.0), {'odom.covariance'}, 'not above 0: x, y, yaw'),
    'scan.rate': (Plan(scan_period=20), {'scan.rate'}, '50.0 Hz'),
    'scan.frame': (
        Plan(scan_frame='elsewhere'),
        {'scan.frame', 'tf.at_scans'},
        "'elsewhere' is not below",
    ),
    'scan.length': (Plan(scan_count=361), {'scan.length'}, '361 ranges'),
    'scan.ranges': (Plan(far=0.0), {'scan.ranges'}, 'are finite and below range_min'),
    'scan.ranges of the largest': (Plan(far=11.0), {'scan.ranges'}, 'above range_max'),
    'scan.geometry': (Plan(scan_varies=True), {'scan.geometry'}, "range_max of 'laser' is"),
    'scan.age': (Plan(scan_lag=400), {'scan.age'}, '400 ms at most'),
    'tf.at_scans': (
        Plan(scan_lag=-5000),
        {'scan.age', 'tf.at_scans'},
        'extrapolation into the future',
    ),
    'scan.range_max': (Plan(range_max=2.0), {'scan.range_max'}, 'range_max 2 m'),
    'cmd_vel.type': (Plan(command_type=TwistStamped), {'cmd_vel.type'}, '/robot subscribes to'),
    'cmd_vel.listener': (Plan(command_type=String), {'cmd_vel.listener'}, 'std_msgs/msg/String'),
    'map.published': (Plan(map_is_latched=False), {'map.published'}, '/robot does not publish it'),
    'time.use_sim_time': (Plan(use_sim_time=False), {'time.use_sim_time'}, 'false in /robot'),
}


@pytest.mark.parametrize('fault', BROKEN)
def test_a_demand_fails_on_a_graph_that_breaks_it(collector, nodes, fault):
    plan, expected, text = BROKEN[fault]
    Robot(collector, nodes, plan).run()
    found = findings(collector)
    assert failed(found) == expected
    assert text in found[fault.split()[0]].found


def test_two_clocks(collector, nodes):
    robot = Robot(collector, nodes)
    bag = nodes.make('bag').create_publisher(Clock, '/clock', 10)
    robot.run(0.3, lambda _: robot.say(bag, '/clock', clock(START - 5000 * MS)))
    found = findings(collector)
    assert {'clock.publishers', 'clock.order'} <= failed(found)
    assert '/bag' in found['clock.publishers'].found


def test_two_nodes_publish_the_odometry_as_a_transform(collector, nodes):
    robot = Robot(collector, nodes)
    ekf = nodes.make('ekf').create_publisher(TFMessage, '/tf', 10)

    def fight(robot):
        later = transforms(robot.time + MS, ('odom', 'base_footprint'))
        robot.say(ekf, '/tf', later)

    robot.run(0.3, fight)
    found = findings(collector)
    assert failed(found) == {'tf.one_parent'}
    assert 'base_footprint is published in odom by two nodes' in found['tf.one_parent'].found
    assert '/ekf' in found['tf.one_parent'].found


def test_a_base_with_two_parents(collector, nodes):
    robot = Robot(collector, nodes)
    wrong = transforms(START, ('odom', 'base_link'))
    robot.run(0.3, lambda _: robot.say(robot.tf, '/tf', wrong))
    found = findings(collector)
    assert 'tf.one_parent' in failed(found)
    assert 'static in base_footprint and dynamic in odom' in found['tf.one_parent'].found


def test_a_reset_begins_anew(collector, nodes):
    robot = Robot(collector, nodes)
    robot.run(0.3)
    robot.time = 0
    robot.say(robot.clock, '/clock', clock(0))
    assert collector.counts == {'/clock': 1, '/tf': 0, 'odom': 0, 'scan': 0}
    robot.run(0.7)
    found = findings(collector)
    assert failed(found) == set()
    assert found['clock.order'].found.endswith('the simulation was reset 1 times meanwhile')


def test_nothing_at_all(collector):
    found = {each.name: each for each in examine(collector.observations())}
    assert failed(found) == {
        'tf.frames',
        'tf.odometry',
        'odom.qos',
        'scan.published',
        'cmd_vel.listener',
    }
    assert found['scan.published'].found == 'nobody publishes /scan'


def test_a_node_that_does_not_answer_is_not_waited_for(collector, nodes):
    """Nobody spins it."""
    mute = Node('mute', context=nodes.context)
    Robot(collector, nodes).run(2.2)
    wait_until(collector.node, lambda: not collector.awaited() or None, of_message=True)
    seen = collector.observations()
    mute.destroy_node()
    assert '/mute' in seen.silent_nodes  # and maybe nodes of an earlier test, just gone
    assert seen.use_sim_time['/robot'] is True
