# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""joint_state_broadcaster: names, order and values, as its upstream tests have them."""

import math

import pytest
from support.control_fakes import MS, WHEELS
from support.controller_bench import ControllerBench
from support.paths import ROOT

from amr_description.control.interfaces import ALL_INTERFACES, StateInterface
from amr_description.controllers.broadcasters.joint_state_broadcaster import (
    BroadcasterParameters,
)
from amr_description.errors import ControllerError
from amr_description.log import Severity
from amr_description.model.urdf import load
from amr_description.parameters import specs

URDF = load(ROOT / 'urdf' / 'amr.urdf')
STANDARD = ('position', 'velocity', 'effort')
JOINTS = ('joint1', 'joint2', 'joint3')
VALUES = (1.1, 2.1, 3.1)


def make_states(joints=JOINTS, interfaces=STANDARD):
    """Every interface of a joint reads the joint's value."""
    return [
        StateInterface(joint, interface, value)
        for joint, value in zip(joints, VALUES, strict=False)
        for interface in interfaces
    ]


class Bench(ControllerBench):
    def __init__(self, robot=None, **values):
        values = {'use_urdf_to_filter': robot is not None} | values
        super().__init__('joint_state_broadcaster/JointStateBroadcaster', robot=robot, **values)
        self.sent, *self.sent_dynamic = self.sent.values()

    def read(self, states):
        self.time = 0
        self.activate(states)
        self.update()
        return self.sent[-1]

    def read_dynamic(self, states):
        """(name, {interface: value}) in order."""
        self.read(states)
        sample = self.sent_dynamic[0][-1]
        rows = zip(sample.layout.interfaces, sample.values, strict=True)
        rows = [dict(zip(names, values, strict=True)) for names, values in rows]
        return list(zip(sample.layout.names, rows, strict=True))


def test_every_interface_of_every_joint():
    sample = Bench().read(make_states())
    assert sample.name == JOINTS
    assert sample.position == sample.velocity == sample.effort == VALUES
    assert (sample.stamp, sample.frame_id) == (10 * MS, 'base_link')


def test_one_message_an_update_with_the_present_states():
    bench, states = Bench(), make_states(['joint1'], ['position'])
    bench.read(states)
    states[0].value = 7.0
    bench.controller.update(20 * MS, 10 * MS)
    assert [(s.stamp, s.position) for s in bench.sent] == [(10 * MS, (1.1,)), (20 * MS, (7.0,))]


def test_all_fields_have_one_length_and_what_is_missing_is_nan():
    sample = Bench().read(
        [*make_states(['joint1'], ['position']), *make_states(['joint2'], ['velocity'])]
    )
    assert sample.name == ('joint1', 'joint2')
    assert sample.position == (1.1, pytest.approx(math.nan, nan_ok=True))
    assert sample.velocity == (pytest.approx(math.nan, nan_ok=True), 1.1)
    assert all(map(math.isnan, sample.effort))
    assert len(sample.effort) == 2


def test_it_asks_for_all_unless_joints_and_interfaces_are_given():
    for values in ({}, {'joints': JOINTS}, {'interfaces': STANDARD}):
        bench = Bench(**values)
        assert bench.controller.state_interfaces() == ALL_INTERFACES
        assert 'All available state interfaces will be published' in bench.log.texts()[0]
    bench = Bench(joints=['b', 'a'], interfaces=['position', 'velocity'])
    assert bench.controller.state_interfaces().names == (
        'b/position', 'b/velocity', 'a/position', 'a/velocity'
    )  # fmt: skip
    assert "defined in 'joints' and 'interfaces'" in bench.log.texts()[0]


def test_given_joints_come_in_the_given_order():
    joints = ('joint3', 'joint1')
    bench = Bench(joints=joints, interfaces=['position'])
    assert bench.read(make_states(interfaces=['position'])[::-1]).name == joints


def test_a_partial_set_leaves_a_gap():
    bench = Bench(joints=JOINTS, interfaces=['position', 'velocity'])
    sample = bench.read(make_states(interfaces=['position', 'velocity'])[:-1])
    assert sample.position == VALUES
    assert math.isnan(sample.velocity[2])


def test_with_the_urdf_the_order_is_alphabetical_and_sensors_stay_out():
    states = [StateInterface(wheel, 'position', 0.0) for wheel in WHEELS]
    sensor = StateInterface('imu', 'velocity', 0.0)
    assert Bench(URDF).read([*states, sensor]).name == (
        'joint_wheel_back_left',
        'joint_wheel_back_right',
        'joint_wheel_front_left',
        'joint_wheel_front_right',
    )
    assert Bench(URDF, use_urdf_to_filter=False).read([*states, sensor]).name == (*WHEELS, 'imu')


