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
from tf2_msgs.msg import TFMessage

from amr_description.bag.mcap_writer import BagWriter
from amr_description.bag.reader import BagReader
from amr_description.bag.storage import OVERHEAD
from amr_description.control.contracts import Input, Port
from amr_description.control.ros.loop_publisher import ClockedLoopPublisher, LoopTopic
from amr_description.errors import BagError
from amr_description.log import Severity
from amr_description.messages.encoders import filling
from amr_description.ros.layouts import serialize
from amr_description.sim.ros.run_recorder import RosRunRecorder
from amr_description.simulation import run_recorder
from amr_description.simulation.run_recorder import RunOptions

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
        names = self.node.create_publisher(String, 'names', LATCHED)
        self.names = self.loop_publisher.topic(names, filling(fill, String()))
        self.now = self.loop_publisher.recorded(self.node.create_publisher(String, 'now', LATCHED))
        subscription = self.node.create_subscription(String, 'heard', print, 1)
        self.heard = Input(Port('heard', 'std_msgs/msg/String'))
        self.loop_publisher.input(self.heard, subscription)
        self.heard.open()
        self.is_paced, self.is_tick = False, True
        self.lines = []

    def record(self, **options):
        self.recorder = RosRunRecorder(
            self.folder,
            RunOptions(**options),
            time=0,
            has_ticked=lambda _: self.is_tick,
            is_paced=lambda: self.is_paced,
            log=lambda severity, text, **_: self.lines.append((severity, text)),
        )
        self.loop_publisher.set_recorder(self.recorder)
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
        self.loop_publisher.set_recorder(None)
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


def test_the_latched_sample_of_a_controller_is_in_each_file(host):
    host.is_tick = False
    host.names.send('sent once, at activation')
    host.cycle(5)
    host.record()
    host.is_tick = True
    host.cycle(10, 'a')
    host.cycle(0, 'b')
    host.is_tick = False
    host.names.send('other names')
    host.cycle(0)
    host.end()
    assert host.files() == [
        [(0, '/names', 'sent once, at activation'), (10, '/said', 'a')],
        [
            (0, '/names', 'sent once, at activation'),
            (0, '/said', 'b'),
            (0, '/names', 'other names'),
        ],
    ]


def test_a_reset_after_which_no_time_passes_begins_no_file(host):
    host.now.publish(String(data='latched'))
    host.record()
    host.cycle(10, 'a')
    host.is_tick = False
    host.cycle(0, 'not in a tick')
    host.now.publish(String(data='changed'))
    host.end()
    assert host.files() == [[(0, '/now', 'latched'), (10, '/said', 'a')]]


def test_files_are_read_before_the_lock_that_the_control_thread_needs(host, monkeypatch):
    recorder, prepared = host.record(), []

    def prepare(name):
        assert not host.loop_publisher._changing_topics.locked()
        prepared.append(name)

    monkeypatch.setattr(recorder, 'prepare', prepare)
    host.loop_publisher.recorded(host.node.create_publisher(TFMessage, 'later', 1))
    assert prepared == ['tf2_msgs/msg/TFMessage']
    host.end()


def test_a_picture_is_published_when_the_recording_ends_meanwhile(host):
    class Racing(LoopTopic):
        """A topic whose sink the control thread takes away once it has been looked at."""

        sinks = ()

        @property
        def sink(self):
            return next(self.sinks, None)

        @sink.setter
        def sink(self, sink):
            self.sinks = iter([sink])

    publisher = host.node.create_publisher(String, 'picture', 1)
    topic = Racing(publisher, lambda text: serialize(String(data=text)), [])
    for write in (topic.write, topic.write_aside):
        taken = []
        topic.sink = taken.append
        write('a')
        assert taken == [serialize(String(data='a'))]


