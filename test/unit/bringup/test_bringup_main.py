# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The command line of ``bringup``: errors are reported in one line, before anything starts."""

from fixtures.bringup.running import install_toys, STACKS
import pytest

from amr_description.bringup.main import main
from amr_description.bringup.stack_files import find_stack
from amr_description.bringup.stacks import STACKS as READY_MADE

CHATTY = str(STACKS / 'chatty.py')


@pytest.fixture(autouse=True)
def toys(tmp_path, monkeypatch):
    install_toys(tmp_path / 'prefix')
    monkeypatch.setenv('AMENT_PREFIX_PATH', str(tmp_path / 'prefix'))
    monkeypatch.setenv('ROS_LOG_DIR', str(tmp_path / 'logs'))


@pytest.mark.parametrize(
    ('words', 'exit_code', 'text'),
    [
        (['simulaton'], 2, "unknown stack 'simulaton'; did you mean 'simulation'? known: display"),
        (['no_such.py'], 2, "no stack: there is no file 'no_such.py'"),
        ([CHATTY, 'txt:=x'], 2, "unknown argument 'txt'; did you mean 'text'? known: text, unf"),
        ([CHATTY, 'text'], 1, "malformed launch argument 'text', expected format"),
        ([CHATTY, 'text:=x', 'code:=y'], 2, "code:=y: 'y' is not an integer"),
        ([CHATTY], 1, "missing required argument 'text'"),
        ([str(STACKS / 'stubborn.py'), 'role:=x'], 1, 'Argument "role" provided value "x" is not'),
        ([str(STACKS / '../running.py')], 1, "has no function 'running' that returns a Stack; kn"),
    ],
)
def test_one_line_and_the_right_exit_code(capsys, tmp_path, words, exit_code, text):
    assert main(words) == exit_code
    captured = capsys.readouterr()
    assert captured.out == ''
    assert captured.err.count('\n') == 1
    assert captured.err.startswith('bringup: ')
    assert text in captured.err
    assert not (tmp_path / 'logs').exists()


def test_a_missing_executable_starts_nothing(capsys, tmp_path):
    (tmp_path / 'prefix/lib/toys/step').unlink()
    assert main([CHATTY, 'text:=x']) == 1
    captured = capsys.readouterr()
    assert captured.err.startswith("bringup: executable 'step' not found on the libexec directory")
    assert captured.out == ''


@pytest.mark.parametrize('words', [[], ['--nonsense'], ['simulation', '--nonsense']])
def test_a_wrong_command_line_is_answered_with_the_usage(capsys, words):
    with pytest.raises(SystemExit, match='2'):
        main(words)
    assert 'usage: bringup' in capsys.readouterr().err


def test_show_args_and_print_start_nothing(capsys, tmp_path):
    assert main([CHATTY, '--show-args']) == 0
    assert "    'text':\n        no description given\n" in capsys.readouterr().out
    assert main([CHATTY, '--print', 'text:=a b']) == 0
    assert capsys.readouterr().out == (
        f'step-1: at once\n'
        f"    {tmp_path}/prefix/lib/toys/step --code 0 'a b' --unfinished '' --ros-args\n"
    )
    assert main([str(STACKS / 'in_order.py'), '-p']) == 0
    text = capsys.readouterr().out
    assert 'step-1: when step-4 exited with code 0\n' in text
    assert '    LOG_FOLDER/worker-3-parameters-1.yaml:\n        /**:\n' in text
    assert text.endswith('ready: when step-1 exited with code 0\n')
    assert not (tmp_path / 'logs').exists()


@pytest.mark.parametrize('name', READY_MADE)
def test_every_ready_made_stack_can_be_found_and_has_a_docstring(name):
    assert find_stack(name).__doc__
