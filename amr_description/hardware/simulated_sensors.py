# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The sensors of a simulated robot: which instruments the names of its state interfaces ask for.

========================================= =======================================================
``position.x`` … ``orientation.w``        the pose of the sensor in the world
``angular_velocity.x`` … ``orientation.w``  an inertial measurement unit
``force.x`` … ``torque.z``                a force-torque sensor, see :class:`SimulatedWrench`
``magnetic_field.x`` … ``.z``             a magnetometer: the field of the world in its axes
``range``                                 a range finder, :mod:`.simulated_range`
========================================= =======================================================

A sensor may have some of them, or those of several instruments. ``orientation.*`` belongs to the
pose where there is a ``position.*``.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from amr_description.control.interfaces import (
    IMU_INTERFACES,
    MAGNETIC_INTERFACES,
    POSE_INTERFACES,
    StateInterface,
    WRENCH_INTERFACES,
)
from amr_description.control.world import World
from amr_description.errors import HardwareError
from amr_description.hardware.simulated_range import SimulatedRange
from amr_description.hardware.simulated_sensor import Mount, mount_of, SimulatedSensor
from amr_description.log import Log, Severity
from amr_description.model.frames import conjugate, multiply, rotate, Transform
from amr_description.model.gazebo.tags import gazebo_sensors_of
from amr_description.model.hardware_info import HardwareInfo
from amr_description.model.robot import JointType, Robot


class SimulatedImu(SimulatedSensor):
    """The state interfaces of a unit: unit quaternion, rad/s and m/s², gravity included."""

    interfaces = IMU_INTERFACES

    def __init__(self, states: Sequence[StateInterface], world: World, mount: Mount) -> None:
        """Take a unit."""
        super().__init__(states, world, mount)
        reference = None if mount.gazebo is None else mount.gazebo.reference
        self._to_reference = None if reference is None else conjugate(reference)

    def measure(self, period: float) -> Sequence[float]:
        """Return what the unit measures; ``period``: since the previous call, s."""
        reading = self.world.imu(self.mount.link, self.mount.pose)
        orientation = reading.orientation
        if self._to_reference is not None:
            orientation = multiply(self._to_reference, orientation)
        # In the order of IMU_INTERFACES.
        return (*orientation, *reading.angular_velocity, *reading.linear_acceleration)


class SimulatedPose(SimulatedSensor):
    """The true pose of a sensor in the world: m, and a unit quaternion."""

    interfaces = POSE_INTERFACES

    def measure(self, period: float) -> Sequence[float]:
        """Return the pose."""
        pose = self.world.pose(self.mount.link) @ self.mount.pose
        return (*pose.translation, *pose.rotation)


class SimulatedWrench(SimulatedSensor):
    """
    What a force-torque sensor measures in the joint above its link: N and N·m.

    As in Gazebo it is the wrench of the child on the parent in the axes of the child link: a
    weight that hangs from the sensor pulls it down. ``<force_torque>`` of the Gazebo sensor may
    say otherwise: ``<measure_direction>parent_to_child``, ``<frame>parent`` or ``sensor``.

    A frame without mass, such as ``tool0``, holds nothing: the sensor then is in the next joint
    towards the root that does, or that moves.
    """

    interfaces = WRENCH_INTERFACES
    stream = b'\0force_torque'

    def __init__(self, states: Sequence[StateInterface], world: World, mount: Mount) -> None:
        """Take a sensor."""
        super().__init__(states, world, mount)
        direction = 'child_to_parent' if mount.gazebo is None else mount.gazebo.measure_direction
        axes = 'child' if mount.gazebo is None else mount.gazebo.frame
        self._sign = 1.0 if direction == 'parent_to_child' else -1.0
        pose = mount.pose if axes == 'sensor' else Transform(mount.pose.translation)
        above = world.description.parent_joint(mount.link)
        self._parent = above.parent if axes == 'parent' and above is not None else ''
        self._link, self._pose = _holding(world.description, mount.link, pose)

    def measure(self, period: float) -> Sequence[float]:
        """Return force and torque."""
        wrench = self.world.wrench(self._link, self._pose)
        force, torque = wrench.force, wrench.torque
        if self._parent:
            here = multiply(self.world.pose(self._link).rotation, self._pose.rotation)
            turn = multiply(conjugate(self.world.pose(self._parent).rotation), here)
            force, torque = rotate(turn, force), rotate(turn, torque)
        return [self._sign * value for value in (*force, *torque)]


