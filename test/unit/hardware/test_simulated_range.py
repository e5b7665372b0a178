# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Range finders in the ``<ros2_control>`` block of a simulated robot: limits, noise, geometry."""

import math
from statistics import fmean, pstdev

from fixtures.sim.driving import Lines
from fixtures.sim.fake_world import FakeWorld, info_of, PERIOD, URDF
import pytest

from amr_description.hardware.mujoco_system import MujocoSystem
from amr_description.hardware.simulated_range import cone
from amr_description.model.frames import Transform
from amr_description.sim.world import MujocoWorld

CONE = math.radians(30.0)
WALL = 2.0
"""m, from the origin to the wall."""
WORLD = f"""<mujoco><worldbody><geom type="plane" size="9 9 1"/>
    <geom type="box" size="0.1 5 1" pos="{WALL + 0.1} 0 1"/></worldbody></mujoco>"""
ROBOT = """<robot name="r"><link name="base">
    <visual><geometry><box size="0.4 0.2 0.2"/></geometry></visual>
    <inertial><mass value="1"/>
    <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
    </link><link name="eye"><visual><geometry><sphere radius="0.05"/></geometry></visual></link>
    <joint name="j" type="fixed"><parent link="base"/><child link="eye"/></joint></robot>"""


def with_range(parameters='', gazebo=''):
    inside = ''.join(f'<param name="{k}">{v}</param>' for k, v in parameters.items())
    part = f'<sensor name="eye"><state_interface name="range"/>{inside}</sensor></ros2_control>'
    return URDF.replace('</ros2_control>', part).replace('</robot>', f'{gazebo}</robot>')


def gazebo(inside):
    return (
        '<gazebo reference="c"><sensor name="eye" type="ray"><pose>0 0 1 0 0 0</pose><ray><scan>'
        '<horizontal><samples>5</samples><min_angle>-0.1</min_angle><max_angle>0.3</max_angle>'
        f'</horizontal></scan><range><min>0.5</min><max>3</max></range>{inside}</ray></sensor></gazebo>'
    )


class Finder:
    def __init__(self, parameters, gazebo=''):
        urdf = with_range(parameters, gazebo)
        self.world, self.lines = FakeWorld(urdf), Lines()
        self.system = MujocoSystem(info_of(urdf), self.lines, self.world)
        (self.state,) = [each for each in self.system.state_interfaces() if each.prefix == 'eye']

    def read(self, distance):
        self.world.distance = distance
        self.system.read(0, PERIOD)
        return self.state.value


LIMITS = {'link': 'b', 'min_range': '0.2', 'max_range': '4'}


@pytest.mark.parametrize(
    ('distance', 'measured'),
    [
        (1.0, 1.0),
        (0.2, 0.2),
        (4.0, 4.0),
        (0.19, -math.inf),
        (4.01, math.inf),
        (math.inf, math.inf),
    ],
)
def test_what_is_out_of_range_is_infinite_as_rep_117_wants_it(distance, measured):
    finder = Finder(LIMITS)
    assert finder.read(distance) == measured
    assert finder.world.looks[-1] == ('b', Transform(), ((1.0, 0.0, 0.0),), 4.0)
    assert finder.lines.lines == []


def test_a_finder_has_the_mount_limits_and_noise_of_its_gazebo_sensor():
    noise = '<noise><type>gaussian</type><mean>0.1</mean><stddev>0.02</stddev></noise>'
    finder = Finder({}, gazebo(noise))
    values = [finder.read(1.0) for _ in range(400)]
    assert fmean(values) == pytest.approx(1.1, abs=0.005)
    assert pstdev(values) == pytest.approx(0.02, rel=0.2)
    assert [finder.read(each) for each in (0.4, 3.1)] == [-math.inf, math.inf]
    assert min(finder.read(0.5) for _ in range(50)) >= 0.5
    link, pose, directions, farthest = finder.world.looks[-1]
    assert (link, pose.translation, farthest) == ('c', (0.0, 0.0, 1.0), 3.0)
    assert directions == cone(0.4)
    finder.system.reset(0)
    assert [finder.read(1.0) for _ in range(400)] == values


