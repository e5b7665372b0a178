# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Recorded requests of services, sent again."""

from typing import Any

from rclpy.client import Client
from rclpy.node import Node
from rclpy.serialization import deserialize_message
from rclpy.task import Future
from service_msgs.msg import ServiceEventInfo

from amr_description.bag.storage import BagMessage, TopicMetadata
from amr_description.bag.topic_filter import EVENT_TYPE
from amr_description.bag.topic_selection import event_topic
from amr_description.ros.message_types import service_type
from amr_description.ros.service_calls import ServiceReadiness
from amr_description.text import shorten

SOURCES = {
    'service_introspection': ServiceEventInfo.REQUEST_RECEIVED,
    'client_introspection': ServiceEventInfo.REQUEST_SENT,
}
"""Of which events the requests are taken."""


class ServiceRequests:
    """Sends what was asked for by the events of services that a recording has."""

    def __init__(self, node: Node, source: str) -> None:
        """``source``: of :data:`SOURCES`; empty: nothing is sent."""
        self._node = node
        self._log = node.get_logger()
        self._event = SOURCES.get(source)
        self._clients: dict[str, tuple[Client, ServiceReadiness, Any]] = {}
        self._told: set[str] = set()
        self._sent: list[Future] = []

    def add(self, topic: TopicMetadata) -> None:
        """Make the client for the topic of a service's events. Raises AmrError: its type."""
        kind = service_type(topic.type.removesuffix(EVENT_TYPE))
        name = topic.name.removesuffix(event_topic(''))
        client = self._node.create_client(kind, name)
        self._clients[topic.name] = client, ServiceReadiness(self._node, client), kind

    def send(self, message: BagMessage) -> bool:
        """Send the request of an event; return False if it has none that is to be sent."""
        if message.topic not in self._clients:
            return False
        client, is_ready, kind = self._clients[message.topic]
        try:
            event = deserialize_message(message.data, kind.Event)
        except RuntimeError as error:
            self._warn_once(
                client.srv_name,
                f"Can't send service request. An event of '{client.srv_name}' cannot be read: "
                f'{shorten(str(error))}',
            )
            return False
        if event.info.event_type != self._event:
            return False
        if not event.request:
            self._warn_once(
                client.srv_name,
                f"Can't send service request. The configuration of introspection for "
                f"'{client.srv_name}' was metadata only!",
            )
            return False
        if not is_ready():
            self._log.error(
                f"Service request hasn't been sent. The '{client.srv_name}' service isn't ready !"
            )
            return False
        self._sent = [each for each in self._sent if not each.done()]
        self._sent.append(client.call_async(event.request[0]))
        return True

    @property
    def is_waiting(self) -> bool:
        """Whether a request was not answered yet."""
        return not all(each.done() for each in self._sent)

    def _warn_once(self, name: str, text: str) -> None:
        if name not in self._told:
            self._told.add(name)
            self._log.warning(text)
