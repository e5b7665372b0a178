# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Mistakes in parameter files are named by their cause; what is right, or of others, is not."""

import pytest
from support.paths import ROOT

from amr_description.controllers.checks.drive_files import examine_drive_files
from amr_description.controllers.checks.parameter_faults import (
    closest_type,
    manager_faults,
    type_fault,
    type_here,
)
from amr_description.controllers.checks.parameter_sections import read_sections
from amr_description.errors import ParameterError
from amr_description.model.findings import Severity, SourceLocation

GOOD = """\
controller_manager:
  ros__parameters:
    update_rate: 100
    use_sim_time: true
    joint_state_broadcaster:
      type: joint_state_broadcaster/JointStateBroadcaster
    diff_drive_controller:
      type: diff_drive_controller/DiffDriveController
diff_drive_controller:
  ros__parameters:
    left_wheel_names: [left]
    right_wheel_names: [right]
    wheel_separation: 0.34
    wheel_radius: 0.08
    publish_rate: 50.0
    linear:
      x:
        max_velocity: 1.0
"""
WHEELS = GOOD[GOOD.index('    left_wheel_names') :]


@pytest.fixture
def faults(tmp_path):
    """Return the faults of the text of a file, one a line."""

    def faults_of(text, *managers):
        path = tmp_path / 'c.yaml'
        path.write_text(text)
        found = examine_drive_files([str(path)], managers or ('controller_manager',)).faults
        return [str(each).replace(str(path), 'c.yaml') for each in found]

    return faults_of


def test_a_right_file_has_none(faults):
    assert faults(GOOD) == []
    assert faults((ROOT / 'config/controllers.yaml').read_text()) == []


MISTAKES = {
    'a parameter that is needed': (
        'wheel_separation:',
        'wheel_seperation:',
        'error: c.yaml:13: diff_drive_controller: there is no parameter "wheel_seperation", and '
        'it is ignored; did you mean "wheel_separation"?',
    ),
    'one that has a default': (
        'publish_rate:',
        'publish_rat:',
        'warning: c.yaml:15: diff_drive_controller: there is no parameter "publish_rat", and it '
        'is ignored; did you mean "publish_rate"?',
    ),
    'one below others': (
        'max_velocity:',
        'max_velocty:',
        'warning: c.yaml:18: diff_drive_controller: there is no parameter "linear.x.max_velocty", '
        'and it is ignored; did you mean "linear.x.max_velocity"?',
    ),
    'the name of a section': (
        '\ndiff_drive_controller:',
        '\ndiffdrive_controller:',
        'error: c.yaml:9: the section "diffdrive_controller" is for no node: expected the name of '
        'the controllers: "joint_state_broadcaster", "diff_drive_controller"; did you mean '
        '"diff_drive_controller"?',
    ),
    'another name of a section': (
        '\ndiff_drive_controller:',
        '\nbase:',
        'error: c.yaml:9: the section "base" is for no node: expected the name of the '
        'controllers: "joint_state_broadcaster", "diff_drive_controller"; did you mean '
        '"diff_drive_controller"?',
    ),
    'a section in a namespace': (
        '\ndiff_drive_controller:',
        '\n/robot/diff_drive_controller:',
        'error: c.yaml:9: the section "/robot/diff_drive_controller" is for the node '
        '/robot/diff_drive_controller, and there is /diff_drive_controller, in the namespace /; '
        'write /**/diff_drive_controller: for any namespace',
    ),
    'the manager': (
        'controller_manager:',
        'controler_manager:',
        'error: c.yaml:1: the section "controler_manager" is for no node: expected the name of '
        'the controller manager: "controller_manager"; did you mean "controller_manager"?',
    ),
    'a parameter of the manager': (
        'update_rate:',
        'update_rat:',
        'warning: c.yaml:3: controller_manager: there is no parameter "update_rat", and it is '
        'ignored; did you mean "update_rate"?',
    ),
    'a controller type': (
        'DiffDriveController\n',
        'DiffDriveControler\n',
        'error: c.yaml:8: diff_drive_controller: there is no controller type '
        '"diff_drive_controller/DiffDriveControler"; did you mean '
        '"diff_drive_controller/DiffDriveController"?',
    ),
    'a controller type with colons': (
        'diff_drive_controller/Diff',
        'diff_drive_controller::Diff',
        'error: c.yaml:8: diff_drive_controller: there is no controller type '
        '"diff_drive_controller::DiffDriveController"; did you mean '
        '"diff_drive_controller/DiffDriveController"?',
    ),
    'the word type': (
        'type: diff',
        'tpye: diff',
        'error: c.yaml:8: controller_manager: there is no parameter "diff_drive_controller.tpye", '
        'and it is ignored; did you mean "diff_drive_controller.type"?',
    ),
    'a value in quotes': (
        '0.08',
        "'0.08'",
        "error: c.yaml:14: diff_drive_controller: parameter 'wheel_radius' must be of type "
        "double, found '0.08', a string; write 0.08, without quotes",
    ),
    'an integer': (
        'update_rate: 100',
        'update_rate: 100.0',
        "error: c.yaml:3: controller_manager: parameter 'update_rate' must be of type integer, "
        'found 100.0, a double; write 100',
    ),
    'one name for a list': (
        '[left]',
        'left',
        "error: c.yaml:11: diff_drive_controller: parameter 'left_wheel_names' must be of type "
        "string_array, found 'left', a string; write [left]",
    ),
    'what is left out': (
        '    wheel_radius: 0.08\n',
        '',
        "error: c.yaml:9: diff_drive_controller: parameter 'wheel_radius' is not set, and must be "
        'greater than 0; add wheel_radius: (Radius of a wheel, m)',
    ),
    'no section': (
        'diff_drive_controller:\n  ros__parameters:\n' + WHEELS,
        '',
        'error: c.yaml:8: diff_drive_controller: no section has its parameters, of which it needs '
        '"left_wheel_names", "right_wheel_names", "wheel_separation", "wheel_radius"; write them '
        'below diff_drive_controller: ros__parameters:',
    ),
}


