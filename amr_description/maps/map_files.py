# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Maps in files: a ``.yaml`` and an image, as nav2_map_server of Jazzy reads and writes them.

How a pixel of brightness ``shade`` (0 black, 1 white) becomes a cell, with ``occ = 1 - shade``
(``shade`` where ``negate`` is set), as in ``map_io.cpp``::

    trinary  occ > occupied_thresh: 100;  occ < free_thresh: 0;  else -1
             (where the image has alpha, it is averaged with the colors)
    scale    not wholly opaque: -1;  occ > occupied_thresh: 100;  occ < free_thresh: 0;
             else rint(100 (occ - free_thresh) / (occupied_thresh - free_thresh))
    raw      round(255 shade) up to 100;  above: -1  (negate is not looked at)

And a cell a pixel of 8 bits::

    trinary  unknown, or between the thresholds: 205;  up to free_thresh: 254;
             from occupied_thresh on: 0
    scale    unknown: transparent;  else 255 (100 - cell) / 100
    raw      unknown: 255;  else the cell

Where the original loses something, this does not:

- Its ``.yaml`` has ``free_thresh: 0.25`` by default, with which it reads the 205 of unknown cells
  as free. The thresholds of a trinary file are 0.65 and 0.196 here, whatever those of the cells
  were, as in nav2 since pull request 5278.
- It writes three digits of the origin, -12.345 as -12.3; here it is to the nanometre.
- A file that is missing, a size or number that no map has, is one line with the file in it.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
import errno
import math
from pathlib import Path
import re
from stat import S_ISDIR, S_ISREG
from typing import Any

import numpy as np
from numpy.typing import NDArray
import yaml

from amr_description.errors import MapDataError, MapError, MapMetadataError, ParameterError
from amr_description.maps.grid import FREE, OccupancyGrid, OCCUPIED, UNKNOWN
from amr_description.maps.images import Bytes, MapImage, pgm, png, read_image
from amr_description.maps.pose import Pose
from amr_description.parameter_files import load_yaml, YamlError
from amr_description.text import encodable
from amr_description.trusted_files import distrust

OCCUPIED_THRESH, FREE_THRESH = 0.65, 0.25
"""Which cells count as occupied and free when a map is saved: the defaults."""
IMAGE_FORMATS = ('pgm', 'png')
"""What is written."""

_TRINARY_OCCUPIED, _TRINARY_FREE = 0.65, 0.196
"""Thresholds in the file, between which its 205 (occ 0.19608) is."""
_GRAY_UNKNOWN, _GRAY_FREE, _GRAY_OCCUPIED = 205, 254, 0
_NUMBER = re.compile(r'[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?', re.IGNORECASE)
_TRUTHS = {
    **dict.fromkeys(('y', 'yes', 'true', 'on'), True),
    **dict.fromkeys(('n', 'no', 'false', 'off'), False),
}
_KEYS = 'image, resolution, origin, negate, occupied_thresh and free_thresh'


class MapMode(StrEnum):
    """How pixels stand for cells."""

    TRINARY = 'trinary'
    SCALE = 'scale'
    RAW = 'raw'


@dataclass(frozen=True, slots=True)
class MapMetadata:
    """What the ``.yaml`` file of a map says."""

    image: Path
    resolution: float
    """Edge of a cell, m."""
    origin: Pose
    """Of the lower left corner of the image in the frame of the map."""
    occupied_thresh: float
    """A share, 0 to 1; so is ``free_thresh``."""
    free_thresh: float
    negate: bool = False
    mode: MapMode = MapMode.TRINARY


@dataclass(frozen=True, slots=True)
class SaveParameters:
    """How a map is saved; names and defaults are those of map_saver."""

    mode: MapMode = MapMode.TRINARY
    image_format: str = 'pgm'
    occupied_thresh: float = OCCUPIED_THRESH
    free_thresh: float = FREE_THRESH


def load_map(yaml_file: Path, *, by_request: bool = False) -> OccupancyGrid:
    """
    Return the map of a ``.yaml`` file and its image.

    Args:
        yaml_file: the file.
        by_request: whether somebody else names it: not every file will do then.

    Raises:
        MapMetadataError: the ``.yaml`` file cannot be used.
        MapDataError: its image cannot.
        MapError: there is no such file.
    """
    if by_request and (reason := distrust(yaml_file.expanduser())):
        raise MapMetadataError(f'{yaml_file} {reason}')
    metadata = load_metadata(yaml_file)
    path = metadata.image
    if by_request and (reason := distrust(path)):
        raise MapDataError(f'{path} {reason}')
    try:
        _require_regular(path)
        image = read_image(path.read_bytes())
    except MapDataError as error:
        raise MapDataError(f'{path}: {error}') from error
    except (OSError, ValueError) as error:  # ValueError: no file can have such a name
        reason = getattr(error, 'strerror', None) or 'it is no name of a file'
        raise MapDataError(
            f"{encodable(str(path))}: it cannot be read: {reason}; 'image' in {yaml_file} names "
            'it, relative to that file'
        ) from error
    return OccupancyGrid(cells_of(image, metadata), metadata.resolution, metadata.origin)