def test_parameters_count_before_the_gazebo_sensor():
    finder = Finder({'max_range': '9'}, gazebo(''))
    assert (finder.read(5.0), finder.read(0.4)) == (5.0, -math.inf)


@pytest.mark.parametrize(
    ('parameters', 'told'),
    [
        ({'max_range': 'far'}, "max_range is 'far'; a number is needed"),
        ({'min_range': '5'}, 'min_range is 5 m and max_range 4 m; the first must be less'),
        ({'field_of_view': '9'}, 'field_of_view is 9 rad and min_range 0.2 m; 0 to 3.14159 rad'),
    ],
)
def test_limits_that_cannot_be_are_told_and_nothing_is_measured(parameters, told):
    finder = Finder(LIMITS | parameters)
    assert math.isnan(finder.read(1.0))
    ((_, line),) = finder.lines.lines
    assert f"sensor 'eye': {told}" in line


def test_a_slow_finder_keeps_its_value_until_it_measures_again():
    noise = '<noise><type>gaussian</type><stddev>0.02</stddev></noise>'
    finder = Finder({'update_rate': '15'}, gazebo(noise))

    def run():
        values = []
        for cycle in range(30):
            finder.world.time = cycle * PERIOD
            values.append(finder.read(1.0))
        return values

    values = run()
    assert len(finder.world.looks) == 5
    new = [cycle for cycle in range(30) if not cycle or values[cycle] != values[cycle - 1]]
    assert new == [0, 7, 14, 20, 27]
    finder.system.reset(0)
    assert run() == values


@pytest.mark.parametrize('view', [0.0, CONE])
def test_rays_are_unit_vectors_that_fill_the_cone(view):
    rays = cone(view)
    assert rays[0] == (1.0, 0.0, 0.0)
    off = [math.acos(min(1.0, x)) for x, _, _ in rays]
    assert max(off) == pytest.approx(view / 2.0)
    assert all(math.hypot(*ray) == pytest.approx(1.0) for ray in rays)


@pytest.fixture
def robot(tmp_path):
    path = tmp_path / 'world.xml'
    path.write_text(WORLD)

    def spawn(x, yaw=0.0, z=0.9):
        world = MujocoWorld(str(path))
        return world.spawn('r', ROBOT, Transform.from_xyz_rpy((x, 0.0, z), (0.0, 0.0, yaw)))

    return spawn


@pytest.mark.parametrize('yaw', [0.0, 0.5, -1.0])
@pytest.mark.parametrize('distance', [0.3, 1.5])
def test_a_wall_at_d_is_d_away_and_the_robot_itself_is_not_seen(robot, distance, yaw):
    robot = robot(WALL - distance, yaw)
    ahead = robot.distances('eye', Transform(), cone(0.0), 10.0)
    assert ahead == [pytest.approx(distance / math.cos(yaw))]
    # Of the cone, the ray that is turned least towards the wall is the shortest.
    nearest = min(robot.distances('eye', Transform(), cone(CONE), 10.0))
    off = max(0.0, abs(yaw) - CONE / 2.0)
    assert nearest == pytest.approx(distance / math.cos(off), rel=1e-6 if off or not yaw else 0.04)
    back = Transform.from_xyz_rpy((0.0, 0.0, 0.0), (0.0, 0.0, math.pi))
    assert robot.distances('eye', back, cone(0.0), 1.0) == [math.inf]


def test_a_cone_meets_the_ground(robot):
    robot = robot(-5.0, z=0.2)
    nearest = min(robot.distances('eye', Transform(), cone(CONE), 10.0))
    assert nearest == pytest.approx(0.2 / math.sin(CONE / 2.0))
