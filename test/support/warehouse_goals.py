# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Random goals in ``warehouse``, and the robot that feels what it touches on the way there."""

import functools
import math
import random

import numpy as np
from support.paths import ROOT

from amr_description.maps.grid import FREE
from amr_description.maps.pose import Pose
from amr_description.navigation.distance_field import distances
from amr_description.navigation.footprint import read_footprint
from amr_description.sim.occupancy import map_of_world, MapSettings

FOOTPRINT = read_footprint('[[0.3, 0.17], [0.3, -0.17], [-0.3, -0.17], [-0.3, 0.17]]')
ROOM = 0.5
"""m around a goal that are free: the robot can stand there however it is turned, 0.35 m."""
CONTACT_TOPIC = '/touched'
_LINKS = (
    'base_link',
    'wheel_front_left',
    'wheel_front_right',
    'wheel_back_left',
    'wheel_back_right',
    'lidar_mast',
    'lidar_link',
)


@functools.cache
def warehouse():
    """Return the map of all that amr would run into, pallets and ramps too."""
    return map_of_world('warehouse', MapSettings(height=0.02, top=0.4))


def random_goals(count, seed):
    """Return that many poses at which the robot can stand."""
    grid, chance = warehouse(), random.Random(seed)
    free = np.argwhere(distances(grid.cells != FREE, grid.resolution) > ROOM).tolist()
    return [
        Pose(*grid.center_of(*chance.choice(free)), chance.uniform(-math.pi, math.pi))
        for _ in range(count)
    ]


def feeling_robot(folder):
    """Return a file with amr and its lidar, and a contact sensor of all its links."""
    collisions = ''.join(f'<collision>{link}_collision</collision>' for link in _LINKS)
    sensor = (
        '<gazebo reference="base_link"><sensor name="skin" type="contact">'
        f'<contact>{collisions}</contact><topic>{CONTACT_TOPIC}</topic></sensor></gazebo>'
    )
    text = (ROOT / 'urdf' / 'amr_sensors.urdf.xacro').read_text()
    text = text.replace('filename="amr.urdf"', f'filename="{ROOT}/urdf/amr.urdf"')
    file = folder / 'amr.urdf.xacro'
    file.write_text(text.replace('</robot>', f'{sensor}</robot>'))
    return file
