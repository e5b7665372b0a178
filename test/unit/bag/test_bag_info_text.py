# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``ros2 bag info`` and ``reindex``, to the letter; and which topics are recorded."""

from argparse import ArgumentParser, Namespace
import os
import re
import time

import pytest
from support.small_bags import topic, write_bag
import yaml

from amr_description.bag import metadata
from amr_description.bag.info_text import Contents, info_text, size_text, SORTING, topic_names
from amr_description.bag.mcap_options import settings_from_text
from amr_description.bag.mcap_writer import BagWriter, WriterOptions
from amr_description.bag.metadata import BagMetadata, TopicInformation
from amr_description.bag.qos_text import QosProfile
from amr_description.bag.storage import BagMessage, TopicMetadata
from amr_description.bag.topic_filter import TopicFilter
from amr_description.cli.bag import listing, record
from amr_description.errors import BagError

SECOND = 10**9
NUMBERS = TopicMetadata('/number_count', 'example_interfaces/msg/Int64')
CALLS = TopicMetadata('/add/_service_event', 'example_interfaces/srv/AddTwoInts_Event')


@pytest.fixture
def in_shanghai(monkeypatch):
    monkeypatch.setenv('TZ', 'Asia/Shanghai')
    time.tzset()
    yield
    monkeypatch.undo()
    time.tzset()


def test_text_is_that_of_rosbag2(in_shanghai):
    """As a user of Jazzy saw it."""
    found = BagMetadata(
        starting_time=1791341976116582550,
        duration=4999887495,
        message_count=6,
        relative_file_paths=['test_0.mcap'],
        topics_with_message_count=[TopicInformation(NUMBERS, 6)],
    )
    assert info_text(found, 5530) == (
        '\nFiles:             test_0.mcap\n'
        'Bag size:          5.4 KiB\n'
        'Storage id:        mcap\n'
        'ROS Distro:        jazzy\n'
        'Duration:          4.999887495s\n'
        'Start:             Oct  7 2026 10:59:36.116582550 (1791341976.116582550)\n'
        'End:               Oct  7 2026 10:59:41.116470045 (1791341981.116470045)\n'
        'Messages:          6\n'
        'Topic information: Topic: /number_count | Type: example_interfaces/msg/Int64 | '
        'Count: 6 | Serialization Format: cdr\n'
        'Service:           0\n'
        'Service information: \n'
    )


def test_services_are_apart_and_verbose_counts_their_calls():
    found = BagMetadata(
        relative_file_paths=['a_0.mcap', 'a_1.mcap'],
        topics_with_message_count=[TopicInformation(NUMBERS, 2), TopicInformation(CALLS, 4)],
        ros_distro='',
    )
    contents = Contents()
    for kind in (0, 1, 2, 3):
        contents.add(BagMessage(CALLS.name, b'\0\1\0\0' + bytes([kind]) + b'\0' * 1019, 0, 0))
    brief, verbose = info_text(found, 0), info_text(found, 0, contents)
    assert topic_names(found) == ['/number_count']
    assert 'Files:             a_0.mcap\n                   a_1.mcap\n' in brief
    assert 'ROS Distro:        unknown\n' in brief
    assert (
        'Service:           1\n'
        'Service information: Service: /add | Type: example_interfaces/srv/AddTwoInts | '
        'Event Count: 4 | Serialization Format: cdr\n'
    ) in brief
    assert (
        'Request Count: 1 | Response Count: 1 | Size Contribution: 4.0 KiB | Serialization'
    ) in verbose
    assert 'Count: 2 | Size Contribution: 0 B | Serialization Format: cdr' in verbose


