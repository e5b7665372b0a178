# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Which wheels of a robot have rollers, as the parameters of its controllers have it."""

import math

from fixtures.sim.mecanum import mecanum, omni
import pytest

from amr_description.controllers.checks.wheeled_drive_files import rollers_of_controllers
from amr_description.model.wheels import Rollers
from amr_description.sim.spawning import read_description

MECANUM = """controller_manager:
  ros__parameters:
    base: {type: mecanum_drive_controller/MecanumDriveController}
base:
  ros__parameters:
    front_left_wheel_command_joint_name: front_left_joint
    front_right_wheel_command_joint_name: front_right_joint
    rear_right_wheel_command_joint_name: rear_right_joint
    rear_left_wheel_command_joint_name: rear_left_joint
    kinematics:
      wheels_radius: 0.05
      sum_of_robot_center_projection_on_X_Y_axis: 0.28
"""
OMNI = """controller_manager:
  ros__parameters:
    base: {type: omni_wheel_drive_controller/OmniWheelDriveController}
base:
  ros__parameters:
    wheel_names: [omni_0_joint, omni_1_joint, omni_2_joint, of_another_robot]
    wheel_offset: 0.0
    wheel_radius: 0.05
    robot_radius: 0.2
"""


@pytest.fixture
def found(tmp_path):
    def find(urdf, text):
        path = tmp_path / 'controllers.yaml'
        path.write_text(text)
        return rollers_of_controllers(read_description(urdf, 'robot'), [str(path)])

    return find


def test_those_of_a_mecanum_drive_are_an_x_from_above(found):
    eighth = math.pi / 4
    assert found(mecanum(''), MECANUM) == {
        'front_left_joint': Rollers(-eighth),
        'front_right_joint': Rollers(eighth),
        'rear_right_joint': Rollers(-eighth),
        'rear_left_joint': Rollers(eighth),
    }


def test_those_of_omni_wheels_are_ahead(found):
    assert found(omni(), OMNI) == {f'omni_{index}_joint': Rollers(0.0) for index in range(3)}


@pytest.mark.parametrize(
    'text',
    [
        MECANUM.replace('wheels_radius: 0.05', 'wheels_radius: -1.0'),
        MECANUM.replace('mecanum_drive_controller/Mecanum', 'diff_drive_controller/Diff'),
        'controller_manager: [',
        '',
    ],
)
def test_what_is_not_sound_has_none(found, text):
    assert found(mecanum(''), text) == {}


def test_without_a_file_there_are_none():
    assert rollers_of_controllers(read_description(omni(), 'robot'), ['/nowhere.yaml']) == {}
