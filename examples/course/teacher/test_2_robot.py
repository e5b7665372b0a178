"""Exercise 2: a description with five faults."""

from pathlib import Path

from conftest import expect
import pytest

from amr_description import Simulation
from amr_description.cli import check_urdf
from amr_description.errors import AmrError

PARAMETERS = Path(__file__).parent / 'robot.yaml'


def said(text, work):
    """Return a text without the folder of the student."""
    return text.replace(f'{work}/', '')


@pytest.fixture
def found(work, capsys):
    """What check_urdf says of the description."""
    check_urdf.main([str(work / 'robot.urdf'), '--controllers', str(PARAMETERS), '--strict'])
    return [
        said(line, work)
        for line in capsys.readouterr().err.splitlines()
        if line.startswith(('error', 'warning'))
    ]


@pytest.fixture
def sim(work):
    """The robot, at rest."""
    try:
        with Simulation(work / 'robot.urdf', PARAMETERS) as sim:
            sim.run(0.5)
            yield sim
    except AmrError as error:
        pytest.fail(said(str(error), work), pytrace=False)


@pytest.mark.points(2)
def test_tree(found):
    """The description is a robot."""
    errors = [line for line in found if line.startswith('error') and 'link' in line]
    expect(not errors, f'check_urdf says: {errors[0]}' if errors else '')


@pytest.mark.points(4)
def test_findings(found):
    """check_urdf finds nothing."""
    expect(not found, f'check_urdf says: {found[0]}' if found else '')


@pytest.mark.points(2)
def test_forward(sim):
    """It drives as far as it is told."""
    begun = sim.truth.x
    sim.drive(0.3, 0.0, seconds=2.0)
    told = f'told to drive 0.60 m it drives {sim.truth.x - begun:.2f} m forward'
    expect(abs(sim.truth.x - begun - 0.6) < 0.04, f'{told}: look at axes and radii')


@pytest.mark.points(2)
def test_turn(sim):
    """It turns as it is told."""
    sim.drive(0.0, 0.5, seconds=2.0)
    told = f'told to turn by 1.00 rad it turns by {sim.truth.yaw:.2f} rad'
    expect(abs(sim.truth.yaw - 1.0) < 0.1, f'{told}: look at axes and radii')
