# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``ros2 bag trim``, ``filter``, ``merge``, ``convert`` and ``list``, called in this process."""

from pathlib import Path
import re

import pytest
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import get_typestore, Stores
from support.small_bags import BEGIN, LATCHED, MS, read_bag, string, topic, write_bag, write_runs
import yaml

from amr_description.bag import rewriting
from amr_description.bag.reader import BagReader
from amr_description.cli.ros2 import main
from amr_description.errors import AmrError, BagError

TOPICS = [topic('/map', LATCHED), topic('/tf_static', LATCHED, LATCHED), topic('/scan')]
TEXTS = [
    (0, '/map', 'm'),
    (5, '/tf_static', 's1'),
    (6, '/tf_static', 's2'),
    *((n, '/scan', str(n)) for n in range(10, 60, 10)),
]


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write_bag(Path('in'), TOPICS, TEXTS, custom_data={'robot': 'rover'})
    return tmp_path


def run(*words):
    return main(['bag', *words])


@pytest.mark.parametrize(
    ('flags', 'begin', 'scans'),
    [
        (('--start-offset', '0.02', '--duration', '0.02'), 20, [20, 30, 40]),
        (('--start-time', '1700000000.0300', '--end-time', '1700000000.040'), 30, [30, 40]),
        (('--start-offset', '0.045'), 45, [50]),
    ],
)
def test_a_part_has_what_was_latched_before(flags, begin, scans, capsys):
    assert run('trim', 'in', '-o', 'out', *flags) == 0
    latched = [(begin, '/map', 'm'), (begin, '/tf_static', 's1'), (begin, '/tf_static', 's2')]
    assert read_bag(Path('out')) == [*latched, *((n, '/scan', str(n)) for n in scans)]
    assert capsys.readouterr().out == f'out: {3 + len(scans)} messages\n'
    with BagReader(Path('out')) as reader:
        assert reader.metadata.starting_time == BEGIN + begin * MS
        assert reader.topics['/tf_static'].offered_qos_profiles == (LATCHED, LATCHED)
        assert reader.metadata.custom_data == {'robot': 'rover'}


RUNS = (
    [(5, '/map', 'm'), (10, '/scan', '10'), (700, '/scan', '700')],
    [(1, '/scan', '1'), (300, '/scan', '300'), (800, '/scan', '800')],
)


@pytest.mark.parametrize(
    ('words', 'written'),
    [
        (('merge', 'drive'), RUNS),
        (('filter', 'drive', '--topics', '/scan'), (RUNS[0][1:], RUNS[1])),
        (
            ('trim', 'drive', '--start-offset', '0.2', '--duration', '0.5'),  # from 205 ms on
            ([(205, '/map', 'm'), RUNS[0][2]], [(205, '/map', 'm'), RUNS[1][1]]),
        ),
        (('trim', 'drive', '--start-offset', '0.7'), ([(705, '/map', 'm'), RUNS[1][2]],)),
    ],
)
def test_runs_of_a_simulation_that_was_reset_stay_apart(words, written):
    write_runs(Path('drive'), TOPICS, *RUNS)
    assert run(*words, '-o', 'out') == 0
    assert [read_bag(file) for file in sorted(Path('out').glob('*.mcap'))] == [*written]
    assert read_bag(Path('out')) == [each for part in written for each in part]


def test_the_begin_of_a_bag_is_kept_as_it_is():
    assert run('trim', 'in', '-o', 'out', '--duration', '0.01') == 0
    assert read_bag(Path('out')) == TEXTS[:4]


def test_what_was_latched_can_be_left_out():
    assert run('trim', 'in', '-o', 'out', '--start-offset', '0.045', '--no-latched') == 0
    assert read_bag(Path('out')) == [(50, '/scan', '50')]


def test_a_part_without_messages_is_refused_with_the_times_of_the_bag():
    with pytest.raises(BagError) as refused:
        run('trim', 'in', '-o', 'out', '--start-time', '1', '--end-time', '2')
    assert str(refused.value) == (
        'in has no message from 1 to 2 s: it goes from 1700000000 to 1700000000.05 s'
    )
    assert not Path('out').exists()


