# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``map_saver_cli``: write the map of a topic into files, like that of nav2_map_server (Jazzy).

::

    ros2 run nav2_map_server map_saver_cli -f hall                  # hall.pgm, hall.yaml
    ros2 run nav2_map_server map_saver_cli -t /left/map -f maps/left --fmt png --mode scale

Exit codes are those of the original: 0; 1 when no map came, or it cannot be written; 255 when the
command line is wrong. Flags that are not known are refused; numbers that are none, too, which the
original takes for 0.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
import math
from pathlib import Path
import sys
import time

from nav_msgs.msg import OccupancyGrid
from rclpy.logging import get_logger
from rclpy.node import Node
from rclpy.qos import QoSProfile

from amr_description.errors import MapError, UsageError
from amr_description.maps.map_files import (
    FREE_THRESH,
    IMAGE_FORMATS,
    MapMode,
    OCCUPIED_THRESH,
    save_map,
    SaveParameters,
)
from amr_description.navigation.ros.messages import grid_of
from amr_description.parameters import parameter
from amr_description.ros.parameters import declare
from amr_description.ros.qos import LATCHED
from amr_description.ros.runtime import argument_errors, program, ros
from amr_description.ros.service_calls import wait_until
from amr_description.ros_arguments import other_arguments

USAGE = """\
Usage:
  map_saver_cli [arguments] [--ros-args ROS remapping args]

Arguments:
  -h/--help
  -t <map_topic>
  -f <mapname>
  --occ <threshold_occupied>
  --free <threshold_free>
  --fmt <image_format>
  --mode trinary(default)/scale/raw

NOTE: --ros-args should be passed at the end of command line"""

_FLAGS = ('-t', '-f', '--occ', '--free', '--fmt', '--mode')


class MapArgumentsError(UsageError):
    """The command line is wrong; the exit code is that of the original."""

    exit_code = 255


@dataclass(frozen=True)
class MapSaverParameters:
    """The parameters of the node map_saver."""

    save_map_timeout: float = parameter(
        2.0, 'How long to wait for the map', unit='s', above=0.0, read_only=True
    )
    free_thresh_default: float = parameter(
        FREE_THRESH, 'Threshold of free cells without --free', minimum=0.0, maximum=1.0,
        read_only=True,
    )  # fmt: skip
    occupied_thresh_default: float = parameter(
        OCCUPIED_THRESH, 'Threshold of occupied cells without --occ', minimum=0.0, maximum=1.0,
        read_only=True,
    )  # fmt: skip
    map_subscribe_transient_local: bool = parameter(
        True, 'Whether the map is latched by its publisher', read_only=True
    )


@dataclass(frozen=True)
class SaveRequest:
    """What the command line asks for."""

    topic: str = 'map'
    name: str = ''
    """Of the files; empty: one of the time."""
    parameters: SaveParameters = field(
        # 0 stands for the default, as in the original.
        default_factory=lambda: SaveParameters(image_format='', occupied_thresh=0, free_thresh=0)
    )


def parse(words: Sequence[str]) -> SaveRequest | None:
    """
    Read a command line without its ROS arguments; None: help is asked for.

    Raises ArgumentsError.
    """
    request, rest = SaveRequest(), iter(words)
    for flag in rest:
        if flag in ('-h', '--help'):
            return None
        if flag not in _FLAGS:
            raise MapArgumentsError(f'Wrong argument: {flag}; there are {", ".join(_FLAGS)}')
        value = next(rest, None)
        if value is None:
            raise MapArgumentsError(f'Wrong argument: {flag} should be followed by a value.')
        request = _with_flag(request, flag, value)
    return request


def _with_flag(request: SaveRequest, flag: str, value: str) -> SaveRequest:
    chosen = request.parameters
    match flag:
        case '-t':
            return replace(request, topic=value)
        case '-f':
            return replace(request, name=value)
        case '--occ':
            chosen = replace(chosen, occupied_thresh=_threshold(flag, value))
        case '--free':
            chosen = replace(chosen, free_thresh=_threshold(flag, value))
        case '--fmt':
            chosen = replace(chosen, image_format=value.lower())
        case '--mode':
            if value not in set(MapMode):
                raise MapArgumentsError(f"--mode is '{value}'; it must be {', '.join(MapMode)}")
            chosen = replace(chosen, mode=MapMode(value))
    return replace(request, parameters=chosen)


