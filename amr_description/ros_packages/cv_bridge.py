# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``cv_bridge``: images of ROS as the arrays that OpenCV takes, and back.

It needs no OpenCV. Colours are converted here, grey with OpenCV's own weights and rounding. Files
that are compressed are read and written by OpenCV where it is installed, JPEG without it as well.

An image without padding shares its bytes with the array: who draws in one draws in the other.
"""

import importlib
import sys
from typing import Any

import numpy as np
from sensor_msgs.msg import CompressedImage, Image
from std_msgs.msg import Header

_DEPTHS = {
    '8U': np.uint8, '8S': np.int8, '16U': np.uint16, '16S': np.int16, '32S': np.int32,
    '32F': np.float32, '64F': np.float64,
}  # fmt: skip
_CV_DEPTHS = tuple(_DEPTHS)
"""In the order of OpenCV's numbers for them."""
_COLOURS = {
    'mono8': ('8UC1', 'Y'), 'mono16': ('16UC1', 'Y'),
    'bgr8': ('8UC3', 'BGR'), 'rgb8': ('8UC3', 'RGB'),
    'bgra8': ('8UC4', 'BGRA'), 'rgba8': ('8UC4', 'RGBA'),
    'bgr16': ('16UC3', 'BGR'), 'rgb16': ('16UC3', 'RGB'),
    'bgra16': ('16UC4', 'BGRA'), 'rgba16': ('16UC4', 'RGBA'),
    'bayer_rggb8': ('8UC1', ''), 'bayer_bggr8': ('8UC1', ''), 'bayer_gbrg8': ('8UC1', ''),
    'bayer_grbg8': ('8UC1', ''), 'yuv422': ('8UC2', ''), 'yuv422_yuy2': ('8UC2', ''),
}  # fmt: skip
"""Encoding -> type of its elements, and its channels in their order; '': no colours here."""
_GREY = {'B': 1868, 'G': 9617, 'R': 4899}
"""OpenCV's weights of grey, in 1/2^14."""
_GREY_BITS = 14


class CvBridgeError(TypeError):
    """An image cannot be converted as it is asked for."""


class CvBridge:
    """Converts between messages and arrays."""

    def encoding_to_cvtype2(self, encoding: str) -> int:
        """Return OpenCV's number of a type. Raises CvBridgeError: there is none."""
        dtype, channels = _elements(encoding)
        return self.dtype_with_channels_to_cvtype2(dtype, channels)

    def dtype_with_channels_to_cvtype2(self, dtype: Any, n_channels: int) -> int:
        """Return OpenCV's number of a type: its depth, and its channels less one in bits."""
        depth = next(
            place for place, name in enumerate(_CV_DEPTHS) if _DEPTHS[name] == np.dtype(dtype)
        )
        return depth + ((n_channels - 1) << 3)

    def cvtype2_to_dtype_with_channels(self, cvtype: int) -> tuple[str, int]:
        """Return the name of the elements' type and the number of channels."""
        return np.dtype(_DEPTHS[_CV_DEPTHS[cvtype & 7]]).name, (cvtype >> 3) + 1

    def encoding_to_dtype_with_channels(self, encoding: str) -> tuple[str, int]:
        """Return the name of the elements' type and the number of channels of an encoding."""
        dtype, channels = _elements(encoding)
        return dtype.name, channels

    def imgmsg_to_cv2(self, img_msg: Image, desired_encoding: str = 'passthrough') -> Any:
        """
        Return the array of an image, of the shape (height, width) or (height, width, channels).

        Args:
            img_msg: The image.
            desired_encoding: ``bgr8``, ``mono8`` …; ``passthrough``: that of the image.

        Raises:
            CvBridgeError: The encoding is unknown, or cannot be converted; or bytes are missing.
        """
        dtype, channels = _elements(img_msg.encoding)
        height, width, step = img_msg.height, img_msg.width, img_msg.step
        stored = dtype.newbyteorder('>' if img_msg.is_bigendian else '<')
        row = width * channels * dtype.itemsize
        if step < row or len(img_msg.data) < step * height:
            raise CvBridgeError(
                f'an image of {width} x {height} pixels, {img_msg.encoding}, takes {height} rows '
                f'of {row} bytes; it has {len(img_msg.data)} bytes in rows of {step}'
            )
        shape = (height, width) if channels == 1 else (height, width, channels)
        pixel = channels * dtype.itemsize
        strides = (step, pixel) if channels == 1 else (step, pixel, dtype.itemsize)
        image = np.ndarray(shape, stored, img_msg.data, strides=strides)
        if img_msg.is_bigendian == (sys.byteorder == 'little'):
            image = image.astype(dtype)
        return _converted(image, img_msg.encoding, desired_encoding)

    def cv2_to_imgmsg(
        self, cvim: Any, encoding: str = 'passthrough', header: Header | None = None
    ) -> Image:
        """
        Return the image of an array of numpy.

        Args:
            cvim: Of the shape (height, width) or (height, width, channels).
            encoding: What its numbers mean; ``passthrough``: only their type, as ``8UC3``.
            header: Of the image.

        Raises:
            TypeError: It is no array.
            CvBridgeError: Its type is not that of the encoding.
        """
        if not isinstance(cvim, np.ndarray | np.generic):
            raise TypeError('Your input type is not a numpy array')
        shape: tuple[int, ...] = cvim.shape
        image = Image(header=Header() if header is None else header)
        image.height, image.width = shape[:2]
        channels = 1 if len(shape) < 3 else shape[2]
        own = f'{_name_of(cvim.dtype)}C{channels}'
        if encoding == 'passthrough':
            image.encoding = own
        else:
            image.encoding = encoding
            if _elements(encoding) != (cvim.dtype, channels):
                raise CvBridgeError(
                    f'encoding specified as {encoding}, but image has incompatible type {own}'
                )
        image.is_bigendian = cvim.dtype.byteorder == '>'
        image.data.frombytes(np.ascontiguousarray(cvim).tobytes())
        image.step = len(image.data) // image.height if image.height else 0
        return image

    def compressed_imgmsg_to_cv2(
        self, cmprs_img_msg: CompressedImage, desired_encoding: str = 'passthrough'
    ) -> Any:
        """Return the array of a compressed image, ``bgr8`` or ``mono8``, else as asked for."""
        octets = np.frombuffer(bytes(cmprs_img_msg.data), np.uint8)
        image = _decoded(octets)
        encoding = 'mono8' if image.ndim == 2 else 'bgra8' if image.shape[2] == 4 else 'bgr8'
        return _converted(image, encoding, desired_encoding)

    def cv2_to_compressed_imgmsg(self, cvim: Any, dst_format: str = 'jpg') -> CompressedImage:
        """Return an array, ``bgr8`` or ``mono8``, as a compressed image."""
        if not isinstance(cvim, np.ndarray | np.generic):
            raise TypeError('Your input type is not a numpy array')
        message = CompressedImage(format=dst_format)
        message.data.frombytes(_encoded(np.asarray(cvim), dst_format))
        return message


