# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The parameters of ``ekf_node``, by the names, types and defaults of robot_localization 3.8 (Jazzy).

Inputs are numbered from 0 on, without gaps: ``odom0``, ``odom1``, ``pose0``, ``twist0``, ``imu0``.
The first of each four is a topic; ``odom0_config`` says which of the 15 states it measures.

What is set and is of no use gets one line: :attr:`EkfParameters.notes`.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
import re
from typing import Any

import numpy as np

from amr_description.clock import NANOSECONDS
from amr_description.errors import ParameterError
from amr_description.navigation.ekf import (
    ACCELERATION,
    Array,
    ControlLimits,
    INITIAL_VARIANCE,
    NO_THRESHOLD,
    POSE,
    PROCESS_NOISE,
    STATE_SIZE,
    StateMember,
    Tuning,
    TURN_RATE,
    TWIST,
)
from amr_description.navigation.ekf_estimator import Timing
from amr_description.navigation.ekf_measurement import Mask, MeasurementChannel
from amr_description.parameters import Bounds, Spec, Value
from amr_description.text import closest_match


def _row(default: Value, **bounds: Any) -> Spec:
    """Return a row of a table below, without its name."""
    kinds = {bool: 'bool', int: 'integer', float: 'double', str: 'string'}
    kind = 'double_array' if isinstance(default, tuple) else kinds[type(default)]
    return Spec('', kind, default, '', '', Bounds(**bounds), read_only=True)


_CONFIG = replace(_row((False,) * STATE_SIZE), type='bool_array')
_NO = _row(False)
_YES = _row(True)
_THRESHOLD = _row(NO_THRESHOLD)
_QUEUE = _row(10, minimum=1)
_NUMBERS = _row(())
_TOPIC = _row('', not_empty=True)

NODE: Mapping[str, Spec] = {
    'frequency': _row(30.0, above=0.0),
    'sensor_timeout': _row(0.0, minimum=0.0),
    'two_d_mode': _NO,
    'transform_time_offset': _row(0.0),
    'transform_timeout': _row(0.0, minimum=0.0),
    'print_diagnostics': _NO,
    'debug': _NO,
    'debug_out_file': _row('robot_localization_debug.txt'),
    'publish_tf': _YES,
    'publish_acceleration': _NO,
    'permit_corrected_publication': _NO,
    'map_frame': _row('map'),
    'odom_frame': _row('odom'),
    'base_link_frame': _row('base_link'),
    'base_link_frame_output': _row(''),
    'world_frame': _row(''),
    'tf_prefix': _row(''),
    'gravitational_acceleration': _row(9.80665),
    'predict_to_current_time': _NO,
    'smooth_lagged_data': _NO,
    'history_length': _row(0.0),
    'reset_on_time_jump': _NO,
    'disabled_at_startup': _NO,
    'use_control': _NO,
    'stamped_control': _NO,
    'control_timeout': _row(0.0, minimum=0.0),
    'control_config': replace(_NUMBERS, type='bool_array'),
    'acceleration_limits': _NUMBERS,
    'deceleration_limits': _NUMBERS,
    'acceleration_gains': _NUMBERS,
    'deceleration_gains': _NUMBERS,
    'dynamic_process_noise_covariance': _NO,
    'process_noise_covariance': _NUMBERS,
    'initial_estimate_covariance': _NUMBERS,
    'initial_state': _NUMBERS,
    'diagnostic_updater.period': _row(1.0, above=0.0),
    'diagnostic_updater.use_fqn': _NO,
}
_WITHOUT_DEFAULT = {
    'sensor_timeout',  # 1 / frequency
    'base_link_frame_output',  # base_link_frame
    'world_frame',  # odom_frame
    'tf_prefix', 'control_config', 'acceleration_limits', 'deceleration_limits',
    'acceleration_gains', 'deceleration_gains', 'process_noise_covariance',
    'initial_estimate_covariance', 'initial_state',
}  # fmt: skip
"""They have no value unless one is given, or the one of another."""
INPUTS: Mapping[str, Mapping[str, Spec]] = {
    'odom': {
        '_config': _CONFIG,
        '_differential': _NO,
        '_relative': _NO,
        '_pose_use_child_frame': _NO,
        '_pose_rejection_threshold': _THRESHOLD,
        '_twist_rejection_threshold': _THRESHOLD,
        '_queue_size': _QUEUE,
    },
    'pose': {
        '_config': _CONFIG,
        '_differential': _NO,
        '_relative': _NO,
        '_rejection_threshold': _THRESHOLD,
        '_queue_size': _QUEUE,
    },
    'twist': {
        '_config': _CONFIG,
        '_rejection_threshold': _THRESHOLD,
        '_queue_size': _QUEUE,
    },
    'imu': {
        '_config': _CONFIG,
        '_differential': _NO,
        '_relative': _NO,
        '_pose_rejection_threshold': _THRESHOLD,
        '_twist_rejection_threshold': _THRESHOLD,
        '_linear_acceleration_rejection_threshold': _THRESHOLD,
        '_remove_gravitational_acceleration': _NO,
        '_queue_size': _QUEUE,
    },
}
"""By the kind of message: nav_msgs/Odometry, geometry_msgs/PoseWithCovarianceStamped and
TwistWithCovarianceStamped, sensor_msgs/Imu."""

