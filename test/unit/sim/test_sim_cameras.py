# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Laws of cameras: where things are in the picture, how far, and of what colour."""

from dataclasses import replace
import math

from hypothesis import given, strategies as st
import numpy as np
import pytest
from support.camera_scenes import camera_of, seen_from, state_of, take
from support.examples import examples

from amr_description.model.frames import quaternion_from_rpy, Transform
from amr_description.model.gazebo.tags import Noise
from amr_description.model.sensors import Distortion, Intrinsics
from amr_description.sim.cameras.lens import (
    distort,
    intrinsics_of,
    pixel_directions,
    project,
    undistort,
)
from amr_description.sim.cameras.pictures import encoded, jpeg, PointMaker, with_noise
from amr_description.sim.cameras.ray_renderer import RayRenderer
from amr_description.sim.cameras.renderer import BACKGROUND, RenderedPicture
from amr_description.sim.sensor_schedule import noise_generator

angles = st.floats(-3.0, 3.0)
poses = st.builds(
    lambda x, y, z, roll, pitch, yaw: Transform((x, y, z), quaternion_from_rpy(roll, pitch, yaw)),
    *[st.floats(-5.0, 5.0)] * 3,
    *[angles] * 3,
)
lenses = st.builds(
    Distortion,
    k1=st.floats(-0.15, 0.3),
    k2=st.floats(-0.02, 0.05),
    k3=st.floats(-0.005, 0.02),
    p1=st.floats(-0.01, 0.01),
    p2=st.floats(-0.01, 0.01),
)
matrices = st.builds(
    Intrinsics,
    fx=st.floats(40.0, 120.0),
    fy=st.floats(40.0, 120.0),
    cx=st.floats(20.0, 60.0),
    cy=st.floats(15.0, 45.0),
)
ONE_RED = '<geom type="sphere" size="{size}" pos="{place}" rgba="1 0 0 1"/>'


@pytest.fixture(scope='module')
def rays():
    return RayRenderer()


def in_words(numbers):
    return ' '.join(map(repr, map(float, numbers)))


@examples(30)
@given(lenses, st.tuples(st.floats(-0.6, 0.6), st.floats(-0.6, 0.6)))
def test_undistortion_is_the_inverse_of_distortion(lens, point):
    points = np.array([point, (0.0, 0.0), (0.5, -0.4)])
    assert undistort(distort(points, lens), lens) == pytest.approx(points, abs=1e-7)


def test_beyond_the_fold_of_a_barrel_lens_nothing_is_seen():
    lens = Distortion(k1=-0.3)  # r (1 - 0.3 r²) is largest at r = 1.054, where it is 0.703
    assert np.isfinite(undistort(np.array([[0.70, 0.0]]), lens)).all()
    assert np.isnan(undistort(np.array([[0.71, 0.0]]), lens)).all()


@examples(10)
@given(poses, matrices, lenses, st.floats(1.0, 5.0), st.floats(0.2, 0.8), st.floats(0.2, 0.8))
def test_a_point_is_at_the_pixel_that_the_pinhole_and_the_lens_say(rays, pose, k, lens, z, u, v):
    camera = camera_of(intrinsics=k, distortion=lens)
    x, y = pixel_directions(camera)[int(60 * v), int(80 * u)] * z
    if not np.isfinite(x):
        return
    place = pose.apply((z, -x, -y))
    state = state_of(ONE_RED.format(size=0.05 * z, place=in_words(place)))
    color = take(rays, camera, state, pose, depth=False).color
    rows, columns = np.nonzero(color[..., 0] > color[..., 1])
    expected = project(np.array([x, y, z]), camera)
    size = 0.1 * max(k.fx, k.fy) * 2.0  # of its picture, pixels
    assert len(rows) > 0
    assert np.hypot(columns.mean() - expected[0], rows.mean() - expected[1]) < 0.5 + 0.1 * size


