# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""When the transform at each scan's stamp became known to a listener of ``/tf``."""

from collections.abc import Sequence
from dataclasses import replace

from amr_description.errors import TransformException
from amr_description.navigation.contract.observations import ScanSeen, TransformSeen
from amr_description.tf2_ros.buffer_core import BufferCore
from amr_description.tf2_ros.time_cache import StampedTransform


def with_lookups(
    scans: Sequence[ScanSeen], transforms: Sequence[TransformSeen], target: str
) -> tuple[ScanSeen, ...]:
    """
    Return scans with the time from each one's reception until ``target`` ← its frame was known.

    It looks up exactly at the stamp, as ``tf2_ros::MessageFilter`` does: nothing is extrapolated.

    Args:
        scans: in the order of their reception.
        transforms: all that came, in the order of their reception.
        target: the frame that scans are transformed to.
    """
    buffer = BufferCore()
    done: dict[int, ScanSeen] = {}
    waiting: dict[int, ScanSeen] = {}

    def look(place: int, scan: ScanSeen, now: int) -> None:
        try:
            buffer.lookup_transform(target, scan.frame, scan.stamp)
        except TransformException as error:
            waiting[place] = replace(scan, error=str(error))
        else:
            waiting.pop(place, None)
            done[place] = replace(scan, wait=max(0, now - scan.received))

    rest = list(enumerate(scans))[::-1]
    for each in transforms:
        while rest and rest[-1][1].received < each.received:
            place, scan = rest.pop()
            look(place, scan, scan.received)
        stamped = StampedTransform(each.parent, each.child, each.stamp, each.transform)
        buffer.set_transform(stamped, static=each.is_static)
        for place, scan in list(waiting.items()):
            look(place, scan, each.received)
    for place, scan in reversed(rest):
        look(place, scan, scan.received)
    return tuple(scan for _, scan in sorted((done | waiting).items()))
