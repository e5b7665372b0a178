# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The polygon of a robot on the ground, and ``check_urdf --footprint``, which prints it."""

import json
import math

from hypothesis import given, strategies as st
import numpy as np
import pytest
from support.examples import examples
from support.mesh_files import box, dae, write
from support.paths import ROOT
import yaml

from amr_description.ament_index import resolve_uri
from amr_description.cli import check_urdf
from amr_description.errors import DescriptionError
from amr_description.model.footprint import Footprint, footprint, simplified, TOLERANCE
from amr_description.model.frames import quaternion_from_rpy, rotate
from amr_description.model.planar_hull import planar_hull
from amr_description.model.urdf import load, parse

LINKS = """<robot name="r"><link name="base_footprint"/>
<joint name="up" type="fixed"><parent link="base_footprint"/><child link="base_link"/>
<origin xyz="0 0 0.1"/></joint><link name="base_link">{base}</link>
<joint name="arm" type="revolute"><parent link="base_link"/><child link="hand"/>
<origin xyz="0.2 0 0.5"/><axis xyz="0 0 1"/><limit lower="-3" upper="3" effort="1" velocity="1"/>
</joint><link name="hand">{hand}</link></robot>"""


def part(shape, xyz='0 0 0', rpy='0 0 0'):
    return f'<collision><origin xyz="{xyz}" rpy="{rpy}"/><geometry>{shape}</geometry></collision>'


BOX = part('<box size="0.4 0.2 0.1"/>', '0.05 0 0')
FOREARM = part('<box size="0.3 0.04 0.04"/>', '0.15 0 0')


def robot_of(base=BOX, hand=''):
    return parse(LINKS.format(base=base, hand=hand), 'r.urdf')


def find_file(folder=ROOT):
    return lambda uri: resolve_uri(uri, folder)


def corners_of(robot, **options):
    return footprint(robot, find_file(), **options).corners


def outside(corners, points):
    """By how much the farthest of some points is outside of a polygon, m."""
    polygon = np.array(corners)
    along = np.roll(polygon, -1, axis=0) - polygon
    normals = np.column_stack((along[:, 1], -along[:, 0])) / np.hypot(*along.T)[:, None]
    return float(((np.asarray(points)[:, None] - polygon) * normals).sum(axis=-1).max())


def test_the_shipped_robot_is_as_long_as_its_wheels_reach_and_as_wide():
    found = footprint(load(ROOT / 'urdf/amr.urdf'), find_file())
    assert found.frame == 'base_link'
    assert found.corners == ((0.3, 0.17), (-0.3, 0.17), (-0.3, -0.17), (0.3, -0.17))
    assert found.text == '[[0.3, 0.17], [-0.3, 0.17], [-0.3, -0.17], [0.3, -0.17]]'
    assert found.inscribed_radius == pytest.approx(0.17)
    assert found.circumscribed_radius == pytest.approx(math.hypot(0.3, 0.17))


def test_a_box_is_its_own_footprint():
    expected = ((0.25, 0.1), (-0.15, 0.1), (-0.15, -0.1), (0.25, -0.1))
    assert corners_of(robot_of()) == expected


def test_joints_are_at_zero_or_where_they_are_said_to_be():
    robot = robot_of(hand=FOREARM)
    assert max(x for x, _ in corners_of(robot)) == pytest.approx(0.5)
    turned = corners_of(robot, positions={'arm': math.pi / 2})
    assert max(y for _, y in turned) == pytest.approx(0.3, abs=0.0011)


def test_heights_are_above_the_lowest_collision():
    robot = robot_of(hand=FOREARM)
    low = corners_of(robot, heights=(0.0, 0.4))
    assert max(x for x, _ in low) == 0.25
    high = corners_of(robot, heights=(0.4, 2.0))
    assert (min(x for x, _ in high), max(x for x, _ in high)) == (0.2, 0.5)
    # A pyramid of one triangle a side would be; a turned box is cut where it is.
    ramp = part('<box size="1 0.2 1"/>', '0 0 0', f'0 {math.pi / 4} 0')
    cut = corners_of(robot_of(ramp), heights=(0.0, 0.2))
    assert max(x for x, _ in cut) == pytest.approx(0.2, abs=0.0011)


def test_the_frame_is_that_of_costmaps_or_the_one_asked_for():
    hand = footprint(robot_of(hand=FOREARM), find_file(), frame='hand')
    assert hand.frame == 'hand'
    assert max(x for x, _ in hand.corners) == 0.3
    assert hand.holds_origin
    bare = parse('<robot name="r"><link name="chassis">' + BOX + '</link></robot>', 'r')
    assert footprint(bare, find_file()).frame == 'chassis'


def test_an_origin_outside_of_the_robot_is_known():
    robot = robot_of(part('<box size="0.2 0.2 0.2"/>', '1 0 0'))
    found = footprint(robot, find_file())
    assert not found.holds_origin
    assert found.inscribed_radius == pytest.approx(0.9)


SHAPES = (
    ('<cylinder radius="0.2" length="0.5"/>', 0.2, 0.25),
    ('<sphere radius="0.3"/>', 0.3, 0.0),
)


