# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Extreme numbers in parameters of controllers, world and serial port: refused, or harmless."""

import functools
from itertools import chain
import math

from fixtures.sim.driving import AMR
from hypothesis import given, strategies as st
import pytest
from support.control_fakes import collect, FakeLog, MS

from amr_description.clock import NANOSECONDS
from amr_description.control.contracts import ControllerContext
from amr_description.control.interfaces import CommandInterface, StateInterface
from amr_description.control.samples import OdometrySample, TwistSample
from amr_description.controllers import CONTROLLERS
from amr_description.controllers.drives.diff_drive_controller import DiffDriveParameters
from amr_description.errors import ControllerError, HardwareError, ParameterError
from amr_description.hardware.serial_link import open_port, SerialParameters
from amr_description.hardware.serial_protocol import encode, Set
from amr_description.model.frames import Transform
from amr_description.parameters import build, specs
from amr_description.sim.world import MujocoWorld
from amr_description.sim.world_file import WorldSettings

FLOATS = (1e300, 1e-300, -1e300, -1e-300, 5e-324, math.inf, -math.inf, math.nan, 0.0, 1.0)
INTEGERS = (2**63 - 1, -(2**63), 2**31, -1, 0, 1)
MECANUM_WHEELS = {
    f'{row}_{side}_wheel_command_joint_name': f'{row}_{side}'
    for row in ('front', 'rear')
    for side in ('left', 'right')
}
NEEDED = {
    'left_wheel_names': ['left'],
    'right_wheel_names': ['right'],
    'wheel_separation': 0.3,
    'wheel_radius': 0.1,
    'joints': ['left', 'right'],
    'joint': 'left',
    'interface_name': 'velocity',
    'interface_names': ['velocity'],
    'sensor_name': 'imu',
    'frame_id': 'imu',
    'link': 'base_link',
    'pose_name': 'pose',
    'traction_joints_names': ['left', 'right'],
    'steering_joints_names': ['front_left', 'front_right'],
    'traction_joint_name': 'drive',
    'steering_joint_name': 'steer',
    'wheelbase': 0.5,
    'traction_track_width': 0.4,
    'steering_track_width': 0.4,
    'traction_wheels_radius': 0.1,
    'traction_wheel_radius': 0.1,
    'kinematics.wheels_radius': 0.1,
    'kinematics.sum_of_robot_center_projection_on_X_Y_axis': 0.5,
    'wheel_names': ['first', 'second', 'third'],
    'robot_radius': 0.2,
    'wheel_offset': 0.0,
    'dof_names': ['left', 'right'],
    'reference_and_state_interfaces': ['velocity'],
    'command_interface': 'velocity',
    **MECANUM_WHEELS,
}
"""The parameters that have no useful default, of all controllers."""
ONE_IN_FRONT = {'steering_joints_names': ['front']}
NEEDED_BY = {
    'bicycle_steering_controller/BicycleSteeringController': {
        'traction_joints_names': ['rear'],
        **ONE_IN_FRONT,
    },
    'joint_trajectory_controller/JointTrajectoryController': {
        'command_interfaces': ['position'],
        'state_interfaces': ['position', 'velocity'],
    },
    'tricycle_steering_controller/TricycleSteeringController': ONE_IN_FRONT,
}


def some_floats(count):
    return st.lists(st.sampled_from(FLOATS), min_size=count, max_size=count)


@functools.cache  # Hypothesis asks each strategy once what it can do
def extremes(table):
    """Dictionaries with an extreme number for any of the numeric parameters of a table."""
    choices = {}
    for spec in specs(table):
        if spec.type == 'double':
            choices[spec.name] = st.sampled_from(FLOATS)
        elif spec.type == 'integer':
            choices[spec.name] = st.sampled_from(INTEGERS)
        elif spec.type == 'double_array':
            lengths = {spec.bounds.length or 1, 9}
            choices[spec.name] = st.sampled_from(sorted(lengths)).flatmap(some_floats)
        elif spec.type == 'bool':
            choices[spec.name] = st.booleans()
    return st.fixed_dictionaries({}, optional=choices)


def singles(table):
    """One extreme number at a time: (name, value)."""
    numbers = {'double': FLOATS, 'integer': INTEGERS}
    rows = [(spec.name, value) for spec in specs(table) for value in numbers.get(spec.type, ())]
    return pytest.mark.parametrize(('name', 'value'), rows)


def checked(table, values, needed=NEEDED):
    """Return the built table; None if it is refused, in one line that names a parameter."""
    known = {spec.name for spec in specs(table)}
    try:
        return build(table, {name: needed[name] for name in needed if name in known} | values)
    except ParameterError as error:
        text = str(error)
        assert '\n' not in text
        assert any(f"parameter '{name}' must " in text and 'found ' in text for name in values), (
            text
        )
        return None


def has_numbers(table):
    return any(spec.type in ('double', 'integer', 'double_array') for spec in specs(table))


WITH_NUMBERS = [
    name for name in CONTROLLERS.names if has_numbers(CONTROLLERS.find(name).parameters_type)
]


