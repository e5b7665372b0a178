# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``metadata.yaml`` of a bag: version 9 is written, all up to it are read."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from amr_description.bag import qos_text, yaml_text
from amr_description.bag.storage import TopicMetadata
from amr_description.bag.yaml_text import shown, word
from amr_description.errors import BagError
from amr_description.text import shorten

FILE_NAME = 'metadata.yaml'
VERSION = 9
ROS_DISTRO = 'jazzy'
_ROOT = 'rosbag2_bagfile_information'


@dataclass
class FileInformation:
    """A file of a bag: its path in the folder, and its times in ns."""

    path: str
    starting_time: int = 0
    duration: int = 0
    message_count: int = 0

    def include(self, log_time: int) -> None:
        """Count a message that was received at a time."""
        if not self.message_count:
            self.starting_time = log_time
        elif log_time < self.starting_time:
            self.duration += self.starting_time - log_time
            self.starting_time = log_time
        self.duration = max(self.duration, log_time - self.starting_time)
        self.message_count += 1


@dataclass
class TopicInformation:
    """A topic, and how many messages of it there are."""

    topic_metadata: TopicMetadata
    message_count: int = 0


@dataclass
class BagMetadata:
    """What ``metadata.yaml`` says, by its names; times are ns."""

    storage_identifier: str = 'mcap'
    version: int = VERSION
    starting_time: int = 0
    duration: int = 0
    message_count: int = 0
    topics_with_message_count: list[TopicInformation] = field(default_factory=list)
    compression_format: str = ''
    compression_mode: str = ''
    relative_file_paths: list[str] = field(default_factory=list)
    files: list[FileInformation] = field(default_factory=list)
    custom_data: dict[str, str] = field(default_factory=dict)
    ros_distro: str = ROS_DISTRO

    @property
    def end_time(self) -> int:
        """When the last message was received."""
        return self.starting_time + self.duration

    def of_file(self, file: FileInformation, counts: Mapping[str, int]) -> 'BagMetadata':
        """Return what a file says that may be played alone; ``counts``: of it, by topic."""
        return replace(
            self,
            starting_time=file.starting_time,
            duration=file.duration,
            message_count=file.message_count,
            topics_with_message_count=[
                replace(topic, message_count=counts.get(topic.topic_metadata.name, 0))
                for topic in self.topics_with_message_count
            ],
            relative_file_paths=[file.path],
            files=[file],
            compression_format='',
            compression_mode='',
        )

    def span_files(self) -> None:
        """Set the times to those of all files."""
        used = [file for file in self.files if file.message_count]
        self.starting_time = min((file.starting_time for file in used), default=0)
        end = max((file.starting_time + file.duration for file in used), default=0)
        self.duration = end - self.starting_time


def to_node(metadata: BagMetadata) -> dict[str, Any]:
    """Return what YAML has below ``rosbag2_bagfile_information``, in version 9."""
    return {
        'version': VERSION,
        'storage_identifier': metadata.storage_identifier,
        'duration': {'nanoseconds': metadata.duration},
        'starting_time': {'nanoseconds_since_epoch': metadata.starting_time},
        'message_count': metadata.message_count,
        'topics_with_message_count': [
            {
                'topic_metadata': _topic_node(topic.topic_metadata),
                'message_count': topic.message_count,
            }
            for topic in metadata.topics_with_message_count
        ],
        'compression_format': metadata.compression_format,
        'compression_mode': metadata.compression_mode,
        'relative_file_paths': list(metadata.relative_file_paths),
        'files': [
            {
                'path': file.path,
                'starting_time': {'nanoseconds_since_epoch': file.starting_time},
                'duration': {'nanoseconds': file.duration},
                'message_count': file.message_count,
            }
            for file in metadata.files
        ],
        'custom_data': dict(metadata.custom_data) or None,
        'ros_distro': metadata.ros_distro,
    }


def _topic_node(topic: TopicMetadata) -> dict[str, Any]:
    return {
        'name': topic.name,
        'type': topic.type,
        'serialization_format': topic.serialization_format,
        'offered_qos_profiles': [
            qos_text.to_node(profile) for profile in topic.offered_qos_profiles
        ],
        'type_description_hash': topic.type_description_hash,
    }


