# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Parameters of the joint trajectory controller: what is refused, in which words, and logged."""

import math

import pytest
from support.trajectory_arm import Arm

from amr_description.controllers.joint_trajectory.parameters import (
    JointTrajectoryParameters,
)
from amr_description.errors import ControllerError, ParameterError
from amr_description.former_parameters import understand


@pytest.mark.parametrize(
    ('parameters', 'text'),
    [
        (
            {'command_interfaces': ('velocity', 'effort')},
            "'velocity' command interface can be used either alone or 'position' interface has to "
            'be present',
        ),
        (
            {'command_interfaces': ('position', 'acceleration')},
            "'acceleration' command interface can only be used if 'velocity' and 'position' "
            'interfaces are present',
        ),
        (
            {'command_interfaces': ('position', 'velocity', 'effort')},
            "'effort' command interface has to be used alone or with a 'position' interface",
        ),
        (
            {'state_interfaces': ('velocity',)},
            "'velocity' state interface cannot be used if 'position' interface is missing.",
        ),
        (
            {'state_interfaces': ('position', 'acceleration')},
            "'acceleration' state interface cannot be used if 'position' and 'velocity' "
            'interfaces are not present.',
        ),
        (
            {'command_interfaces': ('velocity',), 'state_interfaces': ('position',)},
            "'velocity' command interface can only be used alone if 'velocity' and 'position' "
            'state interfaces are present',
        ),
        (
            {'command_interfaces': ('effort',), 'state_interfaces': ('position',)},
            "'effort' command interface can only be used alone or with 'position' command "
            "interface if 'velocity' and 'position' state interfaces are present",
        ),
        (
            {'command_joints': ('a', 'b', 'c')},
            "The 'command_joints' parameter must not exceed the size of the 'joints' parameter.",
        ),
        (
            {'command_joints': ('c',)},
            "'command_joints' parameter must be a subset of 'joints' parameter, if their size is "
            'not equal.',
        ),
    ],
)
def test_combinations_that_mean_nothing_are_refused_in_these_words(parameters, text):
    with pytest.raises(ControllerError) as caught:
        Arm(**parameters)
    assert str(caught.value) == text


@pytest.mark.parametrize(
    ('parameters', 'text'),
    [
        ({'joints': ()}, "'joints' must not be empty"),
        ({'joints': ('a', 'a')}, "'joints' must not hold anything twice"),
        ({'command_interfaces': ('torque',)}, "'command_interfaces' must hold only position, "),
        ({'interpolation_method': 'none at all'}, "'interpolation_method' must be one of"),
        ({'action_monitor_rate': 0.0}, "'action_monitor_rate' must be at least 0.1"),
        ({'constraints__goal_time': -1.0}, r"'constraints\.goal_time' must be at least 0"),
        (
            {'gains__a__antiwindup_strategy': 'x'},
            r"'gains\.a\.antiwindup_strategy' must be one of",
        ),
    ],
)
def test_parameters_out_of_bounds_are_refused(parameters, text):
    with pytest.raises(ParameterError, match=text):
        Arm(**parameters)


@pytest.mark.parametrize(
    ('gains', 'limits'),
    [
        ({}, (-math.inf, math.inf)),
        ({'i_clamp': 2.0}, (-2.0, 2.0)),
        ({'i_clamp': 2.0, 'i_clamp_max': 1.0}, (-2.0, 1.0)),
        ({'i_clamp_max': 0.0}, (-math.inf, 0.0)),
        ({'antiwindup_strategy': 'none', 'i_clamp_min': -3.0}, (-3.0, math.inf)),
    ],
)
def test_integral_clamps_of_older_and_newer_files_are_understood(gains, limits):
    arm = Arm(**{f'gains__a__{name}': value for name, value in gains.items()})
    pid = arm.parameters.gains['a'].pid()
    assert (pid.i_min, pid.i_max) == limits


def test_parameters_of_earlier_releases_are_understood():
    given = {
        'joints': ['a'],
        'state_publish_rate': 50.0,
        'start_with_holding': True,
        'constraints.goal_time': 1,
        'gains.a.normalize_error': True,
    }
    found = understand(JointTrajectoryParameters, given)
    assert found.values == {'constraints.goal_time': 1.0}
    assert found.texts['gains.a.normalize_error'] == (
        "parameter 'gains.a.normalize_error' is true: it is of Humble, and has no effect: joints "
        'that the URDF calls continuous wrap around'
    )
    assert len(found.texts) == 4


def test_what_is_set_up_is_logged():
    arm = Arm(open_loop_control=True, allow_partial_joints_goal=True)
    assert arm.log.texts() == [
        "[deprecated] 'open_loop_control' parameter is deprecated. Instead, set the feedback "
        "gains to zero and use 'interpolate_from_desired_state' parameter",
        "No specific joint names are used for command interfaces. Using 'joints' parameter.",
        'Goals with partial set of joints are allowed',
        'Command interfaces are [position] and state interfaces are [position velocity].',
        "Using 'splines' interpolation method.",
        'Action status changes will be monitored at 20.00 Hz.',
    ]


def test_less_interfaces_than_requested_are_refused():
    arm = Arm()
    with pytest.raises(ControllerError, match=r'Expected 2 command interfaces, got 1\.'):
        arm.controller.activate(arm.commands[:1], arm.states, 0)
