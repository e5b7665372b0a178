# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The flags of ``ros2 bag`` are those of Jazzy (0.26.11): names, values, what excludes what."""

from argparse import ArgumentParser
import re
import sys

import pytest

from amr_description.cli.bag import VERBS
from amr_description.cli.lazy_parser import imported

USAGE = {
    'record': """
        [-h] [-o OUTPUT] [-s {sqlite3,mcap}] [--topics Topic [Topic ...]]
        [--services ServiceName [ServiceName ...]] [--topic-types TopicType [TopicType ...]] [-a]
        [--all-topics] [--all-services] [-e REGEX] [--exclude-regex EXCLUDE_REGEX]
        [--exclude-topic-types ExcludeTopicTypes [ExcludeTopicTypes ...]]
        [--exclude-topics Topic [Topic ...]] [--exclude-services ServiceName [ServiceName ...]]
        [--include-unpublished-topics] [--include-hidden-topics] [--no-discovery]
        [-p POLLING_INTERVAL] [--ignore-leaf-topics]
        [--qos-profile-overrides-path QOS_PROFILE_OVERRIDES_PATH] [-f {}] [-b MAX_BAG_SIZE]
        [-d MAX_BAG_DURATION] [--max-cache-size MAX_CACHE_SIZE] [--disable-keyboard-controls]
        [--start-paused] [--use-sim-time] [--node-name NODE_NAME] [--custom-data [KEY=VALUE ...]]
        [--snapshot-mode] [--log-level {debug,info,warn,error,fatal}]
        [--storage-config-file STORAGE_CONFIG_FILE]
        [--storage-preset-profile {none,fastwrite,zstd_fast,zstd_small}]
        [--compression-queue-size COMPRESSION_QUEUE_SIZE]
        [--compression-threads COMPRESSION_THREADS]
        [--compression-threads-priority COMPRESSION_THREADS_PRIORITY]
        [--compression-mode {none,file,message}] [--compression-format {zstd}]
        [[Topic ...] ...]""",
    'play': """
        [-h] [-s {sqlite3,mcap}] [-i uri [storage_id ...]]
        [--read-ahead-queue-size READ_AHEAD_QUEUE_SIZE] [-r RATE] [--topics topic [topic ...]]
        [--services service [service ...]] [-e REGEX] [-x EXCLUDE_REGEX]
        [--exclude-topics topic [topic ...]] [--exclude-services service [service ...]]
        [--qos-profile-overrides-path QOS_PROFILE_OVERRIDES_PATH] [-l]
        [--remap REMAP [REMAP ...]] [--storage-config-file STORAGE_CONFIG_FILE]
        [--clock [Hz] | --clock-topics CLOCK_TOPICS [CLOCK_TOPICS ...] | --clock-topics-all]
        [-d DELAY] [--playback-duration PLAYBACK_DURATION]
        [--playback-until-sec PLAYBACK_UNTIL_SEC | --playback-until-nsec PLAYBACK_UNTIL_NSEC]
        [--disable-keyboard-controls] [-p] [--start-offset START_OFFSET]
        [--wait-for-all-acked TIMEOUT] [--disable-loan-message] [--publish-service-requests]
        [--service-requests-source {service_introspection,client_introspection}]
        [--log-level {debug,info,warn,error,fatal}]
        [bag_path]""",
    'burst': """
        [-h] [-s {sqlite3,mcap}] [--read-ahead-queue-size READ_AHEAD_QUEUE_SIZE]
        [--topics TOPICS [TOPICS ...]] [--services SERVICES [SERVICES ...]]
        [--qos-profile-overrides-path QOS_PROFILE_OVERRIDES_PATH] [--remap REMAP [REMAP ...]]
        [--storage-config-file STORAGE_CONFIG_FILE] [--start-offset START_OFFSET]
        [-n NUM_MESSAGES] bag_path""",
    'info': '[-h] [-s {sqlite3,mcap}] [-t] [-v] [--sort {name,type,count}] bag_path',
    'reindex': '[-h] [-s {sqlite3,mcap}] bag_path',
    'convert': '[-h] -i uri [storage_id ...] -o OUTPUT_OPTIONS',
    'list': '[-h] [--verbose] {storage,converter,compression,decompression}',
}
LONG = {
    'record': {
        '-o': '--output', '-s': '--storage', '-a': '--all', '-e': '--regex',
        '-p': '--polling-interval', '-f': '--serialization-format', '-b': '--max-bag-size',
        '-d': '--max-bag-duration',
    },
    'play': {
        '-s': '--storage', '-i': '--input', '-r': '--rate', '-e': '--regex',
        '-x': '--exclude-regex', '-l': '--loop', '-m': '--remap', '-d': '--delay',
        '-p': '--start-paused',
    },
    'burst': {'-s': '--storage', '-m': '--remap', '-n': '--num-messages'},
    'info': {'-s': '--storage', '-t': '--topic-name', '-v': '--verbose'},
    'reindex': {'-s': '--storage'},
    'convert': {'-i': '--input', '-o': '--output-options'},
    'list': {},
}  # fmt: skip
DEFAULTS = {
    'record': {
        '--storage': 'mcap', '--polling-interval': 100, '--max-cache-size': 100 * 1024 * 1024,
        '--node-name': 'rosbag2_recorder', '--log-level': 'info', '--compression-mode': 'none',
        '--storage-preset-profile': 'none', '--compression-queue-size': 1,
    },
    'play': {
        '--rate': 1.0, '--read-ahead-queue-size': 1000, '--playback-duration': -1.0,
        '--playback-until-sec': -1.0, '--playback-until-nsec': -1, '--wait-for-all-acked': -1,
        '--service-requests-source': 'service_introspection', '--log-level': 'info',
    },
    'burst': {'--read-ahead-queue-size': 1000},
    'info': {'--sort': 'name'},
    'reindex': {},
    'convert': {},
    'list': {},
}  # fmt: skip


@pytest.fixture(params=USAGE)
def verb(request):
    return request.param


@pytest.fixture
def parser(verb):
    made = ArgumentParser(prog='ros2')
    imported(VERBS[verb]).add_arguments(made)
    return made


def options(parser):
    found = [action for action in parser._actions if action.option_strings]
    return [action for action in found if action.dest != 'help']


def test_flags_and_their_values(verb, parser):
    usage = ' '.join(USAGE[verb].split())
    if sys.version_info >= (3, 14) and verb == 'record':
        # Its argparse leaves out a group of two if one of them, the former positional, is hidden.
        usage = usage.replace('[--topics Topic [Topic ...]] ', '')
    assert parser.format_usage().split() == ['usage:', 'ros2', *usage.split()]


def test_short_forms(verb, parser):
    pairs = [sorted(each.option_strings, key=len) for each in options(parser)]
    assert {pair[0]: pair[1] for pair in pairs if len(pair) == 2} == LONG[verb]


def test_defaults(verb, parser):
    """Others are empty, 0 or no."""
    given = {max(each.option_strings, key=len): each.default for each in options(parser)}
    assert {name: value for name, value in given.items() if value} == DEFAULTS[verb]


def test_each_has_a_help(parser):
    assert all(re.match(r'\w', each.help) for each in options(parser))


@pytest.mark.parametrize('words', ['-f cdr', '-s rosbag', '--compression-format lz4', '-p x'])
def test_values_that_are_none(words, capsys):
    made = ArgumentParser(prog='ros2')
    imported(VERBS['record']).add_arguments(made)
    with pytest.raises(SystemExit, match='^2$'):
        made.parse_args(['-a', *words.split()])
    assert re.search(r'invalid (choice|int value): ', capsys.readouterr().err)
