# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``image_geometry`` by its own name: a camera's equations, and laws of its lens."""

import math

from hypothesis import given, strategies as st
from image_geometry import PinholeCameraModel, StereoCameraModel
import pytest
from sensor_msgs.msg import CameraInfo, RegionOfInterest


def info(lens=(), baseline=0.0, **options):
    k = [500.0, 0.0, 320.0, 0.0, 400.0, 240.0, 0.0, 0.0, 1.0]
    p = [500.0, 0.0, 320.0, -500.0 * baseline, 0.0, 400.0, 240.0, 0.0, 0.0, 0.0, 1.0, 0.0]
    r = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
    made = CameraInfo(width=640, height=480, k=k, p=p, r=r, d=list(lens), **options)
    made.header.frame_id = 'camera_optical'
    return made


def camera(*args, **options):
    made = PinholeCameraModel()
    made.fromCameraInfo(info(*args, **options))
    return made


def test_a_point_is_where_the_matrix_has_it():
    model = camera()
    assert model.project3dToPixel((0.2, -0.1, 2.0)) == (370.0, 220.0)
    assert all(map(math.isnan, model.project3dToPixel((1.0, 1.0, 0.0))))
    assert (model.fovX(), model.fovY()) == (2 * math.atan(0.64), 2 * math.atan(0.6))
    assert (model.getDeltaU(0.1, 2.0), model.getDeltaV(0.1, 2.0)) == (25.0, 20.0)
    assert (model.getDeltaX(25.0, 2.0), model.getDeltaY(20.0, 2.0)) == (0.1, 0.1)
    assert model.getDeltaU(0.1, 0.0) == math.inf
    assert (model.tfFrame(), model.fullResolution()) == ('camera_optical', (640, 480))


@given(st.floats(0.0, 640.0), st.floats(0.0, 480.0), st.floats(0.1, 50.0))
def test_a_ray_goes_through_its_pixel(u, v, depth):
    model = camera()
    ray = model.projectPixelTo3dRay((u, v))
    assert math.hypot(*ray) == pytest.approx(1.0)
    point = tuple(depth / ray[2] * each for each in ray)
    assert model.project3dToPixel(point) == pytest.approx((u, v))


def test_binning_and_a_region_move_and_scale_the_pixels():
    region = RegionOfInterest(x_offset=100, y_offset=40, width=200, height=100)
    model = camera(roi=region, binning_x=2, binning_y=4)
    whole = camera().project3dToPixel((0.2, -0.1, 2.0))
    expected = ((whole[0] - 100) / 2, (whole[1] - 40) / 4)
    assert model.project3dToPixel((0.2, -0.1, 2.0)) == pytest.approx(expected)
    assert model.fullIntrinsicMatrix()[0, 2] == 320.0
    assert model.intrinsicMatrix()[0, 2] == 110.0


LENSES = [(), (-0.2, 0.05, 0.001, -0.002, 0.01), (-0.2, 0.05, 0.0, 0.0, 0.01, 0.1, -0.02, 0.003)]


@pytest.mark.parametrize('lens', LENSES)
@given(st.floats(-0.5, 0.5), st.floats(-0.5, 0.5))
def test_a_raw_pixel_is_rectified_to_that_of_its_ray(lens, x, y):
    """By the equations of OpenCV's page "Camera Calibration", written out."""
    k1, k2, p1, p2, k3, k4, k5, k6 = [*lens, *[0.0] * 8][:8]
    r2 = x * x + y * y
    radial = (1 + k1 * r2 + k2 * r2**2 + k3 * r2**3) / (1 + k4 * r2 + k5 * r2**2 + k6 * r2**3)
    raw_x = x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x)
    raw_y = y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y
    model = camera(lens)
    rectified = model.rectifyPoint((500.0 * raw_x + 320.0, 400.0 * raw_y + 240.0))
    assert rectified == pytest.approx((500.0 * x + 320.0, 400.0 * y + 240.0), abs=1e-6)


@given(st.floats(-2.0, 2.0), st.floats(-2.0, 2.0), st.floats(0.5, 20.0))
def test_two_cameras_see_how_far_a_point_is(x, y, z):
    pair = StereoCameraModel()
    pair.fromCameraInfo(info(), info(baseline=0.12))
    left, right = pair.project3dToPixel((x, y, z))
    assert left[1] == pytest.approx(right[1])
    disparity = left[0] - right[0]
    assert pair.getZ(disparity) == pytest.approx(z)
    assert pair.getDisparity(z) == pytest.approx(disparity)
    assert pair.projectPixelTo3d(left, disparity)[2] == pytest.approx(z)
    assert pair.projectPixelTo3d(left, disparity)[0] == pytest.approx(x, abs=1e-6)


def test_what_is_infinitely_far_has_no_disparity():
    pair = StereoCameraModel()
    pair.fromCameraInfo(info(), info(baseline=0.12))
    assert pair.getZ(0.0) == pair.getDisparity(0.0) == math.inf
    assert pair.projectPixelTo3d((1.0, 2.0), 0.0) == (0.0, 0.0, 0.0)
