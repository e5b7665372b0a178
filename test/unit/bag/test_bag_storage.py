# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What is written is read: by ours, by the library of MCAP and by rosbags; cut off, too."""

from functools import cache
from pathlib import Path
import sqlite3
from tempfile import TemporaryDirectory

from hypothesis import given, strategies as st
from mcap.reader import make_reader
import pytest
from rosbags.highlevel import AnyReader
from rosbags.rosbag2 import CompressionFormat, CompressionMode, Reader, StoragePlugin, Writer
from rosbags.typesys import get_typestore, Stores
from support.paths import ROOT
import yaml
import zstandard

from amr_description import Simulation
from amr_description.bag import compression, metadata, qos_text
from amr_description.bag.compression import SUFFIX
from amr_description.bag.mcap_options import PRESETS, settings_from_text
from amr_description.bag.mcap_writer import BagWriter, WriterOptions
from amr_description.bag.qos_text import QosProfile
from amr_description.bag.reader import BagReader
from amr_description.bag.storage import BagMessage, TopicMetadata
from amr_description.errors import BagError

LATCHED = QosProfile(depth=1, durability='transient_local')
HASH = 'RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18'
CHATTER = TopicMetadata('/chatter', 'std_msgs/msg/String', 'cdr', (LATCHED,), HASH)
SCAN = TopicMetadata('/scan', 'sensor_msgs/msg/LaserScan', 'cdr', (QosProfile(), LATCHED), '')
SECOND = 10**9


def string(text: str) -> bytes:
    """A std_msgs/msg/String in CDR."""
    data = text.encode() + b'\0'
    return b'\0\1\0\0' + len(data).to_bytes(4, 'little') + data


def messages(count: int, padding: int = 0) -> list[BagMessage]:
    return [
        BagMessage('/chatter', string(f'{n}' + 'x' * padding), SECOND + n * 1000, SECOND + n * 990)
        for n in range(count)
    ]


def write(folder: Path, written: list[BagMessage], **options) -> Path:
    with BagWriter(folder, WriterOptions(**options)) as writer:
        writer.add_topic(CHATTER)
        writer.add_topic(SCAN)
        for message in written:
            writer.write(message)
    return folder


def read(path: Path, **wanted) -> list[BagMessage]:
    with BagReader(path) as reader:
        return [*reader.messages(**wanted)]


@pytest.mark.parametrize('preset', PRESETS)
def test_what_was_written_is_read(tmp_path, preset):
    written = messages(2000, padding=1000)
    bag = write(tmp_path / 'bag', written, preset=preset, custom_data={'a': 'b'})
    assert read(bag) == written
    with BagReader(bag) as reader:
        assert reader.topics == {'/chatter': CHATTER, '/scan': SCAN}
        assert reader.metadata.custom_data == {'a': 'b'}
        assert reader.metadata.duration == 1_999_000
        assert reader.schemas['std_msgs/msg/String'].endswith('string data\n')


@pytest.mark.parametrize(
    'option',
    [
        'noChunkIndex', 'noMessageIndex', 'noMetadataIndex', 'noRepeatedChannels',
        'noRepeatedSchemas', 'noStatistics', 'noSummaryOffsets', 'noChunking',
    ],
)  # fmt: skip
def test_files_that_lack_a_part_of_their_summary(tmp_path, option):
    written = messages(1000, padding=1000)
    bag = write(tmp_path / 'bag', written, settings=settings_from_text(f'{option}: true', 'x'))
    (bag / 'metadata.yaml').unlink()
    with BagReader(bag) as reader:
        assert [*reader.messages()] == written
        assert reader.topics['/chatter'] == CHATTER
        assert 'std_msgs/msg/String' in reader.schemas


def test_metadata_is_version_9_to_the_letter(tmp_path):
    bag = write(tmp_path / 'drive', messages(3), custom_data={'site': 'A'})
    root = yaml.safe_load((bag / 'metadata.yaml').read_text())
    infinite = {'sec': 9223372036, 'nsec': 854775807}
    profile = {
        'history': 'keep_last',
        'depth': 1,
        'reliability': 'reliable',
        'durability': 'transient_local',
        'deadline': infinite,
        'lifespan': infinite,
        'liveliness': 'automatic',
        'liveliness_lease_duration': infinite,
        'avoid_ros_namespace_conventions': False,
    }
    times = {
        'starting_time': {'nanoseconds_since_epoch': SECOND},
        'duration': {'nanoseconds': 2000},
    }
    topics = root['rosbag2_bagfile_information'].pop('topics_with_message_count')
    assert topics[0] == {
        'topic_metadata': {
            'name': '/chatter',
            'type': 'std_msgs/msg/String',
            'serialization_format': 'cdr',
            'offered_qos_profiles': [profile],
            'type_description_hash': HASH,
        },
        'message_count': 3,
    }
    assert topics[1]['message_count'] == 0
    assert root == {
        'rosbag2_bagfile_information': {
            'version': 9,
            'storage_identifier': 'mcap',
            **times,
            'message_count': 3,
            'compression_format': '',
            'compression_mode': '',
            'relative_file_paths': ['drive_0.mcap'],
            'files': [{'path': 'drive_0.mcap', **times, 'message_count': 3}],
            'custom_data': {'site': 'A'},
            'ros_distro': 'jazzy',
        }
    }


