# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The static surroundings of a world: as shapes, as markers, and as a page draws them."""

import math
import operator

import mujoco
import pytest
import rclpy
from rclpy.node import Node
from support.running_programs import PATIENCE
from visualization_msgs.msg import Marker, MarkerArray

from amr_description.ament_index import shipped_worlds
from amr_description.model.frames import rotate
from amr_description.ros.qos import LATCHED
from amr_description.ros.service_calls import wait_until
from amr_description.sim.ros.world_publisher import WorldPublisher
from amr_description.sim.static_geometry import ShapeKind, visible_shapes
from amr_description.sim.world import MujocoWorld
from amr_description.sim.world_file import load_world
from amr_description.simulation.topics.world_markers import INFINITE_WIDTH, markers
from amr_description.viewer.ros.markers import shapes_of

GEOMS = """
<mujoco>
  <asset>
    <material name="red" rgba="1 0 0 0.5"/>
    <mesh name="wedge" vertex="0 0 0  1 0 0  0 1 0  0 0 1"/>
    <hfield name="hill" nrow="3" ncol="4" size="2 1 0.5 0.1"
            elevation="0 0 0 0  0 1 1 0  0 0 0 0"/>
  </asset>
  <worldbody>
    <geom name="ground" type="plane" size="0 0 1"/>
    <geom name="floor" type="plane" size="2 3 1" pos="0 0 1" euler="0 30 0"/>
    <geom name="box" type="box" size="1 2 3" pos="1 2 3" material="red"/>
    <geom type="sphere" size="0.5" rgba="0 1 0 1"/>
    <geom name="egg" type="ellipsoid" size="1 2 3"/>
    <geom name="pillar" type="cylinder" size="0.1 0.4"/>
    <geom name="pill" type="capsule" size="0.1 0.4" euler="90 0 0"/>
    <geom name="wedge" type="mesh" mesh="wedge"/>
    <geom name="hill" type="hfield" hfield="hill"/>
    <geom name="hidden" type="box" size="1 1 1" rgba="0 0 0 0"/>
    <body pos="0 0 5"><geom name="shelf" type="box" size="1 1 1"/></body>
    <body pos="0 0 9"><freejoint/><geom name="ball" size="1"/></body>
  </worldbody>
</mujoco>
"""


@pytest.fixture(scope='module')
def shapes():
    return {shape.name: shape for shape in visible_shapes(mujoco.MjSpec.from_string(GEOMS))}


def test_visible_static_geoms_are_there_and_moving_or_hidden_ones_are_not(shapes):
    assert list(shapes) == [
        'ground', 'floor', 'box', 'sphere_3', 'egg', 'pillar', 'pill', 'wedge', 'hill', 'shelf'
    ]  # fmt: skip


def test_sizes_are_whole_extents(shapes):
    sizes = {name: (str(shape.kind), *shape.size) for name, shape in shapes.items()}
    assert sizes == {
        'ground': ('plane', 0, 0, 0),
        'floor': ('plane', 4, 6, 0),
        'box': ('box', 2, 4, 6),
        'sphere_3': ('sphere', 1, 1, 1),
        'egg': ('sphere', 2, 4, 6),
        'pillar': ('cylinder', 0.2, 0.2, 0.8),
        'pill': ('capsule', 0.2, 0.2, 1.0),
        'wedge': ('triangles', *shapes['wedge'].size),
        'hill': ('triangles', 4, 2, 0.5),
        'shelf': ('box', 2, 2, 2),
    }


def test_poses_are_in_the_world(shapes):
    assert shapes['box'].position == (1.0, 2.0, 3.0)
    assert shapes['shelf'].position == (0.0, 0.0, 5.0)
    up = rotate(shapes['floor'].rotation, (0.0, 0.0, 1.0))
    assert up == pytest.approx((math.sin(math.radians(30)), 0.0, math.cos(math.radians(30))))


def test_colors_are_of_the_material_or_the_geom(shapes):
    assert shapes['box'].color == (1.0, 0.0, 0.0, 0.5)
    assert shapes['sphere_3'].color == (0.0, 1.0, 0.0, 1.0)


def test_a_mesh_is_its_triangles_where_they_stand(shapes):
    wedge = shapes['wedge']
    corners = {
        tuple(
            round(a + b, 6) for a, b in zip(rotate(wedge.rotation, p), wedge.position, strict=True)
        )
        for p in wedge.points
    }
    assert corners == {(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)}
    assert len(wedge.points) == 4 * 3