@examples(10)
@given(poses, matrices, st.tuples(angles, angles), st.floats(0.5, 20.0))
def test_the_depth_of_a_plane_is_exact(rays, pose, k, tilt, distance):
    camera = camera_of(intrinsics=k)
    # It stands across the view, tilted by less than a right angle.
    facing = quaternion_from_rpy(0.0, -math.pi / 2 + 0.3 * tilt[0], 0.0)
    plane = pose @ Transform((distance, 0.0, 0.0), facing)
    x, y, z, w = plane.rotation
    state = state_of(
        f'<geom type="plane" size="0 0 1" pos="{in_words(plane.translation)}" '
        f'quat="{in_words((w, x, y, z))}"/>'
    )
    depth = take(rays, camera, state, pose, color=False).depth
    normal = np.subtract(plane.apply((0.0, 0.0, 1.0)), plane.translation)
    seen = seen_from(pose, [plane.translation, np.add(plane.translation, normal)])
    middle, across = seen[0], seen[1] - seen[0]
    ahead = np.dstack((pixel_directions(camera), np.ones((60, 80))))
    with np.errstate(divide='ignore'):
        expected = (middle @ across) / (ahead @ across)
    is_seen = (expected > camera.depth_near) & (expected < camera.depth_far)
    assert is_seen.any()
    assert depth[is_seen] == pytest.approx(expected[is_seen], abs=1e-3, rel=1e-6)
    assert (depth[(expected > camera.depth_far) | (expected < 0.0)] == np.inf).all()


@examples(10)
@given(poses, matrices, lenses)
def test_camera_info_takes_each_point_of_the_cloud_back_to_its_pixel(rays, pose, k, lens):
    camera = camera_of(intrinsics=k, distortion=lens)
    box = '<geom type="box" size="3 2 1" pos="{}"/><geom type="sphere" size="1" pos="{}"/>'
    state = state_of(box.format(in_words(pose.apply((6, 1, 0))), in_words(pose.apply((3, -1, 0)))))
    depth = take(rays, camera, state, pose, color=False).depth
    points = PointMaker(camera, with_color=False).points(depth, None)[..., :3].astype(float)
    is_seen = np.isfinite(depth)
    assert is_seen.any()
    assert (np.isnan(points).any(axis=-1) == ~is_seen).all()
    v, u = np.nonzero(is_seen)
    pixels = project(points[is_seen], camera)
    assert pixels == pytest.approx(np.column_stack((u, v)), abs=1e-3)


def test_points_in_the_sensors_axes_are_those_of_the_optical_frame_turned():
    camera = camera_of(width=4, height=2)
    depth = np.full((2, 4), 2.0, np.float32)
    optical = PointMaker(camera, with_color=False).points(depth, None)
    turned = PointMaker(replace(camera, points_are_optical=False), with_color=False).points(
        depth, None
    )
    x, y, z, _ = np.moveaxis(optical, -1, 0)
    assert (np.moveaxis(turned, -1, 0)[:3] == (z, -x, -y)).all()


def test_a_red_box_on_the_left_is_red_and_on_the_left_and_the_sky_is_above(rays):
    state = state_of(
        '<geom type="box" size=".5 .5 .5" pos="3 1 0" rgba="1 0 0 1"/>'
        '<geom type="box" size=".5 .5 .5" pos="3 -1 0" rgba="0 0 1 1"/>'
        '<geom type="plane" size="0 0 1" pos="0 0 -.5" rgba="0 1 0 1"/>'
    )
    color = take(rays, camera_of(), state, depth=False).color.astype(int)
    red, green, blue = np.moveaxis(color, -1, 0)
    _, reds = np.nonzero(red > green + blue)
    _, blues = np.nonzero(blue > green + red)
    greens, _ = np.nonzero(green > red + blue)
    assert 0 < reds.max() < 40 <= blues.min()
    assert greens.min() > 29
    assert (color[0] == BACKGROUND).all()


