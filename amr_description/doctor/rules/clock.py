# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``/clock``, ``use_sim_time``, the real-time factor, and stamps of another clock."""

from collections.abc import Iterator
from itertools import pairwise
import math

from amr_description.clock import NANOSECONDS
from amr_description.doctor.findings import Finding, Rule, Severity
from amr_description.doctor.observations import Observations
from amr_description.doctor.observations.clock import StampSeen
from amr_description.doctor.observations.graph import ObservedGraph
from amr_description.doctor.rules.wording import listed, passes_on, right_clock, seconds

OTHER_CLOCK = 60 * NANOSECONDS
"""ns: a stamp that is this far from the present is of another clock, not late or early."""

LEAST_FACTOR_SHARE = 0.9
"""Share of the real-time factor that was asked for, below which it is not kept."""

_CLOCK = '/clock'
_RESET_BEFORE = NANOSECONDS
"""ns of simulated time: where it goes back to less, the simulation was reset."""
_SILENCE = 1.0
"""s without a message on ``/clock``, after which none is on its way."""
_STAMPED = {
    'geometry_msgs/msg/PoseWithCovarianceStamped',
    'geometry_msgs/msg/TwistStamped',
    'nav_msgs/msg/Odometry',
    'sensor_msgs/msg/CameraInfo',
    'sensor_msgs/msg/Image',
    'sensor_msgs/msg/Imu',
    'sensor_msgs/msg/JointState',
    'sensor_msgs/msg/LaserScan',
    'sensor_msgs/msg/PointCloud2',
    'tf2_msgs/msg/TFMessage',
}
"""Whoever publishes one of these stamps it by the node's clock, and whoever subscribes to one
compares the stamps with it."""


def two_clocks(seen: Observations) -> Iterator[Finding]:
    """
    Two nodes publish ``/clock``: the time of all others jumps between them.

    Simulators, bridges of Gazebo and ``ros2 bag play --clock`` publish it. End all but one, or use
    another ``ROS_DOMAIN_ID``.
    """
    clock = seen.clock
    if clock is None or len(clock.publishers) < 2:
        return
    there = seen.graph.topic(_CLOCK).publishers if seen.graph else ()
    if len(there) == 1:
        return  # the other one has ended, and stays in the graph for a moment
    names = listed(clock.publishers)
    yield Finding(
        severity=Severity.ERROR,
        rule='two_clocks',
        what=f'{len(clock.publishers)} publishers of {_CLOCK}: {names}',
        why='the time of every node with use_sim_time jumps between them: tf2 and costmaps drop '
        'their data, timers stop',
        fix='end all but one (a second simulator, a bridge, ros2 bag play --clock), or separate '
        'them: export ROS_DOMAIN_ID=7 for one',
    )


def no_clock(seen: Observations) -> Iterator[Finding]:
    """
    Nodes wait for a simulated time that nobody publishes.

    Until ``/clock`` comes, their time is 0 and their timers stand. Start what publishes it, or set
    ``use_sim_time`` to false for a real robot.
    """
    if seen.clock is None or seen.clock.publishers or seen.graph is None:
        return
    waiting = [each.name for each in seen.graph.nodes if each.use_sim_time]
    if not waiting:
        return
    subscribers = seen.graph.topic(_CLOCK).subscriptions
    if not {each.node for each in subscribers} & {*waiting}:
        return
    yield Finding(
        severity=Severity.ERROR,
        rule='no_clock',
        what=f'use_sim_time is true in {listed(waiting)}, and nobody publishes {_CLOCK}',
        why='their time stays at 0: timers do not run, stamps are 0, transforms are not found',
        fix='start the simulation, or play the bag with --clock 100, or '
        f'ros2 param set {waiting[0]} use_sim_time false',
    )


def standing_clock(seen: Observations) -> Iterator[Finding]:
    """
    Simulated time stands still: the simulation is paused.

    Controllers stand with it. The fix is the command that lets time go on.
    """
    clock = seen.clock
    if clock is None or len(clock.publishers) != 1:
        return
    is_mute = not clock.ticks and clock.seconds >= _SILENCE
    if not clock.is_standing and not is_mute:
        return
    what = f'nothing comes on {_CLOCK} from {clock.publishers[0]}'
    if clock.ticks:
        what = f'{_CLOCK} stands still at {seconds(clock.ticks[-1].time)}'
    source = next((each for each in clock.sources if each.resume), None)
    yield Finding(
        severity=Severity.WARNING,
        rule='standing_clock',
        what=what,
        why='the simulation is paused: controllers do not run, and nodes with use_sim_time wait',
        fix=source.resume if source else f'let {clock.publishers[0]} go on, or start it again',
    )


def clock_goes_back(seen: Observations) -> Iterator[Finding]:
    """
    Simulated time goes back, though one node alone publishes it.

    tf2 clears its buffer ("Detected jump back in time"), and filters begin anew. A bag with
    ``--loop`` does so. One reset of a simulation is no finding.
    """
    clock = seen.clock
    if clock is None or len(clock.publishers) != 1:
        return
    times = [tick.time for tick in clock.ticks]
    back = [(a, b) for a, b in pairwise(times) if b < a and b >= _RESET_BEFORE]
    if not back:
        return
    before, after = back[0]
    yield Finding(
        severity=Severity.WARNING,
        rule='clock_goes_back',
        what=f'{_CLOCK} goes back from {seconds(before)} to {seconds(after)}; it is published '
        f'by {clock.publishers[0]}',
        why='tf2 clears its buffer and warns of TF_OLD_DATA, filters and planners begin anew',
        fix='play a bag without --loop; after a reset of the simulation start again what keeps '
        'its time (EKF, SLAM, Nav2)',
    )


