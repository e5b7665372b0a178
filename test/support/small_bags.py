# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Bags of a few texts, for tests."""

from collections.abc import Iterable
from pathlib import Path

from amr_description.bag.mcap_writer import BagWriter, WriterOptions
from amr_description.bag.qos_text import QosProfile
from amr_description.bag.reader import BagReader
from amr_description.bag.storage import BagMessage, TopicMetadata

MS = 10**6
BEGIN = 1_700_000_000 * 10**9
"""When the bags begin, ns."""
LATCHED = QosProfile(depth=1, durability='transient_local')
STRING = 'std_msgs/msg/String'


def string(text: str) -> bytes:
    """Return a std_msgs/msg/String as it is on the wire."""
    data = text.encode() + b'\0'
    return b'\0\1\0\0' + len(data).to_bytes(4, 'little') + data


def text_of(data: bytes) -> str:
    """Return the text of a std_msgs/msg/String."""
    return data[8:-1].decode()


def topic(name: str, *profiles: QosProfile, kind: str = STRING) -> TopicMetadata:
    """Return a topic whose publishers had these profiles; without any: the default."""
    return TopicMetadata(name, kind, 'cdr', profiles or (QosProfile(),))


def write_bag(
    folder: Path,
    topics: Iterable[TopicMetadata],
    texts: Iterable[tuple[int, str, str]],
    **options: object,
) -> Path:
    """Write a bag of (ms after :data:`BEGIN`, topic, text); return its folder."""
    return write_runs(folder, topics, texts, **options)


def write_runs(
    folder: Path,
    topics: Iterable[TopicMetadata],
    *files: Iterable[tuple[int, str, str]],
    **options: object,
) -> Path:
    """Write a bag as :func:`write_bag`, with a file for each of these, whose times begin again."""
    with BagWriter(folder, WriterOptions(**options)) as writer:
        for each in topics:
            writer.add_topic(each)
        for number, texts in enumerate(files):
            if number:
                writer.split()
            for after, name, text in texts:
                time = BEGIN + after * MS
                writer.write(BagMessage(name, string(text), time, time - MS))
    return folder


def read_bag(path: Path) -> list[tuple[int, str, str]]:
    """Return (ms after :data:`BEGIN`, topic, text) of all messages."""
    with BagReader(path) as reader:
        return [
            ((each.log_time - BEGIN) // MS, each.topic, text_of(each.data))
            for each in reader.messages()
        ]
