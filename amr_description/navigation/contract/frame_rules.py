# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The tree of frames, and the transform of odometry."""

from collections.abc import Iterator
from itertools import pairwise

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
    ScanSeen,
    TransformSeen,
)
from amr_description.navigation.contract.series import mean_rate, names_of, not_after, seconds

LOWEST_ODOM_RATE = 30.0
"""Hz."""

TF_TIMEOUT = 200_000_000
"""ns that slam_toolbox waits for the transform of a scan: ``tf_timeout``."""

_FEWEST = 3
_ROUNDING = 1e-3
_SHOWN = 4
_ODOMETRY_OWNER = (
    'let one node publish it: the drive controller (enable_odom_tf: true) or an EKF (publish_tf)'
)


def parents(seen: ContractObservations) -> dict[str, TransformSeen]:
    """Return the last transform of each frame that has a parent."""
    return {each.child: each for each in seen.transforms}


def ancestors(tree: dict[str, TransformSeen], frame: str) -> Iterator[TransformSeen]:
    """Yield the transforms from a frame up to its root; of a loop each once."""
    passed_by: set[str] = set()
    while frame in tree and frame not in passed_by:
        passed_by.add(frame)
        yield tree[frame]
        frame = tree[frame].parent


def odometry_edge(seen: ContractObservations) -> TransformSeen | None:
    """Return the transform from the odometry frame to what is below it on the way to the base."""
    tree, names = parents(seen), seen.frames
    for frame in (names.footprint, names.base):
        for edge in ancestors(tree, frame):
            if edge.parent == names.odom:
                return edge
    return None


def both_bases(seen: ContractObservations) -> CheckOutcome:
    """Nav2's costmaps use one of the two, AMCL, the collision monitor and SLAM the other."""
    names = seen.frames
    wanted = (names.odom, names.base, names.footprint)
    known = {*parents(seen), *(each.parent for each in seen.transforms)}
    missing = [name for name in wanted if name not in known]
    if not missing:
        return _both_below_odom(seen, len(known))
    if not known:
        return failed(
            f'no frames at all; /tf is published by {names_of(seen.tf.publishers)}',
            'start robot_state_publisher and the drive controller; with /tf in a namespace: '
            '-r /tf:=tf -r /tf_static:=tf_static',
        )
    others = ', '.join(sorted(known)[:_SHOWN]) + (' …' if len(known) > _SHOWN else '')
    return failed(
        f'no {" and no ".join(missing)}; there are {others}', _for_missing(missing, known)
    )


def _both_below_odom(seen: ContractObservations, count: int) -> CheckOutcome:
    tree, names = parents(seen), seen.frames
    lost = [
        frame
        for frame in (names.base, names.footprint)
        if names.odom not in {each.parent for each in ancestors(tree, frame)}
    ]
    return outcome(
        not lost,
        f'{" and ".join(lost)} is not below {names.odom}'
        if lost
        else f'{names.odom}, {names.base}, {names.footprint} are among {count} frames',
        'publish the transform of odometry to the root of the URDF, and the URDF by '
        'robot_state_publisher',
    )


def _for_missing(missing: list[str], known: set[str]) -> str:
    """Return what would do where frames are missing: prefixed ones are there, or none."""
    prefixed = [name for name in sorted(known) if name.rpartition('/')[2] in missing]
    if prefixed:
        return (
            f'{" and ".join(prefixed)} would be given by --odom-frame, --base-frame and '
            '--footprint-frame, and in the parameters of Nav2 and slam_toolbox'
        )
    return (
        'add an empty link base_footprint on the ground, joined to base_link by a fixed joint, to '
        'the URDF, and have the odometry published as a transform'
    )


def odometry_moves(seen: ContractObservations) -> CheckOutcome:
    """The pose of the robot in the odometry frame comes with every odometry."""
    names = seen.frames
    edge = odometry_edge(seen)
    if edge is None:
        return failed(
            f'no way from {names.odom} to {names.footprint} or {names.base}; /tf is published by '
            f'{names_of(seen.tf.publishers)}',
            _ODOMETRY_OWNER,
        )
    return outcome(
        not edge.is_static,
        f'{edge.parent} → {edge.child} is {"static" if edge.is_static else "dynamic"}',
        'remove the static_transform_publisher of the odometry frame',
    )


def one_parent(seen: ContractObservations) -> CheckOutcome:
    """A frame that two nodes publish jumps between their poses."""
    faults = [text for child in parents(seen) if (text := _conflict(seen, child))]
    if not seen.transforms:
        return not_checked('no transform came')
    return outcome(
        not faults,
        '; '.join(faults[:_SHOWN])
        + (f'; published by {names_of(seen.tf.publishers)}' if faults else '')
        or f'{len(parents(seen))} frames, each with one',
        'let one node publish each frame: of the odometry either the drive controller '
        '(enable_odom_tf) or an EKF (publish_tf), and its child is the root of the URDF',
    )


def _conflict(seen: ContractObservations, child: str) -> str:
    """Return how a frame is published twice; '' if it is not."""
    edges = [each for each in seen.transforms if each.child == child]
    kinds = list(dict.fromkeys((each.parent, each.is_static) for each in edges))
    if len(kinds) > 1:
        return f'{child} is published ' + ' and '.join(
            f'{"static" if is_static else "dynamic"} in {parent}' for parent, is_static in kinds
        )
    if edges[0].is_static:
        return f'{child} has two static poses' if len({e.transform for e in edges}) > 1 else ''
    numbers = [each.sequence for each in edges if each.sequence]
    if any(later < earlier for earlier, later in pairwise(numbers)):
        return f'{child} is published in {edges[0].parent} by two nodes'
    return ''


