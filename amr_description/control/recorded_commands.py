# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Which of the commands that a controller takes are recorded."""

from collections.abc import Callable


def each_new(sink: Callable[[bytes], None]) -> Callable[[list[bytes]], None]:
    """
    Return what hands the messages of an update on, for :attr:`Input.on_drain`.

    Equal ones in a row are one: a client that sees no acknowledgement sends once more.
    """

    def record(messages: list[bytes]) -> None:
        latest = b''
        for message in messages:
            if message != latest:
                sink(message)
            latest = message

    return record