_INPUT = re.compile(r'(odom|pose|twist|imu)(\d+)(_\w+)?')
_OF_ROS = re.compile(r'use_sim_time|start_type_description_service|qos_overrides\..*')
_MEASURES: Mapping[str, tuple[slice, ...]] = {
    'odom': (POSE, TWIST),
    'pose': (POSE,),
    'twist': (TWIST,),
    'imu': (slice(3, 6), TURN_RATE, ACCELERATION),
}


@dataclass(frozen=True, slots=True, eq=False)
class EkfInput:
    """One sensor: its topic, and what its messages measure."""

    kind: str
    """``odom``, ``pose``, ``twist`` or ``imu``"""
    name: str
    """``odom0``"""
    topic: str
    queue_size: int
    pose: MeasurementChannel
    twist: MeasurementChannel
    acceleration: MeasurementChannel
    uses_child_frame: bool
    """Whether its pose is that of its child frame, else of the robot."""
    removes_gravity: bool

    @property
    def channels(self) -> tuple[MeasurementChannel, MeasurementChannel, MeasurementChannel]:
        """Its three parts."""
        return (self.pose, self.twist, self.acceleration)

    @property
    def is_used(self) -> bool:
        """Whether it measures anything."""
        return any(channel.is_used for channel in self.channels)


@dataclass(frozen=True, slots=True, eq=False)
class EkfParameters:
    """The parameters of a node, understood."""

    values: Mapping[str, Value]
    """Of all that are known, given or not, by name."""
    inputs: Sequence[EkfInput]
    tuning: Tuning
    timing: Timing
    map_frame: str
    odom_frame: str
    base_link_frame: str
    base_link_frame_output: str
    world_frame: str
    notes: Sequence[str] = field(default=())
    """One line for each that is of no use, or means something else than is written."""

    def is_on(self, name: str) -> bool:
        """Return a boolean."""
        return bool(self.values[name])

    def number(self, name: str) -> float:
        """Return a double."""
        value = self.values[name]
        assert isinstance(value, float), name
        return value

    def nanoseconds(self, name: str) -> int:
        """Return a duration in s as ns."""
        return _nanoseconds(self.number(name))


def read_parameters(given: Mapping[str, object]) -> EkfParameters:
    """
    Understand the parameters of a node.

    Raises:
        ParameterError: a value is of another type or out of bounds.
    """
    notes: list[str] = []
    values = _values(given, notes)
    frames = _frames(values, notes)
    inputs = [_input(kind, name, values, notes) for kind, name in _inputs(given)]
    if not inputs:
        notes.append(
            'there is no input, so nothing will be published: set odom0, pose0, twist0 or imu0 to '
            'a topic, and odom0_config … to what it measures, below the name of this node, '
            'ekf_filter_node, or the one that it was given'
        )
    history: int | None = None
    if values['smooth_lagged_data']:
        history = abs(_nanoseconds(_number(values, 'history_length')))
    timing = Timing(
        _nanoseconds(_number(values, 'sensor_timeout')),
        bool(values['predict_to_current_time']),
        history,
    )
    control = _control(values, inputs, notes)
    tuning = Tuning(
        _covariance(values, 'process_noise_covariance', np.diag(PROCESS_NOISE)),
        _covariance(values, 'initial_estimate_covariance', np.eye(STATE_SIZE) * INITIAL_VARIANCE),
        _initial_state(values),
        bool(values['dynamic_process_noise_covariance']),
        control,
    )
    notes += _notes_on_values(values, given)
    notes += _notes_on_names(given)
    return EkfParameters(values, inputs, tuning, timing, *frames, notes=notes)


