"""Exercise 6: a planner."""

import math

from conftest import expect
import numpy as np
import pytest

from amr_description import Simulation
from amr_description.maps.grid import OccupancyGrid
from amr_description.maps.pose import Pose
from amr_description.navigation.costmap import Costmap, CostmapSettings
from amr_description.simulation.goal_drive import drive_to

SIDE = 60  # cells of 0.05 m: a room of 3 m
START, GOAL = Pose(0.5, 0.5, 0.0), Pose(2.5, 1.0, 0.0)
BEHIND = (0.0, 2.7)  # m; a box of the warehouse is in the way


@pytest.fixture
def way(submitted):
    """The way of the student's planner through a room."""
    plan = submitted('planner').plan

    def ask(*walls):
        cells = np.zeros((SIDE, SIDE), dtype=np.int8)
        for rows, columns in walls:
            cells[rows, columns] = 100
        costmap = Costmap(OccupancyGrid(cells, 0.05, Pose(0.0, 0.0, 0.0)), 0.1, CostmapSettings())
        return costmap, [tuple(point)[:2] for point in plan(costmap, START, GOAL) or []]

    return ask


def length(way):
    return sum(math.dist(a, b) for a, b in zip(way, way[1:], strict=False))


def between(a, b):
    """Points of a line, no farther apart than a cell."""
    steps = max(1, math.ceil(math.dist(a, b) / 0.05))
    return [tuple(np.add(a, np.subtract(b, a) * step / steps)) for step in range(steps + 1)]


def ends_right(way):
    expect(way, 'there is a way; yours finds none')
    for place, (point, wanted) in {'start': (way[0], START), 'end': (way[-1], GOAL)}.items():
        off = math.dist(point, wanted[:2])
        told = f'({point[0]:.2f}, {point[1]:.2f}); it is to {place} at'
        expect(off < 0.1, f'your way {place}s at {told} ({wanted.x:.2f}, {wanted.y:.2f})')


@pytest.mark.points(4)
def test_free(way):
    """Through an empty room."""
    _, found = way()
    ends_right(found)
    widest = max(math.dist(a, b) for a, b in zip(found, found[1:], strict=False))
    expect(widest < 0.101, f'two points of your way are {widest:.2f} m apart; 0.1 m are allowed')
    expect(length(found) < 2.6, f'your way has {length(found):.2f} m; 2.06 m would be straight')


@pytest.mark.points(5)
def test_around(way):
    """Around a wall, touching nothing."""
    costmap, found = way((slice(0, 45), slice(28, 32)))
    ends_right(found)
    points = [point for a, b in zip(found, found[1:], strict=False) for point in between(a, b)]
    costs = costmap.costs_at(np.array(points))
    hit = next((point for point, cost in zip(points, costs, strict=True) if cost >= 253), None)
    expect(hit is None, f'your way touches a wall at ({hit[0]:.2f}, {hit[1]:.2f})' if hit else '')
    expect(length(found) < 5.5, f'your way has {length(found):.1f} m; 4.6 m would do')


@pytest.mark.points(3)
def test_none(way):
    """Where there is no way, it says so."""
    _, found = way((slice(None), slice(28, 32)))
    expect(not found, 'a wall parts the room; your planner goes through it')


@pytest.mark.points(3)
def test_drive(submitted):
    """The robot reaches a goal behind a box by it."""
    plan = submitted('planner').plan
    with Simulation('package://amr_description/urdf/amr.urdf', world='warehouse') as sim:
        drive = drive_to(sim, BEHIND, plan=plan)
        where = f'at ({sim.truth.x:.1f}, {sim.truth.y:.1f}) m'
    expect(drive.status.name == 'SUCCEEDED', f'the drive ends {where} with: {drive.error}')
