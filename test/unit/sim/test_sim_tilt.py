# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A robot that rears up is told, with its pitch and what would do; one on a slope is not."""

import math
import re

from fixtures.sim.driving import Drive, Lines, ROOT
import pytest

from amr_description.model.frames import quaternion_from_rpy, rpy_from_quaternion, Transform
from amr_description.sim.world import MujocoWorld

TWO_WHEELS = (ROOT / 'test' / 'fixtures' / 'sim' / 'two_wheels.urdf').read_text()
REARING = re.sub(r'xyz="0\.02 (-?0\.17)', r'xyz="-0.01 \1', TWO_WHEELS).replace(
    'xyz="-0.12 0', 'xyz="0.12 0'
)
"""With its ball before the wheels, and the centre of mass 1 cm before the axle."""
RADIUS = 0.05
TICK = 0.02


class Rover:
    def __init__(self, urdf=REARING, pose=None):
        self.log = Lines()
        self.world = MujocoWorld('empty', log=self.log)
        self.faults = []
        self.world.faults.on_fault = lambda: self.faults.append(self.world.time)
        self.robot = self.world.spawn('rover', urdf, pose or Transform())
        self.wheels = self.robot.joints(['left', 'right'])
        self.run(1.0)

    def run(self, seconds):
        for _ in range(round(seconds / TICK)):
            self.world.advance(round(TICK * 1e9))

    def drive(self, speed, seconds, acceleration=math.inf):
        """Set the speed of the wheels, m/s, from rest on at an acceleration, m/s²."""
        for tick in range(1, round(seconds / TICK) + 1):
            now = math.copysign(min(abs(speed), acceleration * tick * TICK), speed)
            self.wheels.command('velocity', [now / RADIUS] * 2)
            self.run(TICK)

    @property
    def lines(self):
        return self.log.text.splitlines()


def test_a_robot_that_rears_up_is_told_once_and_again_after_a_reset():
    rover = Rover()
    for times in (1, 2):
        rover.drive(0.5, seconds=3.0)
        assert len(rover.lines) == times
        found = re.fullmatch(
            r"WARN robot 'rover' is not on all its wheels: pitch (-\d+) deg \(nose up\), "
            r'roll 0 deg, against the ground at \d\.\d+ s; odometry is wrong while it is so. '
            'Likely: it speeds up harder than its centre of mass allows: limit '
            'linear.x.max_acceleration of the diff_drive_controller, or have that centre lower '
            'and further from the axle',
            rover.lines[-1],
        )
        assert -25 < int(found[1]) < -15
        rover.world.reset()
    assert rover.faults == []  # the physics is right: nothing is paused


def test_who_speeds_up_as_the_centre_of_mass_allows_does_not():
    rover = Rover()
    rover.drive(0.5, seconds=3.0, acceleration=0.5)
    assert rover.lines == []
    assert rover.robot.pose('base_footprint').translation[0] > 1.0


def test_the_other_way_round_it_brakes_or_goes_backwards():
    rover = Rover(re.sub(r'xyz="0\.02 (-?0\.17)', r'xyz="0.01 \1', TWO_WHEELS))
    rover.drive(-0.5, seconds=2.0)
    (line,) = rover.lines
    assert re.search(r'pitch \d+ deg \(nose down\)', line)
    assert 'limit linear.x.max_deceleration and linear.x.max_acceleration_reverse' in line


def test_a_robot_on_its_side():
    lying = Transform((0.0, 0.0, 0.3), quaternion_from_rpy(1.4, 0.0, 0.0))
    (line,) = Rover(pose=lying).lines
    assert abs(int(re.search(r'roll (-?\d+) deg', line)[1])) > 70
    assert 'it turns harder than its centre of mass allows: limit angular.z.max_velocity' in line


@pytest.mark.parametrize('pitch', [-0.4, 0.4])
@pytest.mark.parametrize(
    ('ground', 'height'),
    [
        ('<geom type="plane" size="50 50 1" euler="0 {degrees} 0"/>', 0.05),
        # A kerb below the front wheels, or the back ones.
        (
            '<geom type="plane" size="50 50 1"/><geom type="box" size="1 2 0.078" '
            'pos="{sign}1.1 0 0.078"/>',
            0.11,
        ),
    ],
)
def test_on_a_slope_or_over_a_kerb_it_stands_as_it_should(tmp_path, ground, height, pitch):
    world, log = tmp_path / 'ground.xml', Lines()
    ground = ground.format(degrees=math.degrees(pitch), sign='-' if pitch > 0.0 else '')
    world.write_text(f'<mujoco><worldbody>{ground}</worldbody></mujoco>')
    pose = Transform((0.0, 0.0, height), quaternion_from_rpy(0.0, pitch, 0.0))
    drive = Drive(world=MujocoWorld(str(world), log=log), pose=pose)
    drive.run(0.0, 0.0, 1.0)
    _, tilted, _ = rpy_from_quaternion(drive.robot.pose('base_footprint').rotation)
    assert tilted == pytest.approx(pitch, abs=0.05)
    assert log.lines == []