def rows_of(given: Mapping[str, object]) -> list[Spec]:
    """Return the parameters that a node has that is given some."""
    rows = dict(NODE)
    for kind, name in _inputs(given):
        rows[name] = _TOPIC
        rows |= {name + suffix: each for suffix, each in INPUTS[kind].items()}
    return [replace(row, name=name) for name, row in rows.items()]


def _inputs(given: Mapping[str, object]) -> Iterator[tuple[str, str]]:
    """Yield (kind, name) of the inputs; numbers after a gap do not count, as in the original."""
    for kind in INPUTS:
        number = 0
        while f'{kind}{number}' in given:
            yield kind, f'{kind}{number}'
            number += 1


def _values(given: Mapping[str, object], notes: list[str]) -> dict[str, Value]:
    """Return the values of all parameters, of the right types."""
    values: dict[str, Value] = {}
    whole: list[str] = []
    for row in rows_of(given):
        name = row.name
        if given.get(name) is None:
            if name not in _WITHOUT_DEFAULT:
                values[name] = row.default
            continue
        values[name] = row.check(row.adopt(given[name]))
        if row.type == 'double' and not isinstance(given[name], float):
            whole.append(name)
    if whole:
        notes.append(
            f'{", ".join(whole)}: taken as doubles; the original ends with an error at an '
            f'integer, write {values[whole[0]]}'
        )
    frequency = _number(values, 'frequency')
    if frequency > 0.0:
        values.setdefault('sensor_timeout', 1.0 / frequency)
    values.setdefault('world_frame', values['odom_frame'])
    values.setdefault('base_link_frame_output', values['base_link_frame'])
    return values


def _check_length(name: str, value: Value, length: int) -> None:
    assert isinstance(value, tuple), name
    if len(value) != length:
        raise ParameterError(
            f"parameter '{name}' has {len(value)} elements; {length} are expected: "
            f'{", ".join(member.name.lower() for member in StateMember)}'
        )


def _frames(values: Mapping[str, Value], notes: list[str]) -> tuple[str, str, str, str, str]:
    """Return the names of map, odom, base link, base link of the output, and world frame."""
    prefix = str(values.get('tf_prefix', '')).strip('/')
    names = ('map_frame', 'odom_frame', 'base_link_frame', 'base_link_frame_output', 'world_frame')
    map_frame, odom, base, output, world = (
        f'{prefix}/{str(values[name]).lstrip("/")}' if prefix else str(values[name])
        for name in names
    )
    if len({map_frame, odom, base}) < 3 or output in {map_frame, odom}:
        notes.append(
            'Invalid frame configuration! The values for map_frame, odom_frame, and '
            'base_link_frame must be unique. If using a base_link_frame_output values, it must '
            f'not match the map_frame or odom_frame. (They are {map_frame}, {odom}, {base}, '
            f'{output}.)'
        )
    if world not in (map_frame, odom) and values['publish_tf']:
        notes.append(
            f'world_frame is {world}: no transform is published; it should be map_frame '
            f'({map_frame}) or odom_frame ({odom})'
        )
    return map_frame, odom, base, output, world


