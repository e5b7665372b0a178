# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``map_server`` and ``map_saver_cli`` as processes: a map goes round, and what is said."""

import os
from pathlib import Path

from nav_msgs.msg import OccupancyGrid
import numpy as np
import pytest
import rclpy
from rclpy.node import Node
from rclpy.qos import QoSProfile
from support.ros_processes import run, running

from amr_description.maps.grid import OccupancyGrid as Grid
from amr_description.maps.map_files import load_map, save_map
from amr_description.maps.pose import Pose

CELLS = np.array([[0, 100, -1], [-1, 0, 0]], np.int8)


@pytest.fixture
def hall(tmp_path):
    return save_map(Grid(CELLS, 0.05, Pose(-12.345, 2.0, 0.0)), tmp_path / 'hall')[1]


def serving(path):
    """A map_server that serves a map."""
    parameters = ['-p', f'yaml_filename:={path}', '-p', 'autostart_node:=true']
    return running('map_server', '--ros-args', *parameters, until='Activating')


@pytest.mark.parametrize('words', [[], ['--mode', 'scale'], ['--mode', 'raw', '--fmt', 'PNG']])
def test_what_is_served_is_saved_again(hall, tmp_path, words):
    with serving(hall):
        result = run('map_saver_cli', '-f', str(tmp_path / 'again'), *words)
    assert result.returncode == 0, result.stderr
    assert 'Map saved successfully' in result.stderr
    found = load_map(tmp_path / 'again.yaml')
    assert (found.cells == CELLS).all()
    assert (found.resolution, found.origin) == (0.05, Pose(-12.345, 2.0, 0.0))
    if not words:
        assert (tmp_path / 'again.pgm').read_bytes() == (tmp_path / 'hall.pgm').read_bytes()


def test_a_map_without_a_name_is_called_after_the_time(hall, tmp_path):
    before = Path.cwd()
    os.chdir(tmp_path)
    try:
        with serving(hall):
            result = run('map_saver_cli')
    finally:
        os.chdir(before)
    assert result.returncode == 0, result.stderr
    assert 'Map file unspecified. Map will be saved to map_' in result.stderr
    (found,) = tmp_path.glob('map_*.yaml')
    assert (load_map(found).cells == CELLS).all()


@pytest.mark.parametrize(
    ('words', 'code', 'line'),
    [
        (['-f'], 255, 'Wrong argument: -f should be followed by a value.'),
        (['hall'], 255, 'Wrong argument: hall; there are -t, -f, --occ, --free, --fmt, --mode'),
        (['--occ', 'much'], 255, "--occ is 'much'; it must be a number from 0 to 1"),
        (['--mode', 'scales'], 255, "--mode is 'scales'; it must be trinary, scale, raw"),
        (
            ['-t', 'plan', '--ros-args', '-p', 'save_map_timeout:=0.2'], 1,
            "no map came on '/plan' within 0.2 s: nobody publishes it",
        ),
        (['-t', 'a b'], 1, 'topic name'),
    ],
)  # fmt: skip
def test_what_cannot_be_saved_is_one_line(words, code, line, tmp_path):
    result = run('map_saver_cli', *words)
    assert result.returncode == code, result.stderr
    assert line in result.stderr
    assert 'Traceback' not in result.stderr


def test_thresholds_that_cross_are_refused(hall, tmp_path):
    with serving(hall):
        result = run('map_saver_cli', '-f', str(tmp_path / 'm'), '--free', '0.7')
    assert result.returncode == 1
    assert 'the thresholds are free 0.7 and occupied 0.65' in result.stderr


def test_a_publisher_that_is_not_latched_is_named(tmp_path):
    rclpy.init(args=[])
    try:
        node = Node('slam')
        node.create_publisher(OccupancyGrid, '/map', QoSProfile(depth=1))
        result = run('map_saver_cli', '--ros-args', '-p', 'save_map_timeout:=1.0')
        node.destroy_node()
    finally:
        rclpy.try_shutdown()
    assert result.returncode == 1
    assert (
        'which slam publishes as nav_msgs/msg/OccupancyGrid, RELIABLE, VOLATILE' in result.stderr
    )


def test_a_map_server_that_starts_itself_ends_without_a_map(tmp_path):
    words = ['-p', f'yaml_filename:={tmp_path}/none.yaml', '-p', 'autostart_node:=true']
    result = run('map_server', '--ros-args', *words)
    assert result.returncode == 1
    assert f'{tmp_path}/none.yaml: there is no such file' in result.stderr
    assert 'Traceback' not in result.stderr