def test_fixed_joints_stay_out():
    states = [StateInterface(name, 'position', 0.0) for name in ('base_joint', WHEELS[0])]
    assert Bench(URDF).read(states).name == (WHEELS[0],)


def test_a_robot_without_a_description_is_published_unfiltered_with_an_error():
    bench = Bench(use_urdf_to_filter=True)
    assert bench.read(make_states()).name == JOINTS
    assert 'Failed to parse robot description' in bench.log.texts(Severity.ERROR)[0]


def test_extra_joints_come_last_at_zero_and_known_ones_are_not_doubled():
    sample = Bench(extra_joints=['extra1', 'joint2', 'extra2']).read(make_states())
    assert sample.name == (*JOINTS, 'extra1', 'extra2')
    assert sample.position == sample.velocity == sample.effort == (*VALUES, 0.0, 0.0)


@pytest.mark.parametrize('field', STANDARD)
def test_a_mapped_interface_fills_its_field(field):
    bench = Bench(**{f'map_interface_to_joint_state.{field}': 'measured'})
    sample = bench.read([StateInterface('joint1', 'measured', 3.5)])
    assert getattr(sample, field) == (3.5,)
    for other in set(STANDARD) - {field}:
        assert math.isnan(getattr(sample, other)[0])


def test_fields_can_be_swapped():
    bench = Bench(**{
        'map_interface_to_joint_state.position': 'velocity',
        'map_interface_to_joint_state.velocity': 'position',
    })  # fmt: skip
    states = [StateInterface('j', 'position', 1.0), StateInterface('j', 'velocity', 2.0)]
    sample = bench.read(states)
    assert (sample.position, sample.velocity) == ((2.0,), (1.0,))


def test_a_selected_standard_interface_takes_precedence_over_its_mapping():
    bench = Bench(
        joints=['joint1'],
        interfaces=['position', 'measured'],
        **{'map_interface_to_joint_state.position': 'measured'},
    )
    states = [StateInterface('joint1', 'position', 1.0), StateInterface('joint1', 'measured', 2.0)]
    assert bench.read(states).position == (1.0,)
    assert (
        "Mapping from 'measured' to interface 'position' will not be done"
        in (bench.log.texts(Severity.WARN)[0])
    )


def test_interfaces_without_joints_count_for_nothing_even_for_a_mapping():
    bench = Bench(interfaces=['position'], **{'map_interface_to_joint_state.position': 'measured'})
    assert bench.read([StateInterface('joint1', 'measured', 2.0)]).position == (2.0,)
    assert bench.log.texts(Severity.WARN) == []


def test_a_custom_interface_without_a_mapping_makes_no_joint():
    assert Bench().read([*make_states(['joint1']), StateInterface('tank', 'level')]).name == (
        'joint1',
    )


def test_an_interface_that_is_not_a_double_is_left_out_and_logged():
    bench = Bench()
    sample = bench.read(
        [*make_states(['joint1']), StateInterface('door', 'position', 1.0, 'bool')]
    )
    assert sample.name == ('joint1',)
    assert bench.sent_dynamic[0][-1].layout.names == ('joint1',)
    assert "'door/position' is of type bool" in bench.log.texts(Severity.WARN)[0]


def test_the_dynamic_message_has_every_interface_of_joints_sensors_and_gpios():
    states = [
        *make_states(['joint1'], ['velocity', 'temperature']),
        StateInterface('imu', 'orientation.x', 0.5),
        StateInterface('joint1', 'position', 7.0),
        StateInterface('gpio', 'voltage', 12.0),
    ]
    for bench in (Bench(), Bench(URDF)):  # the URDF filters only joint_states
        assert bench.read_dynamic(states) == [
            ('joint1', {'velocity': 1.1, 'temperature': 1.1, 'position': 7.0}),
            ('imu', {'orientation.x': 0.5}),
            ('gpio', {'voltage': 12.0}),
        ]
        assert list(bench.read_dynamic(states)[0][1]) == ['velocity', 'temperature', 'position']
        sample = bench.sent_dynamic[0][-1]
        assert (sample.stamp, sample.layout.frame_id) == (10 * MS, 'base_link')


def test_the_dynamic_message_has_the_present_states():
    bench, states = Bench(), make_states(['joint1'], ['position'])
    bench.read(states)
    states[0].value = 7.0
    bench.controller.update(20 * MS, 10 * MS)
    samples = bench.sent_dynamic[0]
    assert [(s.stamp, s.values) for s in samples] == [(10 * MS, ((1.1,),)), (20 * MS, ((7.0,),))]
    assert samples[0].layout is samples[1].layout


