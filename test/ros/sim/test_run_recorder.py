# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What a process with a control loop records of itself, without a simulation."""

import re
import threading

import pytest
import rclpy
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.serialization import deserialize_message
from std_msgs.msg import String
from support.running_programs import PATIENCE

from amr_description.bag.mcap_writer import BagWriter
from amr_description.bag.reader import BagReader
from amr_description.control.contracts import Input, Port, Severity
from amr_description.control.ros.encoders import filling
from amr_description.control.ros.loop_publisher import ClockedLoopPublisher
from amr_description.errors import BagError
from amr_description.ros.cdr_padding import serialize
from amr_description.sim.ros.run_recorder import RunOptions, RunRecorder

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


def fill(sample, message):
    message.data = sample


class Host:
    """A loop by hand: topics ``said`` (samples) and ``now`` (latched), an input ``heard``."""

    def __init__(self, folder):
        self.node = Node('test_run_recorder')
        self.folder = folder / 'run'
        self.loop_publisher = ClockedLoopPublisher(self.node)
        said = self.node.create_publisher(String, 'said', 1)
        self.said = self.loop_publisher.topic(said, filling(fill, String()))
        self.now = self.loop_publisher.taped(self.node.create_publisher(String, 'now', LATCHED))
        subscription = self.node.create_subscription(String, 'heard', print, 1)
        self.heard = Input(Port('heard', 'std_msgs/msg/String'))
        self.loop_publisher.input(self.heard, subscription)
        self.heard.open()
        self.is_paced, self.is_tick = False, True
        self.lines = []

    def record(self, **options):
        self.recorder = RunRecorder(
            self.folder,
            RunOptions(**options),
            time=0,
            has_ticked=lambda _: self.is_tick,
            is_paced=lambda: self.is_paced,
            log=lambda severity, text, **_: self.lines.append((severity, text)),
        )
        self.loop_publisher.set_tape(self.recorder)
        return self.recorder

    def cycle(self, time, *samples):
        self.loop_publisher.set_clocks(time)
        for _ in self.heard.drain():
            pass
        for sample in samples:
            self.said.send(sample)
        self.loop_publisher.publish(time)

    def command(self, text):
        self.heard.put(text, serialize(String(data=text)))

    def end(self):
        self.loop_publisher.set_tape(None)
        return self.recorder.close()

    def files(self):
        """(time, topic, text) of each message but ``/clock``, by file."""
        return [
            [
                (each.log_time, each.topic, deserialize_message(each.data, String).data)
                for each in BagReader(path).messages()
                if each.topic != '/clock'
            ]
            for path in BagReader(self.folder).file_paths
        ]


@pytest.fixture
def host(tmp_path):
    rclpy.init(args=[])
    host = Host(tmp_path)
    yield host
    host.node.destroy_node()
    rclpy.try_shutdown()


def test_messages_are_recorded_at_the_time_at_which_they_are(host):
    host.now.publish(String(data='before'))
    host.record()
    host.cycle(10, 'a', 'b')
    host.command('go')
    host.command('go')  # once more, as its client has seen no acknowledgement
    host.now.publish(String(data='between'))
    host.cycle(20, 'c')
    host.end()
    host.cycle(30, 'd')
    assert host.files() == [
        [
            (0, '/now', 'before'),
            (10, '/said', 'a'),
            (10, '/said', 'b'),
            (10, '/now', 'between'),
            (20, '/heard', 'go'),
            (20, '/said', 'c'),
        ]
    ]
    assert host.recorder.commands == {'/heard'}
    topics = BagReader(host.folder).topics
    assert topics['/now'].offered_qos_profiles[0].durability == 'transient_local'
    assert topics['/said'].type_description_hash.startswith('RIHS01_')


def test_what_is_sent_while_time_stands_still_is_not_recorded(host):
    host.record()
    host.cycle(10, 'a')
    host.is_tick = False
    host.cycle(10, 'again')
    host.is_tick = True
    host.cycle(20, 'b')
    host.end()
    assert host.files() == [[(10, '/said', 'a'), (20, '/said', 'b')]]


def test_a_reset_begins_a_file_with_what_is_latched(host):
    host.now.publish(String(data='latched'))
    host.record()
    host.cycle(10, 'a')
    host.cycle(0, 'b')
    host.end()
    assert host.files() == [
        [(0, '/now', 'latched'), (10, '/said', 'a')],
        [(0, '/now', 'latched'), (0, '/said', 'b')],
    ]


def test_what_was_latched_by_who_is_gone_is_in_no_later_file(host):
    host.now.publish(String(data='latched'))
    recorder = host.record()
    recorder.latch('/robot_description', 'std_msgs/msg/String', serialize(String(data='robot')))
    host.cycle(10)
    host.loop_publisher.forget((), [host.now.publisher])
    recorder.unlatch('/robot_description')
    host.cycle(0, 'a')
    host.end()
    assert host.files() == [
        [(0, '/now', 'latched'), (0, '/robot_description', 'robot')],
        [(0, '/said', 'a')],
    ]


def test_topics_are_chosen_by_their_names(host):
    host.record(regex=re.compile('/said|/heard'), exclude_regex=re.compile('/h.*'))
    host.now.publish(String(data='no'))
    host.command('no')
    host.cycle(10, 'a')
    host.end()
    assert host.files() == [[(10, '/said', 'a')]]
    assert list(BagReader(host.folder).topics) == ['/said']


def test_a_full_disk_ends_the_recording_and_nothing_else(host, monkeypatch):
    def refuse(self, message):
        raise BagError('No space left on device')

    host.record()
    monkeypatch.setattr(BagWriter, 'write', refuse)
    host.cycle(10, 'a')
    host.cycle(20, 'b')
    assert host.lines == [
        (Severity.ERROR, 'nothing is recorded any more: No space left on device')
    ]
    host.end()


def test_in_real_time_what_has_no_room_is_counted_and_said(host, monkeypatch):
    may_write, write = threading.Event(), BagWriter.write

    def write_slowly(self, message):
        assert may_write.wait(PATIENCE)
        write(self, message)

    monkeypatch.setattr(BagWriter, 'write', write_slowly)
    host.is_paced = True
    host.record(exclude_regex=re.compile('/clock'), most_queued=0)
    host.cycle(10, 'a')
    host.cycle(20, 'lost', 'too')
    (line,) = host.lines
    assert line[0] == Severity.WARN
    assert line[1].startswith('2 messages were not recorded: the disk is too slow; ')
    may_write.set()
    host.is_paced = False
    host.cycle(30, 'b')  # time waits for the disk
    assert host.end() == 2
    assert host.files() == [[(10, '/said', 'a'), (30, '/said', 'b')]]


def test_a_folder_that_is_there_is_refused(host):
    host.folder.mkdir()
    with pytest.raises(BagError, match='cannot create the bag'):
        host.record()
