# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Point clouds from and to arrays, as sensor_msgs_py of Jazzy has it."""

from hypothesis import given, strategies as st
import numpy as np
import pytest
from rclpy.serialization import deserialize_message, serialize_message
from sensor_msgs.msg import PointCloud2, PointField
from std_msgs.msg import Header

from amr_description.errors import PointCloudError
from amr_description.sensor_msgs_py import numpy_compat, point_cloud2

HEADER = Header(frame_id='laser')
TYPES = {
    PointField.INT8: 'i1',
    PointField.UINT8: 'u1',
    PointField.INT16: 'i2',
    PointField.UINT16: 'u2',
    PointField.INT32: 'i4',
    PointField.UINT32: 'u4',
    PointField.FLOAT32: 'f4',
    PointField.FLOAT64: 'f8',
}
NAN = float('nan')


def field(name, offset, datatype=PointField.FLOAT32, count=1):
    return PointField(name=name, offset=offset, datatype=datatype, count=count)


XYZ = [field('x', 0), field('y', 4), field('z', 8)]
WITH_RING = [*XYZ, field('ring', 12, PointField.UINT16)]
POINTS = [(1.0, 2.0, 3.0), (NAN, 5.0, 6.0), (7.0, 8.0, 9.0), (10.0, NAN, 12.0)]


def as_lists(points):
    return [tuple(point) for point in points.tolist()]


def test_a_cloud_of_points_says_what_it_holds():
    cloud = point_cloud2.create_cloud_xyz32(HEADER, POINTS)
    assert (cloud.header, cloud.fields) == (HEADER, XYZ)
    assert (cloud.width, cloud.height, cloud.point_step, cloud.row_step) == (4, 1, 12, 48)
    assert (cloud.is_bigendian, cloud.is_dense) == (False, False)
    assert bytes(cloud.data) == np.array(POINTS, 'f4').tobytes()
    assert deserialize_message(serialize_message(cloud), PointCloud2) == cloud


def test_points_are_read_by_field_index_and_without_nans():
    cloud = point_cloud2.create_cloud_xyz32(HEADER, POINTS)
    whole = point_cloud2.read_points(cloud)
    assert (whole.shape, whole.dtype.names) == ((4,), ('x', 'y', 'z'))
    assert as_lists(point_cloud2.read_points(cloud, ('z', 'x'), skip_nans=True)) == [
        (3.0, 1.0), (9.0, 7.0), (12.0, 10.0),
    ]  # fmt: skip
    assert as_lists(point_cloud2.read_points(cloud, uvs=[2, 0])) == [POINTS[2], POINTS[0]]
    picked = point_cloud2.read_points(cloud, skip_nans=True, uvs=np.array([1]))
    assert as_lists(picked) == [POINTS[2]]
    cloud.is_dense = True  # says that there is none
    assert len(point_cloud2.read_points(cloud, skip_nans=True)) == 4


def test_points_are_read_as_a_list():
    cloud = point_cloud2.create_cloud_xyz32(HEADER, POINTS)
    first, last = point_cloud2.read_points_list(cloud, skip_nans=True)
    assert (first.x, first.y, first.z) == POINTS[0]
    assert last == POINTS[2]
    assert point_cloud2.read_points_list(cloud, ['y'], uvs=[0]) == [(2.0,)]


def test_points_are_read_as_a_plain_array():
    cloud = point_cloud2.create_cloud(HEADER, WITH_RING, [(1, 2, 3, 4), (5, 6, 7, 8)])
    plain = point_cloud2.read_points_numpy(cloud, ['x', 'z'])
    assert (plain.dtype, plain.tolist()) == (np.dtype('f4'), [[1, 3], [5, 7]])
    with pytest.raises(PointCloudError, match=r'several types \(x: float32, .*ring: uint16\)'):
        point_cloud2.read_points_numpy(cloud)


@pytest.mark.parametrize(('datatype', 'kind'), TYPES.items())
def test_every_type_of_field_has_its_own(datatype, kind):
    fields = [field('a', 0, datatype), field('b', 8, datatype, count=2)]
    layout = point_cloud2.dtype_from_fields(fields, point_step=32)
    size = np.dtype(kind).itemsize
    assert layout.names == ('a', 'b_0', 'b_1')
    assert [layout.fields[name][1] for name in layout.names] == [0, 8, 8 + size]
    assert ({layout[name] for name in layout.names}, layout.itemsize) == ({np.dtype(kind)}, 32)
    cloud = point_cloud2.create_cloud(HEADER, fields, [(1, 2, 3), (4, 5, 6)], point_step=32)
    assert (cloud.point_step, len(cloud.data)) == (32, 64)
    assert as_lists(point_cloud2.read_points(cloud)) == [(1, 2, 3), (4, 5, 6)]


def test_a_field_without_name_is_called_by_its_index():
    layout = point_cloud2.dtype_from_fields([field('x', 0), field('', 4)])
    assert layout.names == ('x', 'unnamed_field_1')
    assert point_cloud2.DUMMY_FIELD_PREFIX == 'unnamed_field'