@pytest.mark.parametrize(
    ('flags', 'kept'),
    [
        (['--topics', '/map'], {'/map'}),
        (['-e', '/.*a.*'], {'/map', '/tf_static', '/scan'}),
        (['-x', '/tf.*'], {'/map', '/scan'}),
        (['--exclude-topics', '/map', '/scan'], {'/tf_static'}),
    ],
)
def test_chosen_topics_are_kept(flags, kept):
    assert run('filter', 'in', '-o', 'out', *flags) == 0
    with BagReader(Path('out')) as reader:
        assert reader.topics.keys() == kept
    assert read_bag(Path('out')) == [each for each in TEXTS if each[1] in kept]


def test_a_choice_of_nothing_names_what_is_there():
    with pytest.raises(
        BagError, match='^no topic of in is meant; it has /map, /scan, /tf_static$'
    ):
        run('filter', 'in', '-o', 'out', '--topics', '/absent')


def test_several_bags_become_one_in_order():
    write_bag(
        Path('other'), [topic('/other'), topic('/scan')], [(15, '/other', 'o'), (99, '/scan', 'z')]
    )
    assert run('merge', 'other', 'in', '-o', 'out', '--storage-preset-profile', 'zstd_fast') == 0
    assert read_bag(Path('out')) == sorted([*TEXTS, (15, '/other', 'o'), (99, '/scan', 'z')])


def test_without_a_name_it_is_named_by_the_time(folder):
    assert run('merge', 'in') == 0
    names = [path.name for path in folder.iterdir() if path.name != 'in']
    assert re.fullmatch(r'rosbag2_\d{4}(_\d\d){2}-\d\d(_\d\d){2}', *names)


def test_what_is_there_is_not_overwritten():
    before = read_bag(Path('in'))
    with pytest.raises(BagError, match='^in is there already: choose another name with --output$'):
        run('merge', 'in', '-o', 'in')
    assert read_bag(Path('in')) == before


def test_a_failure_leaves_nothing(monkeypatch):
    """Neither does Ctrl-C."""

    def interrupted(*_args):
        raise KeyboardInterrupt

    monkeypatch.setattr(rewriting._Writer, 'write', interrupted)
    with pytest.raises(KeyboardInterrupt):
        run('merge', 'in', '-o', 'out')
    assert not Path('out').exists()


def convert(*outputs, source='in'):
    Path('options.yaml').write_text(yaml.safe_dump({'output_bags': outputs}))
    return run('convert', '-i', source, '-o', 'options.yaml')


def test_several_bags_are_made_at_once(capsys):
    assert (
        convert(
            {'uri': 'all', 'all': True, 'compression_mode': 'file', 'compression_format': 'zstd'},
            {'uri': 'some', 'regex': 'a', 'exclude_topic_types': [], 'exclude_topics': ['/map']},
            {'uri': 'split', 'topics': ['scan'], 'max_cache_size': 0},
            {
                'uri': 'part',
                'topic_types': ['std_msgs/msg/String'],
                'start_time_ns': BEGIN + 6 * MS,
                'end_time_ns': BEGIN + 20 * MS,
                'storage_preset_profile': 'zstd_small',
                'custom_data': {'robot': 'other', 'day': '1'},
            },
        )
        == 0
    )
    assert capsys.readouterr().out.splitlines() == [
        'all: 8 messages',
        'some: 7 messages',
        'split: 5 messages',
        'part: 3 messages',
    ]
    assert read_bag(Path('all')) == TEXTS
    assert [path.name for path in Path('all').glob('all_*')] == ['all_0.mcap.zstd']
    assert read_bag(Path('some')) == TEXTS[1:]
    assert read_bag(Path('part')) == [
        (6, '/tf_static', 's2'),
        (10, '/scan', '10'),
        (20, '/scan', '20'),
    ]
    with BagReader(Path('part')) as reader:
        assert reader.metadata.custom_data == {'robot': 'other', 'day': '1'}


@pytest.mark.parametrize('limit', [{'max_bagfile_size': 2000}, {'max_bagfile_duration': 1}])
def test_bags_are_split(limit):
    write_bag(Path('long'), [topic('/a')], [(n * 1500, '/a', 'x' * 2000) for n in range(3)])
    assert convert({'uri': 'split', 'all': True, **limit}, source='long') == 0
    assert len([*Path('split').glob('split_*.mcap')]) == 3
    assert read_bag(Path('split')) == read_bag(Path('long'))


