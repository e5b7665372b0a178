# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Which topics ``ros2 bag record`` records."""

from collections.abc import Collection
from dataclasses import dataclass, field
import re

from amr_description.errors import BagError

EVENT_TOPIC = '/_service_event'
EVENT_TYPE = '_Event'
"""How the names of the types of their messages end."""


@dataclass(frozen=True)
class TopicFilter:
    """What the options ask for; names are full ones."""

    all_topics: bool = False
    all_services: bool = False
    topics: Collection[str] = ()
    topic_types: Collection[str] = ()
    services: Collection[str] = ()
    regex: str = ''
    exclude_regex: str = ''
    exclude_topics: Collection[str] = ()
    exclude_topic_types: Collection[str] = ()
    exclude_services: Collection[str] = ()
    include_hidden_topics: bool = False
    _patterns: dict[str, re.Pattern[str]] = field(default_factory=dict, init=False)

    def __post_init__(self) -> None:
        """Raise BagError if a regular expression is none."""
        for name in ('regex', 'exclude_regex'):
            text = getattr(self, name)
            try:
                if text:
                    self._patterns[name] = re.compile(text)
            except re.error as error:
                option = name.replace('_', '-')
                raise BagError(
                    f"--{option} '{text}' is not a regular expression: {error}"
                ) from error

    @property
    def names_all(self) -> bool:
        """Whether all that is asked for has a name: when all are there, nothing more will come."""
        names = bool(self.topics or self.services)
        return names and not (
            self.all_topics or self.all_services or self.regex or self.topic_types
        )

    @property
    def names(self) -> set[str]:
        """The topics that are asked for by name, those of services too."""
        return {*self.topics, *(f'{service}{EVENT_TOPIC}' for service in self.services)}

    def wants(self, topic: str, type_name: str) -> bool:
        """Return whether a topic is recorded."""
        return self.chooses(topic, type_name) and not self._hides(topic, type_name)

    def chooses(self, topic: str, type_name: str) -> bool:
        """Return whether a topic is recorded if it is not hidden, or hidden ones are, too."""
        if self._matches('exclude_regex', self._known_as(topic, type_name)):
            return False
        if is_service_event(topic, type_name):
            return self._wants_service(topic.removesuffix(EVENT_TOPIC))
        if topic in self.exclude_topics or type_name in self.exclude_topic_types:
            return False
        return (
            self.all_topics
            or topic in self.topics
            or type_name in self.topic_types
            or self._matches('regex', topic)
        )

    def _hides(self, topic: str, type_name: str) -> bool:
        is_event = is_service_event(topic, type_name)
        return is_hidden(topic) and not (is_event or self.include_hidden_topics)

    def _wants_service(self, service: str) -> bool:
        if service in self.exclude_services:
            return False
        return self.all_services or service in self.services or self._matches('regex', service)

    def _known_as(self, topic: str, type_name: str) -> str:
        return topic.removesuffix(EVENT_TOPIC) if is_service_event(topic, type_name) else topic

    def _matches(self, name: str, text: str) -> bool:
        """Return whether a part of the text matches; rosbag2 searches, too."""
        pattern = self._patterns.get(name)
        return pattern is not None and pattern.search(text) is not None


def is_hidden(topic: str) -> bool:
    """Return whether a part of the name begins with ``_``."""
    return '/_' in topic or topic.startswith('_')


def is_service_event(topic: str, type_name: str) -> bool:
    """Return whether a topic has the events of a service."""
    is_event = '/srv/' in type_name and type_name.endswith(EVENT_TYPE)
    return is_event and topic.endswith(EVENT_TOPIC)
