# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Which topics of a bag are meant by ``--topics``, ``--regex`` and the flags that exclude."""

from collections.abc import Collection
from dataclasses import dataclass
import re

from amr_description.bag import topic_filter
from amr_description.bag.storage import TopicMetadata
from amr_description.bag.topic_filter import EVENT_TOPIC
from amr_description.errors import UsageError
from amr_description.text import quote


def is_service_event(topic: TopicMetadata) -> bool:
    """Return whether a topic has the events of a service: its requests and responses."""
    return topic_filter.is_service_event(topic.name, topic.type)


def event_topic(service: str) -> str:
    """Return the topic of the events of a service."""
    return service + EVENT_TOPIC


def full_name(name: str) -> str:
    """Return the name of a topic or service with the slash before it."""
    return name if name.startswith('/') else f'/{name}'


@dataclass(frozen=True)
class TopicSelection:
    """
    What is given on the command line; a topic that is excluded anywhere is not meant.

    Of names and expressions that include, one is enough; where there is none, all are meant.
    """

    topics: Collection[str] = ()
    services: Collection[str] = ()
    regex: str = ''
    """Matches the whole name."""
    exclude_topics: Collection[str] = ()
    exclude_services: Collection[str] = ()
    exclude_regex: str = ''

    def __post_init__(self) -> None:
        """Raises UsageError: an expression is none."""
        for flag, text in (('--regex', self.regex), ('--exclude-regex', self.exclude_regex)):
            try:
                re.compile(text)
            except re.error as error:
                raise UsageError(
                    f'{flag}: {quote(text)} is no regular expression: {error}'
                ) from error

    def holds(self, topic: TopicMetadata) -> bool:
        """Return whether a topic is meant."""
        name = topic.name
        excluded = (
            {event_topic(full_name(each)) for each in self.exclude_services}
            if is_service_event(topic)
            else {full_name(each) for each in self.exclude_topics}
        )
        if name in excluded or (self.exclude_regex and re.fullmatch(self.exclude_regex, name)):
            return False
        if not (self.topics or self.services or self.regex):
            return True
        return (
            name in {full_name(each) for each in self.topics}
            or name in {event_topic(full_name(each)) for each in self.services}
            or bool(self.regex and re.fullmatch(self.regex, name))
        )