def test_an_interface_not_written_yet_is_nan_in_both():
    ((_, row),) = Bench().read_dynamic([StateInterface('joint1', 'position')])
    assert math.isnan(row['position'])


def test_extra_joints_stand_in_the_dynamic_message_with_three_interfaces_at_zero():
    bench = Bench(extra_joints=['extra1', 'joint1'])
    assert bench.read_dynamic(make_states(['joint1'], ['position'])) == [
        ('joint1', {'position': 1.1}),
        ('extra1', {'position': 0.0, 'velocity': 0.0, 'effort': 0.0}),
    ]


def test_an_extra_joint_that_is_known_by_another_interface_is_none():
    bench = Bench(extra_joints=['tank'])
    states = [*make_states(['joint1']), StateInterface('tank', 'level', 1.0)]
    assert bench.read(states).name == ('joint1',)
    assert bench.read_dynamic(states)[1] == ('tank', {'level': 1.0})


@pytest.mark.parametrize('order', [1, -1])
def test_a_mapped_interface_has_the_standard_name_in_the_dynamic_message(order):
    bench = Bench(**{'map_interface_to_joint_state.position': 'measured'})
    measured, plain = (
        StateInterface('joint1', 'measured', 3.5),
        make_states(['joint1'], ['position']),
    )
    states = [measured, *plain][::order]
    assert bench.read_dynamic(states) == [('joint1', {'position': 3.5})]
    assert bench.sent[-1].position == (3.5,)


def test_a_joint_without_the_mapped_interface_keeps_its_own():
    bench = Bench(**{'map_interface_to_joint_state.position': 'measured'})
    assert bench.read_dynamic(make_states(['joint1'], ['position'])) == [
        ('joint1', {'position': 1.1})
    ]
    assert bench.sent[-1].position == (1.1,)


def test_a_custom_interface_without_a_mapping_is_in_the_dynamic_message_only():
    bench = Bench()
    assert bench.read_dynamic([StateInterface('tank', 'level', 2.0)]) == [('tank', {'level': 2.0})]
    assert bench.sent[-1].name == ()


def test_a_gap_in_the_chosen_set_is_no_interface_in_the_dynamic_message():
    bench = Bench(joints=JOINTS, interfaces=['position', 'velocity'])
    rows = dict(bench.read_dynamic(make_states(interfaces=['position', 'velocity'])[:-1]))
    assert rows['joint3'] == {'position': 3.1}


def test_nothing_but_other_types_is_an_error():
    with pytest.raises(ControllerError, match='Error initializing joint data.*is a double'):
        Bench().controller.activate((), [StateInterface('door', 'open', 1, 'bool')], 0)


def test_no_interface_at_all_is_an_error():
    with pytest.raises(ControllerError, match=r'No state interfaces found to publish\.'):
        Bench().controller.activate((), (), 0)


@pytest.mark.parametrize(('local', 'prefix'), [(False, ''), (True, '~/')])
def test_the_topics(local, prefix):
    ports = [output.port for output in Bench(use_local_topics=local).controller.outputs()]
    assert [(port.name, port.message) for port in ports] == [
        (f'{prefix}joint_states', 'sensor_msgs/msg/JointState'),
        (f'{prefix}dynamic_joint_states', 'control_msgs/msg/DynamicJointState'),
    ]


def test_the_dynamic_topic_can_be_switched_off():
    bench = Bench(publish_dynamic_joint_states=False)
    assert bench.read(make_states()).name == JOINTS
    assert len(bench.controller.outputs()) == 1


def test_the_parameters_are_those_of_the_original():
    table = {spec.name: (spec.type, spec.default) for spec in specs(BroadcasterParameters)}
    assert table == {
        'use_local_topics': ('bool', False),
        'joints': ('string_array', ()),
        'interfaces': ('string_array', ()),
        'extra_joints': ('string_array', ()),
        'map_interface_to_joint_state.position': ('string', 'position'),
        'map_interface_to_joint_state.velocity': ('string', 'velocity'),
        'map_interface_to_joint_state.effort': ('string', 'effort'),
        'use_urdf_to_filter': ('bool', True),
        'frame_id': ('string', 'base_link'),
        'publish_dynamic_joint_states': ('bool', True),
    }
    assert all(spec.read_only for spec in specs(BroadcasterParameters))


def test_an_empty_frame_is_warned_of():
    bench = Bench(frame_id='')
    assert 'Frame ID is not set.' in bench.log.texts(Severity.WARN)
    assert bench.read(make_states()).frame_id == ''


def test_it_can_be_activated_again_on_other_hardware():
    bench = Bench()
    bench.read(make_states())
    bench.controller.deactivate(0)
    assert bench.read(make_states(['joint1'])).name == ('joint1',)