def test_bags_of_sqlite_become_mcap():
    store = get_typestore(Stores.ROS2_JAZZY)
    kind = 'std_msgs/msg/String'
    with Writer(Path('old'), version=8, storage_plugin=StoragePlugin.SQLITE3) as writer:
        connection = writer.add_connection('/scan', kind, typestore=store)
        for n in range(3):
            writer.write(connection, BEGIN + n * MS, string(str(n)))
    assert convert({'uri': 'new', 'all_topics': True}, source='old') == 0
    assert read_bag(Path('new')) == [(n, '/scan', str(n)) for n in range(3)]
    with BagReader(Path('new')) as reader:
        assert reader.storage == 'mcap'
        assert kind in reader.schemas


@pytest.mark.parametrize(
    ('options', 'line'),
    [
        ('a: [', 'options.yaml: not YAML: '),
        (
            'output_bags: {}',
            'options.yaml: want a sequence of bags under the only key, output_bags',
        ),
        ('output_bags: [1]', r'options.yaml: output_bags\[0\]: want a mapping with uri'),
        ('output_bags: [{all: true}]', r'output_bags\[0\]: uri is missing'),
        ('output_bags: [{uri: a}]', 'no topic is asked for: say all_topics: true'),
        ('output_bags: [{uri: a, al_topics: true}]', '"al_topics"; did you mean "?all_topics'),
        ('output_bags: [{uri: a, all: 1}]', 'all: want a bool, not 1'),
        ('output_bags: [{uri: a, storage_id: db3}]', 'mcap or sqlite3 is written, not "db3"'),
        ('output_bags: [{uri: a, compression_mode: message}]', 'want none or file'),
        ('output_bags: [{uri: a, storage_preset_profile: x}]', 'want one of none, fastwrite'),
        ('output_bags: [{uri: a, regex: "("}]', '--regex .* is not a regular expression'),
    ],
)
def test_what_is_wrong_with_options_is_told_with_their_place(options, line):
    Path('options.yaml').write_text(options)
    with pytest.raises(BagError, match=line):
        run('convert', '-i', 'in', '-o', 'options.yaml')


@pytest.mark.parametrize(
    ('words', 'line'),
    [
        (
            ['convert', '-i', 'absent', '-o', 'x'],
            r"^\[ERROR\] \[ros2bag\]: Bag path 'absent' does",
        ),
        (['convert', '-i', 'in', 'odd', '-o', 'x'], "Unknown storage ID 'odd', options are: sqli"),
        (['convert', '-i', 'in', 'mcap', 'x', '-o', 'x'], '--input expects 1 or 2 arguments, 3'),
        (['convert', '-i', 'in', '-o', 'absent.yaml'], '^absent.yaml: No such file'),
        (['trim', 'in'], '^say what to keep by --start-offset'),
    ],
)
def test_what_is_wrong_with_a_line_is_told(words, line):
    with pytest.raises(AmrError, match=line):
        run(*words)


@pytest.mark.parametrize(
    ('words', 'line'),
    [
        (['trim', 'in', '--duration', '-1'], "argument --duration: '-1' is not a number of sec"),
        (['trim', 'in', '--end-time', '1e999999'], "'1e999999' is not a number of seconds"),
        (['trim', 'in', '--start-offset', 'x'], "'x' is not a number of seconds from 0 on"),
        (['merge', 'absent'], "argument bag_paths: Bag path 'absent' does not exist!"),
    ],
)
def test_what_is_no_value_is_told_by_argparse(words, line, capsys):
    with pytest.raises(SystemExit, match='^2$'):
        run(*words)
    assert line in capsys.readouterr().err


@pytest.mark.parametrize(
    ('kind', 'names'),
    [
        ('storage', ['mcap', 'sqlite3']),
        ('converter', []),
        ('compression', ['zstd']),
        ('decompression', ['zstd']),
    ],
)
def test_plugins_are_listed(kind, names, capsys):
    assert run('list', kind) == 0
    assert capsys.readouterr().out.splitlines() == names
    assert run('list', kind, '--verbose') == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == f'available {kind} plugins are:'
    assert [line for line in lines if not line.startswith('\t')][1:] == [
        f'name: {name}' for name in names
    ]
