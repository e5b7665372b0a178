# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The ``MessageRecorder`` of the loop's publisher, which knows topics by their publishers."""

from contextlib import suppress

from rclpy.exceptions import InvalidHandle
from rclpy.publisher import Publisher
from rclpy.subscription import Subscription

from amr_description.bag.ros.qos_profiles import from_rclpy
from amr_description.bag.storage import TopicMetadata
from amr_description.control.ros.message_recorder import Sink
from amr_description.ros.message_types import type_name
from amr_description.simulation import run_recorder


class RosRunRecorder(run_recorder.RunRecorder):
    """See the base class; made and closed on the ROS thread."""

    def forget(self, publisher: Publisher) -> None:
        """Keep nothing that a publisher has latched, for it is destroyed."""
        with suppress(InvalidHandle):
            self.unlatch(publisher.topic_name)

    def samples_of(self, publisher: Publisher) -> Sink | None:
        """Return what takes the samples of cycles; None: this topic is not wanted."""
        topic = _topic_of(publisher)
        return None if topic is None else self.sink_of_samples(topic)

    def messages_of(self, publisher: Publisher) -> Sink | None:
        """Return what takes messages that are published now and then, likewise."""
        topic = _topic_of(publisher)
        return None if topic is None else self.sink_of_messages(topic)

    def commands_of(self, subscription: Subscription) -> Sink | None:
        """Return what takes the messages that a controller acts on, likewise."""
        try:
            name, kind = subscription.topic_name, type_name(subscription.msg_type)
        except InvalidHandle:
            return None
        return self.sink_of_commands(name, kind)


def _topic_of(publisher: Publisher) -> TopicMetadata | None:
    try:
        name, profile = publisher.topic_name, from_rclpy(publisher.qos_profile)
    except InvalidHandle:  # its robot has been removed
        return None
    return TopicMetadata(name, type_name(publisher.msg_type), 'cdr', (profile,))
