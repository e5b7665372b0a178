# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Mecanum drives of others: their types, and their names of the same parameters."""

from fixtures.sim.mecanum import HALF_BASE, HALF_TRACK, mecanum, RADIUS
import pytest

from amr_description import Simulation

HEAD = """controller_manager:
  ros__parameters:
    joint_state_broadcaster: {type: joint_state_broadcaster/JointStateBroadcaster}
    drive: {type: %s/MecanumDriveController}
drive:
  ros__parameters:
"""
OFFICIAL = f"""    front_left_wheel_command_joint_name: front_left_joint
    front_right_wheel_command_joint_name: front_right_joint
    rear_left_wheel_command_joint_name: rear_left_joint
    rear_right_wheel_command_joint_name: rear_right_joint
    kinematics.wheels_radius: {RADIUS}
    kinematics.sum_of_robot_center_projection_on_X_Y_axis: {HALF_BASE + HALF_TRACK}
    reference_timeout: 0.5
"""
HUSARIONS = f"""    front_left_wheel_name: front_left_joint
    front_right_wheel_name: front_right_joint
    rear_left_wheel_name: rear_left_joint
    rear_right_wheel_name: rear_right_joint
    wheel_separation_x: {2 * HALF_BASE}
    wheel_separation_y: {2 * HALF_TRACK}
    wheel_radius: {RADIUS}
    cmd_vel_timeout: 0.3
"""
TUTORIALS = f"""    front_left_joint_name: front_left_joint
    front_right_joint_name: front_right_joint
    back_left_joint_name: rear_left_joint
    back_right_joint_name: rear_right_joint
    wheel_base: {2 * HALF_BASE}
    wheel_separation: {2 * HALF_TRACK}
    wheel_radius: {RADIUS}
"""
EARLY = f"""    command_joint_names:
      [front_left_joint, rear_left_joint, rear_right_joint, front_right_joint]
    state_joint_names: [front_left_joint, rear_left_joint, rear_right_joint, front_right_joint]
    kinematics.wheels_radius: {RADIUS}
    kinematics.sum_of_robot_center_projection_on_X_Y_axis: {HALF_BASE + HALF_TRACK}
    reference_timeout: 0.5
"""


@pytest.mark.parametrize(
    ('package', 'parameters'),
    [
        ('clearpath_mecanum_drive_controller', OFFICIAL),
        ('mecanum_drive_controller', HUSARIONS),
        ('mecanum_drive_controller', TUTORIALS),
        ('mecanum_drive_controller', EARLY),
    ],
    ids=['clearpath', 'husarion', 'tutorial', 'early'],
)
def test_the_mecanum_drives_of_others_move_as_told(tmp_path, package, parameters):
    file = tmp_path / 'drive.yaml'
    file.write_text(HEAD % package + parameters)
    with Simulation(mecanum(), file) as sim:
        for twist in ({'linear': {'y': 0.3}}, {'angular': {'z': 0.5}}):
            sim.reset()
            for _ in range(20):
                sim.send('/drive/reference', {'twist': twist})
                sim.run(0.1)
            if 'linear' in twist:
                assert sim.truth.y == pytest.approx(0.6, rel=0.03)
            else:
                assert sim.truth.yaw == pytest.approx(1.0, rel=0.03)
        assert sim.log.count('is not here, and is taken as') == package.count('clearpath')
        if parameters is EARLY:
            assert 'is of an early mecanum drive controller: taken as' in sim.log
        elif parameters is not OFFICIAL:
            assert 'is of another mecanum drive controller: taken as' in sim.log
