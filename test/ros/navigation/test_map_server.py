# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The node map_server: its states, its map, its services."""

from lifecycle_msgs.srv import ChangeState, GetState
from nav2_msgs.srv import LoadMap
from nav_msgs.msg import OccupancyGrid as OccupancyGridMessage
from nav_msgs.srv import GetMap
import numpy as np
import pytest
import rclpy
from rclpy.lifecycle import TransitionCallbackReturn
from rclpy.node import Node
from rclpy.parameter import Parameter
from support.running_programs import PATIENCE

from amr_description.errors import MapError
from amr_description.maps.grid import OccupancyGrid
from amr_description.maps.map_files import save_map
from amr_description.maps.pose import Pose
from amr_description.navigation.ros.messages import grid_of
from amr_description.nodes import map_server
from amr_description.nodes.map_server import MapServer
from amr_description.ros.qos import LATCHED
from amr_description.ros.runtime import spinning
from amr_description.ros.service_calls import call, wait_until

CELLS = np.array([[0, 100, -1], [-1, 0, 0]], np.int8)
SUCCESS, FAILURE = TransitionCallbackReturn.SUCCESS, TransitionCallbackReturn.FAILURE


@pytest.fixture
def hall(open_path):
    """The .yaml file of a small map."""
    return save_map(OccupancyGrid(CELLS, 0.05, Pose(-1.0, 2.0, 0.0)), open_path / 'hall')[1]


@pytest.fixture
def started():
    """Makes the node with ROS arguments, and one that listens; both end with the test."""
    stack = []

    def start(*parameters, make=MapServer):
        words = [word for each in parameters for word in ('-p', each)]
        rclpy.init(args=['--ros-args', *words])
        stack.append(rclpy.try_shutdown)
        running = spinning(make())
        executor = running.__enter__()
        stack.append(lambda: running.__exit__(None, None, None))
        node = Node('listener')
        stack.append(node.destroy_node)
        (server,) = executor.get_nodes()
        return server, node

    yield start
    while stack:
        stack.pop()()


def heard_on(node, topic='/map'):
    messages = []
    node.create_subscription(OccupancyGridMessage, topic, messages.append, LATCHED)
    wait_until(node, lambda: messages or None, timeout=PATIENCE, of_message=True)
    return messages


def change(node, transition):
    request = ChangeState.Request()
    request.transition.label = transition
    return call(node, ChangeState, '/map_server/change_state', request, timeout=PATIENCE).success


def state(node):
    request = GetState.Request()
    found = call(node, GetState, '/map_server/get_state', request, timeout=PATIENCE)
    return found.current_state.label


def load(node, url):
    request = LoadMap.Request(map_url=str(url))
    return call(node, LoadMap, '/map_server/load_map', request, timeout=PATIENCE)


def asked(node):
    return call(node, GetMap, '/map_server/map', GetMap.Request(), timeout=PATIENCE).map


def test_a_lifecycle_manager_brings_it_up_and_down(started, hall):
    _, node = started(f'yaml_filename:={hall}')
    assert state(node) == 'unconfigured'
    assert not node.get_publishers_info_by_topic('/map')
    assert change(node, 'configure')
    assert state(node) == 'inactive'
    assert asked(node).info.width == 0
    assert load(node, hall).result == LoadMap.Response.RESULT_UNDEFINED_FAILURE
    assert change(node, 'activate')
    message = heard_on(node)[0]
    grid = grid_of(message)
    assert (grid.cells == CELLS).all()
    assert (grid.origin, message.header.frame_id) == (Pose(-1.0, 2.0, 0.0), 'map')
    assert message.header.stamp == message.info.map_load_time
    assert message.header.stamp.sec > 0
    assert asked(node) == message
    assert change(node, 'deactivate')
    assert asked(node).info.width == 0
    assert change(node, 'cleanup')
    assert state(node) == 'unconfigured'
    wait_until(
        node, lambda: not node.get_publishers_info_by_topic('/map') or None, timeout=PATIENCE
    )
    assert not node.get_publishers_info_by_topic('/map')
    assert change(node, 'configure')
    assert change(node, 'activate')
    assert (grid_of(asked(node)).cells == CELLS).all()
    assert change(node, 'shutdown')
    assert state(node) == 'finalized'


def test_a_node_that_is_destroyed_leaves_nothing_in_the_graph(started):
    _, node = started()
    other = MapServer()
    wait_until(node, lambda: node.count_services('/map_server/get_state') == 2 or None)
    other.destroy_node()
    assert node.count_services('/map_server/get_state') == 1


