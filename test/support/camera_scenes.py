# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Worlds of a few shapes, and cameras that look at them, without ROS."""

import mujoco
import numpy as np

from amr_description.model.frames import matrix_from_quaternion, Transform
from amr_description.model.sensors import Camera, SensorMount
from amr_description.sim.cameras.renderer import Shot
from amr_description.sim.state_copy import StateCopy

AT_ORIGIN = Transform()


def state_of(shapes, assets='', options='', robots=()):
    """Return the state of a world with geoms or bodies, in MJCF."""
    model = mujoco.MjModel.from_xml_string(
        f'<mujoco>{options}<asset>{assets}</asset><worldbody>{shapes}</worldbody></mujoco>'
    )
    data = mujoco.MjData(model)
    return StateCopy(model, 0, data.qpos, data.mocap_pos, data.mocap_quat, frozenset(robots))


def camera_of(width=80, height=60, fov=1.2, **others):
    """Return a camera with colours and depth."""
    return Camera(SensorMount('camera', 'link'), width, height, fov, **others)


def take(renderer, camera, state, pose=AT_ORIGIN, *, color=True, depth=True, body=''):
    """Return a picture."""
    return renderer.render(Shot(camera, pose, body, state, color, depth))


def seen_from(pose, points):
    """Return points (…, 3) of the world in the optical frame of a camera: REP 103."""
    turn = np.array(matrix_from_quaternion(pose.rotation))
    x, y, z = np.moveaxis((np.asarray(points) - pose.translation) @ turn, -1, 0)
    return np.stack((-y, -z, x), axis=-1)
