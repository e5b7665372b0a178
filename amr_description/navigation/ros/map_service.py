# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A map as map_server offers it: latched on a topic, and by a service of the node."""

from collections.abc import Callable
from pathlib import Path

from nav2_msgs.srv import LoadMap
from nav_msgs.msg import OccupancyGrid as OccupancyGridMessage
from nav_msgs.srv import GetMap
from rclpy.node import Node

from amr_description.ament_index import resolve_uri
from amr_description.errors import AmrError, MapDataError, MapError, MapMetadataError
from amr_description.maps.grid import OccupancyGrid
from amr_description.maps.map_files import load_map
from amr_description.navigation.ros.messages import grid_message
from amr_description.ros.qos import LATCHED


class MapService:
    """
    The topic and the service ``~/map`` (``nav_msgs/srv/GetMap``) of a node.

    The topic is RELIABLE, transient local, of depth 1, as costmaps and amcl subscribe to it.
    """

    def __init__(
        self, node: Node, topic: str, frame_id: str, is_active: Callable[[], bool] = lambda: True
    ) -> None:
        """
        Make them.

        Args:
            node: Has them.
            topic: The name of the topic.
            frame_id: The frame of the map.
            is_active: Whether requests are answered; to others the answer is an empty map.
        """
        self._node = node
        self._frame_id = frame_id
        self._is_active = is_active
        self.message = OccupancyGridMessage()
        """The map; without cells as long as there is none."""
        self._publisher = node.create_publisher(OccupancyGridMessage, topic, LATCHED)
        self._service = node.create_service(GetMap, '~/map', self._get_map)

    def take(self, grid: OccupancyGrid) -> None:
        """Keep a map, its stamps now."""
        message = grid_message(grid, self._frame_id)
        message.header.stamp = self._node.get_clock().now().to_msg()
        message.info.map_load_time = message.header.stamp
        self.message = message

    def publish(self) -> None:
        """Publish the map, if there is one."""
        if self.message.info.width:
            self._publisher.publish(self.message)

    def destroy(self) -> None:
        """Remove topic and service."""
        self._node.destroy_publisher(self._publisher)
        self._node.destroy_service(self._service)

    def _get_map(self, request: GetMap.Request, response: GetMap.Response) -> GetMap.Response:
        if not self._is_active():
            self._node.get_logger().warning(
                'Received GetMap request but not in ACTIVE state, ignoring!'
            )
            return response
        self._node.get_logger().info('Handling GetMap request')
        response.map = self.message
        return response

    def load(self, request: LoadMap.Request, response: LoadMap.Response) -> LoadMap.Response:
        """Read the map of a file, and publish it in place of the present one: of a service."""
        logger = self._node.get_logger()
        if not self._is_active():
            logger.warning('Received LoadMap request but not in ACTIVE state, ignoring!')
            response.result = LoadMap.Response.RESULT_UNDEFINED_FAILURE
            return response
        logger.info('Handling LoadMap request')
        try:
            self.take(map_of(request.map_url, by_request=True))
        except AmrError as error:
            logger.error(f'Failed to load map yaml file: {request.map_url}: {error}')
            response.result = _result(error)
            return response
        self.publish()
        response.map = self.message
        response.result = LoadMap.Response.RESULT_SUCCESS
        return response


def map_of(url: str, *, by_request: bool) -> OccupancyGrid:
    """Return the map of a path, or of a URI. Raises AmrError."""
    if not url:
        raise MapError('the name of the .yaml file of a map is asked, and it is empty')
    path = resolve_uri(url) if '://' in url else Path(url)
    return load_map(path, by_request=by_request)


def _result(error: AmrError) -> int:
    """Return the result of loading a map for an error."""
    if isinstance(error, MapDataError):
        return int(LoadMap.Response.RESULT_INVALID_MAP_DATA)
    if isinstance(error, MapMetadataError):
        return int(LoadMap.Response.RESULT_INVALID_MAP_METADATA)
    return int(LoadMap.Response.RESULT_MAP_DOES_NOT_EXIST)
