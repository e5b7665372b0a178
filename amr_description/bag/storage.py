# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A topic and a message of a bag, and what a file has of them."""

from dataclasses import dataclass
from typing import NamedTuple

from amr_description.bag.qos_text import QosProfile


@dataclass(frozen=True)
class TopicMetadata:
    """What a bag knows of a topic."""

    name: str
    type: str
    """As ``std_msgs/msg/String``."""
    serialization_format: str = 'cdr'
    offered_qos_profiles: tuple[QosProfile, ...] = ()
    """Of each publisher that was there."""
    type_description_hash: str = ''
    """As ``RIHS01_…``; empty: not known."""


class FileExtent(NamedTuple):
    """Between which times a file has messages, ns, and of which topics."""

    begin: int
    end: int
    topics: set[str]


class BagMessage(NamedTuple):
    """A message as it is on the wire, and its times: ns of the clock that the recorder used."""

    topic: str
    data: bytes
    log_time: int
    """When it was received."""
    publish_time: int
    """When it was sent."""


OVERHEAD = 200
"""Bytes of memory that a message takes beside its data."""
