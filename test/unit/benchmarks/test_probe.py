# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The probe in a simulator: cycles, the physics alone, and where the time goes."""

import json

from fixtures.sim.driving import AMR
import pytest

from amr_description.ament_index import package_share
from amr_description.control.loop import Loop
from amr_description.errors import BringupError
from amr_description.sim.world import MujocoWorld
from benchmarks.adapted_controllers import adapted
from benchmarks.call_tree import CallTree
from benchmarks.probe import CYCLES, Probe
from benchmarks.profiles import Profile, profile_text, Speed


class Nothing:
    """The other collaborators of a loop."""

    def take(self):
        return ()

    def pace(self, time):
        return True

    def set_clocks(self, time):
        pass

    publish = set_clocks


def test_a_profile_of_a_loop():
    world = MujocoWorld('empty')
    world.spawn('amr', AMR)
    nothing = Nothing()
    probe = Probe(Loop(world, nothing, nothing, nothing, 10_000_000), world.engine)
    before = world.time
    probe.run(0.05)
    profile = probe.result()
    assert world.time - before >= 2 * CYCLES * 10_000_000
    assert profile.period == 0.01
    assert profile.bare > 0.0
    assert profile.tree.total == pytest.approx(profile.cycle)
    calls = {each.name: each.calls for each in profile.tree.walk()}
    assert calls['Loop.run_once'] == calls['Nothing.pace'] == calls['mj_step'] == 1.0
    assert Profile.from_json(json.loads(json.dumps(profile.as_json()))) == profile
    text = profile_text('nobody', profile)
    assert 'Loop.run_once' in text and 'besides the physics' in text


def test_besides_the_physics():
    assert Profile(100.0, 40.0, 1, 0.01, 1.0, CallTree('a cycle')).besides == 60.0


def test_a_speed_is_compared_with_the_physics_before_and_after_it():
    speed = Speed(full=(30.0, 10.0, 60.0), bare=(90.0, 110.0, 90.0, 110.0))
    assert speed.ratio == pytest.approx(0.3)


def test_the_shipped_controllers_as_a_measurement_needs_them():
    file = package_share('amr_description') / 'config' / 'controllers.yaml'
    shipped = file.read_text(encoding='utf-8')
    text = adapted(shipped, 1000)
    assert 'update_rate: 1000\n' in text and 'cmd_vel_timeout: 0.0\n' in text
    assert len(text.splitlines()) == len(shipped.splitlines()) + 1
    with pytest.raises(BringupError, match='has no line "update_rate: 100"'):
        adapted(text, 500)
