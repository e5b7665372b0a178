# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Extreme numbers in the parameters of nodes: refused in one line, or harmless."""

import math

from fixtures.sim.driving import AMR
import pytest
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from support.manager_host import ros_in_this_process

from amr_description.clock import NANOSECONDS
from amr_description.control.manager_parameters import CommonParameters, ManagerTable
from amr_description.control.ros.loop_publisher import ClockedLoopPublisher, NodeTopics
from amr_description.control.ros.loop_thread import CallQueue, LoopThread
from amr_description.control.ros.node_parameters import NodeParameters
from amr_description.control.ros.pacing import WallPacer
from amr_description.control.ros.status_topics import DiagnosticsTopic
from amr_description.controller_manager.parameters import ManagerParameters
from amr_description.controllers.drives.diff_drive_controller import DiffDriveParameters
from amr_description.errors import AmrError, ParameterError
from amr_description.log import null_log
from amr_description.nodes.joint_state_publisher import (
    JointStatePublisher,
    JointStatePublisherSettings,
)
from amr_description.nodes.robot_state_publisher import (
    RobotStatePublisher,
    RobotStatePublisherSettings,
)
from amr_description.nodes.teleop_twist_keyboard import KeyboardDriver, node as teleop
from amr_description.nodes.viewer import ViewerSettings
from amr_description.parameters import build, specs
from amr_description.ros.parameters import declare, declare_missing
from amr_description.ros.runtime import argument_errors
from amr_description.sim.world import MujocoWorld
from amr_description.simulation.parameters import SimulationParameters
from amr_description.simulation.topics.ground_truth import GroundTruth

FLOATS = (1e300, 1e-300, -1e300, -1e-300, 5e-324, math.inf, -math.inf, math.nan, 0.0)
INTEGERS = (2**63 - 1, -(2**63), 2**31, -1, 0)


@pytest.fixture(scope='module', autouse=True)
def ros():
    with ros_in_this_process():
        yield


def extremes(table):
    """Return the numeric parameters of a table, each with extreme numbers: (name, value)."""
    numbers = {'double': FLOATS, 'integer': INTEGERS}
    return [(spec.name, value) for spec in specs(table) for value in numbers.get(spec.type, ())]


def given(name, value):
    """Options of a node that is given one parameter."""
    return {'parameter_overrides': [Parameter(name, value=value)]}


def made(make, name, value):
    """Return what was made with an extreme parameter; None if one line refuses it."""
    try:
        with argument_errors():
            return make()
    except AmrError as error:
        assert '\n' not in str(error)
        assert name in str(error)
        return None


@pytest.mark.parametrize(
    ('name', 'value'),
    [*extremes(JointStatePublisherSettings), *(('rate', v) for v in (*FLOATS, *INTEGERS))],
)
def test_joint_state_publisher(tmp_path, name, value):
    path = tmp_path / 'amr.urdf'
    path.write_text(AMR)
    node = made(lambda: JointStatePublisher([str(path)], **given(name, value)), name, value)
    if node is not None:
        node._publish()
        node.destroy_node()
    node = JointStatePublisher([str(path)])
    (result,) = node.set_parameters([Parameter(name, value=value)])
    assert result.successful or name in result.reason
    node._publish()
    node.destroy_node()


@pytest.mark.parametrize(('name', 'value'), extremes(RobotStatePublisherSettings))
def test_robot_state_publisher(name, value):
    text = Parameter('robot_description', value=AMR)
    overrides = [text, Parameter(name, value=value)]
    node = made(lambda: RobotStatePublisher(parameter_overrides=overrides), name, value)
    if node is not None:
        node.destroy_node()
    node = RobotStatePublisher(parameter_overrides=[text])
    (result,) = node.set_parameters([Parameter(name, value=value)])
    assert result.successful or name in result.reason
    node.destroy_node()


@pytest.mark.parametrize(('name', 'value'), extremes(teleop.TeleopSettings))
def test_teleop_twist_keyboard(name, value):
    node = Node('teleop', **given(name, value))
    node.settings = made(lambda: declare(node, teleop.TeleopSettings), name, value)
    if node.settings is not None:
        driver = KeyboardDriver(node, None)
        driver._teleop.press('i')
        driver._hold.press('i', 0.0, moving=True, name='i')
        assert driver._hold.wait(0.0) is None or driver._hold.wait(0.0) >= 0.0
        assert all(math.isfinite(part) for part in parts_of(driver._teleop.velocity))
    node.destroy_node()


def parts_of(velocity):
    return velocity.x, velocity.y, velocity.z, velocity.yaw


@pytest.mark.parametrize(
    ('name', 'value'), [row for row in extremes(ManagerTable) if 'threshold' not in row[0]]
)
def test_controller_manager(name, value):
    node = Node('manager', allow_undeclared_parameters=True, **given(name, value))
    parameters = made(lambda: ManagerParameters(NodeParameters(node), [], null_log), name, value)
    if parameters is not None:
        assert round(NANOSECONDS / parameters.update_rate) > 0
        DiagnosticsTopic(node, LoopThread(CallQueue(), SingleThreadedExecutor()), parameters)
    node.destroy_node()


@pytest.mark.parametrize(('name', 'value'), extremes(CommonParameters))
def test_parameters_of_every_controller(name, value):
    try:
        common = build(CommonParameters, {name: value})
    except ParameterError as error:
        assert f"parameter '{name}' must be " in str(error)
    else:
        assert common.update_rate <= 100_000


@pytest.mark.parametrize(('name', 'value'), extremes(SimulationParameters))
def test_mujoco_sim(name, value):
    node = Node('simulator', **given(name, value))
    parameters = made(lambda: declare(node, SimulationParameters), name, value)
    if parameters is not None:
        calls = CallQueue()
        calls.put(lambda: None)  # which ends the sleep
        pacer = WallPacer(parameters.real_time_factor, calls)
        pacer.resume(0)
        pacer.pace(10_000_000)
        world = MujocoWorld('empty', settings=parameters.physics, seed=parameters.seed)
        publisher = ClockedLoopPublisher(node)
        GroundTruth(NodeTopics(node, publisher), world, parameters.ground_truth_rate)
        for _ in range(3):
            publisher.publish(world.time)
            world.step(1)
    node.destroy_node()


@pytest.mark.parametrize(('name', 'value'), extremes(ViewerSettings))
def test_viewer(name, value):
    node = Node('viewer', **given(name, value))
    settings = made(lambda: declare(node, ViewerSettings), name, value)
    assert settings is None or (0 <= settings.port < 2**16 and 1.0 <= settings.rate <= 240.0)
    node.destroy_node()


@pytest.mark.parametrize(
    ('table', 'name'),
    [(DiffDriveParameters, 'wheel_radius'), (CommonParameters, 'update_rate')],
)
def test_a_bound_that_ros_does_not_know_is_not_in_the_descriptor(table, name):
    """The original describes none, and ``ros2 param describe`` prints what it prints there."""
    node = Node('drive')
    declare_missing(node, table)
    descriptor = node.describe_parameter(name)
    assert list(descriptor.floating_point_range) == list(descriptor.integer_range) == []
    node.destroy_node()
