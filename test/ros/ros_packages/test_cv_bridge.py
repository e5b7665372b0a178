# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``cv_bridge`` by its own name, without OpenCV."""

import sys

from cv_bridge import CvBridge, CvBridgeError
from hypothesis import given, strategies as st
import numpy as np
import pytest
from sensor_msgs.msg import Image
from std_msgs.msg import Header

BRIDGE = CvBridge()
COLOURS = np.array([[[255, 0, 0], [0, 255, 0]], [[0, 0, 255], [10, 20, 30]]], np.uint8)
"""Blue, green, red, and a dark one; as bgr8."""


@given(
    st.sampled_from(['8UC1', '8UC3', '16UC1', '32FC1', '32FC2', '64FC4', '16SC3', '8SC1']),
    st.integers(1, 5),
    st.integers(1, 5),
)
def test_an_array_becomes_an_image_and_back(encoding, height, width):
    dtype, channels = BRIDGE.encoding_to_dtype_with_channels(encoding)
    shape = (height, width) if channels == 1 else (height, width, channels)
    array = np.arange(np.prod(shape)).reshape(shape).astype(dtype)
    image = BRIDGE.cv2_to_imgmsg(array, header=Header(frame_id='camera'))
    assert (image.encoding, image.height, image.width) == (encoding, height, width)
    assert (image.header.frame_id, image.is_bigendian) == ('camera', 0)
    assert image.step == array.itemsize * width * channels
    back = BRIDGE.imgmsg_to_cv2(image)
    assert back.dtype == array.dtype
    assert np.array_equal(back, array)


def test_rows_may_be_longer_than_their_pixels_and_bytes_the_other_way_round():
    image = Image(height=2, width=2, encoding='16UC1', step=6, is_bigendian=1)
    image.data = [0, 1, 0, 2, 9, 9, 1, 0, 2, 0, 9, 9]
    assert BRIDGE.imgmsg_to_cv2(image).tolist() == [[1, 2], [256, 512]]


def test_an_array_shares_the_bytes_of_its_image():
    image = BRIDGE.cv2_to_imgmsg(COLOURS, 'bgr8')
    BRIDGE.imgmsg_to_cv2(image, 'bgr8')[0, 0] = 7
    assert list(image.data[:3]) == [7, 7, 7]


def test_colours_are_converted_as_opencv_does():
    image = BRIDGE.cv2_to_imgmsg(COLOURS, 'bgr8')
    assert BRIDGE.imgmsg_to_cv2(image, 'rgb8')[0, 0].tolist() == [0, 0, 255]
    assert BRIDGE.imgmsg_to_cv2(image, 'mono8').tolist() == [[29, 150], [76, 22]]
    assert BRIDGE.imgmsg_to_cv2(image, 'bgra8')[1, 1].tolist() == [10, 20, 30, 255]
    grey = BRIDGE.cv2_to_imgmsg(np.array([[3, 200]], np.uint8), 'mono8')
    assert BRIDGE.imgmsg_to_cv2(grey, 'bgr8').tolist() == [[[3] * 3, [200] * 3]]
    assert BRIDGE.imgmsg_to_cv2(grey, 'mono16').tolist() == [[771, 51400]]
    fine = BRIDGE.cv2_to_imgmsg(np.array([[771, 65535]], np.uint16), 'mono16')
    assert BRIDGE.imgmsg_to_cv2(fine, 'mono8').tolist() == [[3, 255]]


@pytest.mark.parametrize(
    ('image', 'desired', 'text'),
    [
        (BRIDGE.cv2_to_imgmsg(COLOURS), 'bgr8', r'\[8UC3\] is not a color format'),
        (BRIDGE.cv2_to_imgmsg(COLOURS, 'bgr8'), '32FC1', r'\[32FC1\] is not a color format'),
        (BRIDGE.cv2_to_imgmsg(COLOURS, 'bgr8'), 'bgr9', r'Unrecognized image encoding \[bgr9\]'),
        (Image(encoding='nonsense'), 'bgr8', 'Unrecognized image encoding'),
        (Image(height=2, width=2, step=2, encoding='mono8'), 'mono8', '2 rows of 2 bytes; it has'),
        (Image(height=1, width=4, step=2, encoding='mono8'), 'mono8', 'rows of 2'),
    ],
)
def test_what_cannot_be_converted_is_said(image, desired, text):
    with pytest.raises(CvBridgeError, match=text):
        BRIDGE.imgmsg_to_cv2(image, desired)


def test_arrays_that_are_no_such_images_are_refused():
    with pytest.raises(TypeError, match='not a numpy array'):
        BRIDGE.cv2_to_imgmsg([[1, 2]])
    with pytest.raises(CvBridgeError, match='bgr8, but image has incompatible type 8UC1'):
        BRIDGE.cv2_to_imgmsg(np.zeros((2, 2), np.uint8), 'bgr8')
    with pytest.raises(CvBridgeError, match='an image has no int64'):
        BRIDGE.cv2_to_imgmsg(np.zeros((2, 2), np.int64))


def test_the_numbers_of_types_are_those_of_opencv():
    assert BRIDGE.encoding_to_cvtype2('bgr8') == 16
    assert BRIDGE.encoding_to_cvtype2('32FC1') == 5
    assert BRIDGE.cvtype2_to_dtype_with_channels(16) == ('uint8', 3)


@pytest.mark.parametrize('shape', [(16, 16), (16, 16, 3)])
def test_a_jpeg_goes_there_and_back_without_opencv(shape, monkeypatch):
    monkeypatch.setitem(sys.modules, 'cv2', None)
    array = np.full(shape, 100, np.uint8)
    message = BRIDGE.cv2_to_compressed_imgmsg(array)
    assert (message.format, bytes(message.data[:2])) == ('jpg', b'\xff\xd8')
    back = BRIDGE.compressed_imgmsg_to_cv2(message)
    assert back.shape == shape
    assert np.abs(back.astype(int) - 100).max() <= 2
    with pytest.raises(CvBridgeError, match='pip install opencv'):
        BRIDGE.cv2_to_compressed_imgmsg(array, 'png')
    message.data = b'\x89PNG'
    with pytest.raises(CvBridgeError, match='no JPEG'):
        BRIDGE.compressed_imgmsg_to_cv2(message)