@examples(10)
@given(seed=st.integers(0, 2**32 - 1))
def test_nothing_of_the_robot_is_outside_and_little_is_added(seed):
    random = np.random.default_rng(seed)
    parts, points = '', []
    for _ in range(4):
        at, turn = random.uniform(-1, 1, 3), random.uniform(-3, 3, 3)
        shape, radius, half = SHAPES[random.integers(2)]
        parts += part(shape, ' '.join(map(str, at)), ' '.join(map(str, turn)))
        # Points of its surface; of the cylinder those of the two rims are enough.
        spread = random.normal(size=(2000, 3))
        if half:
            spread[:, 2] = 0.0
        spread *= radius / np.linalg.norm(spread, axis=1)[:, None]
        if half:
            spread[:, 2] = random.choice([-half, half], 2000)
        turned = quaternion_from_rpy(*turn)
        axes = np.array([rotate(turned, tuple(axis)) for axis in np.eye(3).tolist()])
        points.append((spread @ axes + at)[:, :2])
    points = np.concatenate(points)
    corners = corners_of(robot_of(parts))
    assert outside(corners, points) <= 1e-9
    # The tolerance, what is around a circle, the rounding, and that the points are a sample.
    assert outside(planar_hull(points), corners) < TOLERANCE + 0.001 + 0.003 + 0.02
    assert all(round(each, 3) == each for corner in corners for each in corner)
    assert len(corners) < 40


@examples(40)
@given(seed=st.integers(0, 2**32 - 1), tolerance=st.floats(0.0, 0.1))
def test_a_polygon_is_simplified_outwards_within_its_tolerance(seed, tolerance):
    random = np.random.default_rng(seed)
    hull = planar_hull(random.normal(size=(random.integers(3, 60), 2)))
    if len(hull) < 3:
        return
    found = simplified(hull, tolerance)
    assert outside(found, hull) <= 1e-9
    assert len(found) <= len(hull)
    edges = dense(hull)
    for corner in found:
        assert np.hypot(*(corner - edges).T).min() <= tolerance + 0.01


def dense(polygon):
    """Points of its edges, 1 cm apart or less for those up to 3 m long."""
    shares = np.linspace(0.0, 1.0, 301)[:, None]
    ends = np.roll(polygon, -1, axis=0)
    return np.concatenate([a + shares * (b - a) for a, b in zip(polygon, ends, strict=True)])


def test_a_circle_gets_few_corners():
    found = corners_of(robot_of(part('<cylinder radius="0.2" length="0.1"/>')))
    assert 8 <= len(found) <= 24
    assert max(math.hypot(*each) for each in found) < 0.2 + TOLERANCE + 0.003


def test_meshes_count_with_their_triangles_and_their_scale(tmp_path):
    write(tmp_path / 'b.dae', dae(box((0.2, 0.4, 0.6))))
    robot = robot_of(part('<mesh filename="b.dae" scale="2 1 1"/>'))
    found = footprint(robot, find_file(tmp_path))
    assert found.corners == ((0.2, 0.2), (-0.2, 0.2), (-0.2, -0.2), (0.2, -0.2))


def test_very_many_points_have_the_same_hull():
    random = np.random.default_rng(3)
    points = random.normal(size=(5000, 2))
    whole = planar_hull(points)
    by_parts = planar_hull(
        np.concatenate([planar_hull(part) for part in points.reshape(50, -1, 2)])
    )
    assert (whole == by_parts).all()


@pytest.mark.parametrize(
    ('base', 'options', 'words'),
    [
        ('', {}, "r.urdf: no link has a <collision>, so there is no footprint; add one, or give"),
        (BOX, {'frame': 'nose'}, 'there is no link "nose"; there are: "base_footprint"'),
        (BOX, {'heights': (1.0, 2.0)}, 'no collision is 1 to 2 m above the ground; they are 0'),
        (part('<box size="1 0 1"/>'), {}, 'have no area, seen from above'),
        (part('<mesh filename="none.dae"/>'), {}, 'the collision of "base_link": .*no such file'),
    ],
)  # fmt: skip
def test_what_has_no_footprint_is_said_in_a_line(base, options, words):
    with pytest.raises(DescriptionError, match=words) as error:
        footprint(robot_of(base), find_file(), **options)
    assert '\n' not in str(error.value)


@pytest.fixture
def command(tmp_path, capsys):
    """Runs --footprint; gives exit code, stdout and stderr."""

    def run(base, *options):
        path = write(tmp_path / 'r.urdf', LINKS.format(base=base, hand=FOREARM if base else ''))
        code = check_urdf.main([str(path), '--footprint', *options])
        return code, *capsys.readouterr()

    return run


def test_the_command_prints_a_line_of_yaml(command):
    code, out, err = command(BOX, '--heights', '0', '0.3')
    assert (code, err) == (0, '')
    assert out.startswith(
        '# in base_link: inscribed radius 0.100 m, circumscribed radius 0.269 m\n'
    )
    value = yaml.safe_load(out)['footprint']
    assert yaml.safe_load(value) == [[0.25, 0.1], [-0.15, 0.1], [-0.15, -0.1], [0.25, -0.1]]


def test_the_command_prints_json_and_takes_another_frame(command):
    code, out, _ = command(BOX, '--json', '--frame', 'hand')
    found = json.loads(out)
    assert (code, found['frame'], found['holds_origin']) == (0, 'hand', True)
    assert Footprint('hand', tuple(map(tuple, found['corners']))).text in json.dumps(
        found['corners']
    )


def test_the_command_says_that_the_frame_is_not_in_the_robot(command):
    _, out, _ = command(part('<box size="0.2 0.2 0.2"/>', '2 0 0'), '--heights', '0', '0.2')
    assert '\n# base_link is outside of the robot: ' in out
    assert 'footprint' in yaml.safe_load(out)


def test_the_command_fails_in_one_line(command):
    code, out, err = command('')
    assert (code, out) == (1, '')
    assert err.count('\n') == 1
    assert 'no link has a <collision>' in err
    with pytest.raises(SystemExit) as end:
        command(BOX, '--heights', 'a', '1')
    assert end.value.code == 2
