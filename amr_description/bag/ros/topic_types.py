# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Classes of the topics of a bag, also of those that have the events of services."""

from typing import Any

from amr_description.bag.topic_filter import EVENT_TYPE
from amr_description.ros.message_types import message_type, service_type


def topic_class(name: str) -> Any:
    """Return the class of a topic's type, as ``package/msg/Name``. Raises AmrError."""
    if '/srv/' in name and name.endswith(EVENT_TYPE):
        return service_type(name.removesuffix(EVENT_TYPE)).Event
    return message_type(name, 'The type of the topic')