def _input(kind: str, name: str, values: Mapping[str, Value], notes: list[str]) -> EkfInput:
    """Return an input, and note what it cannot measure."""
    config = values[f'{name}_config']
    _check_length(f'{name}_config', config, STATE_SIZE)
    used = np.array(config, dtype=bool)
    measured = np.zeros(STATE_SIZE, dtype=bool)
    for part in _MEASURES[kind]:
        measured[part] = True
    names = [
        member.name.lower() for member in StateMember if used[member] and not measured[member]
    ]
    if names:
        notes.append(f'{name}_config: its messages do not hold {", ".join(names)}: not used')
    used &= measured
    differential = bool(values.get(f'{name}_differential', False))
    relative = bool(values.get(f'{name}_relative', False))
    if differential and relative:
        notes.append(
            f'Both {name}_differential and {name}_relative were set to true. Using differential '
            'mode.'
        )
    thresholds = {
        part: _number(values, f'{name}{suffix}', NO_THRESHOLD)
        for part, suffix in _thresholds_of(kind).items()
    }
    entry = EkfInput(
        kind,
        name,
        str(values[name]),
        int(values[f'{name}_queue_size']),  # type: ignore[arg-type]
        MeasurementChannel(
            f'{name}_pose' if kind != 'pose' else name,
            _part(used, POSE),
            differential,
            relative and not differential,
            thresholds.get('pose', NO_THRESHOLD),
        ),
        MeasurementChannel(
            f'{name}_twist' if kind != 'twist' else name,
            _part(used, TWIST),
            threshold=thresholds.get('twist', NO_THRESHOLD),
        ),
        MeasurementChannel(
            f'{name}_acceleration',
            _part(used, ACCELERATION),
            threshold=thresholds.get('acceleration', NO_THRESHOLD),
        ),
        bool(values.get(f'{name}_pose_use_child_frame', False)),
        bool(values.get(f'{name}_remove_gravitational_acceleration', False)),
    )
    if not entry.is_used:
        notes.append(
            f'{entry.topic} is listed as an input topic ({name}), but all update variables are '
            f'false: set some of {name}_config'
        )
    return entry


def _thresholds_of(kind: str) -> Mapping[str, str]:
    """Return the suffixes of rejection thresholds, by what they are of."""
    if kind in ('pose', 'twist'):
        return {kind: '_rejection_threshold'}
    both = {'pose': '_pose_rejection_threshold', 'twist': '_twist_rejection_threshold'}
    if kind == 'imu':
        return both | {'acceleration': '_linear_acceleration_rejection_threshold'}
    return both


def _part(used: Mask, part: slice) -> Mask:
    result = np.zeros(STATE_SIZE, dtype=bool)
    result[part] = used[part]
    return result


def _number(values: Mapping[str, Value], name: str, default: float = 0.0) -> float:
    value = values.get(name, default)
    assert isinstance(value, float), name
    return value


def _nanoseconds(seconds: float) -> int:
    return round(seconds * NANOSECONDS)


def _covariance(values: Mapping[str, Value], name: str, default: Array) -> Array:
    """Return a covariance of 225 elements, or of 15 on its diagonal. Raises ParameterError."""
    given = values.get(name)
    if given is None:
        return default
    assert isinstance(given, tuple)
    if len(given) == STATE_SIZE:
        return np.diag(np.array(given, dtype=float))
    if len(given) == STATE_SIZE * STATE_SIZE:
        return np.array(given, dtype=float).reshape(STATE_SIZE, STATE_SIZE)
    raise ParameterError(
        f'Invalid {name} specified. Expected a length of {STATE_SIZE} or '
        f'{STATE_SIZE * STATE_SIZE}, received length {len(given)}'
    )


def _initial_state(values: Mapping[str, Value]) -> Array:
    given = values.get('initial_state')
    if given is None:
        return np.zeros(STATE_SIZE)
    _check_length('initial_state', given, STATE_SIZE)
    return np.array(given, dtype=float)


