# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The topic ``odom``."""

import math

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
    ODOMETRY_TYPE,
    OdometrySeen,
)
from amr_description.navigation.contract.series import absence_of, mean_rate, names_of

LOWEST_RATE = 20.0
"""Hz."""

_FEWEST = 3
_ROUNDING = 1e-3
_WHO = 'start the drive controller or the EKF that publishes odometry'
_LEAST_WAY = 0.1
"""m in one go, from which on speeds and poses are compared."""
_LARGEST_DIFFERENCE = 0.2
"""Of the way by poses, that the way by speeds may differ."""


def reliable(seen: ContractObservations) -> CheckOutcome:
    """
    Nav2's ``SystemDefaultsQoS`` is reliable with Cyclone DDS, best effort with Fast DDS.

    A reliable publisher serves both; one of best effort is not heard by the first.
    """
    if not seen.odom.publishers:
        return _absence(seen)
    others = [each for each in seen.odom.publishers if each.type_name != ODOMETRY_TYPE]
    if others:
        kinds = ', '.join(dict.fromkeys(each.type_name for each in others))
        return failed(f'{names_of(others)} publishes {kinds}', f'use {ODOMETRY_TYPE}')
    lossy = [each for each in seen.odom.publishers if not each.is_reliable]
    if not (lossy or seen.odometry):
        return _absence(seen)
    return outcome(
        not lossy,
        f'{names_of(lossy)} publishes by best effort'
        if lossy
        else f'{names_of(seen.odom.publishers)} publishes reliably',
        'publish with the default QoS: reliable, volatile',
    )


def rate(seen: ContractObservations) -> CheckOutcome:
    """The controllers of Nav2 take the present speed from it."""
    stamps = [each.stamp for each in seen.odometry]
    if not stamps:
        return _absent(seen)
    if len(stamps) < _FEWEST:
        return failed(f'{len(stamps)} messages in {seen.seconds:.0f} s', 'publish at 50 Hz')
    found = mean_rate(stamps)
    return outcome(
        found >= LOWEST_RATE * (1.0 - _ROUNDING),
        f'{found:.1f} Hz of {len(stamps)} messages by {names_of(seen.odom.publishers)}',
        'raise publish_rate of the drive controller, or frequency of the EKF, to 50',
    )


def frames(seen: ContractObservations) -> CheckOutcome:
    """The pose is in the odometry frame, the twist in the one of the robot."""
    if not seen.odometry:
        return _absent(seen)
    names = seen.frames
    found = dict.fromkeys((each.frame, each.child_frame) for each in seen.odometry)
    wrong = [
        pair
        for pair in found
        if pair[0] != names.odom or pair[1] not in (names.footprint, names.base)
    ]
    return outcome(
        not wrong,
        ' and '.join(f"'{frame}' → '{child}'" for frame, child in wrong or found),
        f"set the frames of who publishes it to '{names.odom}' and '{names.footprint}' "
        '(odom_frame_id, base_frame_id of a drive controller)',
    )


def twist(seen: ContractObservations) -> CheckOutcome:
    """Of a robot that has turned, the world's axes are not those of its base."""
    if not seen.odometry:
        return _absent(seen)
    way, by_poses, by_speeds = _ways(seen)
    if way < _LEAST_WAY:
        return not_checked(
            f'the robot moved {way:.2f} m; {_LEAST_WAY:g} m are needed',
            'drive it, or give --drive',
        )
    difference = math.dist(by_poses, by_speeds) / way
    return outcome(
        difference <= _LARGEST_DIFFERENCE,
        f'by poses it went {by_poses[0]:+.2f} m ahead and {by_poses[1]:+.2f} m to the left, by '
        f'twists {by_speeds[0]:+.2f} m and {by_speeds[1]:+.2f} m',
        'give twist.linear and twist.angular in the axes of child_frame_id, m/s and rad/s',
    )


def covariances(seen: ContractObservations) -> CheckOutcome:
    """robot_localization takes a variance of 0 for certainty: it replaces it by 1e-9."""
    if not seen.odometry:
        return _absent(seen)
    labels = ('x', 'y', 'yaw', 'speed along x', 'speed about z')
    least = [min(each.variances[place] for each in seen.odometry) for place in range(5)]
    wrong = [label for label, value in zip(labels, least, strict=True) if not value > 0.0]
    return outcome(
        not wrong,
        f'not above 0: {", ".join(wrong)}'
        if wrong
        else ', '.join(f'{label} {value:.3g}' for label, value in zip(labels, least, strict=True)),
        'set pose_covariance_diagonal and twist_covariance_diagonal of the drive controller: '
        '[0.001, 0.001, 1.0e+6, 1.0e+6, 1.0e+6, 0.01]',
    )


def _ways(seen: ContractObservations) -> tuple[float, tuple[float, float], tuple[float, float]]:
    """Return the length of the way, and how far ahead and to the left, by poses and by twists."""
    way, by_poses, by_speeds = 0.0, [0.0, 0.0], [0.0, 0.0]
    for before, after in zip(seen.odometry, seen.odometry[1:], strict=False):
        ahead, left = _step(before, after)
        way += math.hypot(ahead, left)
        time = (after.stamp - before.stamp) / NANOSECONDS
        for axis, moved in enumerate((ahead, left)):
            by_poses[axis] += abs(moved)
            by_speeds[axis] += 0.5 * time * abs(before.linear[axis] + after.linear[axis])
    return way, (by_poses[0], by_poses[1]), (by_speeds[0], by_speeds[1])


def _step(before: OdometrySeen, after: OdometrySeen) -> tuple[float, float]:
    """Return how far a robot moved along its own axes, m, of the heading half way."""
    yaw = before.yaw + 0.5 * math.remainder(after.yaw - before.yaw, math.tau)
    cos, sin = math.cos(yaw), math.sin(yaw)
    x, y = after.x - before.x, after.y - before.y
    return cos * x + sin * y, cos * y - sin * x


def _absent(seen: ContractObservations) -> CheckOutcome:
    """Return that messages are lacking, which is the fault of ``odom.qos`` alone."""
    return not_checked(f'no message came on {seen.odom.name}')


def _absence(seen: ContractObservations) -> CheckOutcome:
    others = seen.elsewhere.get(ODOMETRY_TYPE, ())
    return absence_of(seen.odom, ODOMETRY_TYPE, seen.seconds, _WHO, others)


def ordered(seen: ContractObservations) -> CheckOutcome:
    """Stamps that repeat give speeds of infinity to whoever divides by their difference."""
    if not seen.odometry:
        return _absent(seen)
    stamps = [each.stamp for each in seen.odometry]
    wrong = sum(later <= earlier for earlier, later in zip(stamps, stamps[1:], strict=False))
    if not wrong:
        return passed(f'{len(stamps)} stamps, each later than the one before')
    return failed(
        f'{wrong} of {len(stamps)} not later than the one before; it is published by '
        f'{names_of(seen.odom.publishers)}',
        'let one node publish odometry on this topic',
    )