def _require_regular(path: Path) -> None:
    """Raise OSError: a pipe or a device may have no end, and a request may name one."""
    mode = path.stat().st_mode
    if not S_ISREG(mode) and not S_ISDIR(mode):  # of a folder the reader says it
        raise OSError(errno.EINVAL, 'it is no regular file')


def load_metadata(yaml_file: Path) -> MapMetadata:
    """Read the ``.yaml`` file of a map. Raises MapError."""
    path = Path(yaml_file).expanduser()
    try:
        _require_regular(path)
        text = path.read_text(encoding='utf-8')
    except (FileNotFoundError, NotADirectoryError):
        raise MapError(
            f'{path}: there is no such file; the .yaml file of a map is asked'
        ) from None
    except (OSError, UnicodeDecodeError) as error:
        reason = getattr(error, 'strerror', None) or 'it is not text'
        raise MapMetadataError(
            f'{path}: it cannot be read: {reason}; the .yaml file of a map is asked'
        ) from error
    try:
        # All as text: YAML 1.1 takes 1e-2 for a string, and yaml-cpp for a number.
        found = load_yaml(text, lambda each: yaml.load(each, Loader=yaml.BaseLoader))
        return _metadata(found, path.parent)
    except ParameterError as error:
        line = f':{error.where[0]}' if isinstance(error, YamlError) and error.where else ''
        raise MapMetadataError(f'{path}{line}: {error}') from error
    except MapMetadataError as error:
        raise MapMetadataError(f'{path}: {error}') from error


def _metadata(found: Any, folder: Path) -> MapMetadata:
    if not isinstance(found, dict):
        raise MapMetadataError(f'it is not the .yaml file of a map, which has {_KEYS}')
    image = found.get('image')
    if not isinstance(image, str) or not image:
        raise MapMetadataError("'image' has to name the image of the map, such as map.pgm")
    mode_name = found.get('mode', MapMode.TRINARY)
    if not isinstance(mode_name, str) or mode_name not in set(MapMode):
        raise MapMetadataError(f"'mode' is {mode_name!r}; it must be {', '.join(MapMode)}")
    resolution = _number(found, 'resolution')
    if resolution <= 0.0:
        raise MapMetadataError(f"'resolution' is {resolution:g} m; it must be above 0")
    metadata = MapMetadata(
        folder / image,
        resolution,
        _origin(found),
        _number(found, 'occupied_thresh'),
        _number(found, 'free_thresh'),
        _negate(found),
        MapMode(mode_name),
    )
    low, high = metadata.free_thresh, metadata.occupied_thresh
    if metadata.mode is MapMode.SCALE and low >= high:
        raise MapMetadataError(
            f"'free_thresh' is {low:g} and 'occupied_thresh' {high:g}; the first must be smaller"
        )
    return metadata


def _number(found: Mapping[str, Any], key: str) -> float:
    if key not in found:
        raise MapMetadataError(f"'{key}' is missing; a map has {_KEYS}")
    return _parsed(found[key], key)


def _parsed(word: object, key: str) -> float:
    if not isinstance(word, str) or not _NUMBER.fullmatch(word):
        raise MapMetadataError(f"'{key}' is {word!r}; it must be a number")
    return float(word)


def _origin(found: Mapping[str, Any]) -> Pose:
    values = found.get('origin')
    if not isinstance(values, list) or len(values) != 3:
        raise MapMetadataError(
            f"'origin' is {values!r}; it must be [x, y, yaw] of the lower left corner, m and rad"
        )
    x, y, yaw = (_parsed(each, 'origin') for each in values)
    return Pose(x, y, yaw)


def _negate(found: Mapping[str, Any]) -> bool:
    word = found.get('negate')
    if isinstance(word, str):
        if re.fullmatch(r'[-+]?\d+', word):
            return int(word) != 0
        if word.lower() in _TRUTHS:
            return _TRUTHS[word.lower()]
    raise MapMetadataError(f"'negate' is {word!r}; it must be 0 or 1")