@pytest.mark.parametrize(
    ('sort', 'names', 'services'),
    [
        ('name', ['/a', '/b', '/c'], ['/r', '/s']),
        ('type', ['/b', '/c', '/a'], ['/s', '/r']),
        ('count', ['/c', '/a', '/b'], ['/r', '/s']),
    ],
)
def test_topics_are_sorted(sort, names, services):
    """Services by themselves."""
    given = [
        ('/b', 'a/msg/A', 9),
        ('/s/_service_event', 'a/srv/A_Event', 7),
        ('/a', 'c/msg/C', 5),
        ('/c', 'b/msg/B', 1),
        ('/r/_service_event', 'b/srv/B_Event', 6),
    ]
    found = BagMetadata(
        topics_with_message_count=[
            TopicInformation(TopicMetadata(name, kind), count) for name, kind, count in given
        ]
    )
    assert topic_names(found, sort) == names
    text = info_text(found, 0, sort=sort)
    assert re.findall(r'Topic: (\S+)', text) == names
    assert re.findall(r'Service: (/\S+)', text) == services
    assert {*SORTING} == {*listing.SORTING}


@pytest.mark.parametrize(
    ('size', 'text'),
    [
        (0, '0 B'),
        (1023, '1023 B'),
        (1024, '1.0 KiB'),
        (1536 * 1024, '1.5 MiB'),
        (2**50, '1024.0 TiB'),
    ],
)
def test_sizes(size, text):
    assert size_text(size) == text


@pytest.fixture
def bag(tmp_path):
    folder = tmp_path / 'bag'
    options = WriterOptions(custom_data={'site': 'A'}, max_bag_duration=5)
    profile = QosProfile(depth=3, durability='transient_local')
    with BagWriter(folder, options) as writer:
        topic = TopicMetadata('/a', 'std_msgs/msg/String', 'cdr', (profile,), 'RIHS01_1')
        writer.add_topic(topic)
        for n in range(20):
            writer.write(BagMessage('/a', b'\0\1\0\0\0\0\0\0', SECOND + n, SECOND))
    return folder


def run(verb, *words):
    parser = ArgumentParser()
    verb.add_arguments(parser)
    return verb.main(parser.parse_args([*map(str, words)]))


def test_reindex_finds_all_that_was_written(bag):
    before = (bag / 'metadata.yaml').read_text()
    (bag / 'metadata.yaml').unlink()
    assert run(listing.ReindexVerb, bag) == 0
    assert (bag / 'metadata.yaml').read_text() == before
    assert yaml.safe_load(before)['rosbag2_bagfile_information']['message_count'] == 20


def test_reindex_mends_what_is_wrong_and_keeps_custom_data(bag):
    wrong = metadata.read(bag)
    wrong.relative_file_paths[0] = 'missing.mcap'
    wrong.custom_data['by'] = 'hand'
    metadata.write(bag, wrong)
    assert run(listing.ReindexVerb, bag) == 0
    found = metadata.read(bag)
    assert (found.message_count, found.custom_data) == (20, {'site': 'A', 'by': 'hand'})


def test_reindex_is_of_folders(bag, capsys):
    with pytest.raises(BagError, match='neither metadata.yaml nor a file'):
        run(listing.ReindexVerb, bag, '-s', 'sqlite3')
    assert run(listing.ReindexVerb, bag / 'bag_0.mcap') == 1
    assert capsys.readouterr().err == '[ERROR] [ros2bag]: Must specify a bag directory\n'


def test_info_of_a_folder_a_file_and_what_was_interrupted(bag, capsys):
    assert run(listing.InfoVerb, bag, '-t') == 0
    assert capsys.readouterr() == ('/a\n', '')
    assert run(listing.InfoVerb, bag, '-s', 'mcap') == 0
    whole = capsys.readouterr().out
    assert 'Messages:          20\n' in whole
    assert whole.endswith('Service information: \n\n')
    assert run(listing.InfoVerb, bag / 'bag_1.mcap') == 0
    assert 'Messages:          6\n' in capsys.readouterr().out
    (bag / 'metadata.yaml').unlink()
    (bag / 'bag_4.mcap').write_bytes(b'')  # it had just been made
    assert run(listing.InfoVerb, bag, '-v') == 0
    printed = capsys.readouterr()
    assert 'Messages:          20\n' in printed.out
    assert 'it was interrupted' in printed.err
    with pytest.raises(BagError, match='neither metadata.yaml nor a file'):
        run(listing.InfoVerb, bag, '-s', 'sqlite3')


