# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Physics of the world: parameters over what the file says, over what was measured."""

import math

from fixtures.sim.driving import AMR, Lines
import mujoco
import pytest

from amr_description.errors import ParameterError
from amr_description.model.frames import Transform
from amr_description.parameters import build, specs
from amr_description.sim.engine import LONGEST_STEP
from amr_description.sim.world import MujocoWorld
from amr_description.sim.world_file import load_world, WorldSettings


@pytest.fixture
def moon(tmp_path):
    """A world that sets everything itself."""
    path = tmp_path / 'moon.xml'
    path.write_text(
        """<mujoco>
          <option gravity="0 0 -1.62" timestep="0.001" impratio="7" cone="elliptic"
                  integrator="implicit" solver="CG" iterations="33"/>
          <worldbody>
            <geom type="plane" size="0 0 1" friction="0.3"/>
            <body pos="0 9 0"><geom type="box" size="1 1 1" friction="0.4"/></body>
          </worldbody>
        </mujoco>"""
    )
    return str(path)


def frictions(world):
    return [float(row[0]) for row in world.engine.model.geom_friction]


def test_the_table_is_one_of_parameters_and_its_defaults_leave_all_to_the_file(moon):
    assert repr(build(WorldSettings, {})) == repr(WorldSettings())
    assert all(row.read_only for row in specs(WorldSettings))
    option = load_world(moon, build(WorldSettings, {})).option
    assert list(option.gravity) == [0, 0, -1.62]
    assert (option.impratio, option.iterations) == (7, 33)
    assert option.integrator == mujoco.mjtIntegrator.mjINT_IMPLICIT
    assert option.solver == mujoco.mjtSolver.mjSOL_CG
    world = MujocoWorld(moon)
    assert (world.timestep, world.longest_step) == (1_000_000, 1_000_000)
    assert frictions(world) == [0.3, 0.4]


def test_parameters_go_over_the_file(moon):
    settings = build(
        WorldSettings,
        {
            'gravity': 3.7,
            'friction': 0.9,
            'physics_step': 0.0005,
            'integrator': 'Euler',
            'cone': 'pyramidal',
            'impratio': 2.0,
            'solver': 'Newton',
            'iterations': 50,
        },
    )
    world = MujocoWorld(moon, settings=settings)
    option = world.engine.model.opt
    assert list(option.gravity) == [0, 0, -3.7]
    assert option.integrator == mujoco.mjtIntegrator.mjINT_EULER
    assert option.cone == mujoco.mjtCone.mjCONE_PYRAMIDAL
    assert option.solver == mujoco.mjtSolver.mjSOL_NEWTON
    assert (option.impratio, option.iterations) == (2.0, 50)
    assert (world.timestep, world.longest_step) == (500_000, 500_000)
    assert frictions(world) == [0.9, 0.9]


def test_a_file_without_options_gets_the_measured_ones():
    world = MujocoWorld('empty')
    option = world.engine.model.opt
    assert option.integrator == mujoco.mjtIntegrator.mjINT_DISCRETE
    assert option.cone == mujoco.mjtCone.mjCONE_ELLIPTIC
    assert option.impratio == 1e4
    assert option.jacobian == mujoco.mjtJacobian.mjJAC_DENSE
    assert world.longest_step == world.timestep == LONGEST_STEP


@pytest.mark.parametrize(
    'name, value, complaint',
    [
        ('friction', -0.1, 'must be at least 0'),
        ('physics_step', 0.0, 'must be greater than 0'),
        ('integrator', 'euler', 'must be one of .*Euler, RK4, implicit'),
        ('solver', 'newton', 'must be one of .*PGS, CG, Newton'),
    ],
)
def test_settings_that_make_no_sense(name, value, complaint):
    with pytest.raises(ParameterError, match=f"parameter '{name}' {complaint}"):
        build(WorldSettings, {name: value})


def test_gravity_is_that_of_the_fall():
    world = MujocoWorld('empty', settings=WorldSettings(gravity=1.62))
    robot = world.spawn('amr', AMR, Transform((0.0, 0.0, 5.0)))
    world.step(500)
    assert robot.velocity('base_footprint')[0][2] == pytest.approx(-1.62, abs=1e-9)


def test_friction_is_that_under_the_wheels():
    # A robot that brakes with all wheels blocked slows down by µ g, all slip.
    world = MujocoWorld('empty', settings=WorldSettings(friction=0.2))
    robot = world.spawn('amr', AMR)
    wheels = robot.joints([j.name for j in robot.description.joints if j.has_position])
    wheels.command('velocity', [10.0] * 4)
    world.step(1500)
    wheels.command('velocity', [-10.0] * 4)
    world.step(50)
    before = robot.velocity('base_footprint')[0][0]
    world.step(50)
    after = robot.velocity('base_footprint')[0][0]
    # Measured: 1.000 of it.
    assert before - after == pytest.approx(0.2 * 9.81 * 0.1, rel=0.02)


def test_a_physics_step_longer_than_measured_is_logged():
    log = Lines()
    MujocoWorld('empty', settings=WorldSettings(physics_step=0.005), log=log)
    assert "WARN world 'empty': a physics step of 5 ms is asked" in log.text
    log = Lines()
    MujocoWorld('empty', settings=WorldSettings(physics_step=math.nan), log=log)
    assert log.lines == []
