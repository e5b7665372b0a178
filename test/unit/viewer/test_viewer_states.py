# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The binary frames of a state: as the page reads them."""

import struct

import numpy as np

from amr_description.viewer.protocol import FrameInfo, Layout, RobotLayout
from amr_description.viewer.states import StateFrame

LAYOUT = Layout(
    7,
    (FrameInfo('base', 'odom'), FrameInfo('wheel', 'base')),
    (RobotLayout('/', ('a', 'b'), ('w',)), RobotLayout('/r', (), ())),
)


def floats(data):
    return np.frombuffer(data, '<f4', offset=16)


def test_the_head_says_kind_layout_number_and_time():
    data = StateFrame(LAYOUT).encode(2**32 + 5, 12.5)
    assert struct.unpack_from('<BBHId', data) == (1, 0, 7, 5, 12.5)


def test_what_is_not_known_is_not_a_number():
    data = StateFrame(LAYOUT).encode(0, 0.0)
    assert len(data) == 16 + 4 * (2 * 7 + (3 * 2 + 10 + 10 + 3 + 4) + (10 + 10 + 3))
    assert np.isnan(floats(data)).all()


def test_every_part_has_its_place():
    frame = StateFrame(LAYOUT)
    frame.poses[:] = np.arange(14).reshape(2, 7)
    first, second = frame.robots
    first.positions[:] = (14, 15)
    first.velocities[:] = (16, 17)
    first.commanded[:] = (18, 19)
    first.odometry[:] = range(20, 30)
    first.truth[:] = range(30, 40)
    first.command[:] = (40, 41, 42)
    first.wheels[0] = (43, 44, 45, 46)
    second.odometry[:] = range(47, 57)
    second.truth[:] = range(57, 67)
    second.command[:] = (67, 68, 69)
    assert floats(frame.encode(1, 0.0)).tolist() == list(range(70))


def test_a_frame_that_was_encoded_does_not_change_any_more():
    frame = StateFrame(LAYOUT)
    frame.poses[:] = 1.0
    data = frame.encode(1, 0.0)
    frame.poses[:] = 2.0
    assert floats(data)[0] == 1.0


def test_nothing_at_all_is_a_head_alone():
    assert len(StateFrame(Layout(0, (), ())).encode(0, 0.0)) == 16
