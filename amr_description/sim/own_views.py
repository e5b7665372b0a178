# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What lidars see of the robot that carries them, as :program:`check_urdf` says it.

A ray that ends on the robot's own camera is an obstacle that goes wherever the robot goes: a
navigator stands still before it, and a map is drawn around it.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from amr_description.errors import AmrError
from amr_description.model.findings import Finding
from amr_description.model.frames import Transform
from amr_description.model.gazebo.tags import Noise
from amr_description.model.gazebo.translation import translate
from amr_description.model.origins import relocated
from amr_description.model.robot import Robot
from amr_description.model.sensors import Lidar
from amr_description.sim.lidar import SimulatedLidar
from amr_description.sim.robot_view import RobotView
from amr_description.sim.world import MujocoWorld
from amr_description.text import quote

_BEYOND = 10.0
"""m, more than a lidar sees, from the ground to the robot."""
_FARTHEST = 1e3
"""m; no part of a robot is so far."""


def own_views(robot: Robot) -> Sequence[Finding]:
    """
    Return a warning for each link of a robot that a lidar of it sees.

    Args:
        robot: That the checker has found sound. Its joints are where they are spawned.
    """
    try:
        described = translate(robot)
        lidars = [
            replace(each, noise=Noise(), range_max=min(each.range_max, _FARTHEST))
            for each in described.sensors
            if isinstance(each, Lidar) and each.sees_robot
        ]
        if not lidars:
            return ()
        world = MujocoWorld('empty')
        high = Transform((0.0, 0.0, max(each.range_max for each in lidars) + _BEYOND))
        view = world.spawn('robot', described.robot, high)
        found = [each for lidar in lidars for each in _seen(world, view, lidar)]
    except AmrError:  # who spawns it says so
        return ()
    return [relocated(each, robot.text) for each in found]


def _seen(world: MujocoWorld, view: RobotView, lidar: Lidar) -> Iterator[Finding]:
    simulated, scene = SimulatedLidar(lidar, view), world.ray_scene()
    hits = simulated.hits(simulated.body(), scene)
    is_seen = (hits.distances >= lidar.range_min) & (hits.distances <= lidar.range_max)
    model = world.engine.model
    links = np.array([model.body(body).name for body in model.geom_bodyid])[hits.geoms]
    description = view.description
    for name in dict.fromkeys(links[is_seen].tolist()):
        rays = is_seen & (links == name)
        yield Finding.warning(
            description.source,
            lidar.mount.line,
            f'lidar {quote(lidar.mount.name)} on {quote(lidar.mount.link)} sees '
            f'{quote(name.partition("/")[2])}, a part of its own robot',
            found=f'{int(rays.sum())} of {len(rays)} rays, nearest '
            f'{float(hits.distances[rays].min()):.2f} m',
            expected='none: what drives by the scan takes it as an obstacle',
            fix='put the lidar or that part elsewhere, narrow its angles, or have its least range '
            'beyond it',
        )