def _elements(encoding: str) -> tuple[np.dtype[Any], int]:
    """Return type and channels of an encoding. Raises CvBridgeError."""
    name = _COLOURS[encoding][0] if encoding in _COLOURS else encoding
    depth, _, channels = name.partition('C')
    if depth not in _DEPTHS or (channels and not channels.isdigit()):
        raise CvBridgeError(f'Unrecognized image encoding [{encoding}]')
    return np.dtype(_DEPTHS[depth]), int(channels or 1)


def _name_of(dtype: Any) -> str:
    """Return OpenCV's name of a type of numbers. Raises CvBridgeError."""
    plain = np.dtype(dtype).newbyteorder('=')
    for name, kind in _DEPTHS.items():
        if kind == plain:
            return name
    raise CvBridgeError(f'an image has no {plain.name}; {", ".join(_DEPTHS)} are possible')


def _converted(image: Any, encoding: str, desired: str) -> Any:
    """Return an image in another encoding. Raises CvBridgeError: there is no way."""
    if desired in ('passthrough', encoding):
        return image
    _elements(desired)
    for asked, other in ((encoding, desired), (desired, encoding)):
        if not _COLOURS.get(asked, ('', ''))[1]:
            raise CvBridgeError(
                f'[{asked}] is not a color format. but [{other}] is. The conversion does not make '
                'sense'
                if _COLOURS.get(other, ('', ''))[1]
                else f'there is no conversion from {encoding} to {desired} here'
            )
    (source, begin), (target, end) = _COLOURS[encoding], _COLOURS[desired]
    planes = image[..., None] if image.ndim == 2 else image
    by_name = {name: planes[..., place] for place, name in enumerate(begin)}
    if begin == 'Y':
        by_name |= dict.fromkeys('BGR', by_name['Y'])
    elif end == 'Y':
        weighted = sum(by_name[name].astype(np.uint32) * _GREY[name] for name in 'BGR')
        by_name['Y'] = (weighted + (1 << _GREY_BITS - 1) >> _GREY_BITS).astype(image.dtype)
    if 'A' in end and 'A' not in by_name:
        by_name['A'] = np.full(planes.shape[:2], np.iinfo(image.dtype).max, image.dtype)
    made = by_name['Y'] if end == 'Y' else np.stack([by_name[name] for name in end], axis=-1)
    if source[:2] == target[:2]:
        return np.ascontiguousarray(made)
    factor = 255.0 / 65535.0 if target.startswith('8U') else 65535.0 / 255.0
    return np.rint(made * factor).astype(_elements(desired)[0])


def _decoded(octets: Any) -> Any:
    """Return the array of a file. Raises CvBridgeError."""
    try:
        cv2 = importlib.import_module('cv2')
    except ImportError:
        import simplejpeg

        data = octets.tobytes()
        if not simplejpeg.is_jpeg(data):
            raise CvBridgeError(_needs_opencv('this image is no JPEG, and')) from None
        grey = simplejpeg.decode_jpeg_header(data)[2] == 'Gray'
        image = simplejpeg.decode_jpeg(data, 'GRAY' if grey else 'BGR')
        return image[..., 0] if grey else image
    image = cv2.imdecode(octets, cv2.IMREAD_UNCHANGED)
    if image is None:
        raise CvBridgeError('OpenCV cannot read the image')
    return image


def _encoded(image: Any, form: str) -> bytes:
    """Return the file of an array. Raises CvBridgeError."""
    try:
        cv2 = importlib.import_module('cv2')
    except ImportError:
        import simplejpeg

        if form not in ('jpg', 'jpeg'):
            raise CvBridgeError(_needs_opencv(f'to write {form}')) from None
        if image.dtype != np.uint8:
            raise CvBridgeError(f'a JPEG has 8 bits, not {image.dtype.name}') from None
        planes = np.ascontiguousarray(image[..., None] if image.ndim == 2 else image)
        space = {1: 'GRAY', 3: 'BGR', 4: 'BGRA'}[planes.shape[2]]
        sampling = 'Gray' if space == 'GRAY' else '420'
        return bytes(simplejpeg.encode_jpeg(planes, 95, space, sampling))
    is_written, octets = cv2.imencode(f'.{form}', image)
    if not is_written:
        raise CvBridgeError(f'OpenCV cannot write {form}')
    return bytes(octets.tobytes())


def _needs_opencv(what: str) -> str:
    return f"{what} OpenCV is needed: 'python -m pip install opencv-python-headless'"
