# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The QoS of a verb: from its flags, or matched to the publishers of the topic."""

from argparse import Namespace
from collections.abc import Iterable
import copy

from rclpy.duration import Duration
from rclpy.qos import (
    QoSDurabilityPolicy,
    QoSHistoryPolicy,
    QoSLivelinessPolicy,
    QoSPresetProfiles,
    QoSProfile,
    QoSReliabilityPolicy,
)

from amr_description.cli.qos_arguments import any_override

_POLICIES = {
    'history': QoSHistoryPolicy,
    'reliability': QoSReliabilityPolicy,
    'durability': QoSDurabilityPolicy,
    'liveliness': QoSLivelinessPolicy,
}


def from_flags(args: Namespace) -> QoSProfile:
    """Return the preset profile with what the flags override."""
    profile = copy.copy(QoSPresetProfiles.get_from_short_key(args.qos_profile))
    for name, policy in _POLICIES.items():
        key = getattr(args, f'qos_{name}')
        if key:
            setattr(profile, name, policy.get_from_short_key(key))
    if args.qos_depth >= 0:
        profile.depth = args.qos_depth
    elif profile.durability == QoSDurabilityPolicy.TRANSIENT_LOCAL and profile.depth == 0:
        profile.depth = 1
    if args.qos_liveliness_lease_duration_seconds is not None:
        seconds = args.qos_liveliness_lease_duration_seconds
        profile.liveliness_lease_duration = Duration(seconds=seconds)
    return profile


def for_subscription(
    args: Namespace, publishers: Iterable[QoSProfile]
) -> tuple[QoSProfile, list[str]]:
    """
    Return the QoS to subscribe with, and lines to print about it.

    Without flags it is the strongest that is compatible with every publisher: reliable, or
    transient local, if all of them are. Any flag disables this, as in the original.
    """
    profile = from_flags(args)
    offered = list(publishers)
    if any_override(args) or not offered:
        return profile, []
    notes = []
    for name, strong, weak in (
        ('reliability', QoSReliabilityPolicy.RELIABLE, QoSReliabilityPolicy.BEST_EFFORT),
        ('durability', QoSDurabilityPolicy.TRANSIENT_LOCAL, QoSDurabilityPolicy.VOLATILE),
    ):
        count = sum(getattr(publisher, name) == strong for publisher in offered)
        setattr(profile, name, strong if count == len(offered) else weak)
        if 0 < count < len(offered):
            notes.append(
                f'Some, but not all, publishers are offering {_full(strong)}. Falling back to '
                f'{_full(weak)} as it will connect to all publishers'
            )
    return profile, notes


def _full(policy: QoSReliabilityPolicy | QoSDurabilityPolicy) -> str:
    """Return the name under which people know the enumeration: QoSReliabilityPolicy.RELIABLE."""
    return f'QoS{type(policy).__name__}.{policy.name}'
