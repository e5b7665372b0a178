# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Whatever is in a bag, it is read, or an error of one line says why not."""

import shutil
import sqlite3

import pytest
from support.hostile_bags import mutate, NASTY, originals, read_all, write_sqlite
from support.small_bags import read_bag, topic, write_bag

from amr_description.bag import metadata, yaml_text
from amr_description.bag.reader import BagReader
from amr_description.bag.recording import BagRecording
from amr_description.errors import BagError


@pytest.fixture(scope='module')
def bags(tmp_path_factory):
    return [*originals(tmp_path_factory.mktemp('originals')).values()]


@pytest.mark.parametrize(
    'seeds', [range(120), pytest.param(range(1000, 11_000), marks=pytest.mark.long)]
)
def test_mutated_bags_are_read_or_refused(bags, tmp_path, seeds):
    results = {'read': 0, 'refused': 0}
    for seed in seeds:
        folder = tmp_path / f'{seed}'
        folder.mkdir()
        mutate(bags[seed % len(bags)], folder / 'bag', seed)
        error = read_all(folder / 'bag', folder / 'new')
        results['refused' if error else 'read'] += 1
        shutil.rmtree(folder)  # thousands would fill the disk
    assert min(results.values()) > len(seeds) / 5


@pytest.mark.parametrize(
    ('column', 'value', 'error'),
    [
        ('timestamp', -1, 'the time of a message is none'),
        ('timestamp', 'soon', 'the time of a message is none'),
        ('data', None, 'a message of it has no data'),
        ('data', 10**12, 'a message of it has no data'),  # not as many zeros
    ],
)
def test_columns_of_sqlite_may_have_anything(tmp_path, column, value, error):
    write_sqlite(tmp_path / 'sqlite')
    base = sqlite3.connect(tmp_path / 'sqlite' / 'sqlite_0.db3')
    base.executescript(
        'CREATE TABLE others(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp, data);'
        'INSERT INTO others SELECT * FROM messages; DROP TABLE messages;'
        'ALTER TABLE others RENAME TO messages;'
    )
    base.execute(f'UPDATE messages SET {column} = ? WHERE id = 1', [value])  # noqa: S608
    base.commit()
    base.close()
    assert read_all(tmp_path / 'sqlite', tmp_path / 'new').endswith(error)


def test_what_sqlite_has_not_is_one_line(tmp_path):
    write_sqlite(tmp_path / 'sqlite')
    base = sqlite3.connect(tmp_path / 'sqlite' / 'sqlite_0.db3')
    base.execute('DROP TABLE messages')
    base.close()
    assert read_all(tmp_path / 'sqlite', tmp_path / 'new').endswith('no such table: messages')


def test_a_time_beyond_those_of_sqlite_is_the_end(tmp_path):
    write_sqlite(tmp_path / 'sqlite')
    with BagReader(tmp_path / 'sqlite') as reader:
        assert [*reader.messages(start=2**63)] == []
        assert len([*reader.messages(end=2**64)]) == 28


@pytest.mark.parametrize('text', NASTY)
def test_metadata_that_nobody_can_have_meant(text):
    good = metadata.to_text(metadata.BagMetadata(custom_data={'a': 'b'}))
    for line in ('nanoseconds: 0', 'message_count: 0', 'storage_identifier: mcap', 'a: b'):
        name = line.partition(':')[0]
        try:
            metadata.from_text(good.replace(line, f'{name}: {text}', 1))
        except BagError as error:
            assert str(error).isprintable()
            assert len(str(error)) < 500


def test_depth_is_counted_only_where_there_may_be_some():
    assert yaml_text.load('a: ' + 'x' * 5000, 'x') == {'a': 'x' * 5000}
    assert yaml_text.load('[' * 900 + ']' * 900, 'x')
    with pytest.raises(BagError, match='^x: not YAML: it is nested too deeply$'):
        yaml_text.load('[' * 1001 + ']' * 1001, 'x')


def test_a_broken_record_of_metadata_does_not_hinder(tmp_path):
    bag = write_bag(tmp_path / 'bag', [topic('/a')], [(0, '/a', 'x')])
    path = bag / 'bag_0.mcap'
    data = path.read_bytes()
    path.write_bytes(data.replace(b'version: 9', b'version: ['))
    assert read_bag(path) == [(0, '/a', 'x')]


def test_a_path_that_is_too_long_is_missing(tmp_path):
    bag = write_bag(tmp_path / 'bag', [topic('/a')], [(0, '/a', 'x')])
    text = (bag / 'metadata.yaml').read_text()
    (bag / 'metadata.yaml').write_text(text.replace('- bag_0.mcap', f'- "{"x" * 300}\\n\\0"'))
    with pytest.raises(BagError, match='which is not there; `ros2 bag reindex') as caught:
        BagReader(bag)
    assert str(caught.value).isprintable()


@pytest.mark.parametrize('depth', [2**70, f'0x{"f" * 6000}'])
def test_a_depth_that_is_none_keeps_what_was_latched(tmp_path, depth):
    bag = write_bag(tmp_path / 'bag', [topic('/a')], [(0, '/a', 'x'), (1, '/a', 'y')])
    text = (bag / 'metadata.yaml').read_text()
    latched = text.replace('depth: 10', f'depth: {depth}').replace('volatile', 'transient_local')
    (bag / 'metadata.yaml').write_text(latched)
    with BagReader(bag) as reader:
        recording = BagRecording([reader])
        assert len(recording.latched_before(recording.end)) == 1
        assert f'depth: {2**64 - 1}\n' in metadata.to_text(reader.metadata)
