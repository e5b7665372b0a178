# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A robot's topics, published in lock-step with a collector: each message is heard before the next.

So stamps and orders are exact on the busiest machine; only the real-time factor is what it is.
Robots are in a context of their own: one participant of DDS has no topic with two types.
"""

from dataclasses import dataclass
import math
import threading

from geometry_msgs.msg import Twist
from nav_msgs.msg import OccupancyGrid, Odometry
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import LaserScan
from std_msgs.msg import String
from support.serving import serve
from tf2_msgs.msg import TFMessage

from amr_description.model.frames import Transform
from amr_description.ros.messages import fill_stamp
from amr_description.ros.qos import LATCHED
from amr_description.ros.runtime import end_wait
from amr_description.ros.service_calls import wait_until
from amr_description.tf2_ros.buffer import transform_message
from amr_description.tf2_ros.time_cache import StampedTransform

MS = 1_000_000
START = 50_000 * MS
BEST_EFFORT = QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)
DESCRIPTION = '<robot name="r"><link name="base_footprint"/></robot>'


@dataclass(frozen=True)
class Plan:
    """What a robot publishes; as it stands, there is nothing wrong with it."""

    tick: int = 10
    """ms between two ticks; other periods are ms, too."""
    tf_period: int = 20
    tf_repeats: bool = False
    """The stamps of transforms stay the same."""
    odom_period: int = 20
    odom_is_reliable: bool = True
    odom_type: type = Odometry
    child_frame: str = 'base_footprint'
    variance: float = 0.01
    scan_period: int = 100
    scan_frame: str = 'laser'
    scan_lag: int = 0
    """ms from the measurement to the message."""
    scan_count: int = 360
    scan_varies: bool = False
    far: float = math.inf
    """m: the range where nothing is met."""
    range_max: float = 10.0
    static: tuple[tuple[str, str], ...] = (
        ('base_footprint', 'base_link'),
        ('base_link', 'laser'),
    )
    command_type: type = Twist
    map_is_latched: bool = True
    use_sim_time: bool = True


class Nodes:
    """Nodes in a context of their own, whose services a thread answers."""

    def __init__(self):
        self.context = rclpy.Context()
        rclpy.init(args=[], context=self.context)
        self.executor = SingleThreadedExecutor(context=self.context)
        self.nodes = []
        self.ended = threading.Event()
        self.thread = threading.Thread(target=serve, args=(self.executor, self.ended.is_set))
        self.thread.start()

    def make(self, name, *, use_sim_time=True):
        parameters = [Parameter('use_sim_time', value=use_sim_time)]
        node = Node(name, context=self.context, parameter_overrides=parameters)
        self.nodes.append(node)
        self.executor.add_node(node)
        end_wait(self.executor)
        return node

    def end(self):
        self.ended.set()
        end_wait(self.executor)
        self.thread.join()
        self.executor.shutdown()
        for node in self.nodes:
            node.destroy_node()
        rclpy.try_shutdown(context=self.context)


class Robot:
    """A node ``/robot`` that publishes to a plan; others may fight it."""

    def __init__(self, collector, nodes, plan=Plan()):
        self.collector, self.plan = collector, plan
        self.node = nodes.make('robot', use_sim_time=plan.use_sim_time)
        # Who publishes the clock is not asked for use_sim_time.
        self.simulator = nodes.make('simulator')
        make = self.node.create_publisher
        self.clock = self.simulator.create_publisher(Clock, '/clock', 10)
        self.tf = make(TFMessage, '/tf', 100)
        self.static = make(TFMessage, '/tf_static', LATCHED)
        self.odom = make(plan.odom_type, '/odom', 10 if plan.odom_is_reliable else BEST_EFFORT)
        self.scan = make(LaserScan, '/scan', 10)
        self.map = make(OccupancyGrid, '/map', LATCHED if plan.map_is_latched else 1)
        self.description = make(String, '/robot_description', LATCHED)
        self.node.create_subscription(plan.command_type, '/cmd_vel', lambda _: None, 10)
        self.time = START
        self.static.publish(transforms(0, *plan.static))
        self.description.publish(String(data=DESCRIPTION))
        self.map.publish(grid())

    def wait(self, condition):
        wait_until(self.collector.node, lambda: condition() or None, of_message=True)

    def say(self, publisher, topic, message, *, has_subscribers=True):
        """Publish, and wait until the collector has heard it."""
        name = publisher.topic_name
        (heard,) = (s for s in self.collector.node.subscriptions if s.topic_name == name)
        count = self.node.count_publishers(name)
        # Either side finds the other by itself, one perhaps later.
        self.wait(lambda: publisher.get_subscription_count() or not has_subscribers)
        self.wait(lambda: heard.get_publisher_count() >= count or not has_subscribers)
        before = self.collector.counts[topic]
        publisher.publish(message)
        self.wait(lambda: self.collector.counts[topic] != before or not has_subscribers)

    def run(self, seconds=0.7, each_cycle=lambda robot: None):
        """Publish what is due in a span of simulated time."""
        plan = self.plan
        self.wait(lambda: self.collector.observations().transforms)  # those of /tf_static
        for _ in range(round(seconds * 1000 / plan.tick)):
            at = (self.time - START) // MS
            self.say(self.clock, '/clock', clock(self.time))
            if at % plan.tf_period == 0:
                stamp = START if plan.tf_repeats else self.time
                self.say(self.tf, '/tf', transforms(stamp, ('odom', 'base_footprint')))
            if at % plan.odom_period == 0:
                hears = plan.odom_type is Odometry and plan.odom_is_reliable
                self.say(self.odom, 'odom', self.odometry(), has_subscribers=hears)
            each_cycle(self)
            if at % plan.scan_period == 0:
                self.say(self.scan, 'scan', self.laser_scan())
            self.time += plan.tick * MS
        self.say(self.clock, '/clock', clock(self.time))

    def odometry(self):
        message = self.plan.odom_type()
        if isinstance(message, Odometry):
            fill_stamp(self.time, message.header.stamp)
            message.header.frame_id, message.child_frame_id = 'odom', self.plan.child_frame
            message.pose.covariance = message.twist.covariance = [self.plan.variance] * 36
        return message

    def laser_scan(self):
        plan, message = self.plan, LaserScan()
        fill_stamp(self.time - plan.scan_lag * MS, message.header.stamp)
        message.header.frame_id = plan.scan_frame
        message.angle_min, message.angle_max = -math.pi, math.pi - math.radians(1.0)
        message.angle_increment = math.radians(1.0)
        message.range_min, message.range_max = 0.1, plan.range_max
        if plan.scan_varies:
            message.range_max += (self.time - START) / MS
        message.ranges = [1.0] * (plan.scan_count - 10) + [plan.far] * 10
        return message


def clock(time):
    message = Clock()
    fill_stamp(time, message.clock)
    return message


def transforms(time, *pairs, x=0.0):
    pose = Transform((x, 0.0, 0.0))
    return TFMessage(
        transforms=[transform_message(StampedTransform(*pair, time, pose)) for pair in pairs]
    )


def grid():
    message = OccupancyGrid()
    message.header.frame_id = 'map'
    message.info.width, message.info.height, message.info.resolution = 3, 2, 0.05
    message.data = [0] * 6
    return message
