# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Wrenches on links by topics, with the messages and meanings of Gazebo's system ApplyLinkWrench.

::

    ~/wrench              ros_gz_interfaces/msg/EntityWrench   during one physics step
    ~/wrench/persistent   ros_gz_interfaces/msg/EntityWrench   until cleared, or replaced
    ~/wrench/clear        ros_gz_interfaces/msg/Entity         ends persistent ones

In Gazebo they are ``/world/<world>/wrench`` and so on. The entity is a robot (MODEL), which stands
for its root link, or a link, ``<robot>::<link>`` (LINK); a reset and a deletion end them, too.
"""

from collections.abc import Callable
from functools import partial

from rclpy.node import Node
from ros_gz_interfaces.msg import Entity, EntityWrench

from amr_description.errors import SimulationError
from amr_description.log import Severity
from amr_description.ros.messages import vector_of
from amr_description.sim.ros.simulation import Simulation
from amr_description.sim.wrenches import MOST, WorldWrench

_SEPARATOR = '::'
_DEPTH = 50


class WrenchTopics:
    """Hears the topics; wrenches take effect between two cycles of the control loop."""

    def __init__(self, node: Node, simulation: Simulation) -> None:
        self._simulation = simulation
        self._world = simulation.world
        for name, message_type, callback in (
            ('~/wrench', EntityWrench, partial(self._on_wrench, lasts=False)),
            ('~/wrench/persistent', EntityWrench, partial(self._on_wrench, lasts=True)),
            ('~/wrench/clear', Entity, self._on_clear),
        ):
            node.create_subscription(message_type, name, callback, _DEPTH)

    def _on_wrench(self, message: EntityWrench, *, lasts: bool) -> None:
        force, torque = vector_of(message.wrench.force), vector_of(message.wrench.torque)
        wrenches = self._world.wrenches
        apply = wrenches.hold if lasts else wrenches.push

        def call() -> None:
            if not all(abs(each) <= MOST for each in (*force, *torque)):
                raise SimulationError(
                    f'{force} N, {torque} N m; finite numbers are needed, up to {MOST:g}: physics '
                    'would lose the state of the robot'
                )
            robot, link = self._target(message.entity)
            root = self._world.robot(robot).description.root.name
            apply(robot, root if link is None else link, WorldWrench(force, torque))

        self._submit(call, message.entity)

    def _on_clear(self, message: Entity) -> None:
        def call() -> None:
            robot, link = self._target(message)
            self._world.robot(robot)
            self._world.wrenches.clear(robot, link)

        self._submit(call, message)

    def _submit(self, call: Callable[[], None], entity: Entity) -> None:
        """Make a call on the control thread; an error is one line of the log."""

        def guarded() -> None:
            try:
                call()
            except SimulationError as error:
                self._simulation.log(
                    Severity.WARN, f"wrench on '{entity.name}': {error}", throttle=1.0
                )

        self._simulation.loop_thread.submit(guarded)

    def _target(self, entity: Entity) -> tuple[str, str | None]:
        """Return the names of robot and link; None: the whole robot. Raises SimulationError."""
        robot, separator, link = entity.name.partition(_SEPARATOR)
        if entity.type not in (Entity.NONE, Entity.MODEL, Entity.LINK):
            raise SimulationError(
                f'entity of type {entity.type}; MODEL ({Entity.MODEL}), <robot>, and '
                f'LINK ({Entity.LINK}), <robot>{_SEPARATOR}<link>, can be pushed'
            )
        if entity.type == Entity.LINK and not separator:
            raise SimulationError(f'a link is named <robot>{_SEPARATOR}<link>')
        return robot, link if separator else None