def others_stand_still(seen: ContractObservations) -> CheckOutcome:
    """What else moves moves by a joint; a sensor that is published as moving costs a lookup."""
    edge = odometry_edge(seen)
    if edge is None:
        return not_checked(f'no way from {seen.frames.odom} to the robot')
    tree = parents(seen)
    below = [
        each
        for child, each in tree.items()
        if not each.is_static and child != edge.child and edge in ancestors(tree, child)
    ]
    if seen.body is None:
        names = ', '.join(sorted(each.child for each in below)[:_SHOWN])
        return (
            not_checked(f'{names} move, and no robot_description came that says by which joints')
            if below
            else passed(f'below {edge.child} all is static')
        )
    links = seen.body.moving_links
    strange = sorted(each.child for each in below if each.child.rpartition('/')[2] not in links)
    return outcome(
        not strange,
        f'{", ".join(strange[:_SHOWN])} move without a joint that moves'
        if strange
        else f'below {edge.child} {len(below)} frames move, each by a joint',
        'publish it once, on /tf_static, or make it the child of a joint in the URDF',
    )


def odometry_rate(seen: ContractObservations) -> CheckOutcome:
    """Between two of its transforms nobody knows where the robot is."""
    stamps = _odometry_stamps(seen)
    if len(stamps) < _FEWEST:
        return _too_few(seen, stamps)
    rate = mean_rate(stamps)
    return outcome(
        rate >= LOWEST_ODOM_RATE * (1.0 - _ROUNDING),
        f'{rate:.1f} Hz of {len(stamps)} transforms',
        'raise publish_rate of the drive controller, or frequency of the EKF, to 50',
    )


def odometry_order(seen: ContractObservations) -> CheckOutcome:
    """Tf2 ignores a transform whose stamp is not later than the last one."""
    stamps = _odometry_stamps(seen)
    if len(stamps) < _FEWEST:
        return _too_few(seen, stamps)
    wrong = not_after(stamps)
    if wrong:
        earlier, later = wrong[0]
        return failed(
            f'{len(wrong)} of {len(stamps)} not later than the one before, first '
            f'{seconds(later)} after {seconds(earlier)}; /tf is published by '
            f'{names_of(seen.tf.publishers)}',
            _ODOMETRY_OWNER,
        )
    return passed(f'{len(stamps)} stamps, each later than the one before')


def known_at_scans(seen: ContractObservations) -> CheckOutcome:
    """slam_toolbox holds one scan back until the transform at its stamp is known, no longer."""
    if not seen.scans:
        return not_checked(f'no scan came on {seen.scan.name}')
    scans = _judged(seen)
    if not scans:
        return not_checked(f'{len(seen.scans)} scans came before the first transform')
    late = [scan for scan in scans if scan.wait is None or scan.wait > TF_TIMEOUT]
    if late:
        waits = [scan.wait for scan in late if scan.wait is not None]
        why = f'up to {seconds(max(waits))} late' if waits else late[0].error or 'never'
        return failed(
            f'not known at {len(late)} of {len(scans)} stamps: {why}',
            'publish odometry more often and before the scan, on one clock with the lidar, stamp '
            'the scan with the time of its measurement, and publish the frame of the lidar',
        )
    longest = max(scan.wait or 0 for scan in scans)
    return passed(
        f'known at all {len(scans)} stamps, at most {longest / NANOSECONDS * 1e3:.0f} ms '
        'after the scan'
    )


def _judged(seen: ContractObservations) -> list[ScanSeen]:
    """Return the scans of which it can be said, between the first transforms and the end."""
    knows = [place for place, scan in enumerate(seen.scans) if scan.wait is not None]
    return [
        scan
        for scan in seen.scans[knows[0] if knows else 0 :]
        if scan.wait is not None or seen.ended is None or seen.ended - scan.received > TF_TIMEOUT
    ]


def scan_frame_fixed(seen: ContractObservations) -> CheckOutcome:
    """slam_toolbox reads the pose of a lidar on the robot once."""
    if not seen.scans:
        return not_checked(f'no scan came on {seen.scan.name}')
    tree, names = parents(seen), seen.frames
    faults = []
    frames = dict.fromkeys(scan.frame for scan in seen.scans)
    for frame in frames:
        way = []
        is_connected = frame in (names.base, names.footprint)
        for edge in ancestors(tree, frame):
            if is_connected:
                break
            way.append(edge)
            is_connected = edge.parent in (names.base, names.footprint)
        moving = [edge.child for edge in way if not edge.is_static]
        if not is_connected:
            faults.append(f"'{frame}' is not below {names.base} or {names.footprint}")
        elif moving:
            faults.append(f"'{frame}' moves against the robot, by {', '.join(moving)}")
    return outcome(
        not faults,
        '; '.join(faults) or f'{", ".join(frames)} is fixed to the robot',
        'set the frame of the sensor (frame_id, gz_frame_id) to a link of the URDF that fixed '
        'joints connect to base_link',
    )


def _odometry_stamps(seen: ContractObservations) -> list[int]:
    edge = odometry_edge(seen)
    if edge is None or edge.is_static:
        return []
    return [
        each.stamp
        for each in seen.transforms
        if each.child == edge.child and each.parent == edge.parent and not each.is_static
    ]


def _too_few(seen: ContractObservations, stamps: list[int]) -> CheckOutcome:
    edge = odometry_edge(seen)
    if edge is None or edge.is_static:
        return not_checked(f'no moving transform from {seen.frames.odom} to the robot')
    return failed(
        f'{len(stamps)} transforms {edge.parent} → {edge.child} in {seen.seconds:.0f} s',
        'let the drive controller publish them at 50 Hz, and time run',
    )
