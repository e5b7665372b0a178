# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Commands as samples, dicts and bytes: one is what the other is."""

import pytest

from amr_description.control.contracts import Port
from amr_description.control.dof_samples import DofCommandSample
from amr_description.control.samples import CommandsSample, FlagSample, TwistSample
from amr_description.control.sensor_samples import InterfaceGroup, InterfaceGroupsSample
from amr_description.control.trajectory_samples import (
    SpeedScalingSample,
    TrajectoryPoint,
    TrajectorySample,
)
from amr_description.errors import AmrError
from amr_description.messages.commands import (
    command_of,
    COMMAND_WRITERS,
    plain_message,
    recorded_command,
)
from amr_description.messages.readers import READERS
from amr_description.messages.writers import WRITERS

SAMPLES = {
    'std_msgs/msg/Float64': CommandsSample((1.5,)),
    'std_msgs/msg/Float64MultiArray': CommandsSample((1.5, -2.0)),
    'control_msgs/msg/MultiDOFCommand': DofCommandSample(('a', 'b'), (1.0, 2.0), (3.0,)),
    'std_msgs/msg/Bool': FlagSample(True),
    'control_msgs/msg/SpeedScalingFactor': SpeedScalingSample(0.5),
    'trajectory_msgs/msg/JointTrajectory': TrajectorySample(
        5, ('a',), (TrajectoryPoint((1.0,), (2.0,)), TrajectoryPoint((3.0,))), (10**9, 2 * 10**9)
    ),
    'geometry_msgs/msg/Twist': TwistSample(0, 0.5, -0.25, lateral=0.125),
    'geometry_msgs/msg/TwistStamped': TwistSample(7, 0.5, -0.25, 'base', 0.125),
    'control_msgs/msg/DynamicInterfaceGroupValues': InterfaceGroupsSample(
        3, (InterfaceGroup('gpio', ('a', 'b'), (1.0, 0.0)),)
    ),
}


def test_all_that_a_controller_can_be_sent_can_be_written():
    topics = {key for key in READERS if '/msg/' in key[1]}
    assert topics <= COMMAND_WRITERS.keys() | WRITERS.keys()
    assert {message for _, message in topics} == SAMPLES.keys()


@pytest.mark.parametrize('name', SAMPLES)
def test_what_is_written_is_the_same_command(name):
    sample = SAMPLES[name]
    port = Port('~/it', name, sample=type(sample))
    data = command_of(port, sample, 0).serialized()
    again = recorded_command(port, plain_message(name, data))
    assert again.sample == sample
    assert again.serialized() == data


def test_a_dict_and_a_sample_have_the_same_bytes_and_get_the_time():
    port = Port('~/cmd_vel', 'geometry_msgs/msg/TwistStamped', sample=TwistSample)
    here = command_of(port, TwistSample(0, 0.5, 0.25), 1_500_000_000)
    there = command_of(
        port, {'twist': {'linear': {'x': 0.5}, 'angular': {'z': 0.25}}}, 1_500_000_000
    )
    assert here.sample == there.sample == TwistSample(1_500_000_000, 0.5, 0.25)
    assert here.serialized() == there.serialized()


def test_what_a_dict_says_beside_the_sample_is_in_the_bytes():
    port = Port('~/cmd_vel', 'geometry_msgs/msg/TwistStamped', sample=TwistSample)
    plain = command_of(port, {'twist': {}}, 1)
    tilted = command_of(port, {'twist': {'angular': {'x': 1.0}}}, 1)
    assert plain.sample == tilted.sample
    assert plain.serialized() != tilted.serialized()


def test_what_cannot_be_written_is_said():
    with pytest.raises(AmrError, match='the definition of my_msgs/msg/It is not in this package'):
        command_of(Port('/it', 'my_msgs/msg/It'), object(), 0).serialized()
    with pytest.raises(
        AmrError, match='nothing writes a object as std_msgs/msg/Bool; send a dict'
    ):
        command_of(Port('/it', 'std_msgs/msg/Bool'), object(), 0).serialized()
    with pytest.raises(AmrError, match='these bytes are no std_msgs/msg/Bool'):
        plain_message('std_msgs/msg/Bool', b'\0\1\0\0')
