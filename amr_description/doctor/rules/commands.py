# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Velocity commands: whether a drive takes them, and who else sends some."""

from collections.abc import Iterator
import math

from amr_description.clock import NANOSECONDS
from amr_description.doctor.findings import Finding, Rule, Severity
from amr_description.doctor.observations import Observations
from amr_description.doctor.observations.commands import (
    CommandSeen,
    median_period,
    ObservedCommandTopic,
    ObservedDrive,
    series_of,
)
from amr_description.doctor.observations.graph import STAMPED_TWIST
from amr_description.doctor.rules.clock import OTHER_CLOCK
from amr_description.doctor.rules.wording import listed, seconds

_UNSTAMPED = '/cmd_vel_unstamped'
_ABOVE = 1.001
"""Times a limit: less above it is rounding."""


def engaged_stop(seen: Observations) -> Iterator[Finding]:
    """
    A lock holds the robot at rest, whoever commands it.

    ``emergency_stop`` is true: STOP was pressed on a page, or by another program. It outlives the
    page.
    """
    for lock in seen.commands.locks if seen.commands else ():
        if not lock.is_locked:
            continue
        release = f"ros2 topic pub --once {lock.topic} std_msgs/msg/Bool '{{data: false}}'"
        yield Finding(
            severity=Severity.ERROR,
            rule='engaged_stop',
            what=f'{lock.topic} is true, published by {listed(lock.holders) or "nobody any more"}',
            why='the robot is held at rest, and takes no commands until it is released',
            fix='once the way is clear, release STOP where it was pressed, or end '
            f'{listed(lock.holders) or "it"} and {release}',
        )


def unstamped_commands(seen: Observations) -> Iterator[Finding]:
    """
    Twist for ``~/cmd_vel_unstamped``, the name of Humble, which Jazzy has no more.

    Controllers of Jazzy take ``TwistStamped`` on ``~/cmd_vel``. Ours take ``Twist`` too, with
    ``enable_cmd_vel_unstamped: true``.
    """
    for topic in seen.graph.topics if seen.graph else ():
        controller = topic.name.removesuffix(_UNSTAMPED)
        if controller == topic.name or topic.subscriptions or not topic.publishers:
            continue
        stamped = seen.graph.topic(f'{controller}/cmd_vel') if seen.graph else topic
        if not any(each.type_name == STAMPED_TWIST for each in stamped.subscriptions):
            continue
        nodes = listed([each.node for each in topic.publishers])
        yield Finding(
            severity=Severity.ERROR,
            rule='unstamped_commands',
            what=f'{nodes} publishes on {topic.name}, which nobody subscribes to; {controller} '
            f'takes TwistStamped on {stamped.name}',
            why='in Jazzy controllers take stamped commands, and use_stamped_vel is gone',
            fix=f'publish TwistStamped on {stamped.name} (teleop_twist_keyboard -p '
            f'stamped:=true -r cmd_vel:={stamped.name}), or set enable_cmd_vel_unstamped: true '
            f'in {controller}',
        )


def commands_not_finite(seen: Observations) -> Iterator[Finding]:
    """A command that is not finite: controllers do not take it."""
    for topic in _topics(seen):
        wrong = [each for each in topic.seen if not all(map(math.isfinite, _values(each)))]
        if wrong:
            yield Finding(
                severity=Severity.ERROR,
                rule='commands_not_finite',
                what=f'{len(wrong)} of {len(topic.seen)} commands on {topic.name} by '
                f'{listed(topic.publishers)} are no numbers (NaN or inf)',
                why='controllers refuse them, and the robot stops after the last good one',
                fix='mend the publisher: a division by 0, an unset reading; send 0.0 instead',
            )


def commands_of_another_clock(seen: Observations) -> Iterator[Finding]:
    """
    Stamps of commands by the system clock for a simulated robot, or the other way round.

    A stamp of 0, as of ``ros2 topic pub``, counts as the time of arrival.
    """
    for topic in _driven(seen):
        wrong = [e for e in topic.seen if e.age is not None and abs(e.age) > OTHER_CLOCK]
        if not wrong:
            continue
        age = wrong[-1].age or 0
        is_simulated = wrong[-1].is_simulated
        present = '/clock' if is_simulated else 'the system clock'
        yield Finding(
            severity=Severity.ERROR,
            rule='commands_of_another_clock',
            what=f'{listed(topic.publishers)} stamps commands on {topic.name} '
            f'{seconds(abs(age))} {"behind" if age > 0 else "ahead of"} {present}',
            why='its time-out does not work: the robot refuses such commands, or follows the last '
            'one for good',
            fix=f'ros2 param set {_node_of(topic)} use_sim_time {str(is_simulated).lower()}, or '
            'leave the stamp at 0: it counts as the time of arrival',
        )


def commands_too_old(seen: Observations) -> Iterator[Finding]:
    """
    Commands whose stamps are older than the drive's time-out: it refuses them.

    Each is older than ``cmd_vel_timeout`` when it arrives. Its stamp is taken too early, or never
    renewed.
    """
    for topic in _driven(seen):
        aged = [e for e in topic.seen if e.age is not None and abs(e.age) <= OTHER_CLOCK]
        for drive in _drives(seen, topic):
            if not drive.timeout or not aged:
                continue
            limit = drive.timeout * NANOSECONDS
            if not all((each.age or 0) >= limit for each in aged):
                continue
            youngest = min(each.age or 0 for each in aged)
            needed = math.ceil(youngest / NANOSECONDS * 10 + 1) / 10
            yield Finding(
                severity=Severity.ERROR,
                rule='commands_too_old',
                what=f'commands of {listed(topic.publishers)} on {topic.name} are stamped '
                f'{seconds(youngest)} ago or more, and {drive.node} takes none older than '
                f'{drive.timeout:g} s',
                why='each is refused on arrival, and the robot does not move',
                fix=f'stamp with the present, self.get_clock().now(), or leave the stamp at 0; or '
                f'set {drive.timeout_parameter}: {needed:g} in {drive.node}',
            )


