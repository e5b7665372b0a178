# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""SE(3): laws first, then vectors, then agreement with numpy, MuJoCo and yourdfpy."""

import math
import random

import mujoco
import numpy as np
import pytest
from support.paths import ROOT

from amr_description.model import frames, kinematics, urdf
from amr_description.model.frames import Transform

ROBOTS = (ROOT / 'urdf/amr.urdf', ROOT / 'test/fixtures/urdf/arm.urdf')
HALF_PI = math.pi / 2


def random_quaternion(chance):
    parts = [chance.gauss() for _ in range(4)]
    length = math.hypot(*parts)
    return tuple(part / length for part in parts)


def random_vector(chance):
    return tuple(chance.uniform(-5.0, 5.0) for _ in range(3))


def random_transform(chance):
    return Transform(random_vector(chance), random_quaternion(chance))


def matrix(transform):
    return np.array(transform.to_matrix())


def assert_same(a, b):
    """q and -q are one rotation, so transforms are compared as matrices."""
    np.testing.assert_allclose(matrix(a), matrix(b), atol=1e-12)


@pytest.fixture(params=range(20))
def chance(request):
    return random.Random(request.param)


def test_composition_is_associative(chance):
    a, b, c = (random_transform(chance) for _ in range(3))
    assert_same((a @ b) @ c, a @ (b @ c))


def test_identity_is_neutral(chance):
    a = random_transform(chance)
    assert_same(a @ Transform(), a)
    assert_same(Transform() @ a, a)


def test_inverse_undoes_on_both_sides(chance):
    a, b = random_transform(chance), random_transform(chance)
    assert_same(a @ a.inverse(), Transform())
    assert_same(a.inverse() @ a, Transform())
    assert_same((a @ b).inverse(), b.inverse() @ a.inverse())


def test_composition_applies_the_right_one_first(chance):
    a, b = random_transform(chance), random_transform(chance)
    point = random_vector(chance)
    assert (a @ b).apply(point) == pytest.approx(a.apply(b.apply(point)))


def test_rigid_motion_keeps_lengths_and_handedness(chance):
    a = random_transform(chance)
    p, q = random_vector(chance), random_vector(chance)
    assert math.dist(a.apply(p), a.apply(q)) == pytest.approx(math.dist(p, q))
    assert np.linalg.det(matrix(a)[:3, :3]) == pytest.approx(1.0)


def test_transforms_multiply_as_their_matrices(chance):
    a, b = random_transform(chance), random_transform(chance)
    np.testing.assert_allclose(matrix(a @ b), matrix(a) @ matrix(b), atol=1e-12)


def test_matrix_round_trip(chance):
    a = random_transform(chance)
    assert_same(Transform.from_matrix(matrix(a)), a)
    assert Transform.from_matrix(a.to_matrix()).rotation[3] >= 0.0


@pytest.mark.parametrize('axis', [(1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 0), (1, -1, 1)])
@pytest.mark.parametrize('angle', [math.pi, -math.pi, math.pi - 1e-9, 1e-9])
def test_matrix_round_trip_at_half_turns(axis, angle):
    """Where w is about 0 the formula by the trace loses all digits."""
    turn = Transform.from_axis_angle(axis, angle)
    assert_same(Transform.from_matrix(turn.to_matrix()), turn)


def test_interpolation_begins_and_ends_where_it_should(chance):
    a, b = random_transform(chance), random_transform(chance)
    assert_same(a.interpolate(b, 0.0), a)
    assert_same(a.interpolate(b, 1.0), b)
    assert_same(a.interpolate(a, 0.3), a)


def test_interpolation_is_the_same_from_the_other_end(chance):
    a, b, ratio = random_transform(chance), random_transform(chance), chance.random()
    assert_same(a.interpolate(b, ratio), b.interpolate(a, 1.0 - ratio))


@pytest.mark.parametrize('angle', [0.0, 1e-17, 1e-12, 1e-7, 0.5, 3.0, math.pi - 1e-9, 4.0])
def test_slerp_turns_evenly_on_the_shorter_arc(angle, chance):
    axis, ratio, start = random_vector(chance), chance.random(), random_quaternion(chance)
    end = frames.multiply(start, frames.quaternion_from_axis_angle(axis, angle))
    shorter = math.remainder(angle, math.tau)
    part = frames.quaternion_from_axis_angle(axis, ratio * shorter)
    turned = frames.slerp(start, end, ratio)
    assert math.hypot(*turned) == pytest.approx(1.0, abs=1e-15)
    assert_same(Transform(rotation=turned), Transform(rotation=frames.multiply(start, part)))


def rotation_about(axis, angle):
    """Return the textbook matrix of a turn about one coordinate axis."""
    c, s = math.cos(angle), math.sin(angle)
    return {
        'x': np.array([[1, 0, 0], [0, c, -s], [0, s, c]]),
        'y': np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]]),
        'z': np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]),
    }[axis]


def test_rpy_turns_about_fixed_x_then_y_then_z(chance):
    roll, pitch, yaw = (chance.uniform(-math.pi, math.pi) for _ in range(3))
    expected = rotation_about('z', yaw) @ rotation_about('y', pitch) @ rotation_about('x', roll)
    turn = frames.matrix_from_quaternion(frames.quaternion_from_rpy(roll, pitch, yaw))
    np.testing.assert_allclose(turn, expected, atol=1e-12)