def test_a_height_field_is_two_triangles_a_cell_that_face_up(shapes):
    points = shapes['hill'].points
    assert len(points) == (3 - 1) * (4 - 1) * 2 * 3
    assert {p[2] for p in points if p[1] == 0.0 and abs(p[0]) < 1} == {0.5}
    for a, b, c in zip(points[::3], points[1::3], points[2::3], strict=True):
        up = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        assert up > 0


def test_the_world_is_left_as_it_was():
    spec = mujoco.MjSpec.from_string(GEOMS)
    before = spec.to_xml()
    visible_shapes(spec)
    assert spec.to_xml() == before


@pytest.mark.parametrize('world', shipped_worlds())
def test_every_geom_of_a_shipped_world_is_there(world):
    spec = load_world(world)
    assert [shape.name for shape in visible_shapes(spec)] == [geom.name for geom in spec.geoms]


def test_markers_are_what_rviz_draws(shapes):
    message = markers(list(shapes.values()))
    first, *others = message.markers
    assert first.action == Marker.DELETEALL
    assert {each.header.frame_id for each in message.markers} == {'world'}
    assert len({(each.ns, each.id) for each in message.markers}) == len(message.markers)
    for each in others:
        assert each.action == Marker.ADD
        assert each.color.a > 0
        assert min(each.scale.x, each.scale.y, each.scale.z) > 0
        assert (each.type == Marker.TRIANGLE_LIST) == bool(each.points)


def test_a_plane_is_a_cube_whose_upper_face_it_is(shapes):
    floor = next(m for m in markers([shapes['floor']]).markers if m.action == Marker.ADD)
    centre, half = floor.pose.position, floor.scale.z / 2
    dx, dy, dz = rotate(shapes['floor'].rotation, (0.0, 0.0, half))
    top = (centre.x + dx, centre.y + dy, centre.z + dz)
    assert top == pytest.approx(shapes['floor'].position)
    assert (floor.scale.x, floor.scale.y) == (4, 6)
    ground = markers([shapes['ground']]).markers[1]
    assert (ground.scale.x, ground.scale.y) == (INFINITE_WIDTH, INFINITE_WIDTH)


def test_the_page_draws_all_shapes(shapes):
    whole = [shape for shape in shapes.values() if shape.kind is not ShapeKind.CAPSULE]
    drawn = shapes_of(markers(whole))
    for shape, seen in zip(whole, drawn, strict=True):
        assert (seen.name, seen.kind) == (shape.name, shape.kind)
        assert seen.position == pytest.approx(shape.position)
        assert seen.orientation == pytest.approx(shape.rotation)
        assert seen.colour == pytest.approx(shape.color)
        flat = [value for point in shape.points for value in point]
        assert list(seen.points) == flat
        if shape.kind is not ShapeKind.TRIANGLES:
            assert seen.size == pytest.approx(shape.size)


def test_a_capsule_is_a_cylinder_and_two_balls(shapes):
    middle, *ends = shapes_of(markers([shapes['pill']]))
    assert (middle.kind, middle.size) == ('cylinder', pytest.approx((0.2, 0.2, 0.8)))
    assert [end.kind for end in ends] == ['sphere', 'sphere']
    assert sorted(end.position[1] for end in ends) == pytest.approx([-0.4, 0.4])


def test_foreign_markers_without_a_shape_are_ignored():
    message = MarkerArray(markers=[Marker(type=Marker.TEXT_VIEW_FACING), Marker(type=Marker.CUBE)])
    message.markers[1].ns = 'unknown'
    (seen,) = shapes_of(message)
    assert (seen.name, seen.kind, seen.orientation) == ('unknown/0', 'box', (0, 0, 0, 1))


@pytest.mark.parametrize('number', [math.nan, math.inf])
def test_foreign_markers_with_invalid_numbers_are_ignored(number):
    for place in ('scale', 'pose.position', 'pose.orientation'):
        marker = Marker(type=Marker.CUBE)
        operator.attrgetter(place)(marker).x = number
        assert shapes_of(MarkerArray(markers=[marker])) == ()


def test_a_late_subscriber_gets_the_world():
    rclpy.init(args=[])
    node = Node('surroundings_host')
    try:
        WorldPublisher(node, MujocoWorld('walls')).publish()
        heard = []
        topic = '/surroundings_host/world'
        node.create_subscription(MarkerArray, topic, heard.append, LATCHED)
        (message,) = wait_until(node, lambda: heard or None, timeout=PATIENCE)
        assert [each.text for each in message.markers[1:]] == [
            'ground', 'east', 'west', 'north', 'south', 'partition', 'pillar'
        ]  # fmt: skip
    finally:
        node.destroy_node()
        rclpy.try_shutdown()
