# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Every broadcaster's samples arrive as messages of its type, and GPIO commands as samples."""

from control_msgs.msg import DynamicInterfaceGroupValues, InterfaceValue
import pytest
from rclpy.serialization import deserialize_message, serialize_message
from support.control_fakes import collect, FakeLog

from amr_description.control.contracts import ControllerContext
from amr_description.control.interfaces import StateInterface
from amr_description.control.sensor_samples import InterfaceGroup
from amr_description.controllers import CONTROLLERS
from amr_description.controllers.gpio_command_controller import GpioCommandController
from amr_description.messages import readers, writers
from amr_description.parameters import build
from amr_description.ros.message_types import message_type

STAMP = 3_000_000_007
SENSOR = {'sensor_name': 's', 'frame_id': 'f'}
KINDS = {
    'force_torque_sensor_broadcaster/ForceTorqueSensorBroadcaster': (
        SENSOR,
        [1.0, 2.0, 3.0, 4.0, 5.0, 6.0],
        {'~/wrench': {'wrench.force.y': 2.0, 'wrench.torque.z': 6.0}},
    ),
    'pose_broadcaster/PoseBroadcaster': (
        {'pose_name': 's', 'frame_id': 'f'},
        [1.0, 2.0, 3.0, 0.0, 0.0, 0.6, 0.8],
        {
            '~/pose': {'pose.position.z': 3.0, 'pose.orientation.w': 0.8},
            '/tf': {'transform.translation.y': 2.0, 'transform.rotation.z': 0.6},
        },
    ),
    'range_sensor_broadcaster/RangeSensorBroadcaster': (
        SENSOR | {'radiation_type': 1, 'field_of_view': 0.125, 'max_range': 8.0, 'variance': 0.5},
        [2.5],
        {
            '~/range': {
                'range': 2.5, 'radiation_type': 1, 'field_of_view': 0.125, 'max_range': 8.0,
                'variance': 0.5,
            }
        },
    ),
    'gps_sensor_broadcaster/GPSSensorBroadcaster': (
        SENSOR,
        [0.0, 1.0, 48.1, 11.5, 520.0],
        {'~/gps/fix': {'status.service': 1, 'latitude': 48.1, 'position_covariance_type': 3}},
    ),
    'magnetometer_broadcaster/MagnetometerBroadcaster': (
        SENSOR | {'static_covariance': [2.0] * 9},
        [1.0, 2.0, 3.0],
        {'~/magnetic_field': {'magnetic_field.z': 3.0}},
    ),
    'state_interfaces_broadcaster/StateInterfacesBroadcaster': (
        {'interfaces': ['a/x', 'b/y']},
        [1.0, 2.0],
        {'~/names': {'keys': ['a/x', 'b/y']}, '~/values': {'values': [1.0, 2.0]}},
    ),
    'battery_state_broadcaster/BatteryStateBroadcaster': (
        {'batteries': ['s'], 's.location': 'left', 's.power_supply_technology': 3},
        [12.5],
        {
            '~/battery_state': {'voltage': 12.5, 'power_supply_technology': 3, 'present': True},
            '~/raw_battery_states': {'voltage': 12.5, 'location': 'left', 'header.frame_id': 's'},
        },
    ),
    'gpio_controllers/GpioCommandController': (
        {'gpios': ['s'], 'state_interfaces.s.interfaces': ['a', 'b']},
        [1.0, 2.0],
        {'~/gpio_states': {'interface_groups': ['s'], 'interface_values.0.values': [1.0, 2.0]}},
    ),
}  # fmt: skip
INSIDE = {'/tf': 'transforms', '~/raw_battery_states': 'battery_states'}


@pytest.mark.parametrize('kind', KINDS)
def test_messages_arrive_as_they_were_sent(kind):
    values, states, expected = KINDS[kind]
    found = CONTROLLERS.find(kind)
    controller = found(ControllerContext('it', FakeLog()))
    controller.configure(build(found.parameters_type, values))
    sent = {output.port.name: (output.port, collect(output)) for output in controller.outputs()}
    names = controller.state_interfaces().names
    handles = [
        StateInterface(*name.split('/'), value) for name, value in zip(names, states, strict=True)
    ]
    controller.activate((), handles, STAMP)
    controller.update(STAMP, 10)
    assert sent.keys() == expected.keys()
    for topic, (port, samples) in sent.items():
        message = message_type(port.message, 'it')()
        for _ in range(2):  # as it is reused
            writers.writer_of(port)(samples[0], message)
        message = deserialize_message(serialize_message(message), type(message))
        if topic in INSIDE:
            (message,) = getattr(message, INSIDE[topic])
        assert (message.header.stamp.sec, message.header.stamp.nanosec) == (3, 7)
        for name, value in expected[topic].items():
            found_value = get(message, name)
            assert (list(found_value) if isinstance(value, list) else found_value) == value, name


def get(message, name):
    for part in name.split('.'):
        message = message[int(part)] if part.isdecimal() else getattr(message, part)
    return message


def test_gpio_commands_keep_their_names():
    controller = GpioCommandController(ControllerContext('it', FakeLog()))
    table = {'gpios': ['s'], 'command_interfaces.s.interfaces': ['a', 'b']}
    controller.configure(build(GpioCommandController.parameters_type, table))
    read = readers.reader_of(controller.inputs()[0].port)
    message = DynamicInterfaceGroupValues(
        interface_groups=['s'],
        interface_values=[InterfaceValue(interface_names=['b', 'a'], values=[1.0, 2.0])],
    )
    assert read(message).groups == (InterfaceGroup('s', ('b', 'a'), (1.0, 2.0)),)
    message.interface_groups = ['s', 't']
    with pytest.raises(ValueError, match='zip'):
        read(message)
