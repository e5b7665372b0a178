# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The services of Nav2's costmaps: what they are, and what is forgotten of them.

There is one costmap, of the map's size; the local one is the part of it around the robot, in the
frame of the map. To clear one is to forget what scans have seen that the map has not.
"""

from array import array
from collections.abc import Callable
from typing import Any

from geometry_msgs.msg import PoseStamped
from nav2_msgs.msg import CostmapMetaData
from nav2_msgs.srv import (
    ClearCostmapAroundPose,
    ClearCostmapAroundRobot,
    ClearCostmapExceptRegion,
    ClearEntireCostmap,
    GetCostmap,
)
from rclpy.node import Node

from amr_description.errors import NavigationError
from amr_description.maps.pose import Pose
from amr_description.navigation.costmap import Costmap
from amr_description.navigation.ros.messages import pose_message
from amr_description.navigation.ros.surroundings import Surroundings

LOCAL_SIDE = 3.0
"""m: width and height of the local costmap, as in nav2_bringup."""


class CostmapServices:
    """For ``global_costmap`` and ``local_costmap``."""

    def __init__(self, node: Node, surroundings: Surroundings, frame: str) -> None:
        """Serve; ``frame``: of the costmaps."""
        self._node, self._surroundings, self._frame = node, surroundings, frame
        for which in ('global', 'local'):
            name = f'{which}_costmap'
            self._serve(ClearEntireCostmap, f'{name}/clear_entirely_{name}', self._clear)
            self._serve(
                ClearCostmapExceptRegion, f'{name}/clear_except_{name}', self._clear_except
            )
            self._serve(ClearCostmapAroundRobot, f'{name}/clear_around_{name}', self._clear_around)
            self._serve(ClearCostmapAroundPose, f'{name}/clear_around_pose_{name}', self._clear_at)
        # nav2_simple_commander asks by these names.
        local = 'local_costmap/clear_costmap'
        self._serve(ClearCostmapExceptRegion, f'{local}_except_region', self._clear_except)
        self._serve(ClearCostmapAroundRobot, f'{local}_around_robot', self._clear_around)
        self._serve(ClearCostmapAroundPose, f'{local}_around_pose', self._clear_at)
        node.create_service(GetCostmap, 'global_costmap/get_costmap', self._get_global)
        node.create_service(GetCostmap, 'local_costmap/get_costmap', self._get_local)

    def _serve(self, kind: Any, name: str, clear: Callable[[Any, Costmap], object]) -> None:
        def answer(request: Any, response: Any) -> Any:
            try:
                clear(request, self._costmap())
            except NavigationError as error:
                self._node.get_logger().error(f'{name}: {error}')
            return response

        self._node.create_service(kind, name, answer)

    def _costmap(self) -> Costmap:
        """Return the costmap. Raises NavigationError: there is none."""
        if self._surroundings.costmap is None:
            raise NavigationError(0, self._surroundings.fault())
        return self._surroundings.costmap

    def _clear(self, request: ClearEntireCostmap.Request, costmap: Costmap) -> None:
        costmap.clear()

    def _clear_except(self, request: ClearCostmapExceptRegion.Request, costmap: Costmap) -> None:
        costmap.clear_square(self._surroundings.pose(), request.reset_distance, inside=False)

    def _clear_around(self, request: ClearCostmapAroundRobot.Request, costmap: Costmap) -> None:
        costmap.clear_square(self._surroundings.pose(), request.reset_distance)

    def _clear_at(self, request: ClearCostmapAroundPose.Request, costmap: Costmap) -> None:
        pose: PoseStamped = request.pose
        costmap.clear_square(self._surroundings.goal(pose), request.reset_distance)

    def _get_global(
        self, request: GetCostmap.Request, response: GetCostmap.Response
    ) -> GetCostmap.Response:
        if (costmap := self._surroundings.costmap) is not None:
            self._fill(response, costmap, costmap.costs, costmap.grid.origin)
        return response

    def _get_local(
        self, request: GetCostmap.Request, response: GetCostmap.Response
    ) -> GetCostmap.Response:
        try:
            costmap = self._costmap()
            self._fill(response, costmap, *costmap.window(self._surroundings.pose(), LOCAL_SIDE))
        except NavigationError as error:
            self._node.get_logger().error(f'local_costmap/get_costmap: {error}')
        return response

    def _fill(
        self, response: GetCostmap.Response, costmap: Costmap, costs: Any, origin: Pose
    ) -> None:
        now = self._node.get_clock().now().to_msg()
        response.map.header.stamp, response.map.header.frame_id = now, self._frame
        height, width = costs.shape
        response.map.metadata = CostmapMetaData(
            map_load_time=now,
            update_time=now,
            layer='master',
            resolution=costmap.resolution,
            size_x=width,
            size_y=height,
            origin=pose_message(origin),
        )
        response.map.data = array('B', costs.tobytes())
