# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Records topics at a page's wish: one bag at a time, which all pages see.

It goes on when the page has gone, until a page ends it or the viewer ends; the bag is complete
then.
"""

import asyncio
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
import shutil
import threading
import time

from rclpy.clock import Clock
from rclpy.clock_type import ClockType
from rclpy.executors import Executor
from rclpy.node import Node
from rclpy.timer import Timer

from amr_description.bag.folder_names import default_folder
from amr_description.bag.mcap_writer import BagWriter
from amr_description.bag.ros.recorder import Recorder, RecorderOptions
from amr_description.bag.topic_filter import TopicFilter
from amr_description.errors import AmrError, ViewerError
from amr_description.viewer.bags import BagWriting, StartRecording, StopRecording
from amr_description.viewer.ros.threads import on_ros_thread

_PERIOD = 0.25
"""s between two looks for new topics, and two messages about what is recorded."""
_NOTHING = BagWriting(False, '', 0.0, 0, 0, 0, 0, '', '', 0)


class PageRecorder:
    """
    Made on any thread.

    :meth:`start` and :meth:`stop` are called on the server's, :meth:`end` on the ROS thread.

    Args:
        node: subscribes.
        executor: of the ROS thread.
        folder: where bags are made.
        tell: gets what is new, on the ROS thread.
    """

    def __init__(
        self, node: Node, executor: Executor, folder: Path, tell: Callable[[BagWriting], object]
    ) -> None:
        self._node = node
        self._executor = executor
        self._folder = folder
        self._tell = tell
        self._writer: BagWriter | None = None
        self._recorder: Recorder | None = None
        self._timer: Timer | None = None
        self._ending: _Ending | None = None
        """What is still being written."""
        self._begin = 0.0
        self.status = replace(_NOTHING, folder=str(folder), free=_free(folder))
        """The last that was told; replaced as a whole."""

    def status_now(self) -> BagWriting:
        """Return the status with the room that is free now; from any thread."""
        return replace(self.status, free=_free(self._folder))

    async def start(self, request: StartRecording, _: str) -> str:
        """Begin to record; return what was done. Raises ViewerError."""
        return await on_ros_thread(self._executor, lambda: self._start(request))

    async def stop(self, _: StopRecording, __: str) -> str:
        """End what is recorded; return what was done. Raises ViewerError."""
        ending = await on_ros_thread(self._executor, self._end_receiving)
        await asyncio.to_thread(ending.complete)
        return await on_ros_thread(self._executor, self._answer_end)

    # --- on the ROS thread -----------------------------------------------------------------------

    def end(self) -> None:
        """End what is recorded, if anything is, and wait until it is written."""
        if self._recorder is not None:
            self._end_receiving()
        if self._ending is not None:
            self._ending.complete()
            self._tell_end()

    def _end_receiving(self) -> '_Ending':
        """End what is recorded; what has come is not written yet. Raises ViewerError."""
        recorder, writer, timer = self._recorder, self._writer, self._timer
        self._recorder = self._writer = self._timer = None
        if timer is not None:
            self._node.destroy_timer(timer)
        if recorder is None or writer is None:
            raise ViewerError('nothing is recorded')
        recorder.end_receiving()
        self._ending = _Ending(recorder, writer)
        return self._ending

    def _answer_end(self) -> str:
        """Tell that all is written; return it as an answer. Raises ViewerError: it is not."""
        self._tell_end()
        status = self.status
        if status.error:
            raise ViewerError(f'{status.path}: {status.error}')
        return f'{status.path}: {status.messages} messages in {status.seconds:.0f} s'

    def _tell_end(self) -> None:
        """Tell that all is written, unless that was told."""
        ending, self._ending = self._ending, None
        if ending is not None:
            status = self._status(ending.recorder)
            error = status.error or ending.error
            self._publish(replace(status, active=False, error=error))

    def _start(self, request: StartRecording) -> str:
        if self._recorder is not None:
            raise ViewerError(f'{self.status.path} is recorded already; stop that first')
        if self._ending is not None:
            raise ViewerError(f'{self.status.path} is still being written; wait for that')
        wanted = TopicFilter(
            all_topics=not request.topics,
            topics=request.topics,
            exclude_topic_types=request.without_types,
        )
        path = _new_folder(self._folder)
        self._writer = BagWriter(path)
        self._recorder = Recorder(self._node, self._writer, RecorderOptions(wanted))
        self._begin = time.monotonic()
        self.status = replace(self.status, active=True, path=str(path))
        self._recorder.start()
        self._look()
        clock = Clock(clock_type=ClockType.STEADY_TIME)  # simulated time may stand
        self._timer = self._node.create_timer(_PERIOD, self._look, clock=clock)
        return f'recording into {path}'

    def _look(self) -> None:
        """Subscribe to what is new, and tell what is recorded."""
        recorder = self._recorder
        if recorder is None:
            return
        recorder.discover()
        self._publish(self._status(recorder))
        if recorder.error is not None:
            self._node.get_logger().error(f'no more is recorded: {recorder.error}')
            self.end()

    def _status(self, recorder: Recorder) -> BagWriting:
        return BagWriting(
            True,
            self.status.path,
            round(time.monotonic() - self._begin, 1),
            recorder.messages_received,
            recorder.bytes_received,
            len(recorder.topics),
            sum(recorder.lost.values()),
            str(recorder.error or ''),
            str(self._folder),
            _free(self._folder),
        )

    def _publish(self, status: BagWriting) -> None:
        self.status = status
        self._tell(status)


class _Ending:
    """A bag of which all has come, but not all is written: a disk may be slow."""

    def __init__(self, recorder: Recorder, writer: BagWriter) -> None:
        self.recorder = recorder
        self.error = ''
        self._writer = writer
        self._completing = threading.Lock()

    def complete(self) -> None:
        """Wait until all is written, on any thread; again: nothing."""
        with self._completing:
            self.recorder.complete()
            try:
                self._writer.close()
            except AmrError as error:
                self.error = str(error)


def _free(folder: Path) -> int:
    """Return the bytes that are free where a folder is, or will be."""
    there = next(each for each in (folder, *folder.absolute().parents) if each.exists())
    try:
        return shutil.disk_usage(there).free
    except OSError:  # it is on a file system that does not tell
        return 0


def _new_folder(parent: Path) -> Path:
    """Return a folder that is not there yet, named as ``ros2 bag record`` names its bags."""
    name = default_folder()
    path, number = parent / name, 1
    while path.exists():  # as of two in one second
        number += 1
        path = parent / f'{name}_{number}'
    return path
