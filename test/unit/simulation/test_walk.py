# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""docs/legged_robots.md: a robot of links and joints stands, moves its legs, and walks."""

import importlib
import math

import pytest
from support.doc_pages import Page, ROOT

from amr_description import Simulation
from amr_description.model.frames import rotate

PAGE = Page('legged_robots.md')
EXAMPLES = ROOT / 'examples'
URDF = EXAMPLES / 'quadruped.urdf.xacro'
LINE = 'ros2 launch amr_description simulation urdf:=examples/quadruped.urdf.xacro'


@pytest.fixture
def walk(monkeypatch):
    monkeypatch.syspath_prepend(EXAMPLES)
    return importlib.import_module('walk')


def test_without_controllers_it_stands_on_its_feet():
    assert LINE in PAGE.text
    with Simulation(URDF) as sim:
        sim.run(1.0)
        begin = sim.truth
        assert begin.z == pytest.approx(0.34, abs=0.015)  # m; its feet are soft
        sim.run(2.0)
        assert sim.truth.pose.translation == pytest.approx(begin.pose.translation, abs=1e-4)


def test_it_follows_trajectories_of_its_legs(tmp_path):
    """As the file of the page has them; the other joints are held."""
    file = tmp_path / 'legs.yaml'
    file.write_text(PAGE.blocks('yaml')[0])
    with Simulation(URDF, controllers=file) as sim:
        point = {'positions': [0.4, -0.8, 0.4, -0.8], 'time_from_start': {'sec': 1}}
        joints = PAGE.tables()[0]['front_legs']['ros__parameters']['joints']
        sim.send('/front_legs/joint_trajectory', {'joint_names': joints, 'points': [point]})
        sim.run(1.5)
        assert sim.joints['front_left_calf_joint'].position == pytest.approx(-0.8, abs=0.02)
        assert sim.joints['rear_left_calf_joint'].position == pytest.approx(0.0, abs=0.02)


def test_it_walks(walk):
    with Simulation(URDF, controllers=EXAMPLES / 'quadruped.yaml') as sim:
        sim.run(1.5)
        begin, lifted = sim.truth, dict.fromkeys(walk.LEGS, 0)
        for _ in range(100):  # of 30 ms
            sim.run(0.03)
            now = sim.truth
            assert 0.23 < now.z < 0.29
            up = rotate(now.pose.rotation, (0.0, 0.0, 1.0))
            assert up[2] > math.cos(0.15)
            for leg in walk.LEGS:
                # A leg that is bent more than the stance bends it has its foot in the air.
                stance = walk.bent(0.0, -walk.HEIGHT)[1]
                lifted[leg] += sim.joints[f'{leg}_calf_joint'].position < stance - 0.1
        assert now.x - begin.x > 0.6 and abs(now.y - begin.y) < 0.15
        assert min(lifted.values()) > 20


def test_a_policy_that_leans_keeps_its_joints_still(walk):
    orientation = dict.fromkeys((f'imu/orientation.{axis}' for axis in 'yz'), 0.0)
    angles = {f'{name}/position': 0.1 * index for index, name in enumerate(walk.JOINTS)}
    half = walk.LARGEST_TILT / 2.0
    for angle, keeps in ((half - 0.01, False), (half + 0.01, True)):
        observed = orientation | angles | {'imu/orientation.x': math.sin(angle)}
        wanted = walk.policy(observed, 3.0, 1.0)
        assert ({f'{name}/position': each for name, each in wanted.items()} == angles) is keeps


def test_the_program_says_how_far_it_came(walk, capsys):
    assert 'python examples/walk.py' in PAGE.text
    walk.main()
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == 5
    assert lines[:2] == PAGE.blocks('text')[0].splitlines()
