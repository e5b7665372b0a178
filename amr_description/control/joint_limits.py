# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The limits of a joint: the most restrictive of the URDF's ``<limit>`` and of the ``min`` and
``max`` parameters of its command interfaces.
"""

from dataclasses import dataclass

from amr_description.control.interfaces import ACCELERATION, EFFORT, JERK, POSITION, VELOCITY
from amr_description.errors import HardwareError
from amr_description.model.hardware_info import ComponentInfo, InterfaceInfo
from amr_description.model.robot import Joint, JointType


@dataclass(frozen=True, slots=True)
class JointLimits:
    """
    What the commands of a joint are kept within, SI; ``None`` where there is no limit.

    All but ``position`` (lower, upper) are magnitudes. ``deceleration`` holds where a joint slows
    down, ``acceleration`` where it does not, or where there is no ``deceleration``.
    """

    position: tuple[float, float] | None = None
    velocity: float | None = None
    effort: float | None = None
    acceleration: float | None = None
    deceleration: float | None = None
    jerk: float | None = None

    def __str__(self) -> str:
        """Those there are, for instance ``position [-1, 1], velocity 2``."""
        texts = []
        if self.position is not None:
            texts.append(f'position [{self.position[0]:g}, {self.position[1]:g}]')
        for name in ('velocity', 'effort', 'acceleration', 'deceleration', 'jerk'):
            value = getattr(self, name)
            if value is not None:
                texts.append(f'{name} {value:g}')
        return ', '.join(texts) or 'none'


def limits_of(info: ComponentInfo, joint: Joint | None) -> JointLimits:
    """
    Return the limits of the joint ``info`` whose URDF joint is ``joint``.

    A command interface with ``<limits enable="false"/>`` has none, of either source. A continuous
    joint has no position limits but those of its parameters. Raises HardwareError: no position
    satisfies both.
    """
    commands = {interface.name: interface for interface in info.command_interfaces}
    urdf = None if joint is None else joint.limit
    lower, upper = _magnitudes(commands.get(ACCELERATION))
    return JointLimits(
        position=_position_limits(info.name, commands.get(POSITION), joint),
        velocity=_magnitude(commands.get(VELOCITY), None if urdf is None else urdf.velocity),
        effort=_magnitude(commands.get(EFFORT), None if urdf is None else urdf.effort),
        acceleration=upper,
        deceleration=lower,
        jerk=_magnitude(commands.get(JERK), None),
    )


def _position_limits(
    name: str, interface: InterfaceInfo | None, joint: Joint | None
) -> tuple[float, float] | None:
    lowers, uppers = [], []
    if joint is not None and joint.limit is not None and joint.type is not JointType.CONTINUOUS:
        lowers.append(joint.limit.lower)
        uppers.append(joint.limit.upper)
    if interface is not None:
        if not interface.limits_enabled:
            return None
        lowers += [] if interface.min is None else [interface.min]
        uppers += [] if interface.max is None else [interface.max]
    if not lowers and not uppers:
        return None
    lower, upper = max(lowers, default=-float('inf')), min(uppers, default=float('inf'))
    if lower > upper:
        raise HardwareError(
            f"joint '{name}': no position is within all its limits; its <limit> and the "
            f'parameters min and max of its position command leave from {lower:g} to {upper:g}'
        )
    return lower, upper


def _magnitude(interface: InterfaceInfo | None, urdf: float | None) -> float | None:
    """Return the least of them: commands are bounded to both sides alike."""
    if interface is not None and not interface.limits_enabled:
        return None
    bounds = [abs(bound) for bound in (*_magnitudes(interface), urdf) if bound is not None]
    return min(bounds, default=None)


def _magnitudes(interface: InterfaceInfo | None) -> tuple[float | None, float | None]:
    if interface is None or not interface.limits_enabled:
        return None, None
    lower, upper = interface.min, interface.max
    return None if lower is None else abs(lower), None if upper is None else abs(upper)
