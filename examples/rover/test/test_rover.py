import pytest


@pytest.fixture
def sim(simulation):
    return simulation('package://rover/urdf/rover.urdf.xacro', 'package://rover/config/rover.yaml')


def test_it_drives_as_far_as_commanded(sim):
    sim.drive(0.5, 0.0, seconds=2)
    assert sim.truth.x == pytest.approx(1.0, rel=0.01)
    assert sim.truth.y == pytest.approx(0.0, abs=0.001)


def test_it_turns_as_commanded(sim):
    sim.drive(0.0, 0.5, seconds=2)
    assert sim.truth.yaw == pytest.approx(1.0, rel=0.01)


def test_odometry_is_the_truth(sim):
    sim.drive(0.3, 0.6, seconds=2)
    assert sim.odometry.x == pytest.approx(sim.truth.x, abs=0.01)
    assert sim.odometry.yaw == pytest.approx(sim.truth.yaw, abs=0.01)
