# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What ``ros2 bag info`` prints of a bag."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from datetime import datetime
from typing import Any

from amr_description.bag.metadata import BagMetadata, TopicInformation
from amr_description.bag.storage import BagMessage, TopicMetadata
from amr_description.bag.topic_filter import EVENT_TOPIC, EVENT_TYPE, is_service_event

_SECOND = 10**9
_INDENTATION = ' ' * len('Topic information: ')
_INDENTATION_OF_SERVICES = ' ' * len('Service information: ')
_UNITS = ('B', 'KiB', 'MiB', 'GiB', 'TiB')
_AT_TYPE_OF_EVENT = 4  # behind the header of CDR
_KINDS_OF_EVENT = 4  # a request sent, received, a response sent, received

SORTING: Mapping[str, Callable[[TopicInformation], Any]] = {
    'name': lambda each: each.topic_metadata.name,
    'type': lambda each: each.topic_metadata.type,
    'count': lambda each: each.message_count,
}
"""By what topics and services can be sorted, the least first."""


@dataclass
class Contents:
    """What only reading all messages tells."""

    sizes: dict[str, int] = field(default_factory=dict)
    """Bytes of the messages of each topic."""
    events: dict[str, list[int]] = field(default_factory=dict)
    """Of each service: how many events of each kind there are."""

    def add(self, message: BagMessage) -> None:
        """Count a message."""
        topic = message.topic
        self.sizes[topic] = self.sizes.get(topic, 0) + len(message.data)
        if topic.endswith(EVENT_TOPIC) and len(message.data) > _AT_TYPE_OF_EVENT:
            kind = message.data[_AT_TYPE_OF_EVENT]
            if kind < _KINDS_OF_EVENT:
                self.events.setdefault(topic, [0] * _KINDS_OF_EVENT)[kind] += 1


def topic_names(metadata: BagMetadata, sort: str = 'name') -> list[str]:
    """Return the names that ``--topic-name`` prints; ``sort``: one of :data:`SORTING`."""
    topics = (each.topic_metadata for each in _sorted(metadata, sort))
    return [topic.name for topic in topics if not _is_of_service(topic)]


def info_text(
    metadata: BagMetadata, size: int, contents: Contents | None = None, sort: str = 'name'
) -> str:
    """
    Return the text, with a line for everything.

    Args:
        metadata: of the bag.
        size: of all files, bytes.
        contents: what was counted, for ``--verbose``; None: not verbose.
        sort: one of :data:`SORTING`.
    """
    topics = _sorted(metadata, sort)
    services = [each for each in topics if _is_of_service(each.topic_metadata)]
    others = [each for each in topics if not _is_of_service(each.topic_metadata)]
    begin, end = metadata.starting_time, metadata.end_time
    return '\n'.join(
        [
            '',
            _rows('Files:             ', metadata.relative_file_paths, _INDENTATION),
            f'Bag size:          {size_text(size)}',
            f'Storage id:        {metadata.storage_identifier}',
            f'ROS Distro:        {metadata.ros_distro or "unknown"}',
            f'Duration:          {_seconds(metadata.duration)}s',
            f'Start:             {_time(begin)}',
            f'End:               {_time(end)}',
            f'Messages:          {metadata.message_count}',
            _rows(
                'Topic information: ', [_topic(each, contents) for each in others], _INDENTATION
            ),
            f'Service:           {len(services)}',
            _rows(
                'Service information: ',
                [_service(each, contents) for each in services],
                _INDENTATION_OF_SERVICES,
            ),
            '',
        ]
    )


def _sorted(metadata: BagMetadata, sort: str) -> list[TopicInformation]:
    return sorted(metadata.topics_with_message_count, key=SORTING[sort])


def _is_of_service(topic: TopicMetadata) -> bool:
    return is_service_event(topic.name, topic.type)


def size_text(size: float) -> str:
    """Return bytes as people read them: ``5.4 KiB``."""
    unit = 0
    while size >= 1024 and unit < len(_UNITS) - 1:
        size, unit = size / 1024, unit + 1
    return f'{size:.1f} {_UNITS[unit]}' if unit else f'{size:.0f} {_UNITS[unit]}'


def _rows(title: str, rows: Iterable[str], indentation: str) -> str:
    return title + f'\n{indentation}'.join(rows)


def _topic(information: TopicInformation, contents: Contents | None) -> str:
    topic = information.topic_metadata
    return (
        f'Topic: {topic.name} | Type: {topic.type} | Count: {information.message_count} | '
        f'{_share(contents, topic.name)}Serialization Format: {topic.serialization_format}'
    )


def _service(information: TopicInformation, contents: Contents | None) -> str:
    topic = information.topic_metadata
    service = topic.name.removesuffix(EVENT_TOPIC)
    kind = topic.type.removesuffix(EVENT_TYPE)
    return (
        f'Service: {service} | Type: {kind} | {_calls(information, contents)} | '
        f'{_share(contents, topic.name)}Serialization Format: {topic.serialization_format}'
    )


def _calls(information: TopicInformation, contents: Contents | None) -> str:
    if contents is None:
        return f'Event Count: {information.message_count}'
    # Each is told by the client, by the server, or by both.
    events = contents.events.get(information.topic_metadata.name, [0] * _KINDS_OF_EVENT)
    return f'Request Count: {max(events[:2])} | Response Count: {max(events[2:])}'


def _share(contents: Contents | None, topic: str) -> str:
    if contents is None:
        return ''
    sizes: Mapping[str, int] = contents.sizes
    return f'Size Contribution: {size_text(sizes.get(topic, 0))} | '


def _seconds(time: int) -> str:
    whole, rest = divmod(time, _SECOND)
    return f'{whole}.{rest:09}'


def _time(time: int) -> str:
    whole, rest = divmod(time, _SECOND)
    return f'{datetime.fromtimestamp(whole):%b %e %Y %H:%M:%S}.{rest:09} ({_seconds(time)})'
