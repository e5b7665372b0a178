# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What a person sees first: help, wrong words; and that none of it costs an import too many."""

from argparse import ArgumentError, ArgumentParser
from importlib import import_module
import re
import sys
from types import ModuleType

from fixtures.cli.commands import python, ros2
import pytest

from amr_description.cli import qos_arguments
from amr_description.cli.lazy_parser import INSTEAD_OF_COMMANDS, LazyParser, run
from amr_description.cli.ros2 import COMMANDS
from amr_description.cli.topic import VERBS

TOPIC_HELP = """\
usage: ros2 topic [-h] [--include-hidden-topics]
                  Call `ros2 topic <command> -h` for more detailed usage. ...

Various topic related sub-commands

options:
  -h, --help            show this help message and exit
  --include-hidden-topics
                        Consider hidden topics as well

Commands:
{verbs}

  Call `ros2 topic <command> -h` for more detailed usage.
"""

IMPORTED = """\
import sys
from amr_description.cli.main import main
try:
    main('ros2', sys.argv[1:])
except SystemExit:
    pass
print(*sorted(sys.modules), sep='\\n')
"""


def imported_by(*args):
    # By an interpreter of its own (-B), which has loaded nothing before.
    return set(python('-B', '-c', IMPORTED, *args).stdout.splitlines())


@pytest.mark.parametrize('args', [(), ('-h',), ('--help',)])
def test_help_names_every_command(args):
    result = ros2(*args)
    assert result.returncode == 0
    listed = result.stdout.partition('Commands:\n')[2].splitlines()
    assert [line.split()[0] for line in listed[: len(COMMANDS)]] == sorted(COMMANDS)


@pytest.mark.parametrize('args', [(), ('-h',), ('--help',)])
def test_the_help_of_a_command_is_laid_out_like_the_genuine_one(args):
    result = ros2('topic', *args)
    listed = re.findall(r'^  ([a-z]+) +[A-Z].*$', result.stdout, re.MULTILINE)
    assert listed == sorted(VERBS)
    verbs = re.search(r'Commands:\n(.*?)\n\n', result.stdout, re.DOTALL)[1]
    assert (result.returncode, result.stderr) == (0, '')
    assert result.stdout == TOPIC_HELP.format(verbs=verbs)
    assert re.search(r'^  echo +Output messages from a topic$', verbs, re.MULTILINE)


def test_an_unknown_word_is_told_with_those_there_are():
    result = ros2('topic', 'ecko')
    assert (result.returncode, result.stdout) == (2, '')
    assert result.stderr.startswith('usage: ros2 topic [-h]')
    # As argparse of this Python says it: from 3.12.8 on without the quotes.
    action = ArgumentParser().add_argument('verb', choices=sorted(VERBS))
    with pytest.raises(ArgumentError) as refused:
        ArgumentParser()._check_value(action, 'ecko')
    assert "invalid choice: 'ecko' (choose from " in refused.value.message
    assert result.stderr.endswith(f"{refused.value.message}\ndid you mean 'echo'?\n")


@pytest.mark.parametrize('command', INSTEAD_OF_COMMANDS)
def test_a_verb_of_the_original_that_is_not_here_is_one_line_with_what_to_do(command, capsys):
    parser = LazyParser(prog='ros2')
    parser.read_table(COMMANDS)
    for rest in ([], ['record', '-a'], ['--help']):
        with pytest.raises(SystemExit, match='2'):
            run(parser, [*command.split()[1:], *rest])
        said = capsys.readouterr()
        assert said.out == ''
        assert said.err == f'{command} is not offered here: {INSTEAD_OF_COMMANDS[command]}\n'


def test_what_is_offered_is_not_in_the_table_of_what_is_not():
    for command in INSTEAD_OF_COMMANDS:
        group, *verb = command.split()[1:]
        offered = import_module(COMMANDS[group]).VERBS if verb else COMMANDS
        assert (verb or [group])[0] not in offered


def test_help_needs_neither_rclpy_nor_verbs():
    modules = imported_by('--help')
    assert 'amr_description.cli.topic' in modules
    assert not {'rclpy', 'yaml', 'numpy', 'amr_description.cli.topic.echo'} & modules


def test_the_help_of_verbs_needs_no_rclpy():
    modules = imported_by('topic', '--help')
    assert 'amr_description.cli.topic.echo' in modules
    assert not {'rclpy', 'yaml', 'numpy'} & modules
    assert not {'rclpy', 'yaml', 'numpy'} & imported_by('topic', 'pub', '--help')


def test_a_verb_does_not_import_the_others():
    modules = imported_by('pkg', 'prefix', 'nobody')
    assert 'amr_description.cli.pkg.index_verbs' in modules
    assert not {'amr_description.cli.topic', 'amr_description.cli.pkg.create'} & modules


@pytest.mark.parametrize('command', COMMANDS)
def test_every_verb_has_a_line_of_help_and_a_way_to_run(command):
    parser = LazyParser(prog='ros2')
    parser.read_table({command: COMMANDS[command]})
    with pytest.raises(SystemExit, match='0'):
        run(parser, [command, '--help'])


def test_what_follows_a_name_is_read_by_its_verb():
    parser = LazyParser(prog='ros2')
    parser.read_table(COMMANDS)
    words = ['run', 'pkg', 'exe', '-h', '--', '--ros-args', '-p', 'x:=1']
    args = parser.parse_args(words)
    assert (args.package_name, args.executable_name) == ('pkg', 'exe')
    assert args.argv == words[3:]


def test_the_choices_of_qos_flags_are_those_of_rclpy():
    from rclpy import qos

    assert list(qos_arguments.PROFILES) == qos.QoSPresetProfiles.short_keys()
    assert list(qos_arguments.HISTORIES) == qos.QoSHistoryPolicy.short_keys()
    assert list(qos_arguments.RELIABILITIES) == qos.QoSReliabilityPolicy.short_keys()
    assert list(qos_arguments.DURABILITIES) == qos.QoSDurabilityPolicy.short_keys()
    assert list(qos_arguments.LIVELINESSES) == qos.QoSLivelinessPolicy.short_keys()


def test_options_may_stand_between_words(monkeypatch):
    def add_arguments(parser):
        parser.add_argument('first')
        parser.add_argument('rest', nargs='*')
        parser.add_argument('-n', type=int)

    verb = ModuleType('verb', 'A verb.')
    verb.add_arguments, verb.main = add_arguments, lambda args: (args.first, args.rest, args.n)
    monkeypatch.setitem(sys.modules, 'verb', verb)

    def read(*words):
        parser = LazyParser(prog='ros2')
        parser.read_table({'verb': 'verb'})
        return run(parser, ['verb', *words])

    for words in (['-n', '1', 'a', 'b', 'c'], ['a', '-n', '1', 'b', 'c'], ['a', 'b', '-n1', 'c']):
        assert read(*words) == ('a', ['b', 'c'], 1)
    assert read('a', '--', '-n') == ('a', ['-n'], None)
    assert read('a') == ('a', [], None)


def test_a_word_too_many_is_told():
    result = ros2('node', 'info', '/node', '--include-hidden', 'more')
    assert result.returncode == 2
    assert result.stderr.endswith('ros2: error: unrecognized arguments: more\n')
