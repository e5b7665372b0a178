"""Tests of a robot, which find what is wrong with it."""

import pytest


def test_it_drives_as_far_as_it_is_told(sim):
    sim.drive(0.5, 0.0, seconds=1.0)
    assert sim.truth.x == pytest.approx(0.5, abs=0.03)


def test_it_turns_as_it_is_told(sim):
    sim.drive(0.0, 0.5, seconds=1.0)
    assert sim.truth.yaw == pytest.approx(0.5, abs=0.05)


def test_odometry_knows(sim):
    sim.drive(0.3, 0.5, seconds=1.0)
    assert sim.odometry.x == pytest.approx(sim.truth.x, abs=0.03)
    assert sim.odometry.y == pytest.approx(sim.truth.y, abs=0.03)
    assert sim.odometry.yaw == pytest.approx(sim.truth.yaw, abs=0.05)
