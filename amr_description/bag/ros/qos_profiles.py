# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""QoS profiles of bags as rclpy has them."""

from rclpy.duration import Duration
from rclpy.qos import (
    DurabilityPolicy,
    HistoryPolicy,
    LivelinessPolicy,
    QoSProfile,
    ReliabilityPolicy,
)

from amr_description.bag.qos_text import POLICIES, QosProfile


def to_rclpy(profile: QosProfile) -> QoSProfile:
    """Return a profile to publish or subscribe with."""
    return QoSProfile(
        history=HistoryPolicy[profile.history.upper()],
        depth=profile.depth,
        reliability=ReliabilityPolicy[profile.reliability.upper()],
        durability=DurabilityPolicy[profile.durability.upper()],
        deadline=Duration(nanoseconds=profile.deadline),
        lifespan=Duration(nanoseconds=profile.lifespan),
        liveliness=LivelinessPolicy[profile.liveliness.upper()],
        liveliness_lease_duration=Duration(nanoseconds=profile.liveliness_lease_duration),
        avoid_ros_namespace_conventions=profile.avoid_ros_namespace_conventions,
    )


def from_rclpy(profile: QoSProfile) -> QosProfile:
    """Return a profile as bags have it."""
    policies = {name: getattr(profile, name).name.lower() for name in POLICIES}
    return QosProfile(
        **policies,
        depth=profile.depth,
        deadline=profile.deadline.nanoseconds,
        lifespan=profile.lifespan.nanoseconds,
        liveliness_lease_duration=profile.liveliness_lease_duration.nanoseconds,
        avoid_ros_namespace_conventions=profile.avoid_ros_namespace_conventions,
    )
