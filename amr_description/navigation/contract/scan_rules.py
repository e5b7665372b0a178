# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The topic ``scan``."""

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
    SCAN_TYPE,
    ScanSeen,
)
from amr_description.navigation.contract.scan_length import expected_length, is_full_circle
from amr_description.navigation.contract.series import (
    absence_of,
    clock_around,
    names_of,
    not_after,
    seconds,
    usual_rate,
)

RATES = (5.0, 20.0)
"""Hz."""

OLDEST = 300_000_000
"""ns: ``transform_tolerance`` of costmaps; the collision monitor's ``source_timeout`` is 1 s."""

LEAST_RANGE_MAX = 3.0
"""m: ``raytrace_max_range`` of the costmaps; ``obstacle_max_range`` is 2.5."""

SLAM_RANGE = 20.0
"""m: ``max_laser_range`` in slam_toolbox's mapper_params_online_async.yaml."""

_FEWEST = 3
_ROUNDING = 1e-3
_WHO = 'start the driver of the lidar; the shipped robot has one with sensors:=true'
_SYSTEM_CLOCK_LEAD = 10_000_000
"""ns that a stamp of a real robot may be ahead of the clock of the machine that listens."""


def published(seen: ContractObservations) -> CheckOutcome:
    """All subscribe with ``SensorDataQoS``, of best effort, which any publisher of it serves."""
    topic = seen.scan
    others = [each for each in topic.publishers if each.type_name != SCAN_TYPE]
    if others:
        kinds = ', '.join(dict.fromkeys(each.type_name for each in others))
        advice = f'use {SCAN_TYPE}; pointcloud_to_laserscan makes it of clouds'
        return failed(f'{names_of(others)} publishes {kinds} on {topic.name}', advice)
    if not seen.scans:
        elsewhere = seen.elsewhere.get(SCAN_TYPE, ())
        return absence_of(topic, SCAN_TYPE, seen.seconds, _WHO, elsewhere)
    kinds = ', '.join(
        dict.fromkeys('reliable' if e.is_reliable else 'best effort' for e in topic.publishers)
    )
    return passed(f'{len(seen.scans)} scans of {names_of(topic.publishers)}, {kinds}')


def rate(seen: ContractObservations) -> CheckOutcome:
    """Fewer are too old when they are used, more cost without being used."""
    if len(seen.scans) < _FEWEST:
        return _absent(seen)
    found = usual_rate([scan.stamp for scan in seen.scans])
    lowest, highest = RATES
    return outcome(
        lowest * (1.0 - _ROUNDING) <= found <= highest * (1.0 + _ROUNDING),
        f'{found:.1f} Hz',
        'set the update_rate of the lidar to 10',
    )


def length(seen: ContractObservations) -> CheckOutcome:
    """Karto refuses a scan of another length: ``LaserRangeScan contains … range readings``."""
    if not seen.scans:
        return _absent(seen)
    for scan in seen.scans:
        shape = scan.geometry
        expected = expected_length(shape)
        angles = (
            f'{shape.angle_min:.5f} to {shape.angle_max:.5f} by {shape.angle_increment:.6f} rad'
        )
        if expected != shape.count:
            return failed(
                f'{shape.count} ranges from {angles}, of which slam_toolbox computes {expected}',
                'publish angle_max = angle_min + (number of ranges - 1) · angle_increment',
            )
    kind = 'a full circle' if is_full_circle(shape) else 'no full circle for it'
    return passed(f'{shape.count} ranges from {angles}, {kind}')


def ranges(seen: ContractObservations) -> CheckOutcome:
    """REP 117: +inf where nothing is met, -inf where it is too near, NaN where it failed."""
    if not seen.scans:
        return _absent(seen)
    total = sum(scan.geometry.count for scan in seen.scans)
    beyond, nearer, infinite, invalid, hits = (
        sum(getattr(scan.counts, name) for scan in seen.scans)
        for name in ('beyond', 'nearer', 'infinite', 'invalid', 'hits')
    )
    shape = seen.scans[-1].geometry
    wrong = [f'{beyond} are finite and above range_max {shape.range_max:g} m'] if beyond else []
    wrong += [f'{nearer} are finite and below range_min {shape.range_min:g} m'] if nearer else []
    wrong += ['none is a range or +inf'] if total and not (hits or infinite) else []
    if wrong:
        return failed(
            f'of {total} ranges {" and ".join(wrong)}',
            'publish +inf where nothing is met and -inf where it is too near, as REP 117 says',
        )
    text = f'of {total} ranges {hits} are hits, {infinite} +inf'
    return passed(text + (f', {invalid} NaN' if invalid else ''))


def constant(seen: ContractObservations) -> CheckOutcome:
    """slam_toolbox reads the geometry of a lidar from its first scan."""
    if not seen.scans:
        return _absent(seen)
    found = {scan.frame: [each for each in seen.scans if each.frame == scan.frame]
             for scan in seen.scans}  # fmt: skip
    faults = [fault for frame, scans in found.items() if (fault := _change_in(frame, scans))]
    return outcome(
        not faults,
        '; '.join(faults) or f'the same in {len(seen.scans)} scans',
        'give each lidar a topic of its own; of a driver whose number of rays varies set a fixed '
        'one (sllidar, ydlidar: angle_compensate, fixed_resolution)',
    )


