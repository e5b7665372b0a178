# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A simulator that was busy takes pushes and what ends them from several topics, in any order."""

from types import SimpleNamespace

import pytest
from rclpy.duration import Duration
from rclpy.executors import SingleThreadedExecutor
from rclpy.experimental import EventsExecutor
from rclpy.node import Node
from support.manager_host import ros_in_this_process
from support.running_programs import PATIENCE
from support.waiting import until

from amr_description.model.frames import Transform
from amr_description.sim.ros.wrench_topics import WrenchTopics
from amr_description.sim.world import MujocoWorld
from amr_description.viewer.ros.pushing import Pushing

BALL = """<robot name="ball"><link name="ball"><inertial><mass value="2"/>
  <inertia ixx="0.05" ixy="0" ixz="0" iyy="0.05" iyz="0" izz="0.05"/></inertial>
  <collision><geometry><sphere radius="0.1"/></geometry></collision></link></robot>"""
NONE = (0.0, 0.0, 0.0)


@pytest.fixture(params=[SingleThreadedExecutor, EventsExecutor])
def busy(request):
    """A viewer, a simulator whose callbacks nobody serves yet, its world, and who serves them."""
    world = MujocoWorld('empty')
    world.spawn('ball', BALL, Transform((0.0, 0.0, 50.0)))
    taken = []

    def submit(call):
        call()
        taken.append(call)

    with ros_in_this_process():
        node, viewer = Node('mujoco_sim'), Node('viewer')
        WrenchTopics(
            node, SimpleNamespace(world=world, loop_thread=SimpleNamespace(submit=submit))
        )
        executor = request.param()
        executor.add_node(node)
        yield viewer, world, taken, executor
        executor.shutdown()
        node.destroy_node()
        viewer.destroy_node()


def test_who_is_let_go_while_the_simulator_is_busy_is_not_pushed_for_ever(busy):
    viewer, world, taken, executor = busy
    pushing = Pushing(viewer, '/mujoco_sim')
    publishers = [each for each in viewer.publishers if '/wrench/' in each.topic_name]
    until(lambda: all(each.get_subscription_count() for each in publishers))
    for force in (1.0, 2.0, 3.0, 0.0):
        pushing.push('ball', 'ball', (force, 0.0, 0.0), NONE)
    acknowledged = Duration(seconds=PATIENCE)
    assert all(each.wait_for_all_acked(acknowledged) for each in publishers)
    assert taken == []
    until(lambda: executor.spin_once(timeout_sec=0.05) or len(taken) == 5)
    assert world.wrenches._lasting == {}
    pushing.destroy()
