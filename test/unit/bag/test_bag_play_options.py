# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What each flag of ``ros2 bag play`` and ``burst`` asks the player for."""

from contextlib import contextmanager
from pathlib import Path
from types import SimpleNamespace

import pytest

from amr_description.bag.playback import PlaybackOptions
from amr_description.bag.qos_text import QosProfile
from amr_description.bag.ros.player import PlayerOptions
from amr_description.bag.topic_selection import TopicSelection
from amr_description.cli.bag import playing
from amr_description.cli.ros2 import main
from amr_description.errors import BagError

SECOND = 10**9
REQUESTS = '--publish-service-requests'


@pytest.fixture
def asked(tmp_path, monkeypatch):
    """A function that returns how the player is called by a command line."""
    monkeypatch.chdir(tmp_path)
    for name in ('bag', 'other', 'storage.yaml'):
        Path(name).touch()
    Path('qos.yaml').write_text('/scan: {reliability: best_effort, depth: 3}')
    calls = []
    monkeypatch.setattr(
        playing, 'play', lambda *args, burst=None: calls.append((*args, burst)) or 0
    )

    def ask(*words):
        assert main(['bag', *words]) == 0
        return calls.pop()

    return ask


@pytest.mark.parametrize(
    ('flags', 'wanted'),
    [
        ([], {}),
        (['-r', '2.5'], {'rate': 2.5}),
        (['--loop'], {'loop': True}),
        (['-p'], {'start_paused': True}),
        (['-d', '1.5'], {'delay': 1_500_000_000}),
        (['--start-offset', '0.25'], {'start_offset': SECOND // 4}),
        (['--playback-duration', '3'], {'duration': 3 * SECOND}),
        (['--playback-duration', '0'], {'duration': 0}),
        (['--playback-duration', '-2'], {}),
        (['--playback-until-sec', '1700000000.5'], {'until': 1_700_000_000_500_000_000}),
        (['--playback-until-nsec', '1700000000000000001'], {'until': 1_700_000_000_000_000_001}),
        (['--playback-until-sec', '1e300'], {'until': 2**63}),
        (['--read-ahead-queue-size', '7'], {'read_ahead': 7}),
    ],
)
def test_flags_of_what_is_played_when(asked, flags, wanted):
    options = asked('play', 'bag', *flags)[2]
    assert options == PlayerOptions(playback=PlaybackOptions(**wanted))


@pytest.mark.parametrize(
    ('flags', 'wanted'),
    [
        (['--clock'], {'clock_frequency': 40}),
        (['--clock', '100'], {'clock_frequency': 100.0}),
        (['--clock-topics', '/a', '/b'], {'clock_topics': ['/a', '/b']}),
        (['--clock-topics-all'], {'clock_topics': ()}),
        (['--wait-for-all-acked', '0'], {'acked_timeout': 0}),
        ([REQUESTS], {'requests_from': 'service_introspection'}),
        (
            [REQUESTS, '--service-requests-source', 'client_introspection'],
            {'requests_from': 'client_introspection'},
        ),
        (['--service-requests-source', 'client_introspection'], {}),
        (
            ['--qos-profile-overrides-path', 'qos.yaml'],
            {'overrides': {'/scan': QosProfile(reliability='best_effort', depth=3)}},
        ),
        (['--storage-config-file', 'storage.yaml', '--disable-loan-message'], {}),
    ],
)
def test_flags_of_how_it_is_published(asked, flags, wanted):
    assert asked('play', 'bag', *flags)[2] == PlayerOptions(**wanted)


def test_flags_of_which_topics_are_played(asked):
    flags = '--topics a b --services s -e r -x x --exclude-topics c --exclude-services t'
    assert asked('play', 'bag', *flags.split())[1] == TopicSelection(
        topics=['a', 'b'],
        services=['s'],
        regex='r',
        exclude_regex='x',
        exclude_topics=['c'],
        exclude_services=['t'],
    )


@pytest.mark.parametrize(
    ('words', 'bags'),
    [
        (['bag'], [('bag', None)]),
        (['bag', '-s', 'sqlite3'], [('bag', 'sqlite3')]),
        (['-i', 'bag', '--input', 'other', 'mcap'], [('bag', None), ('other', 'mcap')]),
    ],
)
def test_which_bags_are_played(asked, words, bags):
    assert asked('play', *words)[0] == [(Path(path), storage) for path, storage in bags]


def test_what_is_about_the_node(asked):
    args = asked('play', 'bag')[3]
    assert (args.remap, args.log_level, args.disable_keyboard_controls) == ('', 'info', False)
    words = 'play bag -m /a:=/b /c:=/d --log-level error --disable-keyboard-controls'
    args = asked(*words.split())[3]
    assert (args.remap, args.log_level) == (['/a:=/b', '/c:=/d'], 'error')
    assert args.disable_keyboard_controls


@pytest.mark.parametrize('is_disabled', [False, True])
def test_keys_can_be_left_to_others(monkeypatch, is_disabled):
    bound = []

    @contextmanager
    def keys(bindings):
        bound.extend(bindings)
        yield False

    monkeypatch.setattr(playing, 'keys', keys)
    player = SimpleNamespace(toggle_paused=None, play_next=None)
    args = SimpleNamespace(disable_keyboard_controls=is_disabled)
    with playing._keyboard(None, player, args):
        assert bool(bound) != is_disabled


def test_a_burst_is_paused(asked):
    words = (
        'burst bag -s mcap -n 5 --start-offset 2 --topics a --services s -m /a:=/b '
        '--read-ahead-queue-size 9 --qos-profile-overrides-path qos.yaml'
    )
    bags, chosen, options, args, count = asked(*words.split())
    assert bags == [(Path('bag'), 'mcap')]
    assert chosen == TopicSelection(topics=['a'], services=['s'])
    assert options.playback == PlaybackOptions(
        start_paused=True, start_offset=2 * SECOND, read_ahead=9
    )
    assert options.overrides.keys() == {'/scan'}
    assert (args.remap, count) == (['/a:=/b'], 5)
    assert asked('burst', 'bag')[4] == 0


@pytest.mark.parametrize(
    'words',
    [
        ['--clock', '--clock-topics-all'],
        ['--playback-until-sec', '1', '--playback-until-nsec', '1'],
    ],
)
def test_what_excludes_each_other_is_refused(asked, words, capsys):
    with pytest.raises(SystemExit, match='^2$'):
        asked('play', 'bag', *words)
    assert 'not allowed with argument' in capsys.readouterr().err


@pytest.mark.parametrize('flag', ['--playback-until-sec', '--playback-duration', '--start-offset'])
@pytest.mark.parametrize('value', ['inf', 'nan'])
def test_times_are_finite(asked, flag, value, capsys):
    with pytest.raises(SystemExit, match='^2$'):
        asked('play', 'bag', flag, value)
    assert capsys.readouterr().err.endswith(f'{flag}: {value} is not a finite number\n')


def test_a_bag_is_given_once(asked):
    with pytest.raises(BagError, match='bag_path and --input cannot be given together'):
        asked('play', 'bag', '-i', 'other')


def test_overrides_that_are_none_are_told_with_their_file(asked):
    Path('qos.yaml').write_text('/scan: {depth: -1}')
    with pytest.raises(BagError, match='^qos.yaml: /scan: depth: '):
        asked('play', 'bag', '--qos-profile-overrides-path', 'qos.yaml')