def test_rosbags_reads_ours_with_types_qos_and_hashes(tmp_path):
    bag = write(tmp_path / 'bag', messages(2000, padding=1000), preset='zstd_fast')
    with Reader(bag) as reader:
        assert reader.message_count == 2000
        chatter = reader.topics['/chatter'].connections[0]
        assert chatter.digest == HASH
        qos = chatter.ext.offered_qos_profiles[0]
        assert (qos.depth, qos.durability.name) == (1, 'TRANSIENT_LOCAL')
    with AnyReader([bag]) as reader:
        texts = [reader.deserialize(data, c.msgtype).data for c, _, data in reader.messages()]
    assert texts == [f'{n}' + 'x' * 1000 for n in range(2000)]


def test_rosbags_reads_all_that_a_simulation_without_ros_records(tmp_path):
    robot = ROOT / 'urdf' / 'amr_sensors.urdf.xacro'
    with Simulation(robot, world='walls', record=tmp_path / 'bag') as sim:
        sim.drive(0.5, 0.0, seconds=0.1, stop=False)
    with AnyReader([tmp_path / 'bag']) as reader:
        read = {
            each.topic: reader.deserialize(raw, each.msgtype) for each, _, raw in reader.messages()
        }
    assert {'/odom', '/tf', '/scan', '/camera/points', '/mujoco_sim/world'} <= read.keys()
    assert len(read['/scan'].ranges) == 360
    assert read['/odom'].header.frame_id == 'odom'


def test_library_of_mcap_reads_ours(tmp_path):
    bag = write(tmp_path / 'bag', messages(5))
    with (bag / 'bag_0.mcap').open('rb') as stream:
        reader = make_reader(stream)
        assert reader.get_header().profile == 'ros2'
        found = [*reader.iter_messages()]
        [own] = reader.iter_metadata()
    schema, channel, message = found[4]
    assert (schema.name, schema.encoding) == ('std_msgs/msg/String', 'ros2msg')
    assert (channel.topic, channel.message_encoding) == ('/chatter', 'cdr')
    assert channel.metadata['topic_type_hash'] == HASH
    assert qos_text.from_text(channel.metadata['offered_qos_profiles']) == (LATCHED,)
    assert (message.log_time, message.publish_time) == (SECOND + 4000, SECOND + 3960)
    assert (message.sequence, message.data) == (0, string('4'))
    assert own.name == 'rosbag2'
    assert metadata.from_text(own.metadata['serialized_metadata']).message_count == 5


@pytest.mark.parametrize('version', [8, 9])
@pytest.mark.parametrize('storage', StoragePlugin)
def test_ours_reads_those_of_rosbags(tmp_path, version, storage):
    types = get_typestore(Stores.ROS2_JAZZY)
    with Writer(tmp_path / 'bag', version=version, storage_plugin=storage) as writer:
        topic = writer.add_connection('/chatter', 'std_msgs/msg/String', typestore=types)
        for n in range(10):
            writer.write(topic, 5 * SECOND - n, string(f'{n}'))
    with BagReader(tmp_path / 'bag') as reader:
        assert reader.topics['/chatter'].type_description_hash == HASH
        assert [m.data for m in reader.messages()] == [string(f'{n}') for n in range(9, -1, -1)]
        assert reader.metadata.message_count == 10
        found = [m.log_time for m in reader.messages(start=5 * SECOND - 3, end=5 * SECOND - 2)]
        assert found == [5 * SECOND - 3, 5 * SECOND - 2]
        assert [*reader.messages(topics=['/other'])] == []


