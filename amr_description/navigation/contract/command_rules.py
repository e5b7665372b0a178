# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The topic ``cmd_vel``, and how the robot follows it."""

from amr_description.clock import NANOSECONDS
from amr_description.navigation.contract.findings import (
    CheckOutcome,
    failed,
    not_checked,
    outcome,
    passed,
)
from amr_description.navigation.contract.observations import (
    ContractObservations,
    OdometrySeen,
    Phase,
    STAMPED_TWIST_TYPE,
    TWIST_TYPE,
)
from amr_description.navigation.contract.series import names_of, seconds

LINEAR_SPEED = 0.5
"""m/s: ``max_velocity`` of Nav2's velocity smoother."""

ANGULAR_SPEED = 2.0
"""rad/s: the same about z."""

LONGEST_BRAKING = NANOSECONDS
"""ns from the last command until the robot stands."""

PROGRESS = 0.5
"""m: ``required_movement_radius`` of Nav2's progress checker."""

PROGRESS_TIME = 10 * NANOSECONDS
"""ns: its ``movement_time_allowance``."""

STANDING = 0.02
"""m/s and rad/s; a robot is taken to stand below this."""

_REACHED = 0.95
_LIMITS = {'linear': 'linear.x', 'angular': 'angular.z'}


def listened_to(seen: ContractObservations) -> CheckOutcome:
    """At the end of ``cmd_vel_nav → cmd_vel_smoothed → cmd_vel`` is the robot."""
    topic = seen.cmd_vel
    velocities = [
        e for e in topic.subscriptions if e.type_name in (TWIST_TYPE, STAMPED_TWIST_TYPE)
    ]
    if velocities:
        return passed(f'{names_of(velocities)} on {topic.name}')
    if topic.subscriptions:
        kinds = ', '.join(dict.fromkeys(each.type_name for each in topic.subscriptions))
        return failed(
            f'{names_of(topic.subscriptions)} subscribes to {kinds} on {topic.name}',
            f'subscribe to {TWIST_TYPE}',
        )
    others = seen.other_command_topics
    elsewhere = '; '.join(f'{names_of(each.subscriptions)} on {each.name}' for each in others)
    advice = (
        f'remap one to the other, -r cmd_vel:={others[0].name}, or run twist_mux between them'
        if others
        else 'start the drive controller'
    )
    found = f'nobody subscribes to {topic.name}' + (f'; {elsewhere}' if elsewhere else '')
    return failed(found, advice)


def of_one_type(seen: ContractObservations) -> CheckOutcome:
    """DDS connects equal types only, and tells nobody; Jazzy's Nav2 publishes Twist by default."""
    topic = seen.cmd_vel
    kinds = {each.type_name for each in topic.subscriptions} & {TWIST_TYPE, STAMPED_TWIST_TYPE}
    if not kinds:
        return not_checked(f'nobody subscribes to velocities on {topic.name}')
    wrong = [each for each in topic.publishers if each.type_name not in kinds]
    if wrong:
        return failed(
            f'{names_of(wrong)} publishes {wrong[0].type_name} on {topic.name}, but '
            f'{names_of(topic.subscriptions)} subscribes to {" and ".join(sorted(kinds))}',
            'set enable_stamped_cmd_vel in all nodes of Nav2 as the robot wants it: '
            f'{str(STAMPED_TWIST_TYPE in kinds).lower()}',
        )
    wanted = STAMPED_TWIST_TYPE if seen.is_stamped else TWIST_TYPE
    other = 'false' if seen.is_stamped else 'true'
    return outcome(
        wanted in kinds,
        f'{names_of(topic.subscriptions)} subscribes to {" and ".join(sorted(kinds))}',
        f'set enable_stamped_cmd_vel: {other} in all nodes of Nav2'
        + ('' if seen.is_stamped else ', and give --stamped here'),
    )


def linear_speed(seen: ContractObservations) -> CheckOutcome:
    """What the velocity smoother commands, open loop."""
    return _reached(seen, 'linear', LINEAR_SPEED, 'm/s')


def angular_speed(seen: ContractObservations) -> CheckOutcome:
    """What the velocity smoother commands, open loop."""
    return _reached(seen, 'angular', ANGULAR_SPEED, 'rad/s')


def braking(seen: ContractObservations) -> CheckOutcome:
    """Without commands the robot stops by itself: who sent them may be gone."""
    if not seen.drive:
        return not_checked(seen.not_driven)
    longest = 0
    for phase in seen.drive:
        stood = _stood(phase)
        if stood is None:
            last = phase.odometry[-1] if phase.odometry else None
            speed = f'{last.linear[0]:.2f} m/s and {last.angular:.2f} rad/s' if last else 'unknown'
            return failed(
                f'of {_command(phase)} it still has {speed}',
                'set a time-out of commands, as cmd_vel_timeout: 0.5 of drive controllers',
            )
        longest = max(longest, stood - phase.ceased)
    return outcome(
        longest < LONGEST_BRAKING,
        f'{seconds(longest)} at most, from {" and from ".join(map(_command, seen.drive))}',
        'lower the time-out of commands (cmd_vel_timeout of drive controllers), or raise the '
        'deceleration',
    )


def progress(seen: ContractObservations) -> CheckOutcome:
    """A robot that is slower is taken to be stuck."""
    phase = next((each for each in seen.drive if each.linear), None)
    if phase is None:
        return not_checked(seen.not_driven)
    start = phase.odometry[0] if phase.odometry else None
    for each in phase.odometry:
        assert start is not None, 'the first one is there'
        if _distance(start, each) >= PROGRESS:
            time = each.stamp - phase.began
            return outcome(
                time <= PROGRESS_TIME,
                f'{PROGRESS:g} m in {seconds(time)}',
                'drive faster, or raise movement_time_allowance of the progress checker',
            )
    way = _distance(start, phase.odometry[-1]) if start else 0.0
    return failed(
        f'{way:.2f} m while {_command(phase)} was commanded',
        'see whether the controller is active, the way is free, and STOP is released',
    )


def _reached(seen: ContractObservations, kind: str, wanted: float, unit: str) -> CheckOutcome:
    phase = next((each for each in seen.drive if getattr(each, kind)), None)
    if phase is None:
        return not_checked(seen.not_driven)
    speeds = [each.linear[0] if kind == 'linear' else each.angular for each in phase.odometry]
    fastest = max(speeds, default=0.0)
    return outcome(
        fastest >= _REACHED * wanted,
        f'{fastest:.2f} {unit} by odometry, of {_command(phase)}',
        f'raise {_LIMITS[kind]}.max_velocity of the drive controller, or lower max_velocity of '
        "Nav2's velocity_smoother and the speeds of its controller",
    )


def _stood(phase: Phase) -> int | None:
    """Return the stamp from which on it stood after the last command; None: it never did."""
    stood: int | None = None
    for each in phase.odometry:
        if each.stamp < phase.ceased:
            continue
        is_standing = max(*map(abs, each.linear), abs(each.angular)) < STANDING
        stood = (each.stamp if stood is None else stood) if is_standing else None
    return stood


def _command(phase: Phase) -> str:
    return f'{phase.linear:g} m/s' if phase.linear else f'{phase.angular:g} rad/s'


def _distance(before: OdometrySeen, after: OdometrySeen) -> float:
    return float(((after.x - before.x) ** 2 + (after.y - before.y) ** 2) ** 0.5)
