# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What the parameter 'record' begins and ends, and what it tells who sets it."""

from unittest.mock import Mock

import pytest
import rclpy
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.serialization import deserialize_message
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

from amr_description.bag.mcap_writer import BagWriter
from amr_description.bag.reader import BagReader
from amr_description.bag.run_description import from_text, RunDescription, TOPIC
from amr_description.control.ros.loop_publisher import ClockedLoopPublisher
from amr_description.errors import BagError
from amr_description.log import Severity
from amr_description.ros.layouts import serialize
from amr_description.sim.ros.run_recorder import RosRunRecorder
from amr_description.sim.ros.run_recording import RosRunRecording
from amr_description.sim.ros.simulation import Simulation
from amr_description.text import shorten


class Transforms:
    """Of no links."""

    def set_robots(self, robots):
        return serialize(TFMessage())

    def restart(self):
        pass

    def moving(self, time):
        return None


class Host:
    """A simulator without a world; its control thread is that of the test."""

    def __init__(self):
        self.node = Node('test_run_recording')
        for name in ('record', 'record_below', 'record_regex', 'record_exclude_regex'):
            self.node.declare_parameter(name, '')
        self.loop_publisher = ClockedLoopPublisher(self.node)
        self.lines, self.run = [], RunDescription({'seed': 1})
        self.recording = RosRunRecording(
            self.node,
            self.loop_publisher,
            on_loop=lambda call: call(),
            time=lambda: 0,
            has_ticked=lambda time: True,
            is_paced=lambda: False,
            describe=self.describe,
            robots=list,
            transforms=Transforms(),
            log=lambda severity, text, **_: self.lines.append((severity, text)),
        )

    def describe(self):
        if isinstance(self.run, Exception):
            raise self.run
        return self.run

    def set(self, name, value):
        (result,) = self.node.set_parameters([Parameter(name, value=str(value))])
        return result.reason if not result.successful else None

    def cycle(self, time):
        self.loop_publisher.set_clocks(time)
        self.loop_publisher.publish(time)


@pytest.fixture
def host(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    rclpy.init(args=[])
    host = Host()
    yield host
    host.recording.close()
    host.node.destroy_node()
    rclpy.try_shutdown()


def test_a_folder_that_cannot_be_made_is_refused_and_the_recording_goes_on(host, tmp_path):
    (tmp_path / 'file').write_text('')
    assert host.set('record', tmp_path / 'bag') is None
    reason = host.set('record', tmp_path / 'file' / 'bag')
    assert reason.startswith(f'record: cannot create the bag {tmp_path / "file" / "bag"}: ')
    assert host.set('record', tmp_path / 'bag').endswith('is there already; another name will do')
    assert host.node.get_parameter('record').value == str(tmp_path / 'bag')
    host.cycle(10)
    assert host.set('record', '') is None
    assert [each.log_time for each in BagReader(tmp_path / 'bag').messages()].count(10) == 1
    assert host.lines[-1][0] == Severity.INFO


@pytest.mark.parametrize(
    'folder',
    ['/elsewhere/bag', '../bag', 'a/../../bag', 'link/bag', '.', 'circle/bag'],
)
def test_who_asks_later_names_a_folder_below_the_one_of_the_start(host, tmp_path, folder):
    outside = tmp_path.parent / f'{tmp_path.name}-outside'
    outside.mkdir()
    (tmp_path / 'link').symlink_to(outside)
    (tmp_path / 'circle').symlink_to('circle')
    reason = host.set('record', folder)
    assert reason.startswith(f'record: {shorten(folder)} is no')
    assert str(tmp_path) in reason and reason.endswith('or another record_below at the start')
    assert '\n' not in reason
    assert list(outside.iterdir()) == []
    assert host.node.get_parameter('record').value == ''
    assert 'File name too long' in host.set('record', 'a' * 5000)
    assert host.set('record', 'below/bag') is None
    assert host.set('record', '') is None
    assert (tmp_path / 'below' / 'bag' / 'metadata.yaml').is_file()


def test_nor_is_it_where_another_user_could_have_it_lead_elsewhere(host, tmp_path):
    shared = tmp_path / 'shared'
    shared.mkdir()
    shared.chmod(0o777)
    assert f'others may write to {shared};' in host.set('record', 'shared/bag')
    assert list(shared.iterdir()) == []


def test_a_recording_that_broke_off_is_refused_its_end_once(host, tmp_path, monkeypatch):
    def refuse(self, message):
        raise BagError('No space left on device')

    monkeypatch.setattr(BagWriter, 'write', refuse)
    assert host.set('record', tmp_path / 'bag') is None
    host.cycle(10)
    assert host.loop_publisher.reporters == [], 'transforms are made for nothing'
    reason = host.set('record', '')
    assert reason == f'record: {tmp_path / "bag"} is not complete: No space left on device'
    assert not [text for _, text in host.lines if text.startswith('Recorded')]
    assert host.set('record', '') is None


def test_the_control_thread_has_no_file_to_read_when_it_begins(host, tmp_path, monkeypatch):
    prepared, described = [], []
    monkeypatch.setattr(RosRunRecorder, 'prepare', lambda _, name: prepared.append(name))

    def attach(call):
        assert 'rosgraph_msgs/msg/Clock' in prepared
        described.append(host.describe)
        monkeypatch.setattr(host.recording, '_describe', None)
        call()
        monkeypatch.setattr(host.recording, '_describe', host.describe)

    monkeypatch.setattr(host.recording, '_on_loop', attach)
    assert host.set('record', tmp_path / 'bag') is None
    assert described


def test_filters_of_the_same_request_count(host, tmp_path):
    assert host.set('record_regex', '(') is not None
    names = {'record_regex': '/clock', 'record': str(tmp_path / 'bag')}
    result = host.node.set_parameters_atomically(
        [Parameter(name, value=value) for name, value in names.items()]
    )
    assert result.successful
    host.cycle(10)
    assert host.set('record', '') is None
    assert list(BagReader(tmp_path / 'bag').topics) == ['/clock']


def test_an_error_while_it_begins_is_told_and_leaves_no_recording(host, tmp_path, monkeypatch):
    def fail(*_):
        raise ValueError('no such text')

    monkeypatch.setattr(host.recording, '_latch', fail)
    assert host.set('record', tmp_path / 'bag') == 'record: ValueError: no such text'
    assert host.loop_publisher.reporters == []
    host.cycle(10)
    assert (tmp_path / 'bag' / 'metadata.yaml').exists()


def test_the_latest_description_is_latched_last_by_whichever_thread(host, tmp_path):
    assert host.set('record', tmp_path / 'bag') is None
    host.cycle(10)
    host.run = RunDescription({'seed': 2})
    host.recording.update()
    host.run = RuntimeError('a file is read on the thread of whoever adds a command')
    host.recording._recorder.on_commands()
    host.cycle(20)
    assert host.set('record', '') is None
    (path,) = BagReader(tmp_path / 'bag').file_paths
    texts = [each.data for each in BagReader(path).messages() if each.topic == TOPIC]
    found = [from_text(deserialize_message(text, String).data) for text in texts]
    assert [each.parameters['seed'] for each in found] == [1, 2]


def test_motors_are_stopped_before_a_slow_disk_gets_the_rest():
    simulation = Mock()
    Simulation.close(simulation)
    calls = [name for name, *_ in simulation.mock_calls]
    assert calls.index('recording.detach') < calls.index('loop_thread.stop')
    assert calls.index('loop_thread.stop') < calls.index('recording.close')