def _change_in(frame: str, scans: list[ScanSeen]) -> str:
    """Return how angles, limits or length of the scans of one frame change; '' if they do not."""
    shapes = list(dict.fromkeys(scan.geometry for scan in scans))
    if len(shapes) == 1:
        return ''
    names = ('angle_min', 'angle_max', 'angle_increment', 'range_min', 'range_max', 'count')
    first, second = shapes[0], shapes[1]
    for name in names:
        before, after = getattr(first, name), getattr(second, name)
        if before != after:
            return f"{name} of '{frame}' is {before:g} and {after:g}"
    return f"the geometry of '{frame}' has values that are no numbers"


def age(seen: ContractObservations) -> CheckOutcome:
    """A stamp is the time of the measurement, and the scan is used soon after it."""
    if not seen.scans:
        return _absent(seen)
    ages = [age for scan in seen.scans if (age := _ages_of(seen, scan))]
    if not ages:
        return not_checked('no message on /clock before and after a scan')
    oldest = max(older for older, _ in ages)
    lead = max(-newer for _, newer in ages)
    if lead > 0:
        return failed(
            f'stamps are up to {seconds(lead)} later than the present',
            'stamp with the time of the measurement, on the same clock: set use_sim_time of the '
            'driver, or synchronize the clocks of the machines (chrony)',
        )
    return outcome(
        oldest < OLDEST,
        f'{oldest / NANOSECONDS * 1e3:.0f} ms at most when received',
        'stamp with the time of the measurement, on the same clock, and process less on the way; '
        'or raise transform_tolerance of the costmaps',
    )


def _ages_of(seen: ContractObservations, scan: ScanSeen) -> tuple[int, int] | None:
    """Return the age of a scan at reception, ns, and at the next tick or within tolerance."""
    if not seen.is_simulated:
        age = scan.received - scan.stamp
        return age, age + _SYSTEM_CLOCK_LEAD
    around = clock_around(seen.ticks, scan.received)
    return around and (around[0] - scan.stamp, around[1] - scan.stamp)


def in_order(seen: ContractObservations) -> CheckOutcome:
    """Two publishers, or a driver that repeats itself."""
    if len(seen.scans) < _FEWEST:
        return _absent(seen)
    wrong = [
        pair
        for frame in {scan.frame for scan in seen.scans}
        for pair in not_after([scan.stamp for scan in seen.scans if scan.frame == frame])
    ]
    if not wrong:
        return passed(f'{len(seen.scans)} stamps, each later than the one before')
    earlier, later = wrong[0]
    return failed(
        f'{seconds(later)} after {seconds(earlier)}, {len(wrong)} times; published by '
        f'{names_of(seen.scan.publishers)}',
        'let one node publish scans of a frame',
    )


def reach(seen: ContractObservations) -> CheckOutcome:
    """Beyond the reach of the lidar costmaps neither mark nor clear."""
    if not seen.scans:
        return _absent(seen)
    least = min(scan.geometry.range_max for scan in seen.scans)
    found = f'range_max {least:g} m'
    if not least >= LEAST_RANGE_MAX:
        return failed(
            found,
            'use a lidar that reaches farther, or lower obstacle_max_range and raytrace_max_range '
            f'of the costmaps to {least:g}',
        )
    misses = any(scan.counts.infinite for scan in seen.scans)
    note = (
        'set inf_is_valid: true for scan in the obstacle layers: by default rays of +inf do not '
        'clear what was marked'
    )
    return passed(found, note if misses else '')


def slam_reach(seen: ContractObservations) -> CheckOutcome:
    """slam_toolbox warns of a larger one, and uses that of the scan."""
    if not seen.scans:
        return _absent(seen)
    least = min(scan.geometry.range_max for scan in seen.scans)
    found = {
        node: value
        for node, values in seen.parameters.items()
        if isinstance(value := values.get('max_laser_range'), int | float)
    }
    if not found:
        advice = f'set max_laser_range: {least:g} in its parameters (its file has {SLAM_RANGE:g})'
        return not_checked(
            f'slam_toolbox is not there; range_max is {least:g} m',
            advice if least < SLAM_RANGE else '',
        )
    wrong = [node for node, value in found.items() if value > least]
    return outcome(
        not wrong,
        ', '.join(f'max_laser_range {value:g} m in {node}' for node, value in found.items())
        + f', range_max {least:g} m',
        f'set max_laser_range: {least:g}',
    )


def _absent(seen: ContractObservations) -> CheckOutcome:
    if seen.scans:
        return failed(
            f'{len(seen.scans)} scans in {seen.seconds:.0f} s', 'set the update_rate to 10'
        )
    return not_checked(f'no message came on {seen.scan.name}')