def test_rpy_round_trip(chance):
    rpy = (
        chance.uniform(-math.pi, math.pi),
        chance.uniform(-HALF_PI, HALF_PI),
        chance.uniform(-math.pi, math.pi),
    )
    rotation = frames.quaternion_from_rpy(*rpy)
    assert frames.rpy_from_quaternion(rotation) == pytest.approx(rpy)
    assert frames.yaw_of(rotation) == pytest.approx(rpy[2])


@pytest.mark.parametrize('pitch', [HALF_PI, -HALF_PI])
def test_rpy_in_gimbal_lock_is_one_of_the_right_answers(pitch, chance):
    rotation = frames.quaternion_from_rpy(chance.uniform(-3, 3), pitch, chance.uniform(-3, 3))
    rpy = frames.rpy_from_quaternion(rotation)
    assert rpy[0] == 0.0
    again = frames.quaternion_from_rpy(*rpy)
    assert abs(sum(a * b for a, b in zip(rotation, again, strict=True))) == pytest.approx(1.0)


@pytest.mark.parametrize(
    ('rpy', 'vector', 'expected'),
    [
        ((HALF_PI, 0, 0), (0, 1, 0), (0, 0, 1)),
        ((0, HALF_PI, 0), (0, 0, 1), (1, 0, 0)),
        ((0, 0, HALF_PI), (1, 0, 0), (0, 1, 0)),
        # The wheel of the tutorial: laid down by a roll, its z points to the right.
        ((1.5707963267948966, 0, 0), (0, 0, 1), (0, -1, 0)),
        # Roll first, about the fixed x, then yaw about the fixed z.
        ((HALF_PI, 0, HALF_PI), (0, 0, 1), (1, 0, 0)),
    ],
)
def test_rpy_vectors(rpy, vector, expected):
    turned = frames.rotate(frames.quaternion_from_rpy(*rpy), vector)
    assert turned == pytest.approx(expected, abs=1e-12)


def test_yaw_does_not_care_about_length(chance):
    rotation = random_quaternion(chance)
    scaled = tuple(7.0 * part for part in rotation)
    assert frames.yaw_of(scaled) == pytest.approx(frames.yaw_of(rotation))
    assert frames.yaw_of(rotation) == pytest.approx(frames.rpy_from_quaternion(rotation)[2])


def test_yaw_quaternion(chance):
    yaw = chance.uniform(-math.pi, math.pi)
    assert frames.quaternion_from_yaw(yaw) == pytest.approx(frames.quaternion_from_rpy(0, 0, yaw))


def test_axis_angle_agrees_with_rpy_and_takes_any_length():
    turn = frames.quaternion_from_axis_angle((0.0, 3.0, 0.0), 0.7)
    assert turn == pytest.approx(frames.quaternion_from_rpy(0.0, 0.7, 0.0))
    assert frames.quaternion_from_axis_angle((0.0, 0.0, 0.0), 0.7) == frames.IDENTITY_QUATERNION


def test_mujoco_order(chance):
    rotation = random_quaternion(chance)
    wxyz = frames.wxyz_from_xyzw(rotation)
    assert frames.xyzw_from_wxyz(wxyz) == rotation
    theirs = np.zeros(9)
    mujoco.mju_quat2Mat(theirs, np.array(wxyz))
    ours = frames.matrix_from_quaternion(rotation)
    np.testing.assert_allclose(theirs.reshape(3, 3), ours, atol=1e-12)


def load_in_yourdfpy(path):
    import yourdfpy

    return yourdfpy.URDF.load(path, build_scene_graph=True, load_meshes=False)


@pytest.mark.parametrize('path', ROBOTS, ids=lambda path: path.stem)
def test_forward_kinematics_agree_with_yourdfpy(path):
    robot, theirs = urdf.load(path), load_in_yourdfpy(path)
    chance = random.Random(1)
    for _ in range(20):
        positions = {name: chance.uniform(-2.0, 2.0) for name in theirs.actuated_joint_names}
        theirs.update_cfg(positions)
        poses = kinematics.link_poses(robot, positions)
        assert set(poses) == {link.name for link in robot.links}
        for link, pose in poses.items():
            expected = theirs.get_transform(link, robot.root.name)
            np.testing.assert_allclose(matrix(pose), expected, atol=1e-9, err_msg=link)


def test_joint_transform_moves_along_or_about_the_axis():
    arm = urdf.load(ROBOTS[1])
    lift, roll = arm.joint('lift'), arm.joint('roll')
    along = frames.rotate(lift.origin.rotation, lift.axis)
    start, end = (kinematics.joint_transform(lift, q) for q in (0.0, 0.25))
    travelled = [b - a for a, b in zip(start.translation, end.translation, strict=True)]
    assert travelled == pytest.approx([0.25 * part for part in along])
    assert start == lift.origin
    assert_same(
        kinematics.joint_transform(roll, 0.3 + math.tau), kinematics.joint_transform(roll, 0.3)
    )


def test_fixed_joint_does_not_move():
    mount = urdf.load(ROBOTS[1]).joint('mount')
    assert kinematics.joint_transform(mount, 1.0) == mount.origin


def test_mimic_joint_follows_unless_it_has_a_position_itself():
    finger = urdf.load(ROBOTS[1]).joint('right_finger')
    assert kinematics.joint_position(finger, {'left_finger': 0.02}) == pytest.approx(-0.028)
    assert kinematics.joint_position(finger, {}) == pytest.approx(0.002)
    assert kinematics.joint_position(finger, {'left_finger': 0.02, 'right_finger': 0.01}) == 0.01
