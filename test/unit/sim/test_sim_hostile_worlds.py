# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Worlds of others: what MuJoCo reads is taken, and what would never end is refused."""

import pytest

from amr_description.errors import SimulationError
from amr_description.sim.friction import DEFAULT_FRICTION
from amr_description.sim.world_file import load_world

GEOM = '<worldbody><geom name="floor" type="plane" size="0 0 1"{more}/></worldbody>'


def world(path, body, more=''):
    path.write_text(f'<mujoco>{body}{GEOM.format(more=more)}</mujoco>')
    return str(path)


@pytest.mark.parametrize(
    ('body', 'more'),
    [
        ('<!-- a -- b -->', ''),
        ('<!------ a ruler ------>', ''),
        ('', ' contype="1"conaffinity="1"'),
        ('', " contype='1'conaffinity='1'"),
        ('<!-- a -- b -->', ' contype="1"conaffinity="1"'),
    ],
)
def test_what_only_mujoco_reads_has_the_default_friction_too(tmp_path, body, more):
    spec = load_world(world(tmp_path / 'a.xml', body, more))
    assert spec.geom('floor').friction[0] == DEFAULT_FRICTION


def test_so_has_what_such_a_file_includes(tmp_path):
    (tmp_path / 'part.xml').write_text(
        '<mujoco><!-- a -- b --><worldbody><geom name="wall" size="1"/></worldbody></mujoco>'
    )
    spec = load_world(world(tmp_path / 'a.xml', '<!-- a -- b --><include file="part.xml"/>'))
    assert spec.geom('wall').friction[0] == DEFAULT_FRICTION


@pytest.mark.parametrize('friction', ['nan', 'inf', '1 nan', '-inf 0 0'])
def test_a_friction_that_is_no_number_is_refused_in_one_line(tmp_path, friction):
    path = world(tmp_path / 'a.xml', '', f' friction="{friction}"')
    with pytest.raises(SimulationError) as refused:
        load_world(path)
    assert "a.xml: the friction of the geom 'floor' is " in str(refused.value)
    assert '\n' not in str(refused.value)


@pytest.mark.parametrize(
    'replicas',
    [
        '<replicate count="100000"><geom size=".1"/></replicate>',
        "<replicate offset='1 0 0' count=\"100000\"><geom size='.1'/></replicate>",
        '<replicate count="100"><replicate count="1000"><geom size=".1"/></replicate></replicate>',
    ],
)
def test_copies_without_end_are_refused_at_once(tmp_path, replicas):
    path = tmp_path / 'a.xml'
    path.write_text(f'<mujoco><worldbody>{replicas}</worldbody></mujoco>')
    with pytest.raises(SimulationError, match=r'<replicate> makes \d+ copies, and 5000 are the m'):
        load_world(str(path))


def test_some_copies_are_made(tmp_path):
    path = tmp_path / 'a.xml'
    path.write_text(
        '<mujoco><worldbody><replicate count="10" offset="1 0 0"><geom size=".1"/></replicate>'
        '<replicate count="10" offset="0 1 0"><geom size=".1"/></replicate></worldbody></mujoco>'
    )
    assert len(load_world(str(path)).geoms) == 20


def test_copies_in_a_comment_are_none(tmp_path):
    path = tmp_path / 'a.xml'
    path.write_text(
        '<mujoco><!-- <replicate count="100000"> --><worldbody><geom size=".1"/></worldbody>'
        '</mujoco>'
    )
    assert len(load_world(str(path)).geoms) == 1


def test_a_world_that_cannot_be_read_is_one_line(tmp_path, monkeypatch):
    path = tmp_path / 'a.xml'
    path.write_text('<mujoco/>')

    def refused(*_args, **_options):
        raise PermissionError(13, 'Permission denied')

    monkeypatch.setattr(type(path), 'read_text', refused)
    with pytest.raises(SimulationError, match=r"^world '.*a.xml': .*a.xml: Permission denied$"):
        load_world(str(path))
