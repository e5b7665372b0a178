# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A robot that somebody else wrote: its own name, pose and controllers, nothing of amr's."""

from fixtures.sim.ackermann import ackermann
import pytest
from support.paths import ROOT

from amr_description.control.ros.client import ManagerClient
from amr_description.errors import SimulationError
from amr_description.model.frames import Transform
from amr_description.testing.simulation import Simulation

CART = (ROOT / 'test/fixtures/urdf_good/cart.urdf').read_text()
HOST = """<gazebo><plugin filename="x" name="gz_ros2_control::GazeboSimROS2ControlPlugin">
<parameters>/gone/cart.yaml</parameters><ros><namespace>left</namespace></ros>
</plugin></gazebo></robot>"""
YAML = """
controller_manager:
  ros__parameters:
    drive: {type: diff_drive_controller/DiffDriveController}
    vendor: {type: vendor/Arm}
    other: {type: diff_drive_controller/DiffDriveController}
states:
  ros__parameters: {type: joint_state_broadcaster/JointStateBroadcaster}
"""
CAR = """
controller_manager:
  ros__parameters:
    car: {type: ackermann_steering_controller/AckermannSteeringController}
car:
  ros__parameters:
    traction_joints_names: [rear_right, rear_left]
    steering_joints_names: [steer_right, steer_left]
    wheelbase: 0.4
    traction_track_width: 0.3
    traction_wheels_radius: 0.06
"""
DRIVE = """
{}:
  ros__parameters:
    left_wheel_names: [left_joint]
    right_wheel_names: [right_joint]
    wheel_separation: 0.3
    wheel_radius: 0.1
"""


def states(sim, manager):
    return ManagerClient(sim.node, manager, timeout=5.0).states()


def test_without_parameters_it_stands_there_without_controllers():
    """Its root is 10 cm above the ground in truth, and its name has a blank."""
    text = CART.replace('"cart"', '"a cart"').replace('xyz="0 0 0.1"', 'xyz="0 0 0"')
    with Simulation(text.replace('</robot>', HOST)) as sim:
        assert sim.name == 'a_cart'
        assert states(sim, '/left/controller_manager') == {}
        sim.run(0.5)
        assert sim.truth.z == pytest.approx(0.1, abs=0.003)
        assert "'a_cart' is lifted by 0.100 m: its link " in sim.log
        assert 'a parameter file that it names is not there: "/gone/cart.yaml"; anoth' in sim.log
        with pytest.raises(SimulationError, match="no controller that drives 'a_cart' is"):
            sim.drive(0.1, 0.0, seconds=0.1)


def test_it_drives_by_its_own_controllers_and_what_cannot_be_is_a_warning(tmp_path):
    file = tmp_path / 'cart.yaml'
    file.write_text(YAML + DRIVE.format('drive') + DRIVE.format('other'))
    with pytest.warns(UserWarning) as told, Simulation(CART, file, name='trolley') as sim:
        assert sim.name == 'trolley'
        assert states(sim, '/controller_manager') == {
            'states': 'active',
            'drive': 'active',
            'other': 'inactive',
        }
        sim.drive(0.3, 0.0, seconds=1)
        assert sim.truth.x == pytest.approx(0.3, rel=0.15)
    vendor, other = (str(each.message) for each in told)
    assert vendor.startswith('Failed loading controller vendor: ')
    assert other.startswith('other stays inactive: drive has claimed left_joint/velocity, ')
    with pytest.raises(SimulationError, match="name is 'x', and robots have the names of robots"):
        Simulation(CART, name='x', robots={})


def test_a_car_drives_by_its_steering_controller(tmp_path):
    file = tmp_path / 'car.yaml'
    file.write_text(CAR)
    with Simulation(ackermann(), file, pose=Transform((0.0, 0.0, 0.06))) as sim:
        sim.drive(0.3, 0.2, seconds=1)
        assert sim.truth.x == pytest.approx(0.3, rel=0.15)
        assert sim.odometry.x == pytest.approx(sim.truth.x, rel=0.05)