def run(name, values):
    """
    Configure a controller with these parameters, if they are accepted, and run it for 1 s.

    Return whether they were.
    """
    kind = CONTROLLERS.find(name)
    parameters = checked(kind.parameters_type, values, NEEDED | NEEDED_BY.get(name, {}))
    if parameters is None:
        return False
    controller = kind(ControllerContext('it', FakeLog()))
    try:
        controller.configure(parameters)
    except (ControllerError, ParameterError):
        return False  # they contradict each other
    sent = [collect(port) for port in controller.outputs()]
    request = controller.command_interfaces()
    commands = [CommandInterface(*name.split('/', 1)) for name in request.names]
    request = controller.state_interfaces()
    states = [StateInterface(*name.split('/', 1), 0.1) for name in request.names]
    controller.activate(commands, states, 0)
    for port in controller.inputs():
        port.open()
    for cycle in range(1, 101):
        for state in states:
            state.value += 0.01
        for port in controller.inputs():
            if port.port.sample is TwistSample:
                port.put(TwistSample(cycle * 10 * MS, 0.5, -0.5))
        controller.update(cycle * 10 * MS, 10 * MS)
    assert all(math.isfinite(command.value) for command in commands)
    for sample in chain.from_iterable(sent):
        if isinstance(sample, OdometrySample):
            odometry = sample.x, sample.y, sample.heading, sample.linear, sample.angular
            assert all(abs(value) < 1e9 for value in odometry)
    controller.deactivate(NANOSECONDS)
    return True


@pytest.mark.parametrize('name', WITH_NUMBERS)
def test_its_ordinary_numbers_are_taken(name):
    assert run(name, {})


@pytest.mark.parametrize('name', WITH_NUMBERS)
def test_one_extreme_number_in_a_controller_is_refused_or_harmless(name):
    for spec in specs(CONTROLLERS.find(name).parameters_type):
        numbers = {'double': FLOATS, 'integer': INTEGERS}
        for value in numbers.get(spec.type, ()):
            run(name, {spec.name: value})


@pytest.mark.parametrize('name', WITH_NUMBERS)
@given(st.data())
def test_any_extreme_numbers_in_a_controller_are_refused_or_harmless(name, data):
    run(name, data.draw(extremes(CONTROLLERS.find(name).parameters_type)))


@given(extremes(DiffDriveParameters))
def test_what_is_accepted_keeps_its_place_between_the_bounds_of_a_robot(values):
    drive = checked(DiffDriveParameters, values)
    if drive is not None:
        assert 1e-5 <= drive.wheel_radius * abs(drive.left_wheel_radius_multiplier) <= 1e4
        assert 1e-5 <= drive.wheel_separation * abs(drive.wheel_separation_multiplier) <= 1e4


@pytest.mark.parametrize(
    ('values', 'text'),
    [
        ({'publish_rate': 1e-300}, "'publish_rate' must be at least 0.001, found 1e-300 Hz"),
        ({'publish_rate': 1e300}, "'publish_rate' must be at most 100000, found 1e+300 Hz"),
        ({'wheel_radius': 1e155}, "'wheel_radius' must be at most 100, found 1e+155 m"),
        ({'wheel_separation': 1e-9}, "'wheel_separation' must be at least 0.001, found 1e-09 m"),
        (
            {'left_wheel_radius_multiplier': -1e300},
            "'left_wheel_radius_multiplier' must be at least -100, found -1e+300",
        ),
        (
            {'right_wheel_radius_multiplier': -1e-300},
            "'right_wheel_radius_multiplier' must be at most -0.01, found -1e-300",
        ),
        ({'cmd_vel_timeout': 5e-324}, "'cmd_vel_timeout' must be 0 or at least 1e-06, found 5e-"),
    ],
)
def test_what_is_refused_is_told_with_its_bound(values, text):
    with pytest.raises(ParameterError) as caught:
        build(DiffDriveParameters, NEEDED | values)
    assert str(caught.value).startswith(f'parameter {text}')


@singles(WorldSettings)
def test_an_extreme_number_in_the_world_is_refused_or_harmless(name, value):
    settings = checked(WorldSettings, {name: value})
    if settings is not None:
        world = MujocoWorld(settings=settings, log=FakeLog())
        world.spawn('amr', AMR, Transform((0.0, 0.0, 0.2)))
        for _ in range(5):
            world.advance(10 * MS)
        assert world.time >= 50 * MS


@singles(SerialParameters)
def test_an_extreme_number_in_a_serial_port_is_refused_or_harmless(name, value):
    values = {'port': '/dev/null', 'left_joints': ['a'], 'right_joints': ['b'], name: value}
    parameters = checked(SerialParameters, values)
    if parameters is not None:
        fastest = parameters.max_velocity * max(
            abs(parameters.left_reduction), abs(parameters.right_reduction)
        )
        assert encode(Set(0, fastest, -fastest))
        with pytest.raises(HardwareError, match="^cannot open the serial port '/dev/null': "):
            open_port(parameters.port, parameters.baud_rate, parameters.answer_timeout)
