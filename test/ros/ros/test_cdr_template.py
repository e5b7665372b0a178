# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Templates of serialized messages: all kinds of fields, and where the gaps are."""

from control_msgs.msg import InterfaceValue, MultiDOFCommand
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from geometry_msgs.msg import PoseStamped, TransformStamped
import pytest
from sensor_msgs.msg import BatteryState, NavSatFix, Range
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

from amr_description.ros.layouts import is_that_of, template_of


def test_a_message_without_gaps_is_its_own_constant():
    for message in (
        BatteryState(present=True, cell_voltage=[1.0, 2.0, 3.0], location='here', voltage=7.5),
        DiagnosticArray(
            status=[
                DiagnosticStatus(level=b'\2', name='a', values=[KeyValue(key='k', value='v')]),
                DiagnosticStatus(level=b'\0', name='longer'),
            ]
        ),
        NavSatFix(latitude=1.0, position_covariance=[float(number) for number in range(9)]),
        String(data='ä'),
        InterfaceValue(interface_names=['a', 'bc', ''], values=[1.0, 2.0, 3.0]),
    ):
        template = template_of(message, ())
        assert is_that_of(message, template.pack(*template.constants), template)


def test_gaps_are_numbers_messages_and_arrays_of_numbers():
    message = Range(radiation_type=1, field_of_view=0.5)
    message.header.frame_id = 'abc'
    template = template_of(message, ('header.stamp', 'radiation_type', 'range'))
    begin, frame, view, end, *_ = template.constants
    data = template.pack(begin, 5, 6, frame, 0, view, 2.5, end)
    message.header.stamp.sec, message.header.stamp.nanosec = 5, 6
    message.radiation_type, message.range = 0, 2.5
    assert is_that_of(message, data, template)


def test_each_element_of_an_array_has_a_gap():
    message = TFMessage(transforms=[TransformStamped(child_frame_id='a'), TransformStamped()])
    template = template_of(message, ('transforms.transform.translation',))
    first, second, end = template.constants
    data = template.pack(first, 1.0, 2.0, 3.0, second, 4.0, 5.0, 6.0, end)
    for transform, values in zip(
        message.transforms, ((1.0, 2.0, 3.0), (4.0, 5.0, 6.0)), strict=True
    ):
        place = transform.transform.translation
        place.x, place.y, place.z = values
    assert is_that_of(message, data, template)


def test_an_empty_sequence_is_an_empty_gap():
    message = MultiDOFCommand(dof_names=['a'])
    template = template_of(message, ('values', 'values_dot'))
    assert is_that_of(message, template.pack(*template.constants), template)


def test_bytes_of_another_message_are_not_taken_for_its_own():
    message = PoseStamped()
    template = template_of(message, ('pose',))
    numbers = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)
    data = template.pack(template.constants[0], *numbers, b'')
    assert is_that_of(message, data, template)
    assert not is_that_of(message, b'\1' + data[1:], template)
    assert not is_that_of(message, data + b'\0', template)
    message.pose.orientation.w = 0.0
    assert not is_that_of(message, data, template)


def test_text_does_not_change():
    with pytest.raises(TypeError, match='text that changes'):
        template_of(PoseStamped(), ('header.frame_id',))
