"""
Tests of a robot, which find what is wrong with it.

``sim`` is a simulation of amr: ``sim.drive(linear, angular, seconds=…)`` m/s and rad/s;
``sim.truth`` and ``sim.odometry`` have ``x``, ``y``, m, and ``yaw``, rad. These tests will be run
with a sound robot, on which they must pass, and with robots that are not sound.
"""


def test_it_drives(sim):
    sim.drive(0.5, 0.0, seconds=1.0)
    assert sim.truth.x > 0.0
    # Your turn: how far, in which direction, and does odometry know?