def _threshold(flag: str, word: str) -> float:
    try:
        value = float(word)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise MapArgumentsError(f"{flag} is '{word}'; it must be a number from 0 to 1")
    return value


def completed(
    request: SaveRequest, defaults: MapSaverParameters, now: float
) -> tuple[Path, SaveParameters, list[str]]:
    """
    Return name and parameters with their defaults, and what to warn of.

    Args:
        request: of the command line.
        defaults: the parameters of the node.
        now: the time of day, s since 1970.
    """
    chosen, lines = request.parameters, []
    name = request.name
    if not name:
        name = f'map_{int(now)}'
        lines.append(f'Map file unspecified. Map will be saved to {name} file')
    chosen = replace(
        chosen,
        free_thresh=chosen.free_thresh or defaults.free_thresh_default,
        occupied_thresh=chosen.occupied_thresh or defaults.occupied_thresh_default,
        image_format=chosen.image_format or ('png' if chosen.mode is MapMode.SCALE else 'pgm'),
    )
    if chosen.image_format not in IMAGE_FORMATS:
        lines.append(f"Format '{chosen.image_format}' is not usable. Using 'png' instead")
        chosen = replace(chosen, image_format='png')
    if chosen.mode is MapMode.SCALE and chosen.image_format == 'pgm':
        lines.append(
            "Map mode 'scale' requires transparency, but format 'pgm' does not support it. "
            "Consider switching image format to 'png'."
        )
    return Path(name), chosen, lines


def save(node: Node, request: SaveRequest) -> None:
    """Wait for a map and write it. Raises MapError."""
    parameters = declare(node, MapSaverParameters)
    logger = node.get_logger()
    name, chosen, lines = completed(request, parameters, time.time())
    topic = request.topic or 'map'
    logger.info(f"Saving map from '{topic}' topic to '{name}' file")
    for line in lines:
        logger.warning(line)
    latched = parameters.map_subscribe_transient_local
    found: list[OccupancyGrid] = []
    with argument_errors():
        node.create_subscription(
            OccupancyGrid, topic, found.append, LATCHED if latched else QoSProfile(depth=10)
        )
    timeout = parameters.save_map_timeout
    if not wait_until(node, lambda: found or None, timeout=timeout, of_message=True):
        raise MapError(_nothing(node, topic, timeout))
    try:
        grid = grid_of(found[-1])
    except ValueError as error:
        raise MapError(f"the map on '{topic}' cannot be saved: it is of {error}") from error
    image, metadata = save_map(grid, name, chosen)
    logger.info(f'Map saved successfully: {image}, {metadata}: {grid.width} x {grid.height} cells')


def _nothing(node: Node, topic: str, timeout: float) -> str:
    """Return why no map came, as far as it can be seen."""
    name = node.resolve_topic_name(topic)
    ends = node.get_publishers_info_by_topic(name)
    asked = f"Failed to save the map: no map came on '{name}' within {timeout:g} s"
    if not ends:
        return f'{asked}: nobody publishes it; -t names the topic, -p save_map_timeout:= the time'
    return (
        f'{asked}, which {ends[0].node_name} publishes as {ends[0].topic_type}, '
        f'{ends[0].qos_profile.reliability.name}, {ends[0].qos_profile.durability.name}; for one '
        'that is not latched: -p map_subscribe_transient_local:=false'
    )


def run_saver(args: list[str] | None) -> int:
    """Save a map; return the exit code."""
    given = sys.argv[1:] if args is None else args
    try:
        request = parse(other_arguments(given))
    except MapArgumentsError as error:
        get_logger('map_saver_cli').error(str(error))
        return error.exit_code
    if request is None:
        print(USAGE, flush=True)
        return 0
    with ros(given):
        with argument_errors():
            node = Node('map_saver')
        try:
            save(node, request)
        finally:
            node.destroy_node()
    return 0


def main(args: list[str] | None = None) -> int:
    """Run the executable; return its exit code."""
    return program(lambda: run_saver(args))


if __name__ == '__main__':
    sys.exit(main())
