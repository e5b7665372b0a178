# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
joint_state_broadcaster/JointStateBroadcaster: publishes state interfaces as ``/joint_states`` and,
with those that no JointState can carry, as ``/dynamic_joint_states``.

It commands nothing. Joints are in the order of ``joints``, or else of the URDF, alphabetically, as
in joint_state_broadcaster 4.x; an interface that a joint lacks is NaN.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain
from operator import itemgetter
from typing import Any, ClassVar, TypeAlias

from amr_description.control.contracts import Controller, ControllerContext, Output, Port
from amr_description.control.interfaces import (
    ALL_INTERFACES,
    CommandInterface,
    EFFORT,
    InterfaceRequest,
    POSITION,
    StateInterface,
    VELOCITY,
)
from amr_description.control.samples import (
    DynamicJointStateSample,
    DynamicLayout,
    JointStateSample,
)
from amr_description.errors import ControllerError
from amr_description.former_parameters import FormerParameter, ignored
from amr_description.log import Severity
from amr_description.parameters import group, parameter

_FIELDS = (POSITION, VELOCITY, EFFORT)

_Pick: TypeAlias = Callable[[list[float]], tuple[float, ...]]

_Row: TypeAlias = dict[str, StateInterface]
"""The states of one joint, sensor or GPIO, by the names under which they are published."""


@dataclass(frozen=True)
class InterfaceMap:
    """Which interface fills each field of JointState."""

    position: str = parameter(POSITION, 'Interface that fills position', read_only=True)
    velocity: str = parameter(VELOCITY, 'Interface that fills velocity', read_only=True)
    effort: str = parameter(EFFORT, 'Interface that fills effort', read_only=True)


@dataclass(frozen=True)
class BroadcasterParameters:
    """The table of joint_state_broadcaster/JointStateBroadcaster."""

    former: ClassVar[tuple[FormerParameter, ...]] = (
        ignored('publish_rate', 'ROS 1', 'update_rate, in Hz, is how often it publishes'),
    )
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
    frame_id: str = parameter('base_link', 'Frame id of both messages', read_only=True)
    publish_dynamic_joint_states: bool = parameter(
        True, 'Publish dynamic_joint_states too', read_only=True
    )


