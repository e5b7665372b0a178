# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A workspace with a package of this one's name, as the tutorial has it: hers, and this one below it.

What is on the PATH and in ``lib/`` is started, with the variables that her ``setup.bash`` sets.
"""

import os
from pathlib import Path
import signal
import subprocess
import sys
import sysconfig

import pytest
from support.paths import ROOT
from support.running_programs import PATIENCE, Program

from amr_description.ament_index import own_prefix

NAME = 'amr_description'
BIN = Path(sys.prefix, 'bin')
SITE = Path(sysconfig.get_path('purelib')).relative_to(sys.prefix)


@pytest.fixture(scope='module')
def hers(tmp_path_factory):
    """The folder of her package, as colcon installs it: a description, a program, no module."""
    prefix = tmp_path_factory.mktemp('tut_ws') / 'install' / NAME
    marker = prefix / 'share/ament_index/resource_index/packages' / NAME
    program = prefix / 'lib' / NAME / 'mine'
    urdf = prefix / 'share' / NAME / 'urdf/amr.urdf'
    module = prefix / SITE / NAME / '__init__.py'
    for file in (marker, program, urdf, module):
        file.parent.mkdir(parents=True, exist_ok=True)
        file.touch()
    program.write_text('#!/bin/sh\necho mine\n')
    program.chmod(0o755)
    text = (ROOT / 'urdf/amr.urdf').read_text(encoding='utf-8')
    urdf.write_text(text.replace('<robot name="amr"', '<robot name="hers"'), encoding='utf-8')
    return prefix


@pytest.fixture
def variables(hers):
    """The environment of her shell."""
    return {
        **os.environ,
        'PATH': f'{BIN}:{os.environ["PATH"]}',
        'AMENT_PREFIX_PATH': f'{hers}:{os.environ["AMENT_PREFIX_PATH"]}',
        'PYTHONPATH': str(hers / SITE),
    }


def run(variables, *command, cwd=None):
    result = subprocess.run(
        command, env=variables, cwd=cwd, capture_output=True, text=True, timeout=PATIENCE
    )
    assert result.returncode == 0, result.stderr
    return result


def test_commands_find_their_modules(variables, hers):
    assert '/parameter_events' in run(variables, BIN / 'ros2', 'topic', 'list').stdout
    urdf = hers / 'share' / NAME / 'urdf/amr.urdf'
    assert 'robot name is: hers' in run(variables, BIN / 'check_urdf', urdf).stdout


def test_what_is_hers_comes_first_and_the_rest_is_found(variables, hers):
    assert run(variables, 'ros2', 'pkg', 'prefix', NAME).stdout == f'{hers}\n'
    assert run(variables, 'ros2', 'run', NAME, 'mine').stdout == 'mine\n'
    listed = run(variables, 'ros2', 'run', NAME, 'calibrate', '--help')
    assert listed.stdout.startswith('usage: calibrate')
    ours = own_prefix() / 'lib' / NAME / 'calibrate'
    said = f"[ros2run]: package '{NAME}' of {hers} has no 'calibrate': running {ours}\n"
    assert listed.stderr == said


def test_executables_find_their_modules_wherever_they_are_started(variables, tmp_path):
    (tmp_path / f'{NAME}.py').write_text('raise SystemExit("of the current folder")')
    for name in ('xacro', 'spawner'):
        program = own_prefix() / 'lib' / NAME / name
        for safe in ({}, {'PYTHONSAFEPATH': '1'}):  # with it, sys.path has no folder of the script
            result = run({**variables, **safe}, program, '--help', cwd=tmp_path)
            assert 'usage' in result.stdout.lower()


IMPORT = """
from tf2_ros import Buffer, LookupException, StaticTransformBroadcaster, TransformException
from tf2_ros.buffer import Buffer as Same
from tf2_ros.transform_broadcaster import TransformBroadcaster
from tf2_ros.transform_listener import TransformListener
import ament_copyright.main, message_filters, sensor_msgs_py.numpy_compat
from message_filters import *
from sensor_msgs_py import point_cloud2
assert ApproximateTimeSynchronizer is message_filters.ApproximateTimeSynchronizer
assert callable(point_cloud2.create_cloud_xyz32) and callable(ament_copyright.main.main)
assert Same is Buffer and issubclass(LookupException, TransformException)
try:
    Buffer().lookup_transform('odom', 'base_link', __import__('rclpy').time.Time())
except TransformException as error:
    print(error)
"""


@pytest.mark.parametrize('is_overlaid', [False, True])
def test_a_node_imports_packages_of_ros_under_their_names(variables, is_overlaid):
    if not is_overlaid:
        del variables['PYTHONPATH']
    said = run(variables, BIN / 'python', '-c', IMPORT).stdout
    assert said.startswith('"odom" passed to lookupTransform argument target_frame does not exist')


def test_a_stack_of_ours_drives_her_robot(variables, hers, tmp_path):
    bringup = own_prefix() / 'lib' / NAME / 'bringup'
    # Not by support.preloaded: it must find its modules by itself.
    command = ['env', str(bringup), 'mock']
    with Program(*command, env={**variables, 'ROS_LOG_DIR': str(tmp_path)}) as stack:
        stack.expect(f"package '{NAME}' of {hers} overlays this one: its files come first")
        stack.expect('ready in')
        name = ('/robot_state_publisher', 'robot_description')
        assert '<robot name="hers"' in run(variables, 'ros2', 'param', 'get', *name).stdout
        assert stack.end(signal.SIGINT) == 0
