# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``ros2 run amr_description map_of_world``: its files, its topic, its words."""

from nav_msgs.msg import OccupancyGrid
from nav_msgs.srv import GetMap
import numpy as np
import pytest
import rclpy
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from support.ros_processes import PATIENCE, run, running

from amr_description.maps.map_files import load_map
from amr_description.navigation.ros.messages import grid_of
from amr_description.ros.service_calls import call, wait_until
from amr_description.sim.occupancy import map_of_world

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


def test_the_files_hold_the_map(tmp_path):
    result = run('map_of_world', 'warehouse', '-o', str(tmp_path / 'hall'), '--resolution', '0.1')
    assert result.returncode == 0, result.stderr
    assert result.stdout.startswith(
        f'{tmp_path}/hall.pgm, {tmp_path}/hall.yaml: 132 x 92 cells of 0.1 m, '
    )
    grid = load_map(tmp_path / 'hall.yaml')
    full = map_of_world('warehouse')
    assert (grid.resolution, grid.origin, grid.cells.shape) == (0.1, full.origin, (92, 132))
    # Whatever is occupied in the fine map is so in the coarse one.
    coarse = np.kron(grid.cells, np.ones((2, 2), np.int8))
    assert (coarse[full.cells == 100] == 100).all()


def test_all_options_reach_the_map(tmp_path):
    heights = ['--height', '0.05', '--top', '0.4']
    extent = ['--start', '-5', '0', '--extent', '-6', '-1', '-4', '1', '--padding', '0']
    words = [*heights, *extent]
    result = run('map_of_world', 'warehouse', '-o', str(tmp_path / 'part'), *words)
    assert result.returncode == 0, result.stderr
    grid = load_map(tmp_path / 'part.yaml')
    assert (grid.cells.shape, grid.origin) == ((40, 40), (-6.0, -1.0, 0.0))


@pytest.mark.parametrize(
    ('words', 'code', 'line'),
    [
        (['moon'], 1, "map_of_world: world 'moon': neither a file nor a shipped world; shipped"),
        (['warehouse', '--start', '0', '2'], 1, "there is 'pillar' 0.25 m above the ground"),
        (['warehouse', '-o', '/none/m'], 1, '/none/m.pgm: it cannot be written: No such file'),
        (['warehouse', '--resolution', 'fine'], 2, "--resolution: 'fine' is no number"),
        (['warehouse', '--resolution', '0'], 1, 'the resolution is 0 m; it must be above 0'),
        ([], 2, 'WORLD'),
    ],
)
def test_what_cannot_be_is_one_line(words, code, line):
    result = run('map_of_world', *words)
    assert result.returncode == code
    assert line in result.stderr
    assert 'Traceback' not in result.stderr
    assert result.stdout == ''


def test_the_map_is_latched_and_a_service_gives_it():
    parameters = ['--ros-args', '-p', 'topic_name:=hall', '-p', 'frame_id:=world']
    with running('map_of_world', 'walls', '--publish', *parameters, until='Published a map'):
        rclpy.init(args=[])
        try:
            node = Node('listener')
            heard = []
            node.create_subscription(OccupancyGrid, '/hall', heard.append, LATCHED)
            wait_until(node, lambda: heard or None, timeout=PATIENCE, of_message=True)
            answer = call(node, GetMap, '/map_of_world/map', GetMap.Request(), timeout=PATIENCE)
            (end,) = node.get_publishers_info_by_topic('/hall')
            node.destroy_node()
        finally:
            rclpy.try_shutdown()
    message = heard[0]
    assert answer.map == message
    assert message.header.frame_id == 'world'
    assert message.header.stamp == message.info.map_load_time
    assert message.header.stamp.sec > 0
    assert (grid_of(message).cells == map_of_world('walls').cells).all()
    assert end.qos_profile.reliability.name == 'RELIABLE'
    assert end.qos_profile.durability.name == 'TRANSIENT_LOCAL'