def test_what_faces_the_light_is_brighter(rays):
    state = state_of(
        '<light type="directional" dir="0 0 -1"/>'
        '<geom type="box" size="1 1 1" pos="5 0 -2" rgba=".5 .5 .5 1"/>',
        options='<visual><headlight ambient=".1 .1 .1" diffuse="0 0 0"/></visual>',
    )
    pose = Transform(rotation=quaternion_from_rpy(0.0, 0.3, 0.0))
    color = take(rays, camera_of(), state, pose, depth=False).color
    values = {tuple(each) for each in color.reshape(-1, 3).tolist()} - {BACKGROUND}
    # Its front is in the dark; of its top 0.1 ambient and 0.7 of the light.
    assert values == {(13, 13, 13), (102, 102, 102)}


@pytest.mark.parametrize('kind', ['directional', 'spot'])
def test_a_shadow_lies_where_the_light_does_not_reach(rays, kind):
    state = state_of(
        f'<light type="{kind}" dir="1 0 -1" pos="-20 0 21" diffuse=".5 .5 .5" cutoff="60"/>'
        '<geom type="plane" size="0 0 1" rgba="1 1 1 1"/>'
        '<geom type="box" size=".5 .5 .1" pos="0 0 1"/>',
        options='<visual><headlight ambient=".2 .2 .2" diffuse="0 0 0"/></visual>',
    )
    # From above, with x of the world down in the picture.
    pose = Transform((1.0, 0.0, 8.0), quaternion_from_rpy(0.0, math.pi / 2, math.pi))
    camera = camera_of(160, 160, fov=math.radians(60.0))
    picture = take(rays, camera, state, pose)
    is_floor = picture.depth > 7.99
    dark = is_floor & (picture.color[..., 0] < 80)
    seen = pixel_directions(camera)[dark] * 8.0
    x = 1.0 + seen[:, 1]
    # A top at 1.1 m and a bottom at 0.9 m, along a slope of 45 degrees; the top hides nothing.
    assert x.min() == pytest.approx(0.5, abs=0.15)
    assert x.max() == pytest.approx(0.5 + 1.1, abs=0.15)
    assert np.abs(seen[:, 0]).max() == pytest.approx(0.5, abs=0.15)
    assert (picture.color[is_floor & ~dark][:, 0] > 100).mean() > 0.99


def test_a_checkered_floor_has_its_squares_where_they_are(rays):
    state = state_of(
        '<geom type="plane" size="0 0 1" material="checker"/>',
        '<texture name="checker" type="2d" builtin="checker" rgb1="1 1 1" rgb2="0 0 0" '
        'width="64" height="64"/>'
        '<material name="checker" texture="checker" texrepeat="1 1" texuniform="true"/>',
        '<visual><headlight ambient="1 1 1" diffuse="0 0 0"/></visual>',
    )
    camera = camera_of()
    pose = Transform((0.3, -0.2, 3.0), quaternion_from_rpy(0.0, math.pi / 2, 0.4))
    picture = take(rays, camera, state, pose)
    points = PointMaker(camera, with_color=False).points(picture.depth, None)[..., :3]
    optical = np.moveaxis(points, -1, 0)
    sensor = np.stack((optical[2], -optical[0], -optical[1]), axis=-1)
    floor = np.array([pose.apply(tuple(point)) for point in sensor.reshape(-1, 3).tolist()])
    assert floor[:, 2] == pytest.approx(0.0, abs=1e-5)
    x, y = np.moveaxis(floor[:, :2], -1, 0)
    # One texture each 2 m, of which a checker has two squares; those on an edge are grey.
    inside = (np.abs(x - np.round(x)) > 0.1) & (np.abs(y - np.round(y)) > 0.1)
    is_white = picture.color.reshape(-1, 3)[:, 0] > 127
    same = (np.floor(x) + np.floor(y)) % 2 == 0
    agreeing = (is_white == same)[inside]
    assert agreeing.all() or not agreeing.any()