def to_text(metadata: BagMetadata, *, with_root: bool = True) -> str:
    """Return the YAML; without its root it is what a record in an MCAP file has."""
    node = to_node(metadata)
    return yaml_text.dump({_ROOT: node} if with_root else node)


def from_text(text: str, what: str = FILE_NAME) -> BagMetadata:
    """
    Return what a YAML text says, with or without its root.

    Raises BagError, which begins with ``what``.
    """
    node = yaml_text.load(text, what)
    if isinstance(node, Mapping) and _ROOT in node:
        node = node[_ROOT]
    if not isinstance(node, Mapping) or 'version' not in node:
        raise BagError(f"{what}: there is no '{_ROOT}' with a version in it")
    if type(node['version']) is not int or not 1 <= node['version'] <= VERSION:
        raise BagError(
            f'{what}: version {shown(node["version"])} is not known; this reads those up to '
            f'{VERSION}'
        )
    try:
        return _metadata(node, what)
    except (AttributeError, KeyError, OverflowError, TypeError, ValueError) as error:
        reason = f'{type(error).__name__}: {shorten(str(error))}'
        raise BagError(f'{what}: not as rosbag2 writes it ({reason})') from error


def read(folder: Path) -> BagMetadata:
    """Return the metadata of a bag in a folder. Raises BagError."""
    path = folder / FILE_NAME
    try:
        return from_text(path.read_text(), str(path))
    except (OSError, UnicodeDecodeError) as error:
        raise BagError(f'cannot read {path}: {error}') from error


def write(folder: Path, metadata: BagMetadata) -> None:
    """Write the file, at once: an interruption leaves the former one, or none."""
    path = folder / FILE_NAME
    partial = path.with_name(f'.{FILE_NAME}.part')
    try:
        partial.write_text(to_text(metadata))
        partial.replace(path)
    except OSError as error:
        partial.unlink(missing_ok=True)
        raise BagError(f'cannot write {path}: {error}') from error


def _metadata(node: Mapping[str, Any], what: str) -> BagMetadata:
    return BagMetadata(
        storage_identifier=word(node['storage_identifier']),
        version=node['version'],
        starting_time=_integer(node['starting_time']['nanoseconds_since_epoch']),
        duration=_integer(node['duration']['nanoseconds']),
        message_count=_integer(node['message_count']),
        topics_with_message_count=[
            TopicInformation(_topic(each['topic_metadata'], what), _integer(each['message_count']))
            for each in node['topics_with_message_count'] or ()
        ],
        compression_format=word(node.get('compression_format')),
        compression_mode=word(node.get('compression_mode')),
        relative_file_paths=[word(path) for path in node['relative_file_paths'] or ()],
        files=[
            FileInformation(
                word(each['path']),
                _integer(each['starting_time']['nanoseconds_since_epoch']),
                _integer(each['duration']['nanoseconds']),
                _integer(each['message_count']),
            )
            for each in node.get('files') or ()
        ],
        custom_data={word(k): word(v) for k, v in (node.get('custom_data') or {}).items()},
        ros_distro=word(node.get('ros_distro')),
    )


def _integer(value: Any) -> int:
    """Return a time or a number as C++ has it. Raises TypeError, ValueError, OverflowError."""
    number = int(value)
    if not -(2**63) <= number < 2**64:
        raise ValueError(f'{shown(number)} has more than 64 bits')
    return number


def _topic(node: Mapping[str, Any], what: str) -> TopicMetadata:
    qos = node.get('offered_qos_profiles') or ()
    name = word(node['name'])
    where = f'{what}: offered_qos_profiles of {shorten(name)}'
    profiles = (
        qos_text.from_text(qos, where)
        if isinstance(qos, str)
        else qos_text.from_nodes(list(qos), where)
    )
    return TopicMetadata(
        name,
        word(node['type']),
        word(node.get('serialization_format')) or 'cdr',
        profiles,
        word(node.get('type_description_hash')),
    )
