# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``tf2_echo``: print the pose of one frame in another, periodically.

::

    ros2 run tf2_ros tf2_echo odom base_link           # the pose of base_link in odom, 1 Hz
    ros2 run tf2_ros tf2_echo odom base_link 10        # 10 Hz; also -r 10
    ros2 run tf2_ros tf2_echo odom base_link -t 12.5   # where it was at 12.5 s; waits until known
    ros2 run tf2_ros tf2_echo odom base_link --once

Arguments, texts and exit codes are those of the original. But the first transform is printed as
soon as it is known, ``-t`` has nanosecond resolution, stamps keep their zeros (``5.000000003``,
not ``5.3``), and no number is ``-0.000``.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from decimal import Decimal, InvalidOperation
import math
import threading
import time
from typing import Any

from rclpy.time import Time

from amr_description.clock import NANOSECONDS
from amr_description.errors import TransformException, UsageError
from amr_description.model.frames import rpy_from_quaternion
from amr_description.tf2_ros.buffer import stamped_transform
from amr_description.tf2_ros.time_cache import LATEST, seconds, StampedTransform
from amr_description.tf2_ros.tools import (
    arguments_of,
    listening,
    print_now,
    run_tool,
    wait_for_transform,
)

USAGE = """\
Usage: tf2_echo source_frame target_frame [options]

Print the transform that takes coordinates from target_frame to source_frame: the pose of
target_frame in source_frame.

Options:
  -r <rate>       How often, Hz (default: 1.0); also as a third word
  -t <time>       The time to look at, s (default: the latest)
  -p <precision>  Digits behind the point (default: 3)
  --once          Print it once and end"""

_MOST_DIGITS = 17  # a double has no more


@dataclass(frozen=True)
class EchoRequest:
    """What to print: ``rate`` in Hz, ``time`` in ns (0: the latest)."""

    source: str
    target: str
    rate: float = 1.0
    time: int = LATEST
    precision: int = 3
    once: bool = False


def parse(words: Sequence[str]) -> EchoRequest | None:
    """Read a command line; None: the frames are missing. Raises UsageError."""
    frames: list[str] = []
    options: dict[str, Any] = {}
    rest = iter(words)
    for word in rest:
        if word == '--once':
            options['once'] = True
        elif word in _OPTIONS:
            name, read = _OPTIONS[word]
            value = next(rest, None)
            if value is None:
                raise _usage_error(5, f'{word} needs a value: see tf2_echo --help')
            options[name] = read(value)
        elif len(frames) < 2:
            frames.append(word)
        elif len(frames) == 2 and 'rate' not in options and not word.startswith('--'):
            options['rate'] = _rate(word)
        else:
            raise _usage_error(5, f'Unknown argument: {word}: see tf2_echo --help')
    return EchoRequest(frames[0], frames[1], **options) if len(frames) == 2 else None


def text_of(stamped: StampedTransform, precision: int = 3) -> str:
    """Return the lines that are printed for a transform; ``precision``: decimals."""
    rpy = rpy_from_quaternion(stamped.transform.rotation)

    def row(values: Sequence[float]) -> str:
        return f'[{", ".join(f"{value:z.{precision}f}" for value in values)}]'

    return '\n'.join(
        [
            f'At time {_stamp(stamped.time)}',
            f'- Translation: {row(stamped.transform.translation)}',
            f'- Rotation: in Quaternion (xyzw) {row(stamped.transform.rotation)}',
            f'- Rotation: in RPY (radian) {row(rpy)}',
            f'- Rotation: in RPY (degree) {row([math.degrees(angle) for angle in rpy])}',
            '- Matrix:',
            *(
                ''.join(f' {value:z6.{precision}f}' for value in line)
                for line in stamped.transform.to_matrix()
            ),
        ]
    )


def echo(args: list[str] | None) -> int:
    """Print until Ctrl-C; return the exit code."""
    words = arguments_of(args)
    wants_help = not {'-h', '--help'}.isdisjoint(words)
    request = None if wants_help else parse(words)
    if request is None:
        print_now(USAGE)
        return 0 if wants_help else 1
    when = Time(nanoseconds=request.time)
    with listening('tf2_echo', args) as (node, buffer, _):
        wait_for_transform(node, buffer, request.source, request.target, when)
        due = time.monotonic()
        while True:
            try:
                transform = stamped_transform(
                    buffer.lookup_transform(request.source, request.target, when)
                )
                print_now(text_of(transform, request.precision))
            except TransformException as error:
                now = seconds(node.get_clock().now().nanoseconds)
                print_now(
                    f'Failure at {now}\nException thrown:{error}\n'
                    f'The current list of frames is:\n{buffer.all_frames_as_string()}'
                )
            if request.once:
                return 0
            due = max(due + 1.0 / request.rate, time.monotonic())
            threading.Event().wait(due - time.monotonic())


def main(args: list[str] | None = None) -> int:
    """Print until Ctrl-C."""
    return run_tool(lambda: echo(args))


def _stamp(stamp: int) -> str:
    """Format a stamp, ns; 0, of static transforms, is ``0.0``."""
    whole, fraction = divmod(stamp, NANOSECONDS)
    return f'{whole}.{fraction:09d}' if stamp else '0.0'


def _rate(word: str) -> float:
    rate = _number(word, 2, 'rate')
    if rate <= 0.0:
        raise _usage_error(2, f"Rate must be positive, not '{word}'")
    return float(rate)


def _time(word: str) -> int:
    moment = _number(word, 3, 'time')
    if moment < 0:
        raise _usage_error(3, f"Time must be non-negative, not '{word}'")
    return int(moment * NANOSECONDS)


def _precision(word: str) -> int:
    try:
        digits = int(word)
    except ValueError:
        raise _usage_error(
            4, f"Failed to convert precision argument '{word}' to an integer"
        ) from None
    if digits < 0:
        raise _usage_error(4, f"Precision must be non-negative, not '{word}'")
    if digits > _MOST_DIGITS:
        raise _usage_error(4, f"Precision must be at most {_MOST_DIGITS}, not '{word}'")
    return digits


def _number(word: str, code: int, name: str) -> Decimal:
    try:
        number = Decimal(word)
    except InvalidOperation:
        number = Decimal('nan')
    if not number.is_finite() or number > 1e12:
        raise _usage_error(
            code, f"Failed to convert {name} argument '{word}' to a floating-point number"
        )
    return number


def _usage_error(code: int, text: str) -> UsageError:
    """Return the error with the exit code of the original."""
    error = UsageError(text)
    error.exit_code = code
    return error


_OPTIONS = {
    '-r': ('rate', _rate),
    '-t': ('time', _time),
    '-p': ('precision', _precision),
}


if __name__ == '__main__':
    raise SystemExit(main())