def contending_commands(seen: Observations) -> Iterator[Finding]:
    """
    Two publishers command one drive at once.

    Teleop and a navigator, or two pages. Let twist_mux decide
    (docs/localisation.md#between-planner-and-wheels).
    """
    for topic in _driven(seen):
        active = [each for each in series_of(topic.seen) if len(each) > 1]
        if not any(
            _overlap(one, other) for i, one in enumerate(active) for other in active[i + 1 :]
        ):
            continue
        driving = [series for series in active if any(any(_values(each)) for each in series)]
        if len(driving) < 2:
            continue  # the others hold it at rest, as the page's STOP does
        drives = listed([drive.node for drive in _drives(seen, topic)])
        yield Finding(
            severity=Severity.ERROR,
            rule='contending_commands',
            what=f'{len(active)} publishers command {drives} on {topic.name} at once: '
            f'{listed(topic.publishers)}',
            why='the robot follows each for a moment: it jerks, and nobody drives it',
            fix='end all but one, or let a mux decide: ros2 run twist_mux twist_mux --ros-args '
            f'--params-file config/twist_mux.yaml -r cmd_vel_out:={topic.name}, with each '
            'publisher on a topic of its own',
        )


def commands_too_seldom(seen: Observations) -> Iterator[Finding]:
    """
    Commands that come more seldom than the drive's time-out: it brakes between them.

    The time-out is ``cmd_vel_timeout``. ``ros2 topic pub`` sends once a second without ``--rate
    10``.
    """
    factor = (seen.clock.factor if seen.clock else None) or 1.0
    for topic in _driven(seen):
        series = [each for each in series_of(topic.seen) if len(each) > 1]
        for drive in _drives(seen, topic):
            if not drive.timeout or len(series) != 1:
                continue
            period = median_period(series[0]) * factor
            if period <= drive.timeout or not any(any(_values(each)) for each in series[0]):
                continue
            rate = math.ceil(2.0 / drive.timeout)
            yield Finding(
                severity=Severity.WARNING,
                rule='commands_too_seldom',
                what=f'{listed(topic.publishers)} sends a command on {topic.name} every '
                f'{period:.2g} s, and {drive.node} brakes {drive.timeout:g} s after each',
                why='the robot goes and stops by turns',
                fix=f'send more often: ros2 topic pub --rate {rate}, or a timer of '
                f'{1000 / rate:.0f} ms; or set {drive.timeout_parameter}: '
                f'{math.ceil(period * 20) / 10:g} in {drive.node}',
            )


def commands_beyond_limits(seen: Observations) -> Iterator[Finding]:
    """
    All commands are beyond what the drive is limited to.

    The controller cuts them. If it cuts one of two velocities, the robot drives another arc:
    ``preserve_curvature: true`` keeps it.
    """
    for topic in _driven(seen):
        for drive in _drives(seen, topic):
            for name, least, most in drive.limits:
                values = [_component(each, name) for each in topic.seen]
                moving = [each for each in values if each and math.isfinite(each)]
                if not moving or not all(_is_beyond(each, least, most) for each in moving):
                    continue
                unit = 'rad/s' if name.startswith('angular') else 'm/s'
                value = max(moving, key=abs)
                bound, kind = (most, 'max') if value > 0 else (least, 'min')
                yield Finding(
                    severity=Severity.WARNING,
                    rule='commands_beyond_limits',
                    what=f'{listed(topic.publishers)} commands {name} {value:g} {unit} on '
                    f'{topic.name}, and {drive.node} is limited to {bound:g} {unit}',
                    why='the robot is slower than commanded, and its arcs are others where only '
                    'one of two velocities is cut',
                    fix=f'command {bound:g} {unit} at most, or set {name}.{kind}_velocity: '
                    f'{value:g} in {drive.node}',
                )


def _topics(seen: Observations) -> tuple[ObservedCommandTopic, ...]:
    return seen.commands.topics if seen.commands else ()


def _driven(seen: Observations) -> list[ObservedCommandTopic]:
    """Return the topics on which something came that a drive takes."""
    return [each for each in _topics(seen) if each.seen and _drives(seen, each)]


def _drives(seen: Observations, topic: ObservedCommandTopic) -> tuple[ObservedDrive, ...]:
    return seen.commands.drives_on(topic.name) if seen.commands else ()


def _values(command: CommandSeen) -> tuple[float, float, float]:
    return *command.linear, command.angular


def _component(command: CommandSeen, name: str) -> float:
    """Return the value of ``linear.x``, ``linear.y`` or ``angular.z``."""
    return {'linear.x': command.linear[0], 'linear.y': command.linear[1]}.get(
        name, command.angular
    )


def _is_beyond(value: float, least: float, most: float) -> bool:
    return value > most * _ABOVE if value > 0.0 else value < least * _ABOVE


def _overlap(one: list[CommandSeen], other: list[CommandSeen]) -> bool:
    return one[0].received < other[-1].received and other[0].received < one[-1].received


def _node_of(topic: ObservedCommandTopic) -> str:
    # Of a node whose name was not discovered yet the probe says 'a node'.
    return next((each for each in topic.publishers if each.startswith('/')), 'NODE')


RULES: tuple[Rule, ...] = (
    unstamped_commands,
    engaged_stop,
    commands_not_finite,
    commands_of_another_clock,
    commands_too_old,
    contending_commands,
    commands_too_seldom,
    commands_beyond_limits,
)