def test_arrays_become_clouds():
    plain = np.arange(6).reshape(2, 3)
    cloud = point_cloud2.create_cloud(HEADER, XYZ, plain)
    assert point_cloud2.read_points_numpy(cloud).tolist() == plain.tolist()
    layout = point_cloud2.dtype_from_fields(WITH_RING)
    structured = np.array([(1, 2, 3, 4)], layout)
    cloud = point_cloud2.create_cloud(HEADER, iter(WITH_RING), structured)
    assert as_lists(point_cloud2.read_points(cloud)) == [(1, 2, 3, 4)]


def test_an_organized_cloud_keeps_its_shape():
    points = np.arange(24, dtype='f4').reshape(4, 2, 3)  # 4 wide, 2 high
    cloud = point_cloud2.create_cloud_xyz32(HEADER, points)
    assert (cloud.width, cloud.height, cloud.row_step) == (4, 2, 48)
    organized = point_cloud2.read_points(cloud, reshape_organized_cloud=True)
    assert organized.shape == (4, 2)
    assert (organized['x'] == points[..., 0]).all()
    numbers = point_cloud2.read_points_numpy(cloud, reshape_organized_cloud=True)
    assert (numbers == points).all()
    assert point_cloud2.read_points(cloud).shape == (8,)


def test_rows_may_be_longer_than_their_points():
    cloud = point_cloud2.create_cloud_xyz32(HEADER, POINTS)
    data = bytes(cloud.data)
    cloud.width, cloud.height, cloud.row_step = 2, 2, 32
    cloud.data = data[:24] + b'padding.' + data[24:] + b'padding.'
    assert point_cloud2.read_points(cloud)['z'].tolist() == [3, 6, 9, 12]


def test_a_cloud_of_the_other_byte_order_is_read_and_not_changed():
    cloud = point_cloud2.create_cloud_xyz32(HEADER, [POINTS[0]])
    cloud.data = np.array(POINTS[0], '>f4').tobytes()
    cloud.is_bigendian = True
    for _ in range(2):
        assert as_lists(point_cloud2.read_points(cloud)) == [POINTS[0]]
        assert as_lists(point_cloud2.read_points(cloud, ['z', 'y'])) == [(3.0, 2.0)]


def test_reading_copies_nothing():
    cloud = point_cloud2.create_cloud_xyz32(HEADER, POINTS)
    assert np.shares_memory(point_cloud2.read_points(cloud), np.frombuffer(cloud.data, 'u1'))


@pytest.mark.parametrize(
    ('fault', 'said'),
    [
        (lambda: point_cloud2.read_points('text'), 'got a str, not a sensor_msgs.msg.PointCloud2'),
        (
            lambda: point_cloud2.read_points(
                point_cloud2.create_cloud_xyz32(HEADER, POINTS), ['x', 'w']
            ),
            "the cloud has no field 'w'; it has x, y, z",
        ),
        (
            lambda: point_cloud2.read_points(
                PointCloud2(fields=XYZ, point_step=12, width=3, height=2, data=bytes(12))
            ),
            '3 x 2 points of 12 bytes are 72, and the data has 12',
        ),
        (
            lambda: point_cloud2.dtype_from_fields([field('x', 0), field('x', 4)]),
            "field 'x' is there twice",
        ),
        (
            lambda: point_cloud2.dtype_from_fields([field('x', 0, count=0)]),
            "field 'x' has a count of 0",
        ),
        (
            lambda: point_cloud2.create_cloud(HEADER, WITH_RING, np.zeros((2, 4))),
            r'a plain array for fields of several types \(float32, uint16\)',
        ),
        (
            lambda: point_cloud2.create_cloud(HEADER, XYZ, np.zeros(2, [('x', 'f8')])),
            'and the fields say',
        ),
        (
            lambda: point_cloud2.create_cloud_xyz32(HEADER, np.zeros((2, 2, 2, 3))),
            'points of 3 dimensions: a cloud has one or two',
        ),
    ],
)
def test_what_does_not_fit_is_an_assertion_error_as_in_the_original(fault, said):
    with pytest.raises(AssertionError, match=said):
        fault()


@given(
    st.lists(
        st.tuples(*[st.floats(width=32, allow_nan=False)] * 3, st.integers(0, 65535)), max_size=20
    ),
    st.integers(14, 40),
)
def test_points_come_back_as_they_went(points, step):
    cloud = point_cloud2.create_cloud(HEADER, WITH_RING, points, point_step=step)
    assert len(cloud.data) == step * len(points)
    assert as_lists(point_cloud2.read_points(cloud)) == points


def test_structured_arrays_become_plain_ones_and_back():
    layout = np.dtype([('x', 'f4'), ('y', 'f4')])
    structured = np.array([(1, 2), (3, 4)], layout)
    plain = numpy_compat.structured_to_unstructured(structured)
    assert plain.tolist() == [[1, 2], [3, 4]]
    assert (numpy_compat.unstructured_to_structured(plain, layout) == structured).all()