def _control(
    values: Mapping[str, Value], inputs: Sequence[EkfInput], notes: list[str]
) -> ControlLimits | None:
    """Return how commands are followed; None: they are not."""
    if not values['use_control']:
        return None
    if 'control_config' not in values:
        notes.append(
            'use_control is set to true, but control_config is missing. No control term will be '
            'used.'
        )
        return None
    used = list(_six(values, 'control_config'))
    for axis, member in enumerate((StateMember.AX, StateMember.AY, StateMember.AZ)):
        if used[axis] and any(each.acceleration.used[member] for each in inputs):
            notes.append(
                f'{"XYZ"[axis]} acceleration is being measured from IMU; {"XYZ"[axis]} velocity '
                'control input is disabled'
            )
            used[axis] = False
    if not any(used):
        notes.append(
            'use_control is set to true, but control_config has only false values. No control '
            'term will be used.'
        )
        return None
    limits = _six(values, 'acceleration_limits') or (1.0,) * 6
    gains = _six(values, 'acceleration_gains') or (1.0,) * 6
    return ControlLimits(
        tuple(bool(each) for each in used),
        _nanoseconds(_number(values, 'control_timeout')),
        limits,
        gains,
        _six(values, 'deceleration_limits') or limits,
        _six(values, 'deceleration_gains') or gains,
    )


def _six(values: Mapping[str, Value], name: str) -> tuple[float, ...]:
    """Return six numbers, or none if they are not given. Raises ParameterError."""
    given = values.get(name, ())
    assert isinstance(given, tuple)
    if given and len(given) != 6:
        raise ParameterError(
            f"parameter '{name}' has {len(given)} elements; 6 are expected: vx, vy, vz, vroll, "
            'vpitch, vyaw'
        )
    return given


def _notes_on_values(values: Mapping[str, Value], given: Mapping[str, object]) -> Iterator[str]:
    """Yield a line for each value that is of no use with the others."""
    history = _number(values, 'history_length')
    if history and not values['smooth_lagged_data']:
        yield (
            f'Filter history interval of {history} specified, but smooth_lagged_data is set to '
            'false. Lagged data will not be smoothed.'
        )
    if history < 0.0 and values['smooth_lagged_data']:
        yield (
            f'Negative history interval of {history} specified. Absolute value will be assumed.'
        )
    if values['smooth_lagged_data'] and not history:
        yield 'smooth_lagged_data has no effect with a history_length of 0: set it in s'
    if values['debug']:
        yield (
            'debug is not offered: no file is written; print_diagnostics tells on /diagnostics '
            'what is wrong with settings or data'
        )
    if values['use_control'] and not values['control_timeout']:
        yield (
            'control_timeout is 0, its default: each command is too old at once, and the robot is '
            'taken to brake; 0.2 would do'
        )
    for name, value in values.items():
        if name.endswith('rejection_threshold') and isinstance(value, float) and value <= 0.0:
            yield f'{name} is {value}: it rejects every measurement; leave it out to reject none'
    for name in ('control_config', 'acceleration_limits', 'deceleration_limits'):
        if name in given and not values['use_control']:
            yield f'{name} has no effect: use_control is false'
            break


def _notes_on_names(given: Mapping[str, object]) -> Iterator[str]:
    """Yield a line for each parameter that is set and not known."""
    known = {each.name for each in rows_of(given)}
    for name in given:
        if name in known or _OF_ROS.fullmatch(name):
            continue
        match = _INPUT.fullmatch(name)
        if match is None:
            close = closest_match(name, [*known, *(f'{kind}0' for kind in INPUTS)])
            guess = f'; did you mean {close}?' if close else ''
            yield f'{name} is set, but there is no such parameter: it has no effect{guess}'
            continue
        kind, number, suffix = match[1], int(match[2]), match[3] or ''
        if suffix == '_nodelay':
            yield f'{name} has no effect: it was for TCP, in ROS 1'
        elif suffix and suffix not in INPUTS[kind]:
            close = closest_match(suffix, list(INPUTS[kind]))
            guess = f'; did you mean {kind}{number}{close}?' if close else ''
            yield f'{name} is set, but there is no such parameter: it has no effect{guess}'
        elif suffix and f'{kind}{number}' not in given:
            yield f'{name} has no effect: {kind}{number}, the topic, is not set'
        elif not suffix:
            gap = next(each for each in range(number) if f'{kind}{each}' not in given)
            yield (
                f'{name} is not read: numbers follow each other from 0 on, and {kind}{gap} is '
                'missing'
            )
