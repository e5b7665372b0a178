# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
r"""
``map_server``: serve a map from its files, like the executable of nav2_map_server (Jazzy).

::

    ros2 run nav2_map_server map_server --ros-args -p yaml_filename:=warehouse.yaml
    ros2 lifecycle set /map_server configure
    ros2 lifecycle set /map_server activate

    ros2 run nav2_map_server map_server --ros-args -p yaml_filename:=warehouse.yaml \
        -p autostart_node:=true

It is a lifecycle node: ``configure`` reads the files and makes topic and services, ``activate``
publishes. As in the original, nav2_lifecycle_manager does both. With ``autostart_node``, which the
nodes of newer releases of Nav2 have, it does both itself, and ends with 1 where that fails.

==============  ===================================================================================
``/map``        ``nav_msgs/msg/OccupancyGrid``, RELIABLE, transient local, depth 1
``~/map``       ``nav_msgs/srv/GetMap``; when it is not active, the answer is an empty map
``~/load_map``  ``nav2_msgs/srv/LoadMap``: read and publish other files; ``map_url`` is a path,
                or ``file://…``, or ``package://…``
==============  ===================================================================================

What differs from the original: a ``.yaml`` file that does not exist is MAP_DOES_NOT_EXIST, which
the original says only of an empty name; why a map cannot be read is one line of the log.

There is no bond to the lifecycle manager: set its ``bond_timeout`` to 0.0.
"""

from dataclasses import dataclass
import sys

from nav2_msgs.srv import LoadMap
from rclpy.lifecycle import LifecycleNode, LifecycleState, TransitionCallbackReturn
from rclpy.service import Service

from amr_description.errors import (
    AmrError,
    ParameterError,
)
from amr_description.navigation.ros.map_service import map_of, MapService
from amr_description.parameters import parameter
from amr_description.ros.node_help import print_help
from amr_description.ros.parameters import declare, values
from amr_description.ros.rclpy_internals import destroy_lifecycle_services
from amr_description.ros.runtime import argument_errors, run

_SUCCESS, _FAILURE = TransitionCallbackReturn.SUCCESS, TransitionCallbackReturn.FAILURE


@dataclass(frozen=True)
class MapServerParameters:
    """The parameters of map_server; they are read when it is configured."""

    yaml_filename: str = parameter('', 'File of the map; empty: none until ~/load_map is called')
    topic_name: str = parameter('map', 'Topic of the map', not_empty=True)
    frame_id: str = parameter('map', 'Frame of the map', not_empty=True)
    autostart_node: bool = parameter(
        False, 'Whether it configures and activates itself, at its start', read_only=True
    )


class MapServer(LifecycleNode):
    """The node."""

    def __init__(self) -> None:
        """Make it, unconfigured. Raises ParameterError."""
        super().__init__('map_server')
        self.get_logger().info('Creating')
        self._own = declare(self, MapServerParameters).yaml_filename
        """Who has started the node names it; who sets the parameter later may be anybody."""
        self._is_active = False
        self._map: MapService | None = None
        self._load_service: Service | None = None
        self.fault: AmrError | None = None
        """Why the last transition failed."""

    def on_configure(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Read the map; make topic and services."""
        self.get_logger().info('Configuring')
        parameters = values(self, MapServerParameters)
        try:
            with argument_errors():
                service = MapService(
                    self, parameters.topic_name, parameters.frame_id, lambda: self._is_active
                )
        except ParameterError as error:
            self.fault = ParameterError(f"parameter 'topic_name': {error}")
            self.get_logger().error(str(self.fault))
            return _FAILURE
        try:
            if name := parameters.yaml_filename:
                service.take(map_of(name, by_request=name != self._own))
            else:
                self.get_logger().info(
                    "yaml-filename parameter is empty, set map through 'load_map'-service"
                )
        except AmrError as error:
            service.destroy()
            self.fault = error
            self.get_logger().error(
                f'Failed to load map yaml file: {parameters.yaml_filename}: {error}'
            )
            return _FAILURE
        self._map = service
        self._load_service = self.create_service(LoadMap, '~/load_map', service.load)
        return _SUCCESS

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Publish the map."""
        self.get_logger().info('Activating')
        assert self._map is not None, 'it was configured'
        self._is_active = True
        self._map.publish()
        return _SUCCESS

    def on_deactivate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Answer no more."""
        self.get_logger().info('Deactivating')
        self._is_active = False
        return _SUCCESS

    def on_cleanup(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Remove topic and services."""
        self.get_logger().info('Cleaning up')
        self._remove()
        return _SUCCESS

    def on_shutdown(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Remove topic and services, from whatever state."""
        self.get_logger().info('Shutting down')
        self._remove()
        return _SUCCESS

    def destroy_node(self) -> None:
        """Remove the node, and its services."""
        super().destroy_node()
        destroy_lifecycle_services(self)

    def _remove(self) -> None:
        self._is_active = False
        if self._map is not None:
            self._map.destroy()
            self.destroy_service(self._load_service)
            self._map = self._load_service = None


def _make_node() -> MapServer:
    """Return the node, active where it starts itself. Raises AmrError."""
    node = MapServer()
    if not node.get_parameter('autostart_node').value:
        return node
    node.trigger_configure()
    if node.fault is not None:
        node.destroy_node()
        raise node.fault
    node.trigger_activate()
    return node


def main(args: list[str] | None = None) -> int:
    """Run the executable; return its exit code."""
    purpose = 'Serve a map from its files: on /map, latched, and by the service ~/map.'
    if print_help(args, 'map_server', purpose, MapServerParameters):
        return 0
    return run(_make_node, args)


if __name__ == '__main__':
    sys.exit(main())
