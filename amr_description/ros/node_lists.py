# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What each participant says of itself: its nodes, and the endpoints that they have.

Participants publish it on the DDS topic ``ros_discovery_info`` (``rmw_dds_common``), the newest
also for whoever comes later. rmw adds it to the endpoints that DDS discovers by itself, which may
come before or after it, and shows what it has of both. Whether that is all, only the lists tell.

No node can subscribe to that topic, because rcl puts a slash in front of every name. So this is
the one place that calls rmw (7.3, ``rmw/rmw.h``), in the libraries that rclpy has loaded.
"""

from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager, suppress
import ctypes
from dataclasses import dataclass
from functools import cache

from rclpy.node import Node

from amr_description.ros.publisher_gids import Allocator, SerializedMessage
from amr_description.ros.readers import Array, Row

TOPIC = 'ros_discovery_info'
"""The topic's name in DDS."""

PREFIX = 12
"""So many bytes of the gid of an endpoint are those of its participant (DDSI-RTPS 2.5, 9.3.1)."""

_GID = 16
_DEPTH = 100  # lists between two looks, of which each participant publishes one at first
_LIBRARY = 'librcl.so'  # symbols are looked for in what it was linked to, too
_TYPE_SUPPORT = (
    'rosidl_typesupport_c__get_message_type_support_handle__'
    'rmw_dds_common__msg__ParticipantEntitiesInfo'
)


@dataclass(frozen=True)
class NodeList:
    """Of one participant."""

    nodes: Counter[tuple[str, str]]
    """Name and namespace of each node; a name may be there twice."""
    endpoints: frozenset[bytes]
    """The gids of publishers, subscriptions, servers and clients."""


class NodeLists:
    """A subscription to the lists; made by :func:`subscribe_to_node_lists`."""

    def __init__(self, rmw: ctypes.CDLL, subscription: int) -> None:
        """``subscription``: the address of an ``rmw_subscription_t``."""
        self._rmw = rmw
        self._subscription = ctypes.c_void_p(subscription)
        self._newest: dict[bytes, NodeList] = {}

    def newest(self) -> dict[bytes, NodeList]:
        """Return the newest list that has come from each participant, by the prefix of its gid."""
        message = SerializedMessage(allocator=self._rmw.rcutils_get_default_allocator())
        taken = ctypes.c_bool()
        try:
            while True:
                code = self._rmw.rmw_take_serialized_message(
                    self._subscription, ctypes.byref(message), ctypes.byref(taken), None
                )
                if code or not taken.value:
                    return self._newest
                with suppress(ValueError):  # of another release of ROS, perhaps
                    gid, found = read_node_list(message.copied())
                    self._newest[gid[:PREFIX]] = found
        finally:
            self._rmw.rcutils_uint8_array_fini(ctypes.byref(message))


@contextmanager
def subscribe_to_node_lists(node: Node) -> Iterator[NodeLists | None]:
    """Yield the lists, to which ``node`` subscribes while inside; None: this rmw has none."""
    rmw = _rmw()
    subscription = None
    with node.handle:
        if rmw is not None:
            rmw_node = ctypes.c_void_p(rmw.rcl_node_get_rmw_handle(node.handle.pointer))
            subscription = rmw.rmw_create_subscription(
                rmw_node,
                ctypes.c_void_p(getattr(rmw, _TYPE_SUPPORT)()),
                TOPIC.encode(),
                ctypes.byref(_Qos(1, _DEPTH, 1, 1, avoid_ros_namespace_conventions=True)),
                ctypes.byref(rmw.rmw_get_default_subscription_options()),
            )
        if rmw is None or not subscription:
            yield None
            return
        try:
            yield NodeLists(rmw, subscription)
        finally:
            rmw.rmw_destroy_subscription(rmw_node, ctypes.c_void_p(subscription))


def read_node_list(data: bytes) -> tuple[bytes, NodeList]:
    """
    Read an ``rmw_dds_common/msg/ParticipantEntitiesInfo``.

    Returns:
        The gid of the participant, and its list.

    Raises:
        ValueError: The bytes are none.
    """
    return _NODE_LIST.read(data)


def _node_list(
    gid: Array, namespaces: list[str], names: list[str], *endpoints: list[list[Array]]
) -> tuple[bytes, NodeList]:
    nodes = Counter(zip(names, namespaces, strict=True))
    gids = (each for kind in endpoints for node in kind for each in node)
    return gid.tobytes(), NodeList(nodes, frozenset(each.tobytes() for each in gids))


_NODE_LIST = Row(
    'rmw_dds_common/msg/ParticipantEntitiesInfo',
    (
        'gid.data',
        'node_entities_info_seq[].node_namespace',
        'node_entities_info_seq[].node_name',
        'node_entities_info_seq[].reader_gid_seq[].data',
        'node_entities_info_seq[].writer_gid_seq[].data',
    ),
    _node_list,
)


class _Qos(ctypes.Structure):
    """``rmw_qos_profile_t``: of 1 1 1, keep last, reliable and transient local; 0: the default."""

    _fields_ = (
        ('history', ctypes.c_int),
        ('depth', ctypes.c_size_t),
        ('reliability', ctypes.c_int),
        ('durability', ctypes.c_int),
        ('deadline', ctypes.c_uint64 * 2),
        ('lifespan', ctypes.c_uint64 * 2),
        ('liveliness', ctypes.c_int),
        ('liveliness_lease_duration', ctypes.c_uint64 * 2),
        ('avoid_ros_namespace_conventions', ctypes.c_bool),
    )


class _Options(ctypes.Structure):
    """``rmw_subscription_options_t``."""

    _fields_ = (
        ('rmw_specific', ctypes.c_void_p),
        ('ignore_local_publications', ctypes.c_bool),
        ('require_unique_network_flow_endpoints', ctypes.c_int),
        ('content_filter_options', ctypes.c_void_p),
    )


@cache
def _rmw() -> ctypes.CDLL | None:
    """Return what rclpy has loaded; None: it has not all that is needed."""
    results = {
        'rcl_node_get_rmw_handle': ctypes.c_void_p,
        'rcutils_get_default_allocator': Allocator,
        'rcutils_uint8_array_fini': ctypes.c_int,
        'rmw_create_subscription': ctypes.c_void_p,
        'rmw_destroy_subscription': ctypes.c_int,
        'rmw_get_default_subscription_options': _Options,
        'rmw_take_serialized_message': ctypes.c_int,
        _TYPE_SUPPORT: ctypes.c_void_p,
    }
    try:
        library = ctypes.CDLL(_LIBRARY)
        for name, result in results.items():
            getattr(library, name).restype = result
    except (OSError, AttributeError):
        return None
    library.rcl_node_get_rmw_handle.argtypes = [ctypes.c_void_p]
    return library