def cells_of(image: MapImage, metadata: MapMetadata) -> NDArray[np.int8]:
    """Return the cells that an image stands for, (height, width), the lowest row first."""
    shade, alpha = image.brightness, image.alpha
    if metadata.mode is MapMode.TRINARY and alpha is not None:
        shade = (3.0 * shade + alpha) / 4.0
    cells = np.full(shade.shape, UNKNOWN, np.int8)
    if metadata.mode is MapMode.RAW:
        values = np.floor(255.0 * shade + 0.5)
        is_known = values <= OCCUPIED
        cells[is_known] = values[is_known]
        return cells[::-1]
    occ = shade if metadata.negate else 1.0 - shade
    low, high = metadata.free_thresh, metadata.occupied_thresh
    if metadata.mode is MapMode.SCALE:
        cells[:] = np.rint(np.clip((occ - low) / (high - low), 0.0, 1.0) * 100.0)
    cells[occ < low] = FREE
    cells[high < occ] = OCCUPIED
    if metadata.mode is MapMode.SCALE and alpha is not None:
        cells[alpha < 1.0] = UNKNOWN
    return cells[::-1]


def save_map(
    grid: OccupancyGrid, name: Path, parameters: SaveParameters | None = None
) -> tuple[Path, Path]:
    """
    Write a map.

    Args:
        grid: the map.
        name: of its files, without a suffix: ``maps/hall`` makes ``maps/hall.pgm`` and ``.yaml``.
        parameters: how; None: trinary, as PGM.

    Returns:
        The image and the ``.yaml`` file.

    Raises:
        MapError: the thresholds or the format cannot be, or a file cannot be written.
    """
    chosen = parameters or SaveParameters()
    _check(chosen)
    base = Path(name).expanduser()
    image = base.with_name(f'{base.name}.{chosen.image_format}')
    metadata = base.with_name(f'{base.name}.yaml')
    gray, alpha = pixels_of(grid.cells, chosen)
    data = pgm(gray) if chosen.image_format == 'pgm' else png(gray, alpha)
    for path, content in (
        (image, data),
        (metadata, metadata_text(grid, image.name, chosen).encode()),
    ):
        try:
            path.write_bytes(content)
        except OSError as error:
            raise MapError(f'{path}: it cannot be written: {error.strerror}') from error
    return image, metadata


def _check(parameters: SaveParameters) -> None:
    low, high = parameters.free_thresh, parameters.occupied_thresh
    if not 0.0 <= low < high <= 1.0:
        raise MapError(
            f'the thresholds are free {low:g} and occupied {high:g}; it must be '
            '0 <= free < occupied <= 1'
        )
    if parameters.image_format not in IMAGE_FORMATS:
        raise MapError(
            f"an image of format '{parameters.image_format}' is not written; "
            f'{" and ".join(IMAGE_FORMATS)} are'
        )


def pixels_of(cells: NDArray[np.int8], parameters: SaveParameters) -> tuple[Bytes, Bytes | None]:
    """Return gray values, and alpha where the mode has it; the highest row first."""
    values = cells[::-1].astype(np.int16)
    is_known = (values >= 0) & (values <= OCCUPIED)
    match parameters.mode:
        case MapMode.RAW:
            return np.where(is_known, values, 255).astype(np.uint8), None
        case MapMode.SCALE:
            gray = np.where(is_known, np.rint(255.0 * (100 - values) / 100.0), 127.0)
            return gray.astype(np.uint8), np.where(is_known, 255, 0).astype(np.uint8)
    gray = np.full(values.shape, _GRAY_UNKNOWN, np.uint8)
    gray[is_known & (values >= round(100.0 * parameters.occupied_thresh))] = _GRAY_OCCUPIED
    gray[is_known & (values <= round(100.0 * parameters.free_thresh))] = _GRAY_FREE
    return gray, None


def metadata_text(grid: OccupancyGrid, image: str, parameters: SaveParameters) -> str:
    """Return what the ``.yaml`` file of a map holds, its keys in the order of map_saver."""
    high, low = parameters.occupied_thresh, parameters.free_thresh
    if parameters.mode is MapMode.TRINARY:
        high, low = _TRINARY_OCCUPIED, _TRINARY_FREE
    # The message has it as float32: 0.05, not 0.05000000074505806.
    resolution = np.format_float_positional(np.float32(grid.resolution), trim='-')
    # Quoted where YAML would read it as something else.
    name = (
        yaml.safe_dump(image, allow_unicode=True, width=math.inf).removesuffix('\n...\n').strip()
    )
    return (
        f'image: {name}\n'
        f'mode: {parameters.mode}\n'
        f'resolution: {resolution}\n'
        f'origin: [{", ".join(map(_written, grid.origin))}]\n'
        'negate: 0\n'
        f'occupied_thresh: {high:g}\n'
        f'free_thresh: {low:g}\n'
    )


def _written(value: float) -> str:
    if not math.isfinite(value):
        raise MapError(f'the origin of the map is {value}; it must be a finite number')
    return f'{round(value, 9) + 0.0:.12g}'
