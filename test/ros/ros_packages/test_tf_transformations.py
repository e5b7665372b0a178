# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``tf_transformations`` by its own name: laws of rotations, and known values."""

import math

from hypothesis import given, strategies as st
import numpy as np
import pytest
import tf_transformations as tft

AXES = [
    frame + first + second + third
    for frame in 'sr'
    for first in 'xyz'
    for second in 'xyz'
    for third in 'xyz'
    if first != second != third
]
ANGLES = st.tuples(*[st.floats(-3.2, 3.2)] * 3)
QUATERNIONS = st.lists(st.floats(-1.0, 1.0), min_size=4, max_size=4).filter(
    lambda q: math.hypot(*q) > 0.1
)


def about(axis, angle):
    """A rotation matrix by its definition."""
    a, b = [each for each in range(3) if each != axis]
    if axis == 1:
        a, b = b, a
    matrix = np.identity(4)
    matrix[a, a] = matrix[b, b] = math.cos(angle)
    matrix[b, a], matrix[a, b] = math.sin(angle), -math.sin(angle)
    return matrix


@pytest.mark.parametrize('axes', AXES)
@given(ANGLES)
def test_euler_angles_of_all_conventions(axes, angles):
    turns = [about('xyz'.index(axis), each) for axis, each in zip(axes[1:], angles, strict=True)]
    expected = np.linalg.multi_dot(turns if axes[0] == 'r' else turns[::-1])
    matrix = tft.euler_matrix(*angles, axes)
    assert np.allclose(matrix, expected)
    assert np.allclose(tft.euler_matrix(*tft.euler_from_matrix(matrix, axes), axes), matrix)
    quaternion = tft.quaternion_from_euler(*angles, axes)
    assert np.allclose(tft.quaternion_matrix(quaternion), matrix)
    again = tft.euler_from_quaternion(quaternion, axes)
    assert np.allclose(tft.euler_matrix(*again, axes), matrix)


def test_roll_pitch_and_yaw_are_as_everybody_has_them():
    assert tft.quaternion_from_euler(0.0, 0.0, math.pi / 2) == pytest.approx(
        [0.0, 0.0, math.sqrt(0.5), math.sqrt(0.5)]
    )
    assert tft.euler_from_quaternion([0.0, 0.0, math.sin(0.2), math.cos(0.2)]) == pytest.approx(
        (0.0, 0.0, 0.4)
    )
    assert tft.euler_from_quaternion(tft.quaternion_from_euler(0.1, -0.2, 0.3)) == pytest.approx(
        (0.1, -0.2, 0.3)
    )


@pytest.mark.parametrize('axes', ['xyz', 'sxx', 'sxxy', 'axyz', 'sxyw'])
def test_what_is_no_convention_is_refused(axes):
    with pytest.raises(ValueError, match='four letters'):
        tft.euler_matrix(0.0, 0.0, 0.0, axes)


@given(QUATERNIONS, QUATERNIONS)
def test_quaternions_and_matrices_agree(one, other):
    product = tft.quaternion_multiply(one, other)
    matrices = tft.quaternion_matrix(one) @ tft.quaternion_matrix(other)
    assert np.allclose(tft.quaternion_matrix(product), matrices)
    back = tft.quaternion_from_matrix(matrices)
    assert np.allclose(tft.quaternion_matrix(back), matrices)
    assert back[3] >= 0.0
    none = tft.quaternion_multiply(one, tft.quaternion_inverse(one))
    assert np.allclose(none, [0.0, 0.0, 0.0, 1.0])


@given(QUATERNIONS, QUATERNIONS, st.floats(0.0, 1.0))
def test_between_two_rotations_lies_a_share_of_the_angle(one, other, share):
    begin, end = tft.unit_vector(one), tft.unit_vector(other)
    found = tft.quaternion_slerp(begin, end, share)
    assert tft.vector_norm(found) == pytest.approx(1.0, abs=1e-6)
    whole = math.acos(min(1.0, abs(float(begin @ end))))
    assert math.acos(min(1.0, abs(float(begin @ found)))) == pytest.approx(share * whole, abs=1e-3)


def test_matrices():
    shift = tft.translation_matrix([1.0, 2.0, 3.0])
    turn = tft.rotation_matrix(math.pi / 2, [0.0, 0.0, 2.0])
    both = tft.concatenate_matrices(shift, turn)
    assert both @ [1.0, 0.0, 0.0, 1.0] == pytest.approx([1.0, 3.0, 3.0, 1.0])
    assert tft.translation_from_matrix(both).tolist() == [1.0, 2.0, 3.0]
    assert tft.is_same_transform(
        tft.concatenate_matrices(both, tft.inverse_matrix(both)), tft.identity_matrix()
    )
    assert tft.quaternion_about_axis(math.pi, [1.0, 0.0, 0.0]) == pytest.approx([1.0, 0, 0, 0])
    assert tft.quaternion_conjugate([1.0, 2.0, 3.0, 4.0]).tolist() == [-1.0, -2.0, -3.0, 4.0]
    assert tft.vector_norm(tft.random_quaternion()) == pytest.approx(1.0)
