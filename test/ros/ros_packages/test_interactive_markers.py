# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``interactive_markers`` by its own name, against a client as RViz is one."""

from interactive_markers import InteractiveMarkerServer, MenuHandler
from interactive_markers.interactive_marker_server import InteractiveMarkerServer as ByModule
from interactive_markers.menu_handler import MenuHandler as MenuByModule
import pytest
import rclpy
from support.running_programs import PATIENCE
from visualization_msgs.msg import (
    InteractiveMarker,
    InteractiveMarkerFeedback,
    InteractiveMarkerUpdate,
)
from visualization_msgs.srv import GetInteractiveMarkers

from amr_description.ros.service_calls import wait_until


class Client:
    """Hears the markers of ``/tool``, and moves them."""

    def __init__(self, node):
        self.node, self.updates = node, []
        node.create_subscription(InteractiveMarkerUpdate, '/tool/update', self.updates.append, 10)
        self.feedback = node.create_publisher(InteractiveMarkerFeedback, '/tool/feedback', 10)
        self.asked = node.create_client(GetInteractiveMarkers, '/tool/get_interactive_markers')

    def last(self, count):
        self.until(lambda: len(self.updates) >= count)
        return self.updates[-1]

    def until(self, condition):
        assert wait_until(self.node, lambda: condition() or None, every=0.02, timeout=PATIENCE)

    def shown(self):
        self.until(self.asked.service_is_ready)
        answer = self.asked.call_async(GetInteractiveMarkers.Request())
        self.until(answer.done)
        return answer.result().markers

    def do(self, event, client='rviz', x=0.0, entry=0):
        message = InteractiveMarkerFeedback(
            marker_name='goal', client_id=client, event_type=event, menu_entry_id=entry
        )
        message.pose.position.x = x
        message.header.frame_id = 'elsewhere'
        self.feedback.publish(message)


@pytest.fixture
def node():
    rclpy.init()
    node = rclpy.create_node('tool_server')
    yield node
    node.destroy_node()
    rclpy.shutdown()


@pytest.fixture
def server(node):
    server = InteractiveMarkerServer(node, 'tool')
    yield server
    server.shutdown()


@pytest.fixture
def client(node, server):
    client = Client(node)
    client.until(
        lambda: node.count_subscribers('/tool/update') and node.count_subscribers('/tool/feedback')
    )
    client.until(lambda: server._publisher.get_subscription_count())
    client.until(lambda: client.feedback.get_subscription_count())
    return client


def marker(name='goal', frame='map'):
    made = InteractiveMarker(name=name)
    made.header.frame_id = frame
    return made


def test_a_marker_is_shown_moved_and_taken_away(client, server):
    server.insert(marker())
    assert server.get('goal') is not None
    assert client.shown() == []
    server.applyChanges()
    assert [each.name for each in client.last(1).markers] == ['goal']
    assert [each.name for each in client.shown()] == ['goal']
    pose = marker().pose
    pose.position.x = 2.0
    assert server.setPose('goal', pose)
    assert not server.setPose('nothing', pose)
    server.applyChanges()
    (moved,) = client.last(2).poses
    assert (moved.name, moved.header.frame_id, moved.pose.position.x) == ('goal', 'map', 2.0)
    assert server.erase('goal')
    assert server.get('goal') is None
    server.applyChanges()
    assert client.last(3).erases == ['goal']
    assert client.shown() == []
    assert [each.seq_num for each in client.updates] == [1, 2, 3]
    server.applyChanges()  # nothing was changed
    assert not server.erase('goal')
    assert server.seq_num == 3


def test_feedback_moves_the_marker_in_its_own_frame_and_calls_back(client, server):
    heard, pressed = [], []
    server.insert(marker(), feedback_callback=heard.append)
    assert server.setCallback('goal', pressed.append, InteractiveMarkerFeedback.BUTTON_CLICK)
    assert not server.setCallback('nothing', pressed.append)
    server.applyChanges()
    client.do(InteractiveMarkerFeedback.POSE_UPDATE, x=1.5)
    client.until(lambda: heard)
    (moved,) = client.last(2).poses
    assert (moved.header.frame_id, moved.pose.position.x) == ('map', 1.5)
    assert server.get('goal').pose.position.x == 1.5
    client.do(InteractiveMarkerFeedback.BUTTON_CLICK)
    client.until(lambda: pressed)
    assert len(heard) == 1


def test_a_second_client_waits_until_the_first_has_let_go(client, server):
    heard = []
    server.insert(marker(), feedback_callback=heard.append)
    server.applyChanges()
    client.do(InteractiveMarkerFeedback.MOUSE_DOWN)
    client.until(lambda: heard)
    client.do(InteractiveMarkerFeedback.MOUSE_DOWN, client='another')
    client.do(InteractiveMarkerFeedback.MOUSE_UP)
    client.until(lambda: len(heard) > 1)
    assert [each.client_id for each in heard] == ['rviz', 'rviz']


def test_a_callback_may_change_the_markers(client, server):
    def add(_feedback):
        server.insert(marker('second'))
        server.applyChanges()

    server.insert(marker(), feedback_callback=add)
    server.applyChanges()
    client.do(InteractiveMarkerFeedback.MOUSE_DOWN)
    client.until(lambda: any(each.name == 'second' for m in client.updates for each in m.markers))


def test_a_menu_calls_what_was_chosen(client, server):
    chosen = []
    menu = MenuHandler()
    speed = menu.insert('Speed')
    slow = menu.insert('slow', parent=speed, callback=chosen.append)
    hidden = menu.insert('never')
    assert menu.insert('lost', parent=99) is None
    assert menu.setCheckState(slow, MenuHandler.CHECKED)
    assert menu.setVisible(hidden, False)
    assert not (menu.setVisible(99, True) or menu.setCheckState(99, 0))
    assert (menu.getTitle(slow), menu.getCheckState(slow)) == ('slow', MenuHandler.CHECKED)
    assert menu.getTitle(99) is menu.getCheckState(99) is None
    assert not menu.apply(server, 'goal')  # it is not there yet
    server.insert(marker())
    assert menu.apply(server, 'goal')
    server.applyChanges()
    (shown,) = client.last(1).markers
    entries = [(each.id, each.parent_id, each.title) for each in shown.menu_entries]
    assert entries == [(speed, 0, 'Speed'), (slow, speed, '[x] slow')]
    client.do(InteractiveMarkerFeedback.MENU_SELECT, entry=slow)
    client.until(lambda: chosen)
    menu.setCheckState(slow, MenuHandler.UNCHECKED)
    assert menu.reApply(server)
    server.applyChanges()
    assert client.last(2).markers[0].menu_entries[1].title == '[ ] slow'


def test_names_of_modules():
    assert (ByModule, MenuByModule) == (InteractiveMarkerServer, MenuHandler)