def test_too_near_is_minus_infinity_and_too_far_plus_infinity(rays):
    camera = camera_of(depth_near=0.5, depth_far=4.0)
    for distance, expected in ((0.3, -np.inf), (2.0, 2.0), (5.0, np.inf)):
        state = state_of(f'<geom type="box" size=".1 9 9" pos="{distance + 0.1} 0 0"/>')
        depth = take(rays, camera, state, color=False).depth
        assert depth[30, 40] == pytest.approx(expected)


def test_a_camera_sees_its_robot_but_not_the_housing_that_it_is_in(rays):
    housing = '<geom type="box" size=".03 .03 .03" group="1" rgba="1 0 0 1"/>'
    lid = '<geom type="cylinder" size=".05 .01" pos=".08 0 0" group="1" rgba="1 0 0 1"/>'
    bumper = (
        '<body name="amr/bumper"><geom type="box" size=".05 .5 .05" pos=".5 0 -.1" {}/></body>'
    )
    for group, seen in (('group="1" rgba="0 0 1 1"', True), ('group="0"', False)):
        state = state_of(
            f'<body name="amr/link">{housing}{lid}{bumper.format(group)}</body>', robots=['amr']
        )
        color = take(rays, camera_of(near=0.1), state, depth=False, body='amr/link').color
        red, _, blue = np.moveaxis(color.astype(int), -1, 0)
        assert not (red > blue).any()
        assert (blue > red).any() == seen


def test_noise_follows_from_seed_sensor_and_time_alone():
    color, depth = np.full((60, 80, 3), 100, np.uint8), np.full((60, 80), 2.0, np.float32)
    noise = Noise(mean=0.1, stddev=0.02)

    def noisy(seed, sensor, time):
        generator = noise_generator(seed, sensor, time)
        return with_noise(RenderedPicture(color.copy(), None), noise, generator).color

    first = noisy([1], 'camera', 5)
    assert (first == noisy([1], 'camera', 5)).all()
    for other in (([2], 'camera', 5), ([1], 'camera_2', 5), ([1], 'camera', 6)):
        assert (first != noisy(*other)).any()
    assert first.mean() == pytest.approx(125.5, abs=1.0)
    assert first[..., 0].std() == pytest.approx(5.1, rel=0.1)
    found = with_noise(
        RenderedPicture(None, depth), noise, noise_generator([1], 'camera', 5)
    ).depth
    assert found.mean() == pytest.approx(2.1, abs=1e-3)
    assert found.std() == pytest.approx(0.02, rel=0.1)


def test_encodings_and_jpegs_keep_the_colors():
    simplejpeg = pytest.importorskip('simplejpeg')
    color = np.zeros((16, 16, 3), np.uint8)
    color[:, :8] = (200, 40, 20)
    assert (encoded(color, 'bgr8')[0, 0] == (20, 40, 200)).all()
    assert encoded(color, 'mono8')[0, 0] == round(0.299 * 200 + 0.587 * 40 + 0.114 * 20)
    for encoding in ('rgb8', 'bgr8'):
        data = jpeg(encoded(color, encoding), encoding)
        decoded = simplejpeg.decode_jpeg(data, 'RGB').astype(int)
        assert np.abs(decoded[2:-2, 2:5] - color[2:-2, 2:5]).max() < 8
    grey = simplejpeg.decode_jpeg(jpeg(encoded(color, 'mono8'), 'mono8'), 'GRAY')
    assert abs(int(grey[8, 3, 0]) - 86) < 4


def test_a_field_of_view_is_that_of_the_whole_width():
    k = intrinsics_of(camera_of(width=320, height=240, fov=1.047))
    assert k.fx == k.fy == pytest.approx(160 / math.tan(1.047 / 2))
    assert (k.cx, k.cy) == (160.0, 120.0)
