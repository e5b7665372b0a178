# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What a joystick commands: axes and buttons of ``sensor_msgs/Joy`` -> velocities.

Pure. Names, defaults and rules are those of teleop_twist_joy 2.6 (Jazzy).
"""

from collections.abc import Sequence
from dataclasses import dataclass

from amr_description.parameters import group, parameter


def _axis(default: int, motion: str) -> int:
    doc = f'Axis of the joystick for {motion}; -1: none'
    field: int = parameter(default, doc, minimum=-1)
    return field


def _scale(default: float, motion: str, unit: str) -> float:
    doc = f'Speed for {motion} at the end of the axis; negative: the other way round'
    field: float = parameter(default, doc, unit=unit)
    return field


@dataclass(frozen=True)
class LinearAxes:
    """The axes of linear motion."""

    x: int = _axis(5, 'driving forward')
    y: int = _axis(-1, 'driving to the left')
    z: int = _axis(-1, 'rising')


@dataclass(frozen=True)
class AngularAxes:
    """The axes of rotation."""

    yaw: int = _axis(2, 'turning left')
    pitch: int = _axis(-1, 'pitching')
    roll: int = _axis(-1, 'rolling')


@dataclass(frozen=True)
class LinearScale:
    """The speeds of linear motion."""

    x: float = _scale(0.5, 'driving forward', 'm/s')
    y: float = _scale(0.0, 'driving to the left', 'm/s')
    z: float = _scale(0.0, 'rising', 'm/s')


@dataclass(frozen=True)
class LinearTurboScale(LinearScale):
    """Those while the turbo button is held."""

    x: float = _scale(1.0, 'driving forward', 'm/s')


@dataclass(frozen=True)
class AngularScale:
    """The speeds of rotation."""

    yaw: float = _scale(0.5, 'turning left', 'rad/s')
    pitch: float = _scale(0.0, 'pitching', 'rad/s')
    roll: float = _scale(0.0, 'rolling', 'rad/s')


@dataclass(frozen=True)
class AngularTurboScale(AngularScale):
    """Those while the turbo button is held."""

    yaw: float = _scale(1.0, 'turning left', 'rad/s')


@dataclass(frozen=True)
class JoyCommandSettings:
    """What buttons and axes do; all of it may be changed while the node runs."""

    require_enable_button: bool = parameter(
        True, 'Whether a button has to be held for the robot to move'
    )
    enable_button: int = parameter(5, 'Button to hold for the usual speeds', minimum=-1)
    enable_turbo_button: int = parameter(
        -1, 'Button to hold for the turbo speeds; -1: none', minimum=-1
    )
    inverted_reverse: bool = parameter(
        False, 'Whether it turns the other way while it drives backwards, as a car is steered'
    )
    axis_linear: LinearAxes = group('axis_linear', LinearAxes)
    axis_angular: AngularAxes = group('axis_angular', AngularAxes)
    scale_linear: LinearScale = group('scale_linear', LinearScale)
    scale_linear_turbo: LinearTurboScale = group('scale_linear_turbo', LinearTurboScale)
    scale_angular: AngularScale = group('scale_angular', AngularScale)
    scale_angular_turbo: AngularTurboScale = group('scale_angular_turbo', AngularTurboScale)


@dataclass(frozen=True, slots=True)
class JoyCommand:
    """A velocity: m/s, and rad/s about x, y and z of the robot."""

    x: float = 0.0
    y: float = 0.0
    z: float = 0.0
    roll: float = 0.0
    pitch: float = 0.0
    yaw: float = 0.0


class JoyCommander:
    """Commands while a button is held, and one stop after it is let go."""

    def __init__(self, settings: JoyCommandSettings) -> None:
        """Make one; ``settings`` may be replaced at any time."""
        self.settings = settings
        self._has_stopped = False

    def command(self, axes: Sequence[float], buttons: Sequence[int]) -> JoyCommand | None:
        """Return what to publish for a state of the joystick; None: nothing."""
        settings = self.settings
        linear: LinearScale
        angular: AngularScale
        if _is_held(buttons, settings.enable_turbo_button):
            linear, angular = settings.scale_linear_turbo, settings.scale_angular_turbo
        elif not settings.require_enable_button or _is_held(buttons, settings.enable_button):
            linear, angular = settings.scale_linear, settings.scale_angular
        else:
            is_first, self._has_stopped = not self._has_stopped, True
            return JoyCommand() if is_first else None
        self._has_stopped = False
        forward = _share(axes, settings.axis_linear.x) * linear.x
        turn = _share(axes, settings.axis_angular.yaw) * angular.yaw
        return JoyCommand(
            x=forward,
            y=_share(axes, settings.axis_linear.y) * linear.y,
            z=_share(axes, settings.axis_linear.z) * linear.z,
            roll=_share(axes, settings.axis_angular.roll) * angular.roll,
            pitch=_share(axes, settings.axis_angular.pitch) * angular.pitch,
            yaw=-turn if settings.inverted_reverse and forward < 0.0 else turn,
        )


def _is_held(buttons: Sequence[int], button: int) -> bool:
    return 0 <= button < len(buttons) and buttons[button] != 0


def _share(axes: Sequence[float], axis: int) -> float:
    return axes[axis] if 0 <= axis < len(axes) else 0.0