def mixed_use_sim_time(seen: Observations) -> Iterator[Finding]:
    """
    Nodes on the system clock among others on simulated time, or the other way round.

    It takes all their stamps for decades old. The parameter can be set while the node runs. Not
    named are nodes that handle no stamps, and those that subscribe to ``/clock`` themselves.
    """
    graph, clock = seen.graph, seen.clock
    if graph is None or clock is None or not clock.publishers:
        return
    followers = {each.node for each in graph.topic(_CLOCK).subscriptions}
    exempt = {*clock.publishers} | followers
    stamping = _stamping(graph)
    wrong = sorted(
        {
            node.name
            for node in graph.nodes
            if node.use_sim_time is False
            and node.name not in exempt
            and node.name in stamping
            and not passes_on(node.name)
        }
    )
    if not wrong:
        return
    others = sum(bool(node.use_sim_time) for node in graph.nodes)
    yield Finding(
        severity=Severity.ERROR,
        rule='mixed_use_sim_time',
        what=f'use_sim_time is false in {listed(wrong)}, though {clock.publishers[0]} publishes '
        f'{_CLOCK}' + (f' and {others} other nodes use it' if others else ''),
        why='its clock is decades ahead of simulated time: transforms and messages are too '
        'old for it, or of the future',
        fix='; '.join(f'ros2 param set {name} use_sim_time true' for name in wrong[:3])
        + ' (for good: use_sim_time: true in its parameters)',
    )


def stamps_of_another_clock(seen: Observations) -> Iterator[Finding]:
    """
    Messages whose stamp is of another clock than the present.

    ``header.stamp`` is more than a minute off: by ``time.time()`` in a simulation, or by machines
    whose clocks differ. Stamp by ``self.get_clock().now()``.
    """
    if seen.clock is None or len(seen.clock.publishers) > 1:
        return
    found: dict[tuple[tuple[str, ...], str, str], list[str]] = {}
    for each in seen.clock.stamps:
        if kind := _other_clock(each):
            found.setdefault((each.publishers, *kind), []).append(each.topic)
    for (nodes, what, fix), topics in found.items():
        yield Finding(
            severity=Severity.ERROR,
            rule='stamps_of_another_clock',
            what=f'{listed(nodes)} stamps {listed(topics)} {what}',
            why='tf2, message filters and costmaps drop it: too old, or of the future',
            fix=fix.replace('NODE', nodes[0]),
        )


def slow_simulation(seen: Observations) -> Iterator[Finding]:
    """
    The simulation is slower than it was asked to be.

    It misses its ``real_time_factor`` by more than a tenth. Results are right all the same. The
    finding names the stage that takes the time.
    """
    clock = seen.clock
    if clock is None or len(clock.publishers) != 1 or clock.is_standing:
        return
    measured = clock.factor
    source = next((each for each in clock.sources if each.asked_factor), None)
    if measured is None or source is None or not source.asked_factor:
        return
    asked = source.asked_factor
    if measured >= LEAST_FACTOR_SHARE * asked:
        return
    suggested = max(math.floor(90.0 * measured) / 100.0, 0.01)
    yield Finding(
        severity=Severity.WARNING,
        rule='slow_simulation',
        what=f'the real-time factor is {measured:.2g} instead of {asked:g}'
        + (f'; {source.node}: {source.report}' if source.report else ''),
        why='results are right, but what goes by the system clock (drivers, Nav2 in Jazzy, you) '
        'finds the robot slow',
        fix=f'ros2 param set {source.node} {source.speed_parameter} {suggested:g}, or simulate '
        'less at once: fewer robots, sensors, contacts',
    )


def _other_clock(stamp: StampSeen) -> tuple[str, str] | None:
    """Return what is wrong with a stamp, and what mends it; None: nothing."""
    present = stamp.received if stamp.time is None else stamp.time
    if stamp.stamp == 0 or abs(stamp.stamp - present) <= OTHER_CLOCK:
        return None
    if stamp.time is None:
        if stamp.stamp < stamp.received / 2:
            return (
                f'{seconds(stamp.stamp)}, a simulated time, but nobody publishes {_CLOCK}',
                'ros2 param set NODE use_sim_time false, or play its bag with --clock 100',
            )
        return (
            f'{_apart(stamp.stamp - stamp.received)} of the system clock here',
            right_clock(stamp.publishers),
        )
    if abs(stamp.stamp - stamp.received) <= OTHER_CLOCK:
        return (
            f'by the system clock, but {_CLOCK} is at {seconds(stamp.time)}',
            'ros2 param set NODE use_sim_time true, and stamp by the clock of the node: '
            'self.get_clock().now()',
        )
    return (
        f'{_apart(stamp.stamp - stamp.time)} of {_CLOCK}',
        'stamp by the clock of the node, self.get_clock().now(), with use_sim_time true',
    )


def _apart(lead: int) -> str:
    return f'{seconds(abs(lead))} {"ahead" if lead > 0 else "behind"}'


def _stamping(graph: ObservedGraph) -> set[str]:
    """Return the nodes that publish or subscribe to what is compared by its stamp."""
    return {
        end.node
        for topic in graph.topics
        if topic.publishers and topic.subscriptions
        for end in (*topic.publishers, *topic.subscriptions)
        if end.type_name in _STAMPED
    }


RULES: tuple[Rule, ...] = (
    two_clocks,
    no_clock,
    clock_goes_back,
    mixed_use_sim_time,
    stamps_of_another_clock,
    standing_clock,
    slow_simulation,
)
