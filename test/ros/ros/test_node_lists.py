# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The lists that participants publish of their nodes, by way of rmw.

All is written for rmw 7.3: a failure here, after an update, is of another rmw.
"""

from collections import Counter

import pytest
import rclpy
from rclpy.context import Context
from rclpy.node import Node
from rclpy.serialization import serialize_message
from rmw_dds_common.msg import Gid, NodeEntitiesInfo, ParticipantEntitiesInfo
from std_msgs.msg import String
from support.ros_processes import PATIENCE

from amr_description.ros import node_lists
from amr_description.ros.node_lists import read_node_list, subscribe_to_node_lists
from amr_description.ros.service_calls import wait_until

GIDS = [bytes([number] * 16) for number in range(5)]


@pytest.fixture
def node():
    rclpy.init(args=[])
    node = Node('verb')
    yield node
    node.destroy_node()
    rclpy.try_shutdown()


@pytest.fixture
def other():
    """Return a node of a participant of its own."""
    context = Context()
    context.init(args=[])
    node = Node('other', namespace='/far/away', context=context)
    yield node
    node.destroy_node()
    context.try_shutdown()


def test_a_list_has_names_and_endpoints_of_all_nodes():
    gids = [Gid(data=list(gid)) for gid in GIDS]
    nodes = [
        NodeEntitiesInfo(node_namespace='/', node_name='one', reader_gid_seq=gids[1:3]),
        NodeEntitiesInfo(node_namespace='/a', node_name='two', writer_gid_seq=gids[3:]),
        NodeEntitiesInfo(node_namespace='/', node_name='one'),
    ]
    data = serialize_message(ParticipantEntitiesInfo(gid=gids[0], node_entities_info_seq=nodes))
    gid, found = read_node_list(data)
    assert gid == GIDS[0]
    assert found.nodes == Counter({('one', '/'): 2, ('two', '/a'): 1})
    assert found.endpoints == frozenset(GIDS[1:])
    for length in range(len(data) - 3):
        with pytest.raises(ValueError, match=r'bytes|CDR'):
            read_node_list(data[:length])


def test_a_participant_is_found_with_what_its_node_gets_and_loses(node, other):
    def endpoints():
        found = [each for each in lists.newest().values() if ('other', '/far/away') in each.nodes]
        return found[0].endpoints if found else frozenset()

    def are(known):
        return wait_until(node, lambda: endpoints() == known or None, timeout=PATIENCE)

    def published():
        return node.get_publishers_info_by_topic('/far/away/chatter') or None

    with subscribe_to_node_lists(node) as lists:
        before = wait_until(node, lambda: endpoints() or None, timeout=PATIENCE)
        publisher = other.create_publisher(String, 'chatter', 1)
        (found,) = wait_until(node, published, timeout=PATIENCE)
        assert are(before | {bytes(found.endpoint_gid)})
        other.destroy_publisher(publisher)
        assert are(before)


def test_no_topic_shows_the_subscription(node):
    before = node.get_topic_names_and_types()
    with subscribe_to_node_lists(node) as lists:
        assert wait_until(node, lambda: lists.newest() or None, timeout=PATIENCE)
        assert node.get_topic_names_and_types() == before


def test_where_rmw_is_another_there_is_none(node, monkeypatch):
    node_lists._rmw.cache_clear()
    monkeypatch.setattr(node_lists, '_LIBRARY', 'libc.so.6')
    try:
        with subscribe_to_node_lists(node) as lists:
            assert lists is None
    finally:
        node_lists._rmw.cache_clear()