@pytest.mark.parametrize('mistake', MISTAKES)
def test_a_mistake_is_the_only_line(faults, mistake):
    """Nothing is said of its consequences."""
    old, new, line = MISTAKES[mistake]
    assert old in GOOD
    assert faults(GOOD.replace(old, new, 1)) == [line]


@pytest.mark.parametrize(
    ('old', 'new', 'line'),
    [
        ('ros__parameters', 'ros_parameters', 'c.yaml:2: '),
        (
            'diff_drive_controller:\n  ros__parameters',
            'diff_drive_controller:\n  ros__params',
            'c.yaml:10: ',
        ),
    ],
)
def test_a_misspelt_key_is_named_on_its_line(faults, tmp_path, old, new, line):
    with pytest.raises(ParameterError) as caught:
        faults(GOOD.replace(old, new, 1))
    said = str(caught.value).replace(str(tmp_path / 'c.yaml'), 'c.yaml')
    written = new.rpartition(' ')[2]
    assert said == (
        f"{line}'{written}' is misspelt: write ros__parameters, with two underscores in front of "
        "'parameters'"
    )


@pytest.mark.parametrize(
    'more',
    [
        'joint_state_publisher:\n  ros__parameters:\n    rate: 30\n',
        'diff_drive_node:\n  ros__parameters:\n    publish_rat: 30.0\n',
        'ekf_filter_node:\n  ros__parameters:\n    frequency: 30.0\n    odom_frame: odom\n',
        '/**:\n  ros__parameters:\n    use_sim_tim: true\n',
        '    qos_overrides: {}\n',
    ],
)
def test_what_others_read_is_not_reported(faults, more):
    assert faults(GOOD + more) == []


@pytest.mark.parametrize(
    ('old', 'new', 'line'),
    [
        (
            'wheel_radius: 0.08',
            'wheel_radius: 1',
            "warning: c.yaml:14: diff_drive_controller: parameter 'wheel_radius' is 1, an integer,"
            ' where a double is declared: taken as 1.0; a node of rclcpp refuses it',
        ),
        (
            'publish_rate: 50.0',
            'use_stamped_vel: false',
            "warning: c.yaml:15: diff_drive_controller: parameter 'use_stamped_vel' is false: it "
            'is of Humble: plain Twist is taken on ~/cmd_vel_unstamped, besides TwistStamped on '
            '~/cmd_vel; Jazzy takes TwistStamped only',
        ),
        (
            'joint_state_broadcaster/JointStateBroadcaster',
            'admittance_controller/AdmittanceController',
            'warning: c.yaml:6: joint_state_broadcaster: controller type '
            "'admittance_controller/AdmittanceController' is not there: move the joints by "
            'joint_trajectory_controller/JointTrajectoryController; ~/wrench of a '
            'force_torque_sensor_broadcaster tells the forces',
        ),
        (
            'joint_state_broadcaster/JointStateBroadcaster',
            'a_vendor_of_arms/ArmController',
            "warning: c.yaml:6: joint_state_broadcaster: controller type 'a_vendor_of_arms/"
            "ArmController' is not known, and cannot be imported as package.module/Class",
        ),
    ],
)
def test_what_is_taken_otherwise_or_not_there_is_a_warning_in_one_line(faults, old, new, line):
    assert old in GOOD
    assert faults(GOOD.replace(old, new, 1)) == [line]