def test_a_message_latched_by_a_removed_node_is_in_no_later_file(host):
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
    host.recorder.on_failure = lambda: host.loop_publisher.set_recorder(None)
    monkeypatch.setattr(BagWriter, 'write', refuse)
    host.cycle(10, 'a')
    assert host.said.sink is None, 'it still makes what nobody hears'
    host.cycle(20, 'b')
    assert host.lines == [
        (Severity.ERROR, 'nothing is recorded any more: No space left on device')
    ]
    with pytest.raises(BagError, match='No space left on device'):
        host.end()


def test_a_fault_in_the_thread_that_writes_ends_the_recording_and_nothing_else(
    host, monkeypatch, capsys
):
    def fail(self, message):
        raise KeyError('a fault of ours')

    monkeypatch.setattr(BagWriter, 'write', fail)
    host.is_paced = True
    host.record()
    host.cycle(10, 'a')
    host.is_paced = False
    host.cycle(20, 'b')  # waits for the thread
    with pytest.raises(BagError, match="the recorder failed: KeyError: 'a fault of ours'"):
        host.end()
    assert 'Traceback' in capsys.readouterr().err


def test_a_disk_that_stands_does_not_keep_the_process(host, monkeypatch):
    may_write, write = threading.Event(), BagWriter.write

    def stand(self, message):
        assert may_write.wait(PATIENCE)
        write(self, message)

    monkeypatch.setattr(BagWriter, 'write', stand)
    monkeypatch.setattr(run_recorder, 'LONGEST_END', 0.05)
    host.is_paced = True
    host.record()
    host.cycle(10, 'a')
    try:
        with pytest.raises(BagError, match=r'the disk has not taken all within 0\.05 s'):
            host.end()
    finally:
        may_write.set()


def test_what_a_slow_disk_has_not_taken_in_time_is_counted_and_the_bag_is_complete(
    host, monkeypatch
):
    monkeypatch.setattr(run_recorder, 'LONGEST_DRAIN', -1.0)
    host.record()
    host.now.publish(String(data='latched'))
    host.said.write('a')
    host.recorder.begin_cycle(10)
    host.said.write('b')
    assert host.end() == 1
    assert host.files() == [[(0, '/now', 'latched')]]
    ((severity, line),) = host.lines
    assert severity == Severity.WARN
    assert line.startswith('1 messages were not recorded')


def held_disk(monkeypatch):
    """Have bags written as soon as the event is set that is returned."""
    may_write, write = threading.Event(), BagWriter.write

    def write_slowly(self, message):
        assert may_write.wait(PATIENCE)
        write(self, message)

    monkeypatch.setattr(BagWriter, 'write', write_slowly)
    return may_write


def test_in_real_time_what_has_no_room_is_counted_and_said(host, monkeypatch):
    may_write = held_disk(monkeypatch)
    host.is_paced = True
    host.record(exclude_regex=re.compile('/clock'), most_queued=0)
    host.cycle(10, 'a')
    host.cycle(20, 'lost', 'too')
    (line,) = host.lines
    assert line[0] == Severity.WARN
    assert line[1].startswith('2 messages were not recorded: the disk is too slow; ')
    host.now.publish(String(data='kept'))
    host.cycle(25)
    may_write.set()
    host.is_paced = False
    host.cycle(30, 'b')  # time waits for the disk
    host.cycle(0, 'c')
    assert host.end() == 5
    assert host.files() == [
        [(10, '/said', 'a'), (20, '/now', 'kept'), (30, '/said', 'b')],
        [(0, '/now', 'kept'), (0, '/said', 'c')],
    ]


def test_memory_is_bounded_for_many_small_messages_too(host, monkeypatch):
    may_write = held_disk(monkeypatch)
    host.is_paced = True
    host.record(regex=re.compile('/said'), most_queued=10 * OVERHEAD)
    for time in range(10, 500, 10):
        host.cycle(time, '')
    assert len(host.lines) == 1
    may_write.set()
    assert host.end() < 20


def test_a_folder_that_is_there_is_refused(host):
    host.folder.mkdir()
    with pytest.raises(BagError, match='cannot create the bag'):
        host.record()
