# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Robots that come and go, and others that drive on meanwhile; physics alone."""

import math

from fixtures.sim.driving import AMR, LEFT, RIGHT

from amr_description.model.frames import Transform
from amr_description.sim.world import MujocoWorld

NAMES = ('one', 'two', 'three')
PLACES = {name: Transform((5.0 * number, 0.0, 0.0)) for number, name in enumerate(NAMES)}


def drive(world, name):
    place = 1.0 + NAMES.index(name)
    wheels = world.robot(name).joints([*LEFT, *RIGHT])
    wheels.command('velocity', [2.0, 2.0, 2.0 + place, 2.0 + place])


def run(*, gone=None):
    """Where the others are at every 0.1 s of 6 s; ``gone`` is away from 2 to 4 s."""
    world = MujocoWorld('empty')
    for name, place in PLACES.items():
        world.spawn(name, AMR, place)
        drive(world, name)
    track = []
    for number in range(60):
        if gone and number == 20:
            world.remove(gone)
        if gone and number == 40:
            world.spawn(gone, AMR, PLACES[gone])
            drive(world, gone)
        world.step(50)
        poses = (world.robot(name).pose('base_footprint') for name in NAMES if name != 'two')
        track.append([pose.translation for pose in poses])
    return track


def test_others_drive_on_undisturbed():
    plain, disturbed = run(), run(gone='two')
    assert plain[:20] == disturbed[:20]
    # Not to the last bit: the solver weighs its start for the whole world at once, and vectors
    # of another length are rounded otherwise. Measured: 2e-8 m after 10 s, of ten robots.
    for before, after in zip(plain, disturbed, strict=True):
        for one, other in zip(before, after, strict=True):
            assert math.dist(one, other) < 1e-6


def test_a_world_is_left_as_it_was_before_a_robot_came():
    world = MujocoWorld('empty')
    world.spawn('stays', AMR)
    before = world.engine.spec.to_xml()
    for _ in range(3):
        world.spawn('guest', AMR, PLACES['two'])
        world.remove('guest')
    assert world.engine.spec.to_xml() == before