KEYED = """\
controller_manager:
  ros__parameters:
    wheels: {type: pid_controller/PidController}
    forces: {type: force_torque_sensor_broadcaster/ForceTorqueSensorBroadcaster}
    lights: {type: gpio_controllers/GpioCommandController}
wheels:
  ros__parameters:
    dof_names: [left_wheel_joint]
    command_interface: velocity
    reference_and_state_interfaces: [velocity]
    gains:
      left_wheel_joint: {p: 0.5, antiwindup: true, my_own: 3.0}
forces:
  ros__parameters:
    frame_id: tool
    sensor_name: cell
    sensor_filter_chain:
      filter1: {name: smooth, type: filters/MeanFilterWrench}
lights:
  ros__parameters:
    gpios: [lamp]
    command_interfaces:
      lamp:
        - interfaces:
          - 'on'
"""


def test_parameters_below_the_elements_of_a_list(faults):
    assert faults(KEYED) == []
    (line,) = faults(KEYED.replace('antiwindup:', 'antiwindupp:'))
    assert line.endswith('did you mean "gains.left_wheel_joint.antiwindup"?')
    (line,) = faults(KEYED.replace('p: 0.5', 'p: fast'))
    assert "c.yaml:12: wheels: parameter 'gains.left_wheel_joint.p' must be of type" in line


@pytest.mark.parametrize('manager', ['/**/controller_manager', '/robot/controller_manager'])
def test_other_namespaces_and_names_of_managers_are_right(faults, manager):
    node = manager.replace('controller_manager', 'diff_drive_controller')
    text = GOOD.replace('controller_manager:', f'{manager}:').replace('\ndiff', '\nXX')
    text = text.replace('\nXX_drive_controller:', f'\n{node}:')
    assert faults(text) == []
    named = GOOD.replace('controller_manager:', 'controller_manager_left:')
    assert faults(named, 'controller_manager', 'controller_manager_left') == []


def test_a_manager_without_controllers_is_a_warning(faults):
    """They may be loaded by other files."""
    assert faults('controller_manager:\n  ros__parameters:\n    update_rate: 100\n') == [
        'warning: c.yaml:1: the section "controller_manager" names no controller, so none can be '
        'spawned; add NAME: {type: joint_state_broadcaster/JointStateBroadcaster} below its '
        'ros__parameters'
    ]


def test_an_ordinary_file_in_a_namespace_is_told_what_to_write(tmp_path):
    path = tmp_path / 'c.yaml'
    path.write_text(GOOD)
    found = read_sections([str(path)])
    (fault,) = manager_faults(found, '/robot1/controller_manager')
    assert fault.text == (
        f'{path}:1: the section "controller_manager" is for the node /controller_manager, and '
        'there is /robot1/controller_manager, in the namespace /robot1; write '
        '/**/controller_manager: for any namespace'
    )
    assert list(manager_faults(found, '/controller_manager')) == []


@pytest.mark.parametrize(
    'kind',
    [
        'admittance_controller/AdmittanceController',
        'swerve_drive_controller/SwerveController',
        'my_diff_drive_controller/DiffDriveController',
        'my_package.drive/DiffDriveController',
        'cartesian_motion_controller/CartesianMotionController',
        'acceleration_controllers/JointGroupAccelerationController',
        'ur_controllers/ForceTorqueStateBroadcaster',
    ],
)
def test_types_of_others_are_not_corrected(kind):
    assert closest_type(kind) == ''


@pytest.mark.parametrize(
    ('kind', 'here'),
    [
        ('clearpath_mecanum_drive_controller/MecanumDriveController', 'mecanum_drive_controller'),
        ('my_diff_drive_controller/DiffDriveController', 'diff_drive_controller'),
        ('makers_arm::JointTrajectoryController', 'joint_trajectory_controller'),
        ('ur_controllers/ScaledJointTrajectoryController', 'joint_trajectory_controller'),
        ('ur_controllers/ForceTorqueStateBroadcaster', 'force_torque_sensor_broadcaster'),
        ('joint_state_controller/JointStateController', 'joint_state_broadcaster'),
    ],
)
def test_a_type_of_a_vendor_is_taken_by_its_class(kind, here):
    assert type_here(kind).partition('/')[0] == here
    found, fault = type_fault('arm', kind, SourceLocation('c.yaml', 3))
    assert found == type_here(kind)
    assert fault.severity is Severity.WARNING
    assert f'"{kind}" is not here, and is taken as "{here}/' in fault.text


@pytest.mark.parametrize(
    'kind',
    [
        'diff_drive_controller/DiffDriveController',  # it is here
        'diff_drive_controler/DiffDriveController',  # misspelt
        'my_package.drive/DiffDriveController',  # of Python
        'pytest/DiffDriveController',  # a package of Python
        'makers/GripperActionController',  # three of ours have that class
        'ur_controllers/ForceModeController',  # none of ours
        'DiffDriveController',
    ],
)
def test_other_types_are_not_taken_as_another(kind):
    assert type_here(kind) == kind


def test_a_file_that_was_edited_is_read_again(faults):
    assert faults(GOOD) == []
    assert len(faults(GOOD.replace('wheel_radius', 'wheel_raduis'))) == 1
    assert faults(GOOD) == []
