# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Each flag of ``ros2 bag record`` is one of what records, or of what writes."""

from argparse import ArgumentParser
import os
import signal
from types import SimpleNamespace

from mcap.writer import CompressionType
import pytest
from support.ros_processes import PATIENCE

from amr_description.bag import metadata
from amr_description.bag.mcap_writer import BagWriter, WriterOptions
from amr_description.bag.qos_text import QosProfile
from amr_description.bag.reader import BagReader
from amr_description.bag.ros.recorder import RecorderOptions
from amr_description.cli.bag import recording
from amr_description.cli.bag.record_arguments import add_recorder_arguments
from amr_description.cli.bag.recording import _serve, recorder_options, writer_options
from amr_description.cli.ros2 import main
from amr_description.errors import BagError
from amr_description.ros.signals import STOP_SIGNALS

NODE = SimpleNamespace(get_name=lambda: 'recorder', get_namespace=lambda: '/')


def parsed(*words):
    parser = ArgumentParser()
    add_recorder_arguments(parser)
    return parser.parse_args([*map(str, words)])


def test_defaults_are_those_of_what_records():
    assert writer_options(parsed('-a')) == WriterOptions()
    found = recorder_options(parsed('--topics', 'a'), NODE)
    assert found == RecorderOptions(topics=found.topics)
    args = parsed('-a')
    assert (args.node_name, args.polling_interval, args.log_level) == (
        'rosbag2_recorder', 100, 'info'
    )  # fmt: skip
    assert (args.storage, args.compression_mode) == ('mcap', 'none')


@pytest.mark.parametrize(
    ('words', 'name', 'value'),
    [
        ('--storage-preset-profile zstd_small', 'preset', 'zstd_small'),
        ('-b 2000', 'max_bag_size', 2000),
        ('-d 2', 'max_bag_duration', 2_000_000_000),
        ('--compression-mode file --compression-format zstd', 'compress_files', True),
        ('--custom-data a=b=c d=1 d=2', 'custom_data', {'a': 'b=c', 'd': '2'}),
    ],
)
def test_flags_of_what_writes(words, name, value):
    assert getattr(writer_options(parsed('-a', *words.split())), name) == value


@pytest.mark.parametrize(
    ('words', 'name', 'value'),
    [
        ('--use-sim-time', 'use_sim_time', True),
        ('--include-unpublished-topics', 'include_unpublished_topics', True),
        ('--ignore-leaf-topics', 'ignore_leaf_topics', True),
        ('--start-paused', 'start_paused', True),
        ('--snapshot-mode', 'snapshot_mode', True),
        ('--max-cache-size 7', 'max_cache_size', 7),
    ],
)
def test_flags_of_what_records(words, name, value):
    assert getattr(recorder_options(parsed('-a', *words.split()), NODE), name) == value


@pytest.mark.parametrize(
    ('words', 'name', 'value'),
    [
        ('-a', 'all_topics', True),
        ('-a', 'all_services', True),
        ('--all-topics', 'all_topics', True),
        ('--all-services', 'all_services', True),
        ('--topics a /b', 'topics', ['/a', '/b']),
        ('--services s', 'services', ['/s']),
        ('--topic-types a/msg/B', 'topic_types', ['a/msg/B']),
        ('-e x.*', 'regex', 'x.*'),
        ('-a -e x.*', 'regex', ''),
        ('--exclude-regex y', 'exclude_regex', 'y'),
        ('--exclude-topics a', 'exclude_topics', ['/a']),
        ('--exclude-topic-types a/msg/B', 'exclude_topic_types', ['a/msg/B']),
        ('--exclude-services s', 'exclude_services', ['/s']),
        ('--include-hidden-topics', 'include_hidden_topics', True),
    ],
)
def test_flags_that_choose_topics(words, name, value):
    assert getattr(recorder_options(parsed(*words.split()), NODE).topics, name) == value


def test_files(tmp_path):
    (tmp_path / 'qos.yaml').write_text('chatter: {reliability: best_effort}')
    (tmp_path / 'mcap.yaml').write_text('compression: Lz4')
    args = parsed(
        '-a',
        '--qos-profile-overrides-path',
        tmp_path / 'qos.yaml',
        '--storage-config-file',
        tmp_path / 'mcap.yaml',
    )
    overrides = recorder_options(args, NODE).overrides
    assert overrides == {'/chatter': QosProfile(reliability='best_effort')}
    assert writer_options(args).settings == {'compression': CompressionType.LZ4}
    args = parsed('-a', '-s', 'sqlite3', '--storage-config-file', tmp_path / 'mcap.yaml')
    with pytest.raises(BagError, match='storage sqlite3 has no setting compression: mcap has'):
        writer_options(args)


class Looking:
    """In place of a session and a recorder: time goes on by waiting, and a look finds nothing."""

    def __init__(self, complete_after=100):
        self.time, self.looks, self.complete_after = 0.0, 0, complete_after
        self.clock = self.executor = self.node = self
        self.error, self.lost = None, {}
        self.said = []

    spin_once = None

    def now(self):
        return self.time

    def wait(self, timeout, _spin):
        self.time += timeout

    def get_logger(self):
        return SimpleNamespace(info=self.said.append)

    def discover(self):
        self.looks += 1
        return []

    @property
    def is_complete(self):
        return self.looks >= self.complete_after


@pytest.mark.parametrize(
    ('words', 'looks'), [('', 10), ('-p 250', 4), ('-p 0', 1000), ('--no-discovery', 1)]
)
def test_topics_are_looked_for_as_often_as_wanted(words, looks):
    host = Looking(complete_after=10**6)
    _serve(host, host, parsed('-a', *words.split()), lambda: host.time >= 1.0 - 1e-9)
    assert abs(host.looks - looks) <= looks // 10


def test_looking_ends_when_all_that_has_a_name_is_there():
    host = Looking(complete_after=3)
    _serve(host, host, parsed('--topics', 'a'), lambda: host.time >= 1.0)
    assert host.looks == 3
    assert host.said == [
        'Recording...', 'All requested topics are subscribed. Stopping discovery...'
    ]  # fmt: skip


def test_an_error_ends_it():
    host = Looking()
    host.error = 'no room'
    _serve(host, host, parsed('-a'), lambda: False)
    assert host.looks == 0


@pytest.fixture
def handlers():
    """Undo what is for a process that ends soon: it ignores further signals."""
    before = {signum: signal.getsignal(signum) for signum in STOP_SIGNALS}
    yield
    for signum, handler in before.items():
        signal.signal(signum, handler)


def test_a_second_ctrl_c_leaves_the_bag_whole(tmp_path, monkeypatch, handlers):
    def serve(session, _recorder, _args, is_stopping):
        os.kill(os.getpid(), signal.SIGINT)
        session.serve(is_stopping, PATIENCE)

    close = BagWriter._close_file

    def close_while_ctrl_c_is_pressed(writer):
        os.kill(os.getpid(), signal.SIGINT)
        return close(writer)

    monkeypatch.setattr(recording, '_serve', serve)
    monkeypatch.setattr(BagWriter, '_close_file', close_while_ctrl_c_is_pressed)
    assert main(['bag', 'record', '-a', '-o', str(tmp_path / 'bag')]) == 0
    assert metadata.read(tmp_path / 'bag').relative_file_paths == ['bag_0.mcap']
    with BagReader(tmp_path / 'bag' / 'bag_0.mcap') as reader:
        assert reader.metadata.message_count == 0
