# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What ``<param>`` may say in the ``<hardware>`` block of a motor board on a serial port."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from amr_description.control.contracts import Log, Severity
from amr_description.errors import HardwareError, ParameterError
from amr_description.hardware.serial_protocol import LONGEST_WATCHDOG, SHORTEST_WATCHDOG
from amr_description.model.hardware_info import HardwareInfo
from amr_description.parameters import build, parameter, Spec, specs


@dataclass(frozen=True, slots=True)
class SerialParameters:
    """
    One row a ``<param>``; lists are written with spaces or commas between the names.

    A *reduction* is how many turns of the motor shaft make one turn of the wheel, negative where a
    motor is mounted the other way round.
    """

    port: str = parameter(
        '', 'Path of the serial port; best one of /dev/serial/by-id', not_empty=True
    )
    left_joints: tuple[str, ...] = parameter(
        (), 'Joints that the left motor turns', not_empty=True
    )
    right_joints: tuple[str, ...] = parameter(
        (), 'Joints that the right motor turns', not_empty=True
    )
    left_reduction: float = parameter(1.0, 'Of the left gear', not_zero=True)
    right_reduction: float = parameter(1.0, 'Of the right gear', not_zero=True)
    max_velocity: float = parameter(
        20.0, 'No wheel is told to turn faster', unit='rad/s', above=0.0
    )
    baud_rate: int = parameter(115200, 'Of the port', unit='bit/s', minimum=1)
    connect_timeout: float = parameter(
        1.0,
        'Longest wait for the board to introduce itself; more for one that restarts when its port '
        'is opened',
        unit='s',
        above=0.0,
        maximum=10.0,
    )
    answer_timeout: float = parameter(
        0.25, 'Longest wait for any other answer', unit='s', minimum=0.05, maximum=5.0
    )
    watchdog_timeout: float = parameter(
        0.2,
        'The board stops by itself when it has heard no command for so long',
        unit='s',
        minimum=SHORTEST_WATCHDOG / 1000,
        maximum=LONGEST_WATCHDOG / 1000,
    )


_READERS: dict[str, Callable[[str], Any]] = {
    'string': str,
    'integer': int,
    'double': float,
    'string_array': lambda text: tuple(text.replace(',', ' ').split()),
}


def read_parameters(info: HardwareInfo, log: Log) -> SerialParameters:
    """Return the checked parameters; one that is not known is warned of. Raises HardwareError."""
    table = {spec.name: spec for spec in specs(SerialParameters)}
    for name in info.parameters.keys() - table.keys():
        log(
            Severity.WARN,
            f"hardware component '{info.name}': parameter '{name}' has no effect. Known: "
            f'{", ".join(table)}',
        )
    try:
        given = {n: _read(table[n], text) for n, text in info.parameters.items() if n in table}
        return build(SerialParameters, given)
    except ParameterError as error:
        raise HardwareError(f"hardware component '{info.name}': {error}") from error


def _read(spec: Spec, text: str) -> Any:
    try:
        return _READERS[spec.type](text)
    except ValueError:
        raise ParameterError(
            f"parameter '{spec.name}' must be of type {spec.type}, found '{text}'"
        ) from None
