# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Mutated bags, and all that reads them. A seed gives the same mutation on every machine."""

from pathlib import Path
import random
import re
import shutil
import sqlite3
import warnings

from mcap.writer import CompressionType
from support.small_bags import BEGIN, LATCHED, MS, string, topic, write_bag

from amr_description.bag.info_text import Contents, info_text
from amr_description.bag.qos_text import to_text
from amr_description.bag.reader import BagReader, reindexed
from amr_description.bag.recording import BagRecording, offer_of
from amr_description.bag.rewriting import rewrite, RewrittenBag
from amr_description.errors import BagError

TOPICS = [topic('/map', LATCHED), topic('/tf_static', LATCHED, LATCHED), topic('/scan')]
TEXTS = [(0, '/map', 'm'), (3, '/tf_static', 's'), *((n, '/scan', 'x' * n) for n in range(4, 30))]
KINDS = {
    'plain': {},
    'fastwrite': {'preset': 'fastwrite'},
    'small_chunks': {'settings': {'chunk_size': 100}},
    'zstd': {'preset': 'zstd_fast'},
    'lz4': {'settings': {'compression': CompressionType.LZ4}},
    'sqlite': None,
}
NUMBERS = [0, 1, 2**31 - 1, 2**32 - 1, 2**63 - 1, 2**63, 2**64 - 1, 8, 255]
NASTY = [
    '.inf', '-.inf', '.nan', '-1', '1e400', '99999999999999999999999', '0x' + 'f' * 6000, '~', '',
    '[]', '{}', '""', '[1, [2]]', '{a: {b: c}}', '2026-99-99', '!!set {a, b}', '&a [*a]', '*b',
    '[' * 500, '[' * 300_000, '{a: ' * 300_000, '- ' * 100_000, '"a\\nb\\e[2J"', '!!binary "AA=="',
    '[&x [1,1,1,1,1,1,1,1,1], &y [*x,*x,*x,*x,*x,*x,*x,*x], &z [*y,*y,*y,*y,*y,*y,*y,*y], '
    '&w [*z,*z,*z,*z,*z,*z,*z,*z], [*w,*w,*w,*w,*w,*w,*w,*w]]',
]  # fmt: skip


def originals(folder: Path) -> dict[str, Path]:
    """Write a bag of each kind; return their folders."""
    found = {}
    for kind, options in KINDS.items():
        found[kind] = folder / kind
        if options is None:
            write_sqlite(folder / kind)
        else:
            write_bag(folder / kind, TOPICS, TEXTS, custom_data={'a': 'b'}, **options)
    return found


def write_sqlite(folder: Path) -> None:
    """Write a bag as rosbag2 of Humble does, without ``metadata.yaml``."""
    folder.mkdir()
    base = sqlite3.connect(folder / 'sqlite_0.db3')
    base.executescript(
        'CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL,'
        ' serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL);'
        'CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL,'
        ' timestamp INTEGER NOT NULL, data BLOB NOT NULL);'
        'CREATE INDEX timestamp_idx ON messages (timestamp ASC);'
    )
    numbers = {}
    for number, each in enumerate(TOPICS):
        qos = to_text(each.offered_qos_profiles, named=False)
        base.execute(
            'INSERT INTO topics VALUES (?, ?, ?, ?, ?)', (number, each.name, each.type, 'cdr', qos)
        )
        numbers[each.name] = number
    base.executemany(
        'INSERT INTO messages VALUES (NULL, ?, ?, ?)',
        [(numbers[name], BEGIN + after * MS, string(text)) for after, name, text in TEXTS],
    )
    base.commit()
    base.close()


def mutate(bag: Path, target: Path, seed: int) -> None:
    """Write a bag with one to three changes of a file."""
    chance = random.Random(seed)
    shutil.copytree(bag, target)
    files = sorted(path for path in target.iterdir() if path.name != 'metadata.yaml')
    text = target / 'metadata.yaml'
    if text.exists() and chance.random() < 0.3:
        _mutate_text(text, chance)
        return
    if chance.random() < 0.7:
        text.unlink(missing_ok=True)
    path = chance.choice(files)
    data = bytearray(path.read_bytes())
    for _ in range(chance.randint(1, 3)):
        chance.choice(_CHANGES)(data, chance)
    path.write_bytes(data)


def _mutate_text(path: Path, chance: random.Random) -> None:
    lines = path.read_text().splitlines()
    for _ in range(chance.randint(1, 2)):
        number = chance.randrange(len(lines))
        if chance.random() < 0.2:
            del lines[number]
        else:
            lines[number] = re.sub(
                '(: |- )[^:]*$', lambda found: found[1] + chance.choice(NASTY), lines[number]
            )
    path.write_text('\n'.join(lines))


def _number(data: bytearray, chance: random.Random) -> None:
    size = chance.choice([1, 2, 4, 8])
    value = chance.choice(NUMBERS) & ((1 << 8 * size) - 1)
    at = chance.randrange(max(1, len(data) - size))
    data[at : at + size] = value.to_bytes(size, chance.choice(['little', 'big']))


def _byte(data: bytearray, chance: random.Random) -> None:
    if data:
        data[chance.randrange(len(data))] ^= 1 << chance.randrange(8)


def _cut(data: bytearray, chance: random.Random) -> None:
    at = chance.randrange(len(data) + 1)
    del data[at : at + chance.choice([1, 8, 100, len(data)])]


def _insert(data: bytearray, chance: random.Random) -> None:
    at, source = (chance.randrange(len(data) + 1) for _ in range(2))
    data[at:at] = data[source : source + chance.choice([1, 8, 100])]


_CHANGES = [_number, _number, _byte, _cut, _insert]


def read_all(bag: Path, new: Path) -> str:
    """Read a bag in all ways, and write it anew; return the error, which is one line."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter('error')
            _read(bag, new)
            reindexed(bag)
    except BagError as error:
        assert str(error).isprintable(), str(error)
        assert len(str(error)) < 700, str(error)
        return str(error)
    return ''


def _read(bag: Path, new: Path) -> None:
    with BagReader(bag) as reader:
        contents = Contents()
        for message in reader.messages():
            contents.add(message)
        info_text(reader.metadata, reader.size, contents)
        recording = BagRecording([reader])
        recording.latched_before(recording.end)
        recording.splits()
        for each in recording.topics.values():
            offer_of(each.offered_qos_profiles)
        assert [*reader.messages(['/none'], 2**70, 2**80)] == []
        rewrite([reader], [RewrittenBag(new)])
    with BagReader(new) as reader:
        for _ in reader.messages():
            pass
