# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
joint_state_broadcaster/JointStateBroadcaster: what the gauges read, as ``/joint_states``.

It commands nothing. Names come in the order of ``joints``, else alphabetically from the URDF, as
joint_state_broadcaster 4.x gives them; an interface that a joint lacks is NaN.
"""

from collections.abc import Sequence
from dataclasses import dataclass
import math

from amr_description.control.contracts import Controller, ControllerContext, Output, Port, Severity
from amr_description.control.interfaces import (
    ALL_INTERFACES,
    CommandInterface,
    EFFORT,
    InterfaceRequest,
    POSITION,
    StateInterface,
    VELOCITY,
)
from amr_description.control.samples import JointStateSample
from amr_description.errors import ControllerError
from amr_description.parameters import group, parameter

_FIELDS = (POSITION, VELOCITY, EFFORT)


@dataclass(frozen=True)
class InterfaceMap:
    """Which interface fills which field of JointState."""

    position: str = parameter(POSITION, 'Interface that fills position', read_only=True)
    velocity: str = parameter(VELOCITY, 'Interface that fills velocity', read_only=True)
    effort: str = parameter(EFFORT, 'Interface that fills effort', read_only=True)


@dataclass(frozen=True)
class BroadcasterParameters:
    """The table of joint_state_broadcaster/JointStateBroadcaster."""

    use_local_topics: bool = parameter(
        False, 'Publish ~/joint_states instead of joint_states', read_only=True
    )
    joints: tuple[str, ...] = parameter(
        (), 'With interfaces: publish only these joints, in this order', read_only=True
    )
    interfaces: tuple[str, ...] = parameter(
        (), 'With joints: publish only these interfaces of theirs', read_only=True
    )
    extra_joints: tuple[str, ...] = parameter(
        (), 'Joints without hardware, published at zero, last', read_only=True
    )
    map_interface_to_joint_state: InterfaceMap = group(
        'map_interface_to_joint_state', InterfaceMap
    )
    use_urdf_to_filter: bool = parameter(
        True, 'Leave out what is no joint of the URDF (sensors, GPIOs)', read_only=True
    )
    frame_id: str = parameter('base_link', 'Frame id of joint_states', read_only=True)


class JointStateBroadcaster(Controller):
    """Publishes all state interfaces, or the chosen ones, at every update."""

    parameters_type = BroadcasterParameters

    def __init__(self, context: ControllerContext) -> None:
        super().__init__(context)
        self._cells: dict[str, list[StateInterface | None]] = {}

    def configure(self, parameters: BroadcasterParameters) -> None:
        """Decide the topic and the interfaces."""
        self._parameters = parameters
        self._is_choosing = bool(parameters.joints and parameters.interfaces)
        self.log(
            Severity.INFO,
            "Publishing state interfaces defined in 'joints' and 'interfaces' parameters."
            if self._is_choosing
            else "'joints' or 'interfaces' parameter is empty. All available state interfaces "
            'will be published',
        )
        if not parameters.frame_id:
            self.log(Severity.WARN, 'Frame ID is not set.')
        self._field_of = self._mapping(parameters)
        self._joint_states: Output[JointStateSample] = Output(
            Port(
                '~/joint_states' if parameters.use_local_topics else 'joint_states',
                'sensor_msgs/msg/JointState',
                'amr_description.nodes.converters:fill_joint_state',
            )
        )

    def state_interfaces(self) -> InterfaceRequest:
        """All there are, or joints × interfaces."""
        if not self._is_choosing:
            return ALL_INTERFACES
        return InterfaceRequest.individual(
            f'{joint}/{interface}'
            for joint in self._parameters.joints
            for interface in self._parameters.interfaces
        )

    def outputs(self) -> tuple[Output[JointStateSample], ...]:
        """``joint_states``."""
        return (self._joint_states,)

    def activate(
        self, commands: Sequence[CommandInterface], states: Sequence[StateInterface], time: int
    ) -> None:
        """Take the gauges. Raises ControllerError when there is none."""
        if not states:
            raise ControllerError('No state interfaces found to publish.')
        cells: dict[str, list[StateInterface | None]] = {}
        for state in states:
            field = self._field_of.get(state.interface)
            if state.data_type != 'double':
                self.log(
                    Severity.WARN,
                    f"The state interface '{state.name}' is of type {state.data_type}, which "
                    'joint_states cannot carry; it is left out',
                )
            elif field is not None:
                row = cells.setdefault(state.prefix, [None, None, None])
                row[_FIELDS.index(field)] = state
        self._cells = {name: cells[name] for name in self._names(cells)}
        extra = [name for name in self._parameters.extra_joints if name not in self._cells]
        self._all_names = (*self._cells, *extra)
        self._zeros = (0.0,) * len(extra)

    def update(self, time: int, period: int) -> None:
        """Publish every gauge as it reads now."""
        rows = self._cells.values()
        position, velocity, effort = (
            tuple(math.nan if row[i] is None else row[i].value for row in rows) + self._zeros
            for i in range(len(_FIELDS))
        )
        self._joint_states.send(
            JointStateSample(
                time, self._parameters.frame_id, self._all_names, position, velocity, effort
            )
        )

    def deactivate(self, time: int) -> None:
        """Give the gauges back."""
        self._cells = {}

    def _mapping(self, parameters: BroadcasterParameters) -> dict[str, str]:
        """Interface name → field; a standard interface that is also claimed beats its mapping."""
        field_of: dict[str, str] = {}
        for field in _FIELDS:
            interface = getattr(parameters.map_interface_to_joint_state, field)
            if interface != field and self._is_choosing and field in parameters.interfaces:
                self.log(
                    Severity.WARN,
                    f"Mapping from '{interface}' to interface '{field}' will not be done, because "
                    f"'{field}' is defined in 'interfaces' parameter.",
                )
                interface = field
            field_of[interface] = field
        return field_of

    def _names(self, cells: dict[str, list[StateInterface | None]]) -> list[str]:
        if self._is_choosing:
            return [joint for joint in self._parameters.joints if joint in cells]
        if not self._parameters.use_urdf_to_filter:
            return list(cells)
        robot = self.context.robot
        if robot is None:
            self.log(
                Severity.ERROR,
                'Failed to parse robot description. Will publish all the interfaces with '
                f'{", ".join(_FIELDS)}',
            )
            return list(cells)
        movable = {joint.name for joint in robot.joints if joint.type != 'fixed'}
        return sorted(name for name in cells if name in movable)
