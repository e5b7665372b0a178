# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""QoS from flags, and matched to publishers."""

from argparse import ArgumentParser

import pytest
from rclpy.duration import Duration
from rclpy.qos import (
    DurabilityPolicy,
    LivelinessPolicy,
    qos_profile_sensor_data,
    QoSProfile,
    ReliabilityPolicy,
)

from amr_description.cli.qos import for_subscription, from_flags
from amr_description.cli.qos_arguments import add_qos_arguments

RELIABLE = QoSProfile(depth=10)
BEST_EFFORT = QoSProfile(depth=5, reliability=ReliabilityPolicy.BEST_EFFORT)
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


def read(*flags, profile='sensor_data'):
    parser = ArgumentParser()
    add_qos_arguments(parser, 'subscribe', profile)
    return parser.parse_args(flags)


def matched(*publishers, flags=()):
    profile, notes = for_subscription(read(*flags), publishers)
    return profile.reliability.name, profile.durability.name, notes


def test_without_publishers_the_preset_stands():
    assert for_subscription(read(), []) == (qos_profile_sensor_data, [])


def test_the_strongest_that_reaches_all_is_chosen():
    assert matched(RELIABLE) == ('RELIABLE', 'VOLATILE', [])
    assert matched(BEST_EFFORT) == ('BEST_EFFORT', 'VOLATILE', [])
    assert matched(LATCHED, LATCHED) == ('RELIABLE', 'TRANSIENT_LOCAL', [])


def test_a_mixture_is_told():
    reliability, durability, notes = matched(RELIABLE, BEST_EFFORT, LATCHED)
    assert (reliability, durability) == ('BEST_EFFORT', 'VOLATILE')
    assert notes == [
        'Some, but not all, publishers are offering QoSReliabilityPolicy.RELIABLE. Falling back '
        'to QoSReliabilityPolicy.BEST_EFFORT as it will connect to all publishers',
        'Some, but not all, publishers are offering QoSDurabilityPolicy.TRANSIENT_LOCAL. Falling '
        'back to QoSDurabilityPolicy.VOLATILE as it will connect to all publishers',
    ]


@pytest.mark.parametrize(
    'flags',
    [
        ('--qos-reliability', 'best_effort'),
        ('--qos-depth', '7'),
        ('--qos-history', 'keep_last'),
        ('--qos-liveliness', 'automatic'),
        ('--qos-liveliness-lease-duration-seconds', '1'),
    ],
)
def test_any_flag_switches_matching_off(flags):
    assert matched(LATCHED, flags=flags)[1] == 'VOLATILE'


def test_a_preset_alone_is_still_matched():
    assert matched(LATCHED, flags=('--qos-profile', 'default'))[1] == 'TRANSIENT_LOCAL'


def test_flags_override_the_preset():
    profile = from_flags(
        read(
            '--qos-depth=3',
            '--qos-durability=transient_local',
            '--qos-liveliness=manual_by_topic',
            '--qos-liveliness-lease-duration-seconds=2.5',
            profile='default',
        )
    )
    assert (profile.depth, profile.reliability) == (3, ReliabilityPolicy.RELIABLE)
    assert profile.durability == DurabilityPolicy.TRANSIENT_LOCAL
    assert profile.liveliness == LivelinessPolicy.MANUAL_BY_TOPIC
    assert profile.liveliness_lease_duration == Duration(seconds=2.5)


def test_what_is_latched_has_room_for_one_message():
    flags = read('--qos-durability=transient_local', '--qos-profile=system_default')
    assert from_flags(flags).depth == 1


def test_the_presets_of_rclpy_are_not_changed():
    from_flags(read('--qos-depth=77'))
    assert qos_profile_sensor_data.depth == 5