class SimulatedMagnetometer(SimulatedSensor):
    """The magnetic field of the world in the axes of the sensor, T."""

    interfaces = MAGNETIC_INTERFACES
    stream = b'\0magnetometer'

    def measure(self, period: float) -> Sequence[float]:
        """Return the field."""
        rotation = (self.world.pose(self.mount.link) @ self.mount.pose).rotation
        return rotate(conjugate(rotation), self.world.magnetic_field)


_INSTRUMENTS = (
    SimulatedPose,
    SimulatedImu,
    SimulatedWrench,
    SimulatedMagnetometer,
    SimulatedRange,
)


@dataclass(frozen=True, slots=True)
class Sensors:
    """
    The sensors of a component.

    ``states`` are all of them in the order of the tag; ``others`` names the states that no
    instrument measures, which keep their initial values, and the sensors that have none.
    """

    instruments: list[SimulatedSensor]
    states: list[StateInterface]
    others: list[str]


def sensors_of(info: HardwareInfo, world: World, log: Log) -> Sensors:
    """
    Return the sensors of a component.

    One that is mounted nowhere measures nothing, which is warned of.

    Args:
        info: of the component.
        world: the simulated world.
        log: of the component.

    Raises:
        DescriptionError: a ``<gazebo>`` block is invalid.
    """
    found = Sensors([], [], [])
    mounted = {}
    if info.sensors:
        mounted = {sensor.name: sensor for sensor in gazebo_sensors_of(world.description)}
    for sensor in info.sensors:
        own = [StateInterface.of(sensor, each) for each in sensor.state_interfaces]
        found.states.extend(own)
        instruments = _instruments(own)
        measured = [state for _, states in instruments for state in states]
        found.others.extend(state.name for state in own if state not in measured)
        if not own:
            found.others.append(sensor.name)
        if not instruments:
            continue
        try:
            mount = mount_of(sensor, world.description, mounted.get(sensor.name))
            found.instruments.extend([kind(states, world, mount) for kind, states in instruments])
        except HardwareError as error:
            text = f"hardware component '{info.name}': {error}; it measures nothing"
            log(Severity.WARN, text)
            continue
        if mount.gazebo is not None and mount.gazebo.has_unknown_reference:
            log(
                Severity.WARN,
                f"hardware component '{info.name}': sensor '{sensor.name}': its <localization> is "
                f"'{mount.gazebo.localization}'; it is taken as ENU, the axes of the world; NED, "
                'NWU and CUSTOM are known, too',
            )
    return found


def _instruments(
    states: Sequence[StateInterface],
) -> list[tuple[type[SimulatedSensor], list[StateInterface]]]:
    """Return the instruments that the interfaces of a sensor ask for, and the states of each."""
    names = {state.interface for state in states}
    instruments: list[tuple[type[SimulatedSensor], list[StateInterface]]] = []
    left = list(states)
    for kind in _INSTRUMENTS:
        if kind is SimulatedPose and not names & {*POSE_INTERFACES[:3]}:
            continue
        measured = [state for state in left if state.interface in kind.interfaces]
        if measured:
            left = [state for state in left if state not in measured]
            instruments.append((kind, measured))
    return instruments


def _holding(robot: Robot, link: str, pose: Transform) -> tuple[str, Transform]:
    """
    Return the link that holds something where a sensor is, and the transform to that link.

    Args:
        robot: the description.
        link: on which the sensor is mounted.
        pose: the transform from the sensor to that link.
    """
    while not _has_mass(robot, link):
        joint = robot.parent_joint(link)
        if joint is None or joint.type is not JointType.FIXED:
            break
        link, pose = joint.parent, joint.origin @ pose
    return link, pose


def _has_mass(robot: Robot, link: str) -> bool:
    """Return whether a link, or one that hangs on it, has mass."""
    inertial = robot.link(link).inertial
    if inertial is not None and inertial.mass > 0.0:
        return True
    return any(_has_mass(robot, joint.child) for joint in robot.child_joints(link))
