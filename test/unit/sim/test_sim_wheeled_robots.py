# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Robots with their controllers, in lock-step with the physics: where they are in the end."""

import math

from fixtures.sim.ackermann import ackermann, RADIUS, TRACK, WHEELBASE
from fixtures.sim.mecanum import CORNERS, HALF_BASE, HALF_TRACK, mecanum, RADIUS as MECANUM_RADIUS
import pytest
from support.wheel_bench import WheelBench

from amr_description.controllers.drives.mecanum_drive_controller import MecanumDriveController
from amr_description.controllers.drives.steering_controllers import AckermannSteeringController
from amr_description.model.frames import Transform
from amr_description.sim.world import MujocoWorld

MECANUM = {
    **{f'{corner}_wheel_command_joint_name': f'{corner}_joint' for corner in CORNERS},
    'kinematics.wheels_radius': MECANUM_RADIUS,
    'kinematics.sum_of_robot_center_projection_on_X_Y_axis': HALF_BASE + HALF_TRACK,
    'reference_timeout': 0.5,
}
ACKERMANN = {
    'traction_joints_names': ['rear_right', 'rear_left'],
    'steering_joints_names': ['steer_right', 'steer_left'],
    'wheelbase': WHEELBASE,
    'traction_track_width': TRACK,
    'traction_wheels_radius': RADIUS,
}


class Driven(WheelBench):
    """A controller whose joints are those of a robot in a world."""

    def __init__(self, controller_class, values, urdf, height):
        self.world = MujocoWorld('empty')
        self.robot = self.world.spawn('robot', urdf, Transform((0.0, 0.0, height)))
        super().__init__(controller_class, values)
        names = {name.split('/')[0] for name in (*self.commands, *self.states)}
        self.joints = {name: self.robot.joints([name]) for name in names}

    def follow(self, period):
        for name, command in self.commands.items():
            joint, interface = name.split('/')
            if not math.isnan(command.value):
                self.joints[joint].command(interface, [command.value])
        self.world.advance(period)
        for name, state in self.states.items():
            joint, interface = name.split('/')
            joints = self.joints[joint]
            read = joints.positions if interface == 'position' else joints.velocities
            [state.value] = read()

    @property
    def truth(self):
        """Return x, y and heading of the base."""
        pose = self.robot.pose('base_link')
        x, y, z, w = pose.rotation
        heading = math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
        return (*pose.translation[:2], heading)


def test_a_mecanum_robot_drives_ahead_and_left_and_turns():
    robot = Driven(MecanumDriveController, MECANUM, mecanum(), MECANUM_RADIUS + 0.02)
    robot.drive(0.5, seconds=2.0)
    robot.drive(seconds=0.5)
    assert robot.truth == pytest.approx((1.0, 0.0, 0.0), abs=0.02)
    robot.drive(lateral=0.5, seconds=2.0)
    robot.drive(seconds=0.5)
    assert robot.truth == pytest.approx((1.0, 1.0, 0.0), abs=0.02)
    robot.drive(angular=math.pi / 4, seconds=2.0)
    robot.drive(seconds=0.5)
    assert robot.truth == pytest.approx((1.0, 1.0, math.pi / 2), abs=0.03)
    assert robot.pose() == pytest.approx(robot.truth, abs=0.01)


@pytest.mark.parametrize('turn', [0.4, -0.4])
def test_a_car_drives_a_circle_of_the_right_radius(turn):
    """0.4 m/s at 0.4 rad/s: a radius of 1 m; two points that are half a circle apart."""
    robot = Driven(AckermannSteeringController, ACKERMANN, ackermann(), RADIUS)
    robot.drive(0.4, angular=turn, seconds=2.0)
    before = robot.truth
    robot.drive(0.4, angular=turn, seconds=math.pi / 0.4)
    after = robot.truth
    assert math.dist(before[:2], after[:2]) == pytest.approx(2.0, rel=0.03)
    turned = math.remainder(after[2] - before[2] - math.pi, 2 * math.pi)
    assert turned == pytest.approx(0.0, abs=0.1)
