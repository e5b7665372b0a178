# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
How long a command takes to the wheels, and how late the cycles of the control loop are.

The simulator keeps real time. Each command has a speed of its own, by which it is found again in
the command interface of a wheel. Both processes read the same monotonic clock.
"""

from collections.abc import Callable
import random
import time

from geometry_msgs.msg import TwistStamped
from rclpy.node import Node

from amr_description.clock import NANOSECONDS
from amr_description.errors import BringupError
from amr_description.ros.service_calls import wait_until
from benchmarks.cycle import controlled_robot, Simulator
from benchmarks.punctuality import latencies, percentile, Punctuality, punctuality, speed_of, Tick
from benchmarks.stack import COMMAND_TOPIC, TIMEOUT

_PERIOD = 0.017
"""s between two commands, on the average."""


def latency_figures(node: Node, seconds: float) -> dict[str, float]:
    """Measure at 100 Hz and at 1 kHz, for ``seconds`` of the wall clock each."""
    slow, _ = _measured(node, 100, seconds)
    quick, kept = _measured(node, 1000, seconds)
    return {
        '100 Hz p50': percentile(slow, 0.5),
        '100 Hz p99': percentile(slow, 0.99),
        '1 kHz p50': percentile(quick, 0.5),
        '1 kHz p99': percentile(quick, 0.99),
        'missed': kept.missed,
        'late': kept.late,
    }


def _measured(node: Node, rate: int, seconds: float) -> tuple[list[float], Punctuality]:
    """Return the latencies (ms) at an update rate (Hz), and how the cycles were kept."""
    publisher = node.create_publisher(TwistStamped, COMMAND_TOPIC, 1)
    try:
        with controlled_robot(factor=1.0, update_rate=rate) as simulator:
            if not wait_until(
                node, lambda: publisher.get_subscription_count() or None, timeout=TIMEOUT
            ):
                raise BringupError(f'nobody subscribes to {COMMAND_TOPIC}')
            time.sleep(0.5)  # the start is over, and the other side has seen this one
            sent, ticks = _send(publisher.publish, simulator, seconds)
    finally:
        node.destroy_publisher(publisher)
    found = latencies(sent, ticks)
    if len(found) < 0.9 * len(sent):
        raise BringupError(f'{len(found)} of {len(sent)} commands came to the wheels')
    return found, punctuality(ticks, NANOSECONDS // rate)


def _send(
    publish: Callable[[TwistStamped], None], simulator: Simulator, seconds: float
) -> tuple[dict[int, int], list[Tick]]:
    simulator.ask('ticks', seconds=seconds)
    sent: dict[int, int] = {}
    message, chance = TwistStamped(), random.Random(1)
    end = time.monotonic() + seconds - 0.1
    while time.monotonic() < end:
        number = len(sent)
        message.twist.linear.x = speed_of(number)
        sent[number] = time.monotonic_ns()
        publish(message)
        # Not in step with the cycles, which the instants of the commands would favour.
        time.sleep(_PERIOD * (0.5 + chance.random()))
    return sent, [Tick(*each) for each in simulator.answer()]