class JointStateBroadcaster(Controller):
    """Publishes all state interfaces, or the selected ones, at every update."""

    parameters_type = BroadcasterParameters

    def __init__(self, context: ControllerContext) -> None:
        super().__init__(context)
        self._states: tuple[StateInterface, ...] = ()
        self._columns: tuple[_Pick, ...] = ()
        self._rows: tuple[_Pick, ...] = ()

    def configure(self, parameters: BroadcasterParameters) -> None:
        """Determine the topics and the interfaces."""
        self._parameters = parameters
        self._is_selecting = bool(parameters.joints and parameters.interfaces)
        self.log(
            Severity.INFO,
            "Publishing state interfaces defined in 'joints' and 'interfaces' parameters."
            if self._is_selecting
            else "'joints' or 'interfaces' parameter is empty. All available state interfaces "
            'will be published',
        )
        if not parameters.frame_id:
            self.log(Severity.WARN, 'Frame ID is not set.')
        self._published_as = self._mapping(parameters)
        prefix = '~/' if parameters.use_local_topics else ''
        self._joint_states: Output[JointStateSample] = Output(
            Port(f'{prefix}joint_states', 'sensor_msgs/msg/JointState', sample=JointStateSample)
        )
        self._dynamic_joint_states: Output[DynamicJointStateSample] = Output(
            Port(
                f'{prefix}dynamic_joint_states',
                'control_msgs/msg/DynamicJointState',
                sample=DynamicJointStateSample,
            )
        )

    def state_interfaces(self) -> InterfaceRequest:
        """Return all, or joints × interfaces."""
        if not self._is_selecting:
            return ALL_INTERFACES
        return InterfaceRequest.individual(
            f'{joint}/{interface}'
            for joint in self._parameters.joints
            for interface in self._parameters.interfaces
        )

    def outputs(self) -> tuple[Output[Any], ...]:
        """Return ``joint_states`` and, unless disabled, ``dynamic_joint_states``."""
        if self._parameters.publish_dynamic_joint_states:
            return self._joint_states, self._dynamic_joint_states
        return (self._joint_states,)

    def activate(
        self, commands: Sequence[CommandInterface], states: Sequence[StateInterface], time: int
    ) -> None:
        """Take the interfaces. Raises ControllerError: there is none."""
        if not states:
            raise ControllerError('No state interfaces found to publish.')
        rows = self._rows_of(states)
        joints = self._joints(rows)
        for extra in self._parameters.extra_joints:
            if extra not in rows:
                rows[extra] = {field: StateInterface(extra, field, 0.0) for field in _FIELDS}
                joints.append(extra)
        if not rows:
            raise ControllerError(
                'Error initializing joint data. JointStateBroadcaster will not run: '
                'no state interface is a double'
            )
        missing = StateInterface('', '')  # NaN
        published = [list(row.values()) for row in rows.values()]
        self._states = (*chain.from_iterable(published), missing)
        self._names = tuple(joints)
        columns = ([rows[joint].get(field, missing) for joint in joints] for field in _FIELDS)
        self._columns = tuple(self._picked(column) for column in columns)
        self._layout = DynamicLayout(
            self._parameters.frame_id, tuple(rows), tuple(tuple(row) for row in rows.values())
        )
        self._rows = tuple(self._picked(row) for row in published)

    def _picked(self, handles: Sequence[StateInterface]) -> '_Pick':
        """Return what picks the values of some states out of those of all of ``_states``."""
        indices = [self._states.index(handle) for handle in handles]
        if len(indices) > 1:
            return itemgetter(*indices)
        return lambda values: tuple([values[index] for index in indices])

    def update(self, time: int, period: int) -> None:
        """Publish the present states."""
        values = [state.value for state in self._states]
        position, velocity, effort = [pick(values) for pick in self._columns]
        self._joint_states.send(
            JointStateSample(
                time, self._parameters.frame_id, self._names, position, velocity, effort
            )
        )
        if self._parameters.publish_dynamic_joint_states:
            rows = tuple([pick(values) for pick in self._rows])
            self._dynamic_joint_states.send(DynamicJointStateSample(time, rows, self._layout))

    def deactivate(self, time: int) -> None:
        """Drop the interfaces."""
        self._states = self._rows = self._columns = ()

    def _mapping(self, parameters: BroadcasterParameters) -> dict[str, str]:
        """
        Return the name under which to publish each interface.

        An interface that is selected by ``interfaces`` takes precedence over one mapped to it.
        """
        published_as: dict[str, str] = {}
        for field in _FIELDS:
            interface = getattr(parameters.map_interface_to_joint_state, field)
            if interface != field and self._is_selecting and field in parameters.interfaces:
                self.log(
                    Severity.WARN,
                    f"Mapping from '{interface}' to interface '{field}' will not be done, because "
                    f"'{field}' is defined in 'interfaces' parameter.",
                )
                interface = field
            published_as[interface] = field
        return published_as

    def _rows_of(self, states: Sequence[StateInterface]) -> dict[str, _Row]:
        """Group the states by joint, sensor or GPIO, in their order."""
        rows: dict[str, _Row] = {}
        for state in states:
            if state.data_type != 'double':
                self.log(
                    Severity.WARN,
                    f"The state interface '{state.name}' is of type {state.data_type}, which "
                    'joint_states cannot carry; it is left out',
                )
                continue
            row = rows.setdefault(state.prefix, {})
            name = self._published_as.get(state.interface, state.interface)
            is_mapped = name != state.interface
            if is_mapped or name not in row:
                row[name] = state
        return rows

    def _joints(self, rows: Mapping[str, _Row]) -> list[str]:
        """Return the names of a JointState, in its order."""
        joints = [name for name, row in rows.items() if not row.keys().isdisjoint(_FIELDS)]
        if self._is_selecting:
            return [joint for joint in self._parameters.joints if joint in joints]
        if not self._parameters.use_urdf_to_filter:
            return joints
        robot = self.context.robot
        if robot is None:
            self.log(
                Severity.ERROR,
                'Failed to parse robot description. Will publish all the interfaces with '
                f'{", ".join(_FIELDS)}',
            )
            return joints
        movable = {joint.name for joint in robot.joints if joint.type != 'fixed'}
        return sorted(movable.intersection(joints))
