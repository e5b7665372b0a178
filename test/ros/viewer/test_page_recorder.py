# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A bag that a page has recorded, on a disk that is slow: the ROS thread does not wait for it."""

import asyncio
from contextlib import contextmanager
import threading

import pytest
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from sensor_msgs.msg import Image
from std_msgs.msg import String
from support.ros_processes import PATIENCE
from support.waiting import until

from amr_description.bag.mcap_writer import BagWriter
from amr_description.bag.reader import BagReader
from amr_description.errors import ViewerError
from amr_description.viewer.bags import StartRecording, StopRecording
from amr_description.viewer.ros.page_recorder import PageRecorder
from amr_description.viewer.ros.threads import on_ros_thread


@contextmanager
def spinning(node):
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    thread = threading.Thread(target=executor.spin)
    thread.start()
    try:
        yield executor
    finally:
        executor.shutdown()
        thread.join()


@pytest.fixture
def node():
    rclpy.init(args=[])
    made = Node('viewer')
    yield made
    made.destroy_node()
    rclpy.try_shutdown()


def test_while_a_bag_is_completed_the_ros_thread_is_free(node, tmp_path, monkeypatch):
    is_written, goes_on = threading.Event(), threading.Event()
    write = BagWriter.write

    def slowly(writer, message):
        is_written.set()
        assert goes_on.wait(PATIENCE)
        write(writer, message)

    monkeypatch.setattr(BagWriter, 'write', slowly)
    publisher = node.create_publisher(String, 'chatter', 10)
    told = []
    with spinning(node) as executor:
        recorder = PageRecorder(node, executor, tmp_path, told.append)

        async def record():
            await recorder.start(StartRecording(1, ('/chatter',)), 'page 1')
            await asyncio.to_thread(until, publisher.get_subscription_count)
            publisher.publish(String(data='hello'))
            assert await asyncio.to_thread(is_written.wait, PATIENCE)
            stopping = asyncio.create_task(recorder.stop(StopRecording(2), 'page 1'))
            await asyncio.to_thread(until, lambda: not publisher.get_subscription_count())
            assert await on_ros_thread(executor, lambda: 'free') == 'free'
            with pytest.raises(ViewerError, match='is still being written'):
                await recorder.start(StartRecording(3, ()), 'page 1')
            assert told[-1].active
            goes_on.set()
            return await stopping

        answer = asyncio.run(record())
    assert ': 1 messages in ' in answer
    assert not told[-1].active
    (folder,) = tmp_path.iterdir()
    with BagReader(folder) as reader:
        assert not reader.is_rebuilt
        assert len([*reader.messages()]) == 1


def test_types_are_left_out_and_the_room_is_told(node, tmp_path):
    folder = tmp_path / 'not' / 'there yet'
    publishers = [node.create_publisher(kind, topic, 10) for kind, topic in
                  ((String, 'chatter'), (Image, 'image'))]  # fmt: skip
    told = []
    with spinning(node) as executor:
        recorder = PageRecorder(node, executor, folder, told.append)
        assert (recorder.status.folder, recorder.status.free > 0) == (str(folder), True)

        async def record():
            await recorder.start(StartRecording(1, (), ('sensor_msgs/msg/Image',)), 'page 1')
            await asyncio.to_thread(until, publishers[0].get_subscription_count)
            return await recorder.stop(StopRecording(2), 'page 1')

        asyncio.run(record())
        assert publishers[1].get_subscription_count() == 0
    assert told[0].active
    assert told[-1].free > 0