def test_topic_and_frame_are_parameters(started, hall):
    _, node = started(f'yaml_filename:={hall}', 'topic_name:=hall', 'frame_id:=world')
    assert change(node, 'configure')
    assert change(node, 'activate')
    assert heard_on(node, '/hall')[0].header.frame_id == 'world'
    (end,) = node.get_publishers_info_by_topic('/hall')
    assert end.qos_profile.reliability.name == 'RELIABLE'
    assert end.qos_profile.durability.name == 'TRANSIENT_LOCAL'


def test_a_map_that_cannot_be_read_is_not_configured_until_it_can(started, hall, open_path):
    server, node = started(f'yaml_filename:={open_path}/none.yaml')
    assert not change(node, 'configure')
    assert state(node) == 'unconfigured'
    assert 'none.yaml: there is no such file' in str(server.fault)
    server.set_parameters([Parameter('yaml_filename', value=str(hall))])
    assert change(node, 'configure')
    assert state(node) == 'inactive'


def test_a_topic_that_is_no_name_is_not_configured_until_it_is_one(started, hall):
    server, node = started(f'yaml_filename:={hall}', "topic_name:='a b'")
    assert not change(node, 'configure')
    assert state(node) == 'unconfigured'
    assert str(server.fault).startswith("parameter 'topic_name': Invalid topic name")
    server.set_parameters([Parameter('topic_name', value='hall')])
    assert change(node, 'configure')


def test_without_a_file_the_map_comes_by_load_map(started, hall):
    _, node = started()
    assert change(node, 'configure')
    assert change(node, 'activate')
    assert asked(node).info.width == 0
    assert load(node, f'file://{hall}').result == LoadMap.Response.RESULT_SUCCESS
    assert (grid_of(heard_on(node)[0]).cells == CELLS).all()


def test_another_map_is_loaded_and_published(started, hall, open_path):
    _, node = started(f'yaml_filename:={hall}', 'autostart_node:=true', make=map_server._make_node)
    messages = heard_on(node)
    other = OccupancyGrid(np.zeros((4, 5), np.int8), 0.1, Pose(0.0, 0.0, 0.0))
    answer = load(node, save_map(other, open_path / 'other')[1])
    assert answer.result == LoadMap.Response.RESULT_SUCCESS
    assert (answer.map.info.width, answer.map.info.height) == (5, 4)
    wait_until(node, lambda: messages[1:] or None, timeout=PATIENCE, of_message=True)
    assert messages[1] == answer.map
    # What cannot be loaded leaves the map as it is.
    for text, result in (
        ('none.yaml', LoadMap.Response.RESULT_MAP_DOES_NOT_EXIST),
        ('', LoadMap.Response.RESULT_MAP_DOES_NOT_EXIST),
        ('package://no_such_package/m.yaml', LoadMap.Response.RESULT_MAP_DOES_NOT_EXIST),
        (open_path / 'hall.pgm', LoadMap.Response.RESULT_INVALID_MAP_METADATA),
    ):
        assert load(node, text).result == result
    (open_path / 'hall.pgm').write_bytes(b'BM')
    assert load(node, hall).result == LoadMap.Response.RESULT_INVALID_MAP_DATA
    assert asked(node) == answer.map


@pytest.mark.parametrize('secret', ['hall.yaml', 'hall.pgm'])
def test_a_request_names_no_map_that_not_everybody_may_read(started, hall, secret):
    hall.with_name(secret).chmod(0o600)
    server, node = started(f'yaml_filename:={hall}')
    assert change(node, 'configure'), 'who starts the node names any'
    assert change(node, 'activate')
    before = asked(node)
    assert load(node, hall).result == (
        LoadMap.Response.RESULT_INVALID_MAP_METADATA
        if secret == hall.name
        else LoadMap.Response.RESULT_INVALID_MAP_DATA
    )
    assert asked(node) == before
    for transition in ('deactivate', 'cleanup'):
        assert change(node, transition)
    server.set_parameters([Parameter('yaml_filename', value=f'{hall.parent}/./{hall.name}')])
    assert not change(node, 'configure')
    assert f'not everybody may read {hall.with_name(secret)}' in str(server.fault)


def test_it_starts_itself_or_ends_with_the_reason(started, hall, tmp_path):
    with pytest.raises(MapError, match=r'none.yaml: there is no such file'):
        started(
            f'yaml_filename:={tmp_path}/none.yaml', 'autostart_node:=true',
            make=map_server._make_node,
        )  # fmt: skip
