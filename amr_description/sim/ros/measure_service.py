# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A service by which sensors measure the present instant, while time stands still.

``~/measure``  (``std_srvs/srv/Trigger``)
    Every sensor that somebody subscribes to measures and publishes once, whatever its rate, with
    the noise of this instant; it has published when the response comes. ``message`` has the names
    of the topics with subscribers, separated by blanks: DDS matches a new subscription some time
    after it was made, and one that is not among them has to ask again. Refused while time passes.

So a test in lock-step reads what a sensor sees at an instant, and costs nothing at all others.
"""

from collections.abc import Awaitable, Callable
from typing import Any

from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node
from std_srvs.srv import Trigger

from amr_description.simulation.topics.sensor_manager import SensorManager


class MeasureService:
    """Serves ``~/measure``."""

    def __init__(
        self,
        node: Node,
        sensors: SensorManager,
        submit: Callable[[Callable[[], Any]], Awaitable[Any]],
        is_standing_still: Callable[[], bool],
    ) -> None:
        """
        Begin to serve; on the ROS thread.

        Args:
            node: Has the service, and the publishers of the sensors.
            sensors: All of them.
            submit: Has the control thread make a call between two cycles.
            is_standing_still: Whether no time passes; called on the control thread.
        """
        self._node = node
        self._sensors = sensors
        self._submit = submit
        self._is_standing_still = is_standing_still
        group = ReentrantCallbackGroup()
        node.create_service(Trigger, '~/measure', self._measure, callback_group=group)

    async def _measure(self, _: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        # First: what has subscribers now has them in the cycle that follows, too.
        topics = [each.topic_name for each in self._node.publishers if _has_subscribers(each)]
        response.success = await self._submit(self._request)
        if response.success:
            await self._submit(_nothing)  # after the cycle in which they measure
            response.message = ' '.join(topics)
        else:
            response.message = (
                'time passes, and sensors measure at their rates; pause it first '
                '(~/set_simulation_state, 2)'
            )
        return response

    def _request(self) -> bool:
        """Have them measure in the cycle that follows, at the same time; on the control thread."""
        is_possible = self._is_standing_still()
        if is_possible:
            self._sensors.request()
        return is_possible


def _has_subscribers(publisher: Any) -> bool:
    return bool(publisher.get_subscription_count())


def _nothing() -> None:
    pass