@pytest.mark.parametrize('mode', ['file', 'message'])
def test_ours_reads_what_is_compressed(tmp_path, mode):
    types = get_typestore(Stores.ROS2_JAZZY)
    writer = Writer(tmp_path / 'bag', version=9, storage_plugin=StoragePlugin.SQLITE3)
    writer.set_compression(CompressionMode[mode.upper()], CompressionFormat.ZSTD)
    with writer:
        topic = writer.add_connection('/chatter', 'std_msgs/msg/String', typestore=types)
        writer.write(topic, 7, string('packed'))
    assert read(tmp_path / 'bag') == [BagMessage('/chatter', string('packed'), 7, 7)]


def test_messages_are_in_order_over_files_and_chunks(tmp_path):
    written = messages(3000, padding=2000)
    shuffled = [message for n in range(3) for message in written[n::3]]
    bag = write(tmp_path / 'bag', shuffled, max_bag_size=2_000_000)
    assert len([*bag.glob('*.mcap')]) == 4
    assert read(bag) == written
    assert read(bag, start=SECOND + 10_000, end=SECOND + 20_000) == written[10:21]
    assert read(bag, topics=['/scan']) == []


def test_a_file_of_a_split_bag_plays_alone(tmp_path):
    bag = write(tmp_path / 'bag', messages(10), max_bag_duration=3000)
    files = sorted(bag.glob('*.mcap'))
    assert [len(read(file)) for file in files] == [4, 4, 2]
    with BagReader(files[1]) as reader:
        assert reader.metadata.message_count == 4
        assert reader.metadata.starting_time == SECOND + 4000
        assert reader.topics['/chatter'] == CHATTER


def test_split_tells_which_files(tmp_path):
    told = []
    options = WriterOptions(
        on_split=lambda closed, opened: told.append((closed.name, opened.name))
    )
    with BagWriter(tmp_path / 'bag', options) as writer:
        writer.split()
    assert told == [('bag_0.mcap', 'bag_1.mcap')]


def test_files_are_compressed_when_complete(tmp_path):
    bag = write(tmp_path / 'bag', messages(10), compress_files=True, max_bag_duration=3000)
    assert {path.name for path in bag.iterdir()} == {
        'metadata.yaml', *(f'bag_{n}.mcap{SUFFIX}' for n in range(3))
    }  # fmt: skip
    assert read(bag) == messages(10)
    (bag / 'metadata.yaml').unlink()
    assert read(bag) == messages(10)


@cache
def flushed_bag(preset: str) -> tuple[bytes, list[int]]:
    """The bytes of a bag of 100 messages, and its sizes after every ten, which were flushed."""
    sizes = []
    with TemporaryDirectory() as above:
        folder = Path(above, 'bag')
        with BagWriter(folder, WriterOptions(preset=preset)) as writer:
            writer.add_topic(CHATTER)
            for n, message in enumerate(messages(100)):
                writer.write(message)
                if n % 10 == 9:
                    writer.flush()
                    sizes.append(writer.path.stat().st_size)
        return (folder / 'bag_0.mcap').read_bytes(), sizes


@pytest.mark.parametrize('preset', ['none', 'fastwrite', 'zstd_fast'])
@given(place=st.floats(0, 1))
def test_a_file_cut_off_anywhere_gives_all_but_its_last_chunk(preset, place):
    content, sizes = flushed_bag(preset)
    size = round(8 + place * (len(content) - 8))
    with TemporaryDirectory() as folder:
        path = Path(folder, 'cut.mcap')
        path.write_bytes(content[:size])
        found = read(path)
    assert found == messages(100)[: len(found)]
    assert len(found) >= 10 * sum(each <= size for each in sizes)


def test_killed_bag_has_all_that_was_flushed(tmp_path):
    writer = BagWriter(tmp_path / 'bag')
    writer.add_topic(CHATTER)
    for message in messages(20):
        writer.write(message)
    writer.flush()
    assert not (tmp_path / 'bag' / 'metadata.yaml').exists()
    with BagReader(tmp_path / 'bag') as reader:
        assert [*reader.messages()] == messages(20)
        assert reader.is_rebuilt
        assert reader.metadata.message_count == 20
    writer.close()


