# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The environment of children: unbuffered output, and the ROS wheels' guard where it is valid."""

import os
from pathlib import Path
import sys

import pytest

from amr_description.bringup.environment import (
    child_environment,
    interpreter_of,
    setup_command,
    WHEELS_GUARD,
)

OURS = f'{sys.prefix}/lib'
BASE = {'PATH': os.environ['PATH'], WHEELS_GUARD: '1', 'LD_LIBRARY_PATH': f'/opt/x:{OURS}'}

OUR_PYTHON = f'"{sys.prefix}/bin/python"'
BY_SHELL = """'''exec' %s "$0" "$@"
"""


@pytest.fixture
def script(tmp_path):
    def make(first_line):
        path = tmp_path / 'script'
        path.write_bytes(first_line)
        return path

    return make


@pytest.mark.parametrize(
    ('first_line', 'has_guard', 'libraries'),
    [
        (f'#!{sys.prefix}/bin/python3 -s\n'.encode(), True, f'/opt/x:{OURS}'),
        (b'#!/opt/other/bin/python3\n', False, '/opt/x'),
        (b'#!/usr/bin/env no-such-python\n', False, f'/opt/x:{OURS}'),
        (b'#!/usr/bin/env -S python-of-nobody\n', False, '/opt/x'),
        (b'#!/bin/sh\n', False, f'/opt/x:{OURS}'),
        (f'#!/bin/sh\n{BY_SHELL % OUR_PYTHON}'.encode(), True, f'/opt/x:{OURS}'),
        (f'#!/bin/sh\n{BY_SHELL % "/opt/other/bin/python"}'.encode(), False, '/opt/x'),
        (b'#!\n', False, f'/opt/x:{OURS}'),
        (b'\x7fELF\x02', False, f'/opt/x:{OURS}'),
        (b'', False, f'/opt/x:{OURS}'),
    ],
)
def test_the_guard_goes_to_pythons_of_this_environment_only(
    script, first_line, has_guard, libraries
):
    environment = child_environment(script(first_line), BASE)
    assert (WHEELS_GUARD in environment) == has_guard
    assert environment['LD_LIBRARY_PATH'] == libraries
    assert environment['PYTHONUNBUFFERED'] == '1'


def test_env_is_looked_up_in_the_path(script):
    path = script(b'#!/usr/bin/env python3\n')
    ours = {**BASE, 'PATH': f'{sys.prefix}/bin'}
    assert WHEELS_GUARD in child_environment(path, ours)
    assert WHEELS_GUARD not in child_environment(path, {**ours, 'PATH': '/nowhere'})


def test_an_interpreter_may_be_named_by_the_scripts_own_folder(tmp_path):
    script = tmp_path / 'lib/some_package/node'
    script.parent.mkdir(parents=True)
    script.write_text('#!/bin/sh\n' + BY_SHELL % '"${0%/*}/../../bin/python"')
    assert interpreter_of(script, {}) == tmp_path / 'bin/python'


def test_without_the_wheels_nothing_is_touched(script):
    base = {'LD_LIBRARY_PATH': OURS, 'A': 'b'}
    environment = child_environment(script(b'#!/opt/other/bin/python3\n'), base)
    assert environment == {**base, 'PYTHONUNBUFFERED': '1'}


def test_the_command_for_another_shell(tmp_path, monkeypatch):
    prefix = tmp_path / 'ws/install/robot'
    marker = prefix / 'share/ament_index/resource_index/packages/robot'
    marker.parent.mkdir(parents=True)
    marker.touch()
    monkeypatch.setenv('AMENT_PREFIX_PATH', str(prefix))
    assert setup_command('robot', {}) == ''
    (tmp_path / 'ws/install/setup.bash').touch()
    assert setup_command('robot', {}) == f'source {tmp_path}/ws/install/setup.bash'
    activate = tmp_path / 'ws/scripts/activate'
    activate.parent.mkdir()
    activate.touch()
    monkeypatch.chdir(tmp_path / 'ws')
    assert Path.cwd() == tmp_path / 'ws'
    assert setup_command('robot', {'ROS_DOMAIN_ID': '0'}) == 'source scripts/activate'
    text = 'source scripts/activate && export ROS_DOMAIN_ID=7'
    assert setup_command('robot', {'ROS_DOMAIN_ID': '7'}) == text
