# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``rosidl_runtime_py`` by its own name, and by those of its modules."""

from collections import OrderedDict

from geometry_msgs.msg import Point, Pose, PoseArray, PoseStamped
import pytest
from rosidl_parser.definition import NamespacedType, UnboundedSequence
from rosidl_runtime_py import (
    get_action_interfaces,
    get_interface_packages,
    get_interface_path,
    get_interfaces,
    get_message_interfaces,
    get_service_interfaces,
    message_to_csv,
    message_to_ordereddict,
    message_to_yaml,
    set_message_fields,
)
from rosidl_runtime_py.convert import get_message_slot_types
from rosidl_runtime_py.import_message import import_message_from_namespaced_type
from rosidl_runtime_py.utilities import (
    get_action,
    get_action_namespaced_type,
    get_interface,
    get_message,
    get_message_namespaced_type,
    get_namespaced_type,
    get_service,
    is_action,
    is_message,
    is_service,
)
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from std_srvs.srv import Trigger

STATE = JointState(name=['left', 'right'], position=[1.0, 2.0])


def test_messages_are_yaml_csv_and_dictionaries():
    assert message_to_yaml(String(data='a: b')) == "data: 'a: b'\n"
    text = message_to_yaml(STATE, flow_style=True)
    assert text.endswith('position: [1.0, 2.0]\nvelocity: []\neffort: []\n')
    assert message_to_csv(STATE) == '0,0,,left,right,1.0,2.0,,'
    found = message_to_ordereddict(STATE)
    assert list(found) == ['header', 'name', 'position', 'velocity', 'effort']
    assert isinstance(found['header']['stamp'], OrderedDict)
    assert (found['name'], found['position']) == (['left', 'right'], [1.0, 2.0])
    assert message_to_ordereddict(STATE, truncate_length=1)['position'] == [1.0, '...']
    assert 'sequence type' in message_to_yaml(STATE, no_arr=True)


def test_what_is_written_is_read_again():
    message = JointState()
    assert set_message_fields(message, message_to_ordereddict(STATE)) == []
    assert message == STATE
    pose = PoseStamped()
    (stamp,) = set_message_fields(pose, {'header': 'auto'}, expand_header_auto=True)
    assert callable(stamp)


@pytest.mark.parametrize(
    ('values', 'error', 'text'),
    [
        ({'nome': []}, AttributeError, "has no attribute 'nome'"),
        ({'position': 'far'}, ValueError, 'position'),
        ([1.0], TypeError, 'expected to be a dictionary but is a list'),
        (
            {'header': 'auto'},
            TypeError,
            "^Value 'auto' .* a dictionary but is a str$",
        ),
        ({'header': {'stamp': 'now'}}, TypeError, "^Value 'now' is expected to be a dictionary"),
    ],
)
def test_what_is_no_value_is_refused(values, error, text):
    with pytest.raises(error, match=text):
        set_message_fields(JointState(), values)


def test_a_field_may_be_given_as_a_message():
    pose = PoseStamped()
    given = Pose(position=Point(x=2.0))
    set_message_fields(pose, {'pose': given})
    array = PoseArray()
    set_message_fields(array, {'poses': [given, {'position': {'x': 2.0}}]})
    assert pose.pose == given == array.poses[0] == array.poses[1]
    with pytest.raises(TypeError, match='expected to be a dictionary but is a Point'):
        set_message_fields(pose, {'pose': Point()})


@pytest.mark.parametrize(
    ('function', 'name', 'error', 'text'),
    [
        (get_message, 'std_srvs/srv/Trigger', ValueError, 'the full name of a message, got'),
        (get_service, 'std_msgs/msg/String', ValueError, "a service, got 'std_msgs/msg/String'"),
        (get_action, 'std_msgs/msg/String', ValueError, 'the full name of an action, got'),
        (get_message, 'a_package_that_is_not/Any', ModuleNotFoundError, 'a_package_that_is_not'),
        (get_message, 'std_msgs/Nothing', AttributeError, 'Nothing'),
        (get_interface, 'String', ValueError, 'is not written as'),
    ],
)
def test_what_is_no_such_interface_is_an_error_as_of_an_import(function, name, error, text):
    with pytest.raises(error, match=text):
        function(name)


def test_the_type_of_an_array_is_taken_with_a_warning():
    array = UnboundedSequence(NamespacedType(['std_msgs', 'msg'], 'String'))
    with pytest.warns(DeprecationWarning, match='not of the array'):
        assert import_message_from_namespaced_type(array) is String


def test_classes_and_files_are_found_by_name():
    assert get_message('std_msgs/msg/String') is get_interface('std_msgs/msg/String') is String
    assert get_service('std_srvs/srv/Trigger') is Trigger
    assert get_action('nav2_msgs/action/Spin').__name__ == 'Spin'
    with pytest.raises(ValueError, match='not written as'):
        get_interface('std_msgs/String')
    assert get_interface_path('nav2_msgs/action/Spin').endswith('nav2_msgs/action/Spin.action')
    for name in ('nav2_msgs/action/Nothing', 'no_such_package/msg/Name'):
        with pytest.raises(LookupError):
            get_interface_path(name)
    assert [*get_message_slot_types(String)] == ['data']


def test_packages_have_interfaces_of_each_kind():
    assert {'std_msgs', 'std_srvs', 'tf2_msgs'} <= get_interface_packages().keys()
    assert 'rosidl_parser' not in get_interface_packages()
    mixed = ['std_msgs', 'std_srvs', 'tf2_msgs', 'rosidl_parser']
    assert get_interfaces(mixed).keys() == {'std_msgs', 'std_srvs', 'tf2_msgs'}
    assert 'msg/String' in get_message_interfaces()['std_msgs']
    assert get_message_interfaces(mixed).keys() == {'std_msgs', 'tf2_msgs'}
    assert get_service_interfaces(mixed)['std_srvs'] == [
        'srv/Empty',
        'srv/SetBool',
        'srv/Trigger',
    ]
    assert get_action_interfaces(mixed) == {'tf2_msgs': ['action/LookupTransform']}
    with pytest.raises(LookupError):
        get_interfaces(['no_such_package'])


def test_types_have_parts_and_classes():
    of = import_message_from_namespaced_type
    assert of(get_message_namespaced_type('std_msgs/String')) is String
    assert of(get_namespaced_type('std_srvs/srv/Trigger')) is Trigger
    action = get_action_namespaced_type('tf2_msgs/LookupTransform')
    assert [is_action(of(action)), is_service(of(action)), is_message(of(action))] == [
        True,
        False,
        False,
    ]
    assert is_service(Trigger)
    assert is_message(String())
    feedback = get_namespaced_type('tf2_msgs/action/LookupTransform_FeedbackMessage')
    assert is_message(of(feedback))
    with pytest.raises(ValueError, match='is not written as package/msg/Name'):
        get_namespaced_type('String')
