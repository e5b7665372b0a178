# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Spawners of one controller take turns; others do not wait for each other."""

from contextlib import contextmanager
import fcntl

import pytest
from rclpy.node import Node
from support.manager_host import ros_in_this_process

from amr_description.control.ros import spawner_lock
from amr_description.control.ros.spawner_lock import exclusive_lock

MANAGER = '/left/controller_manager'


@pytest.fixture(scope='module')
def node():
    with ros_in_this_process():
        node = Node('locker')
        yield node
        node.destroy_node()


@pytest.fixture(autouse=True)
def home(tmp_path, monkeypatch):
    monkeypatch.setenv('ROS_HOME', str(tmp_path))
    return tmp_path


@contextmanager
def is_free(path):
    with path.open('a') as file:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        yield


def test_a_lock_is_for_one_controller_of_one_manager_in_one_domain(node, home):
    domain = node.context.get_domain_id()
    with exclusive_lock(node, MANAGER, ['b', 'a', 'a']):
        names = [f'spawner.{domain}.left.controller_manager.{name}.lock' for name in 'ab']
        paths = sorted((home / 'locks').iterdir())
        assert [path.name for path in paths] == names
        for path in paths:
            with pytest.raises(BlockingIOError), is_free(path):
                raise AssertionError(f'{path} is free')
        with (
            exclusive_lock(node, MANAGER, ['c']),
            exclusive_lock(node, '/controller_manager', ['a']),
        ):
            pass  # these do not wait
    for path in paths:
        with is_free(path):
            pass


def test_whoever_waits_says_for_whom_and_goes_on_when_that_one_ends(node, home, monkeypatch):
    monkeypatch.setattr(spawner_lock, '_LOG_PERIOD', 0.05)
    with exclusive_lock(node, MANAGER, ['a']):
        (path,) = (home / 'locks').iterdir()
    lines = []
    with path.open('a') as file:
        fcntl.flock(file, fcntl.LOCK_EX)

        class Log:
            """Hears that somebody waits, and lets go."""

            def warning(self, text):
                lines.append(text)
                fcntl.flock(file, fcntl.LOCK_UN)

        monkeypatch.setattr(node, 'get_logger', Log)
        with exclusive_lock(node, MANAGER, ['a']):
            assert lines == [
                f'Waiting for the spawner that works on controller a of {MANAGER} ({path})'
            ]


def test_without_a_folder_for_locks_there_is_none(node, home):
    (home / 'locks').write_text('a file')
    with exclusive_lock(node, MANAGER, ['a']):
        assert (home / 'locks').is_file()
