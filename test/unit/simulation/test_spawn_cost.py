# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""How long a robot keeps time waiting is said before, and what takes too long is refused."""

import pytest
from support.control_fakes import FakeLog

from amr_description.errors import SpawnError
from amr_description.log import Severity
from amr_description.model.urdf import parse
from amr_description.sim.spawning import check_name
from amr_description.simulation.spawn_cost import announce, cost_of, patience_with, SpawnCost


def chain(count):
    links = ''.join(f'<link name="l{i}"/>' for i in range(count))
    joints = ''.join(
        f'<joint name="j{i}" type="fixed"><parent link="l{i}"/><child link="l{i + 1}"/></joint>'
        for i in range(count - 1)
    )
    return parse(f'<robot name="chain">{links}{joints}</robot>')


def meshed(tmp_path, size):
    path = tmp_path / 'part.stl'
    with path.open('wb') as file:
        file.truncate(size)
    geometry = f'<geometry><mesh filename="file://{path}"/></geometry>'
    parts = ''.join(
        f'<link name="{each}"><collision>{geometry}</collision></link>' for each in 'a'
    )
    return parse(f'<robot name="meshed">{parts}</robot>')


def test_a_usual_robot_is_not_worth_a_line():
    log = FakeLog()
    announce('amr', cost_of(chain(50)), log)
    assert log.lines == []


@pytest.mark.parametrize(('links', 'seconds'), [(400, '2'), (1000, '10')])
def test_a_long_chain_is_announced(links, seconds):
    log = FakeLog()
    announce('chain', cost_of(chain(links)), log)
    (line,) = log.texts(Severity.WARN)
    assert line == (
        f"'chain' has {links} links and up to 0 triangles of collision meshes: time stands still "
        f'for about {seconds} s while it is spawned'
    )


def test_a_heavy_mesh_is_announced_by_the_size_of_its_file(tmp_path):
    log = FakeLog()
    announce('meshed', cost_of(meshed(tmp_path, 84 + 50 * 300_000)), log)
    (line,) = log.texts(Severity.WARN)
    assert 'up to 300001 triangles' in line
    assert 'about 4 s' in line


@pytest.mark.parametrize('cost', [SpawnCost(10_000, 0), SpawnCost(2, 5_000_000)])
def test_what_takes_minutes_is_refused(cost):
    with pytest.raises(SpawnError, match='time would stand still for about .* 60 s are the most'):
        announce('heavy', cost, FakeLog())


def test_a_mesh_that_is_not_there_costs_nothing():
    robot = parse(
        '<robot name="r"><link name="a"><collision><geometry><mesh filename="file:///none.stl"/>'
        '</geometry></collision></link></robot>'
    )
    assert cost_of(robot) == SpawnCost(1, 0)


@pytest.mark.parametrize('kind', ['collision', 'visual'])
def test_who_waits_for_a_spawn_waits_as_long_as_its_meshes_take_on_a_busy_machine(tmp_path, kind):
    robot = meshed(tmp_path, 84 + 50 * 100_000)
    text = robot.text.replace('collision', kind)
    assert patience_with(text, 30.0) == pytest.approx(30.0 + 30.0 * 1.45, abs=0.1)
    assert patience_with('<robot name="r"><link name="a"/></robot>', 30.0) < 30.01
    assert patience_with('no robot', 60.0) == 60.0


def test_of_what_is_refused_no_more_is_expected(tmp_path):
    text = meshed(tmp_path, 50 * 50_000_000).text
    assert patience_with(text, 60.0) == 60.0 + 30.0 * 60.0


@pytest.mark.parametrize('name', ['x' * 201, 'x' * 100_000])
def test_a_name_may_not_be_longer_than_one_can_read(name):
    with pytest.raises(SpawnError, match=f'it has {len(name)} characters, and 200') as refused:
        check_name(name, ())
    assert len(str(refused.value)) < 400
    check_name('x' * 200, ())