class FullDisk:
    """In place of an unbuffered file: half of a write fits, and later there is room again."""

    def __init__(self, file) -> None:
        self.file, self.is_full = file, True

    def write(self, data) -> int:
        if not self.is_full:
            return self.file.write(data)
        if len(data) > 1:
            return self.file.write(data[: len(data) // 2])
        self.is_full = False
        raise OSError(28, 'No space left on device')

    def __getattr__(self, name):
        return getattr(self.file, name)


def test_full_disk_leaves_what_was_written(tmp_path):
    writer = BagWriter(tmp_path / 'bag', WriterOptions(custom_data={'site': 'A'}))
    writer.add_topic(CHATTER)
    for message in messages(20):
        writer.write(message)
    writer.flush()
    size = writer.path.stat().st_size
    output = writer._file._output
    output._file = FullDisk(output._file)
    writer.write(messages(21)[20])
    with pytest.raises(BagError, match='cannot write .*bag_0.mcap: .*No space left on device'):
        writer.flush()
    assert not output._file.is_full
    writer.write(messages(22)[21])
    with pytest.raises(BagError, match='cannot write .*bag_0.mcap: it was cut off'):
        writer.flush()
    writer.close()
    assert writer.path.stat().st_size == size
    assert read(tmp_path / 'bag') == messages(20)
    found = metadata.read(tmp_path / 'bag')
    assert (found.message_count, found.custom_data) == (20, {'site': 'A'})


def test_no_room_for_the_next_file_leaves_the_former_ones(tmp_path, monkeypatch):
    def no_room(*_):
        raise OSError(28, 'No space left on device')

    writer = BagWriter(tmp_path / 'bag', WriterOptions(compress_files=True))
    writer.add_topic(CHATTER)
    writer.write(messages(1)[0])
    monkeypatch.setattr('amr_description.bag.mcap_writer.OutputFile', no_room)
    with pytest.raises(BagError, match='cannot create a file of the bag .*No space left'):
        writer.split()
    writer.close()
    assert metadata.read(tmp_path / 'bag').relative_file_paths == ['bag_0.mcap.zstd']
    assert read(tmp_path / 'bag') == messages(1)


def test_no_room_to_compress_leaves_the_file(tmp_path, monkeypatch):
    class NoRoomToCompress:
        def copy_stream(self, source, sink):
            sink.write(source.read(10))
            raise OSError(28, 'No space left on device')

    writer = BagWriter(tmp_path / 'bag', WriterOptions(compress_files=True))
    writer.add_topic(CHATTER)
    writer.write(messages(1)[0])
    monkeypatch.setattr(compression.zstandard, 'ZstdCompressor', NoRoomToCompress)
    with pytest.raises(BagError, match='cannot compress .*bag_0.mcap: .*No space left'):
        writer.close()
    assert {path.name for path in writer.folder.iterdir()} == {'bag_0.mcap', 'metadata.yaml'}
    assert read(tmp_path / 'bag') == messages(1)


@pytest.mark.parametrize('size', [-1, 100])
def test_killed_while_it_compresses(tmp_path, size):
    """Both files are there, the new one perhaps in part; the messages are found once."""
    bag = write(tmp_path / 'bag', messages(3))
    (bag / 'metadata.yaml').unlink()
    packed = zstandard.compress((bag / 'bag_0.mcap').read_bytes())
    (bag / f'bag_0.mcap{SUFFIX}').write_bytes(packed[:size])
    assert read(bag) == messages(3)


def test_bags_that_cannot_be_made_are_refused(tmp_path):
    with pytest.raises(BagError, match='value greater than 1024. Specified value of 1000'):
        BagWriter(tmp_path / 'small', WriterOptions(max_bag_size=1000))
    with pytest.raises(BagError, match='cannot create the bag .*File exists'):
        BagWriter(tmp_path)


@pytest.mark.parametrize(
    ('content', 'message'),
    [
        (None, 'No such bag: .* does not exist'),
        ({}, 'neither metadata.yaml nor a file'),
        ({'a_0.mcap': b'no'}, 'begins neither as an MCAP file nor as one of SQLite'),
        ({'metadata.yaml': b'a: 1'}, "there is no 'rosbag2_bagfile_information'"),
        ({'metadata.yaml': b'version: 12'}, 'version 12 is not known; this reads those up to 9'),
        ({'metadata.yaml': b'version: 9'}, 'not as rosbag2 writes it'),
        ({'metadata.yaml': b'a: ]'}, 'not YAML'),
    ],
)
def test_what_is_no_bag_is_one_line(tmp_path, content, message):
    folder = tmp_path / 'bag'
    if content is not None:
        folder.mkdir()
        for name, data in content.items():
            (folder / name).write_bytes(data)
    with pytest.raises(BagError, match=message) as caught:
        BagReader(folder)
    assert '\n' not in str(caught.value)


def test_missing_file_says_how_to_mend_it(tmp_path):
    bag = write(tmp_path / 'bag', messages(2))
    (bag / 'bag_0.mcap').rename(bag / 'other_0.mcap')
    with pytest.raises(BagError, match='names bag_0.mcap, which is not there; `ros2 bag reindex'):
        BagReader(bag)


def test_version_4_with_numbers_for_policies():
    qos = qos_text.to_text([LATCHED], named=False)
    assert 'durability: 1' in qos
    text = yaml.safe_dump(
        {
            'rosbag2_bagfile_information': {
                'version': 4,
                'storage_identifier': 'sqlite3',
                'relative_file_paths': ['a_0.db3'],
                'duration': {'nanoseconds': 3},
                'starting_time': {'nanoseconds_since_epoch': 4},
                'message_count': 1,
                'topics_with_message_count': [
                    {
                        'topic_metadata': {
                            'name': '/a',
                            'type': 'std_msgs/msg/String',
                            'serialization_format': 'cdr',
                            'offered_qos_profiles': qos,
                        },
                        'message_count': 1,
                    }
                ],
                'compression_format': '',
                'compression_mode': '',
            }
        }
    )
    found = metadata.from_text(text)
    [topic] = found.topics_with_message_count
    assert topic.topic_metadata.offered_qos_profiles == (LATCHED,)
    assert (found.starting_time, found.end_time, found.files) == (4, 7, [])


def test_sqlite_of_before_hashes_and_qos(tmp_path):
    base = sqlite3.connect(tmp_path / 'old_0.db3')
    base.executescript(
        'CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL,'
        ' serialization_format TEXT NOT NULL);'
        'CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL,'
        ' timestamp INTEGER NOT NULL, data BLOB NOT NULL);'
        "INSERT INTO topics VALUES(1, '/a', 'std_msgs/msg/String', 'cdr');"
        "INSERT INTO messages VALUES(1, 1, 5, x'00010000');"
    )
    base.close()
    with BagReader(tmp_path / 'old_0.db3') as reader:
        assert [*reader.messages()] == [BagMessage('/a', b'\0\1\0\0', 5, 5)]
        assert reader.topics['/a'] == TopicMetadata('/a', 'std_msgs/msg/String')


@pytest.mark.parametrize(
    ('text', 'message'),
    [
        ('[]', 'a QoS profile for each topic'),
        ('/a: 1', 'want a mapping'),
        ('/a: {reliable: 1}', 'there is no policy "reliable"'),
        ('/a: {history: keep}', 'history: want one of system_default, keep_last'),
        ('/a: {depth: -1}', 'depth: want a number from 0 on, not -1'),
        ('/a: {deadline: {sec: -1, nsec: 0}}', 'deadline: a duration must not be negative'),
        ('/a: {deadline: {sec: 1}}', r'deadline: want \{sec: S, nsec: N\}'),
        ('a: ]', 'not YAML'),
    ],
)
def test_overrides_that_are_wrong(text, message):
    with pytest.raises(BagError, match=f'^over.yaml: .*{message}'):
        qos_text.overrides_from_text(text, 'over.yaml')


def test_overrides_have_only_what_differs():
    text = '/a: {reliability: best_effort, deadline: {sec: 1, nsec: 5}}'
    assert qos_text.overrides_from_text(text, 'x') == {
        '/a': QosProfile(reliability='best_effort', deadline=SECOND + 5)
    }


def test_sqlite_files_are_written_as_they_are_read(tmp_path):
    sent = messages(40, padding=1000)
    folder = write(tmp_path / 'bag', sent, storage='sqlite3', max_bag_size=20_000)
    assert sorted(path.name for path in folder.iterdir())[:2] == ['bag_0.db3', 'bag_1.db3']
    with BagReader(folder) as reader:
        assert (reader.storage, reader.is_rebuilt) == ('sqlite3', False)
        assert reader.topics == {'/chatter': CHATTER, '/scan': SCAN}
        assert 'string data' in reader.schemas['std_msgs/msg/String']
        found = [*reader.messages()]
    assert [each[:3] for each in found] == [each[:3] for each in sent]
    assert {each.publish_time - each.log_time for each in found} == {0}, (
        'there is no column for it'
    )
    with BagReader(folder / 'bag_1.db3') as alone:  # which says itself what it has
        assert alone.metadata.message_count == len([*alone.messages()]) < 40


def test_what_is_flushed_into_sqlite_is_there_when_the_writer_is_killed(tmp_path):
    writer = BagWriter(tmp_path / 'bag', WriterOptions(storage='sqlite3'))
    writer.add_topic(CHATTER)
    sent = messages(3)
    writer.write(sent[0])
    writer.flush()
    writer.write(sent[1])
    with BagReader(tmp_path / 'bag') as reader:
        assert reader.is_rebuilt
        assert [each.data for each in reader.messages()] == [sent[0].data]
    writer.close()
