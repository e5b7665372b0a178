# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``map_of_world``: the occupancy grid of a simulated world, as a file or on ``/map``.

::

    ros2 run amr_description map_of_world warehouse              # warehouse.pgm and .yaml
    ros2 run amr_description map_of_world hall.xml -o maps/hall --resolution 0.02
    ros2 run amr_description map_of_world warehouse --publish    # /map, latched, until Ctrl-C

It is the section of the world at the height of the lidar (see sim/occupancy.py). With
``--publish`` it is a node: ``/map`` (``nav_msgs/msg/OccupancyGrid``, RELIABLE, transient local,
depth 1) and the service ``~/map`` (``nav_msgs/srv/GetMap``), with the parameters ``topic_name``
and ``frame_id`` of map_server.

Exit codes: 0; 1 when there is no such world, or no map can be made of it or written; 2 when the
command line is wrong.
"""

import argparse
from dataclasses import dataclass
from pathlib import Path
import sys

from amr_description.argument_types import finite
from amr_description.errors import AmrError
from amr_description.maps.grid import FREE, OccupancyGrid, OCCUPIED
from amr_description.maps.map_files import save_map
from amr_description.parameters import parameter
from amr_description.ros_arguments import other_arguments
from amr_description.sim.occupancy import map_of_world, MapSettings

_DEFAULTS = MapSettings()


@dataclass(frozen=True)
class MapTopicParameters:
    """Where a map is published; names and defaults are those of map_server."""

    topic_name: str = parameter('map', 'Topic of the map', not_empty=True, read_only=True)
    frame_id: str = parameter('map', 'Frame of the map', not_empty=True, read_only=True)


def parser() -> argparse.ArgumentParser:
    """Return the parser of the words before the ROS arguments."""
    options = argparse.ArgumentParser(
        prog='map_of_world',
        description='Make the occupancy grid of a world: what a level lidar sees of all that '
        'never moves.',
        epilog='Exit code: 0; 1 no such world, or no map of it; 2 wrong arguments.',
        allow_abbrev=False,
    )
    add = options.add_argument
    add('world', metavar='WORLD', help='a shipped world by name, or the path of an MJCF file')
    add('-o', '--output', metavar='NAME', type=Path,
        help='write NAME.pgm and NAME.yaml (default: the name of the world, in this folder; with '
        '--publish: nothing)')  # fmt: skip
    add('--resolution', metavar='M', type=finite, default=_DEFAULTS.resolution,
        help='edge of a cell in m (default: %(default)s)')  # fmt: skip
    add('--height', metavar='M', type=finite, default=_DEFAULTS.height,
        help="height of the section in m (default: %(default)s, that of amr's lidar)")  # fmt: skip
    add('--top', metavar='M', type=finite,
        help='take all that is between --height and this height, in m')  # fmt: skip
    add('--start', metavar=('X', 'Y'), nargs=2, type=finite, default=_DEFAULTS.start,
        help='what can be reached from here is free, in m (default: 0 0)')  # fmt: skip
    add('--padding', metavar='M', type=finite, default=_DEFAULTS.padding,
        help='how far the map reaches beyond everything, in m (default: %(default)s)')  # fmt: skip
    add('--extent', metavar=('X', 'Y', 'TO_X', 'TO_Y'), nargs=4, type=finite,
        help='of the map in m, in place of that')  # fmt: skip
    add('--publish', action='store_true', help='publish it on /map, until Ctrl-C')
    return options


def settings_of(options: argparse.Namespace) -> MapSettings:
    """Return what the command line asks for."""
    return MapSettings(
        height=options.height,
        top=options.top,
        resolution=options.resolution,
        start=(options.start[0], options.start[1]),
        padding=options.padding,
        extent=tuple(options.extent) if options.extent else None,
    )


def write(grid: OccupancyGrid, name: Path) -> None:
    """Write a map, and print where, and what is in it. Raises MapError."""
    image, metadata = save_map(grid, name)
    share = [100.0 * float((grid.cells == each).mean()) for each in (FREE, OCCUPIED)]
    print(
        f'{image}, {metadata}: {grid.width} x {grid.height} cells of {grid.resolution:g} m, '
        f'{share[0]:.1f} % free, {share[1]:.1f} % occupied'
    )


def publish(grid: OccupancyGrid, args: list[str]) -> int:
    """Publish a map until asked to stop; return the exit code."""
    from nav2_msgs.srv import LoadMap
    from rclpy.node import Node

    from amr_description.navigation.ros.map_service import MapService
    from amr_description.ros.parameters import declare
    from amr_description.ros.runtime import run

    def make_node() -> Node:
        node = Node('map_of_world')
        parameters = declare(node, MapTopicParameters)
        service = MapService(node, parameters.topic_name, parameters.frame_id)
        service.take(grid)
        service.publish()
        if node.resolve_topic_name(parameters.topic_name).endswith('/map'):  # not a map beside it
            node.create_service(LoadMap, 'map_server/load_map', service.load)
        node.get_logger().info(
            f'Published a map of {grid.width} x {grid.height} cells of {grid.resolution:g} m'
        )
        return node

    return run(make_node, args)


def main(args: list[str] | None = None) -> int:
    """Run the executable; return its exit code."""
    given = sys.argv[1:] if args is None else args
    options = parser().parse_args(other_arguments(given))
    try:
        grid = map_of_world(options.world, settings_of(options))
        if options.output is not None or not options.publish:
            write(grid, options.output or Path(Path(options.world).stem))
    except AmrError as error:
        print(f'map_of_world: {error}', file=sys.stderr)
        return error.exit_code
    if not options.publish:
        return 0
    return publish(grid, given)


if __name__ == '__main__':
    sys.exit(main())
