# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``/clock``, ``use_sim_time``, and the real-time factor."""

from collections.abc import Set

from amr_description.clock import NANOSECONDS
from amr_description.navigation.contract.findings import (
    CheckOutcome,
    failed,
    not_checked,
    outcome,
    passed,
)
from amr_description.navigation.contract.observations import ContractObservations
from amr_description.navigation.contract.series import names_of, seconds, usual_rate

LOWEST_CLOCK_RATE = 100.0
"""Hz of simulated time."""

REAL_TIME_FACTORS = (0.9, 1.1)

_FEWEST_TICKS = 3
_ROUNDING = 1e-3  # of a rate: 99.95 Hz are 100 Hz
_SHOWN = 5
_REAL = 'nobody publishes /clock: a real robot, whose nodes follow the system clock'


def one_clock(seen: ContractObservations) -> CheckOutcome:
    """One node publishes the time; with two, it jumps back and forth."""
    if not seen.is_simulated:
        waiting = _nodes(seen, sim_time=True)
        if waiting:
            return failed(
                f'nobody publishes /clock, and use_sim_time is true in {waiting}: they stay at 0',
                'start the simulation, or set use_sim_time: false',
            )
        return not_checked(_REAL)
    count = len(seen.clock.publishers)
    return outcome(
        count == 1,
        f'{count} publisher{"s" if count > 1 else ""}: {names_of(seen.clock.publishers)}',
        'end all but one: a second simulator, a bridge, ros2 bag play --clock',
    )


def clock_rate(seen: ContractObservations) -> CheckOutcome:
    """Timers, time-outs and rates of nodes with simulated time are as coarse as the clock."""
    if not seen.is_simulated:
        return not_checked(_REAL)
    times = [tick.time for tick in seen.ticks]
    if len(times) < _FEWEST_TICKS:
        return failed(
            f'{len(times)} messages in {seen.seconds:.0f} s of {names_of(seen.clock.publishers)}',
            'let the time of the simulation run',
        )
    rate = usual_rate(times)
    if not rate:
        return failed(f'time stands still at {seconds(times[-1])}', 'unpause the simulation')
    return outcome(
        rate >= LOWEST_CLOCK_RATE * (1.0 - _ROUNDING),
        f'{rate:.1f} Hz by {names_of(seen.clock.publishers)}',
        'raise the rate of /clock: in mujoco_sim the update_rate of the controller manager, in '
        'Gazebo the max_step_size, of ros2 bag play --clock 100',
    )


def clock_order(seen: ContractObservations) -> CheckOutcome:
    """Where time goes back, tf2 and costmaps drop what they know."""
    if not seen.is_simulated:
        return not_checked(_REAL)
    times = [tick.time for tick in seen.ticks]
    back = [(a, b) for a, b in zip(times, times[1:], strict=False) if b < a]
    if back:
        before, after = back[0]
        return failed(
            f'{len(back)} times, first from {seconds(before)} to {seconds(after)}; it is '
            f'published by {names_of(seen.clock.publishers)}',
            'end all publishers of /clock but one',
        )
    if len(times) < _FEWEST_TICKS:
        return not_checked(f'{len(times)} messages on /clock')
    reset = f'; the simulation was reset {seen.resets} times meanwhile' if seen.resets else ''
    return passed(f'{len(times)} messages in order{reset}')


def same_time(seen: ContractObservations) -> CheckOutcome:
    """A node on another clock takes every stamp for too old, or for one of the future."""
    if not seen.use_sim_time:
        return not_checked('no node has said its use_sim_time')
    expected = seen.is_simulated
    unharmed = _unharmed(seen) if expected else frozenset()
    other = _nodes(seen, sim_time=not expected, but=unharmed)
    value = str(expected).lower()
    if other:
        return failed(
            f'use_sim_time is {str(not expected).lower()} in {other}',
            f'set use_sim_time: {value} there, as /clock is {"" if expected else "not "}published',
        )
    count = len(seen.use_sim_time) - len(unharmed)
    harmless = f'; not in {_names(unharmed)}, which no stamp can harm' if unharmed else ''
    silent = f'; no answer of {", ".join(seen.silent_nodes)}' if seen.silent_nodes else ''
    return passed(f'use_sim_time is {value} in all {count} nodes{harmless}{silent}')


def real_time_factor(seen: ContractObservations) -> CheckOutcome:
    """In Jazzy loops of Nav2 run on the system clock: at factor 5 they are 5 times too slow."""
    if not seen.is_simulated:
        return not_checked(_REAL)
    if len(seen.ticks) < _FEWEST_TICKS:
        return not_checked(f'{len(seen.ticks)} messages on /clock')
    first, last = seen.ticks[0], seen.ticks[-1]
    wall = last.received - first.received
    factor = (last.time - first.time) / wall if wall > 0 else 0.0
    lower, upper = REAL_TIME_FACTORS
    return outcome(
        lower <= factor <= upper,
        f'{factor:.2f} over {wall / NANOSECONDS:.1f} s',
        "Nav2's controller, costmaps, behaviours and velocity smoother run on the system clock in "
        'Jazzy: set rtf:=1 (real_time_factor 1.0), and on a slow machine simulate less; other '
        'factors and lock-step are for tests without Nav2',
    )


def _unharmed(seen: ContractObservations) -> frozenset[str]:
    """
    Return the nodes on the system clock that do well with it where time is simulated.

    They follow ``/clock`` by a subscription of their own, or neither publish nor subscribe to
    anything that is stamped here.
    """
    stamped = (seen.tf, seen.odom, seen.scan, seen.map, seen.cmd_vel)
    ends = {end.node for each in stamped for end in (*each.publishers, *each.subscriptions)}
    follow = {end.node for end in seen.clock.subscriptions}
    other = {name for name, value in seen.use_sim_time.items() if not value}
    return frozenset(other & follow | other - ends)


def _nodes(seen: ContractObservations, *, sim_time: bool, but: Set[str] = frozenset()) -> str:
    """Return the nodes whose use_sim_time has a value, the first few by name."""
    return _names({name for name, value in seen.use_sim_time.items() if value is sim_time} - but)


def _names(nodes: Set[str]) -> str:
    found = sorted(nodes)
    more = f' and {len(found) - _SHOWN} more' if len(found) > _SHOWN else ''
    return ', '.join(found[:_SHOWN]) + more