def test_info_can_be_sorted(tmp_path, capsys):
    write_bag(tmp_path / 'bag', [topic('/a'), topic('/b')], [(0, '/a', 'x')])
    assert run(listing.InfoVerb, tmp_path / 'bag', '-t', '--sort', 'count') == 0
    assert run(listing.InfoVerb, tmp_path / 'bag', '-t') == 0
    assert capsys.readouterr().out.split() == ['/b', '/a', '/a', '/b']


def test_verbose_goes_before_names(bag, capsys):
    assert run(listing.InfoVerb, bag, '-t', '-v') == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == (
        "Warning! You have set both the '-t' and '-v' parameters. The '-t' parameter will be "
        'ignored.'
    )
    assert 'Size Contribution' in lines[-4]


def test_topics_without_their_flag_are_warned_of(tmp_path, capsys):
    assert run(record, '/a', '/b', '-o', tmp_path) == 1
    assert capsys.readouterr() == (
        '[WARN] [ros2bag]: Positional "topics" argument deprecated. Please use optional '
        '"--topics" argument instead.\n',
        f"[ERROR] [ros2bag]: Output folder '{tmp_path}' already exists.\n",
    )


STRING, EVENT = 'std_msgs/msg/String', 'std_srvs/srv/Empty_Event'


@pytest.mark.parametrize(
    ('options', 'recorded'),
    [
        ({'all_topics': True}, {'/a', '/b/c', '/other'}),
        ({'all_topics': True, 'include_hidden_topics': True}, {'/a', '/b/c', '/other', '/_h'}),
        ({'all_services': True}, {'/s/_service_event', '/t/_service_event'}),
        ({'topics': ['/a', '/_h']}, {'/a'}),
        ({'topic_types': ['x/msg/Y']}, {'/other'}),
        ({'services': ['/s']}, {'/s/_service_event'}),
        ({'regex': 'b/'}, {'/b/c'}),
        ({'regex': '^/(a|s)$'}, {'/a', '/s/_service_event'}),
        ({'topics': ['/a'], 'regex': '/b'}, {'/a', '/b/c'}),
        ({'all_topics': True, 'exclude_topics': ['/a']}, {'/b/c', '/other'}),
        ({'all_topics': True, 'exclude_topic_types': [STRING]}, {'/other'}),
        ({'all_topics': True, 'exclude_regex': '[ac]$'}, {'/other'}),
        ({'all_services': True, 'exclude_services': ['/s']}, {'/t/_service_event'}),
        ({'all_services': True, 'exclude_regex': '^/s$'}, {'/t/_service_event'}),
    ],
)  # fmt: skip
def test_each_option_chooses_topics(options, recorded):
    topics = {
        '/a': STRING, '/b/c': STRING, '/other': 'x/msg/Y', '/_h': STRING,
        '/s/_service_event': EVENT, '/t/_service_event': EVENT,
    }  # fmt: skip
    chosen = TopicFilter(**options)
    assert {topic for topic, kind in topics.items() if chosen.wants(topic, kind)} == recorded


def test_what_is_no_regular_expression():
    with pytest.raises(BagError, match=r"--exclude-regex '\(' is not a regular expression"):
        TopicFilter(exclude_regex='(')


def test_only_names_are_ever_complete():
    assert TopicFilter(topics=['/a'], services=['/s']).names == {'/a', '/s/_service_event'}
    assert TopicFilter(topics=['/a']).names_all
    assert not TopicFilter(topics=['/a'], regex='b').names_all
    assert not TopicFilter(all_topics=True).names_all


def parsed(line) -> Namespace:
    parser = ArgumentParser()
    record.add_arguments(parser)
    args = parser.parse_args(line.split())
    args.topics = [*args.topics_positional, *args.topics]
    return args


