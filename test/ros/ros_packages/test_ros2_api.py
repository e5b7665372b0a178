# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``ros2node.api`` and its like by their own names: what they say of a node beside them."""

import threading

from action_msgs.msg import GoalStatusArray
from ament_index_python.packages import get_package_prefix
import pytest
from rcl_interfaces.msg import ParameterType
import rclpy
from rclpy.action import ActionServer
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
import ros2action.api
from ros2cli.node.strategy import NodeStrategy
import ros2node.api
import ros2param.api
import ros2pkg.api
import ros2service.api
import ros2topic.api
from std_msgs.msg import String
from std_srvs.srv import Trigger
from support.ros_processes import PATIENCE
from tf2_msgs.action import LookupTransform


@pytest.fixture(scope='module')
def asking():
    """A node that asks, beside one in another context that is asked."""
    context = Context()
    rclpy.init(context=context)
    asked = Node('asked', namespace='/there', context=context)
    asked.declare_parameter('speed', 1.5)
    asked.create_publisher(String, 'words', 1)
    asked.create_publisher(String, '_quiet/words', 1)
    asked.create_subscription(GoalStatusArray, 'status', print, 1)
    asked.create_service(Trigger, 'do', lambda _, response: response)
    asked.create_client(Trigger, 'wish')
    server = ActionServer(asked, LookupTransform, 'look', lambda goal: None)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(asked)
    thread = threading.Thread(target=executor.spin)
    thread.start()
    with NodeStrategy(None) as node:
        assert ros2node.api.wait_for_node(node, 'there/asked', timeout=PATIENCE)
        yield node
    executor.shutdown()
    thread.join()
    server.destroy()
    asked.destroy_node()
    context.try_shutdown()


OF = {'remote_node_name': '/there/asked'}


def names(found):
    return {each.name: each.types for each in found}


def test_what_a_node_has(asking):
    published = names(ros2node.api.get_publisher_info(node=asking, **OF))
    assert published['/there/words'] == ['std_msgs/msg/String']
    assert '/there/_quiet/words' not in published
    shown = ros2node.api.get_publisher_info(node=asking, include_hidden=True, **OF)
    assert '/there/_quiet/words' in names(shown)
    assert '/there/status' in names(ros2node.api.get_subscriber_info(node=asking, **OF))
    assert '/there/do' in names(ros2node.api.get_service_server_info(node=asking, **OF))
    assert '/there/wish' in names(ros2node.api.get_service_client_info(node=asking, **OF))
    served = names(ros2node.api.get_action_server_info(node=asking, **OF))
    assert served == {'/there/look': ['tf2_msgs/action/LookupTransform']}
    plain = ros2node.api.get_action_server_info(node=asking.node, **OF)
    assert names(plain) == served
    assert ros2node.api.get_action_client_info(node=asking, **OF) == []


def test_what_the_graph_has(asking):
    found = ros2node.api.get_node_names(node=asking)
    assert ('asked', '/there', '/there/asked') in found
    assert not any(each.name.startswith('_ros2cli') for each in found)
    hidden = ros2node.api.get_node_names(node=asking, include_hidden_nodes=True)
    assert any(each.name.startswith('_ros2cli') for each in hidden)
    assert '/there/words' in ros2topic.api.get_topic_names(node=asking)
    assert '/there/_quiet/words' not in ros2topic.api.get_topic_names(node=asking)
    assert '/there/do' in ros2service.api.get_service_names(node=asking)
    assert '/there/look' in ros2action.api.get_action_names(node=asking)
    assert not ros2node.api.wait_for_node(asking, '/nobody', timeout=0.0)


def test_classes_of_topics_and_services(asking, capsys):
    assert ros2topic.api.get_msg_class(asking, '/there/words') is String
    assert ros2service.api.get_service_class(asking, '/there/do', False) is Trigger
    assert ros2topic.api.get_msg_class(asking, '/nothing') is None
    assert 'topic [/nothing] does not appear to be published yet' in capsys.readouterr().out
    with pytest.raises(RuntimeError, match="Cannot find type for '/nothing'"):
        ros2service.api.get_service_class(asking, '/nothing', False)
    with pytest.raises(RuntimeError, match='topic name'):
        ros2topic.api.get_msg_class(asking, '/no//name')


def test_parameters_are_asked_for_and_set(asking, tmp_path, capsys):
    of = {'node': asking, 'node_name': '/there/asked'}
    fast = Parameter('speed', value=2.5).to_parameter_msg()
    assert ros2param.api.call_set_parameters(parameters=[fast], **of).results[0].successful
    (value,) = ros2param.api.call_get_parameters(parameter_names=['speed'], **of).values
    assert ros2param.api.get_value(parameter_value=value) == 2.5
    assert ros2param.api.get_parameter_type_string(value.type) == 'double'
    assert 'speed' in ros2param.api.call_list_parameters(**of).result().result.names
    described = ros2param.api.call_describe_parameters(parameter_names=['speed'], **of)
    assert described.descriptors[0].type == ParameterType.PARAMETER_DOUBLE
    file = tmp_path / 'a.yaml'
    file.write_text('/there/asked:\n  ros__parameters: {speed: 3.5, other: 1}\n')
    ros2param.api.load_parameter_file(parameter_file=str(file), use_wildcard=False, **of)
    said = capsys.readouterr()
    assert 'Set parameter successful' in said.out
    assert 'Set parameter failed' in said.err


@pytest.mark.parametrize(
    ('value', 'text'),
    [
        (ParameterType.PARAMETER_NOT_SET, 'not set'),
        (ParameterType.PARAMETER_BOOL_ARRAY, 'boolean array'),
        (ParameterType.PARAMETER_BYTE_ARRAY, 'byte array'),
    ],
)
def test_types_of_parameters_have_names(value, text):
    assert ros2param.api.get_parameter_type_string(value) == text


def test_names_have_parts():
    assert ros2node.api.parse_node_name('a/b') == ('b', '/a', '/a/b')
    assert ros2node.api.parse_node_name('/b') == ('b', '/', '/b')
    assert ros2node.api.get_absolute_node_name('b') == '/b'
    assert ros2node.api.get_absolute_node_name('') is None
    assert ros2node.api.has_duplicates(['a', 'b', 'a'])


def test_packages_and_their_executables():
    assert 'xacro' in ros2pkg.api.get_package_names()
    assert ros2pkg.api.get_prefix_path('no_such_package') is None
    (path,) = ros2pkg.api.get_executable_paths(package_name='xacro')
    assert path == f'{get_package_prefix("xacro")}/lib/xacro/xacro'
    with pytest.raises(ros2pkg.api.PackageNotFound):
        ros2pkg.api.get_executable_paths(package_name='no_such_package')
