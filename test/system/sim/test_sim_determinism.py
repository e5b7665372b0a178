# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Same world, same commands at the same steps: the same bits, in one process and in another."""

import os
import subprocess
import sys

from fixtures.sim import scenario
from fixtures.sim.driving import AMR, Drive
import pytest

from amr_description.model.frames import Transform
from amr_description.sim.world import MujocoWorld


@pytest.fixture(scope='module')
def expected():
    return scenario.state_hash()


def test_two_worlds_in_one_process(expected):
    assert scenario.state_hash() == expected


def test_however_the_steps_are_handed_over(expected):
    assert scenario.state_hash(steps=1) == expected


def test_two_worlds_that_take_turns():
    drives = [Drive(), Drive()]
    for tick in range(100):
        for drive in drives:
            drive.command(0.5, tick / 50)
            drive.tick()
        assert drives[0].world.state() == drives[1].world.state()


@pytest.mark.parametrize('seed', ['0', '4242'])
def test_another_process(expected, seed):
    # Another order of sets and dictionaries, other addresses, another working folder.
    ended = subprocess.run(
        [sys.executable, scenario.__file__],
        env=os.environ | {'PYTHONHASHSEED': seed, 'PYTHONPATH': os.pathsep.join(sys.path)},
        cwd='/',
        capture_output=True,
        text=True,
        timeout=60,
        check=True,
    )
    assert ended.stdout.strip() == expected


def test_after_a_reset():
    drive = Drive()

    def run():
        drive.world.reset()
        states = [drive.world.state()]
        drive.command(0.5, 1.0)
        for _ in range(100):
            drive.world.step(5)
            states.append(drive.world.state())
        return states

    assert run() == run()


def test_the_hash_sees_a_difference_of_the_last_bit():
    worlds = [MujocoWorld('empty'), MujocoWorld('empty')]
    for world, x in zip(worlds, (1.0, 1.0 + 2**-52), strict=True):
        world.spawn('amr', AMR, Transform((x, 0.0, 0.0)))
        world.step(1)
    assert worlds[0].state() != worlds[1].state()