@pytest.mark.parametrize(
    ('line', 'reason'),
    [
        ('', 'Need to specify at least one option out of --all, --all-topics, --all-services, '
         '--services, --topics, --topic-types or --regex'),
        ('/a --exclude-regex b', '--exclude-regex argument requires either --all, --all-topics, '
         '--topic-types, --all-services or --regex'),
        ('/a --exclude-topics b', '--exclude-topics argument requires either --all, '
         '--all-topics, --topic-types or --regex'),
        ('/a --exclude-topic-types b', '--exclude-topic-types argument requires either --all, '
         '--all-topics or --regex'),
        ('/a --exclude-services b', '--exclude-services argument requires either --all, '
         '--all-services or --regex'),
        ('-a --use-sim-time --no-discovery', '--use-sim-time and --no-discovery both set, but '
         'are incompatible settings. The /clock topic needs to be discovered to record with sim '
         'time.'),
        ('-a --compression-format zstd', 'Invalid choice: Cannot specify compression format '
         'without a compression mode.'),
        ('-a --compression-queue-size -1', 'Compression queue size must be at least 0.'),
        ('-a -s sqlite3 --storage-preset-profile zstd_fast', 'storage sqlite3 has no '
         '--storage-preset-profile zstd_fast: it is one of mcap'),
        ('-a --max-bag-size -1', '--max-bag-size must not be negative'),
        ('-a --custom-data a', "--custom-data: want KEY=VALUE, not 'a'"),
    ],
)  # fmt: skip
def test_command_lines_that_will_not_do(line, reason, tmp_path):
    assert record.objection(parsed(line), str(tmp_path / 'new')) == reason


def test_modes_that_mcap_does_not_have(tmp_path):
    new = str(tmp_path / 'new')
    assert '--storage-preset-profile' in record.objection(
        parsed('-a --compression-mode message'), new
    )
    assert '--max-cache-size' in record.objection(
        parsed('-a --snapshot-mode --max-cache-size 0'), new
    )
    assert (
        record.objection(parsed('-a'), str(tmp_path))
        == f"Output folder '{tmp_path}' already exists."
    )
    good = '-a --snapshot-mode --compression-mode file --compression-format zstd'
    assert record.objection(parsed(good), new) is None


@pytest.mark.parametrize(
    ('line', 'expected'),
    [
        ('-a --services s', ['--all or --all-services will override --services']),
        ('--all-topics --topics s', ['--all or --all-topics will override --topics']),
        ('--all-services -e s', ['--all, --all-topics or --all-services will override --regex']),
        ('-e s /a', []),
    ],
)
def test_what_is_overridden_is_said(line, expected):
    assert record.notes(parsed(line)) == expected


@pytest.mark.parametrize(
    ('text', 'message'),
    [
        ('- a', 'want options of MCAP'),
        ('noChunkCRCs: true', 'no option "noChunkCRCs"; did you mean noChunkCRC'),
        ('noChunking: 3', 'noChunking: want true or false'),
        ('chunkSize: 0', 'chunkSize: want bytes'),
        ('compression: zip', 'compression: want one of None, Lz4, Zstd'),
        ('a: ]', 'not YAML'),
    ],
)
def test_wrong_files_of_storage_options(text, message):
    with pytest.raises(BagError, match=f'^mcap.yaml: .*{message}'):
        settings_from_text(text, 'mcap.yaml')


def test_storage_options_reach_the_file(tmp_path):
    text = 'compression: Zstd\nchunkSize: 100000\nnoMessageIndex: true\nnoSummary: false\n'
    sizes = {}
    for name, settings in (('plain', {}), ('packed', settings_from_text(text, 'x'))):
        with BagWriter(tmp_path / name, WriterOptions(settings=settings)) as writer:
            writer.add_topic(NUMBERS)
            for n in range(1000):
                writer.write(BagMessage(NUMBERS.name, b'x' * 1000, n, n))
        sizes[name] = os.path.getsize(writer.path)
    assert sizes['packed'] < sizes['plain'] / 20
