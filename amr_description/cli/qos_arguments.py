# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The ``--qos-*`` flags. What they mean is in :mod:`~amr_description.cli.qos`."""

from argparse import ArgumentParser, Namespace

# As rclpy.qos spells them in lower case; a test compares. Importing rclpy would cost 0.1 s.
PROFILES = (
    'unknown',
    'default',
    'system_default',
    'sensor_data',
    'services_default',
    'parameters',
    'parameter_events',
    'action_status_default',
    'best_available',
)
HISTORIES = ('system_default', 'keep_last', 'keep_all', 'unknown')
RELIABILITIES = ('system_default', 'reliable', 'best_effort', 'unknown', 'best_available')
DURABILITIES = ('system_default', 'transient_local', 'volatile', 'unknown', 'best_available')
LIVELINESSES = ('system_default', 'automatic', 'manual_by_topic', 'unknown', 'best_available')

_POLICIES = {
    'history': ('History of samples', HISTORIES),
    'reliability': ('Quality of service reliability', RELIABILITIES),
    'durability': ('Quality of service durability', DURABILITIES),
    'liveliness': ('Quality of service liveliness', LIVELINESSES),
}


def add_qos_arguments(parser: ArgumentParser, verb: str, profile: str, matched: str = '') -> None:
    """
    Add the flags.

    Args:
        parser: of the verb.
        verb: what the QoS is for, ``subscribe`` or ``publish``.
        profile: the default of ``--qos-profile``.
        matched: the policies that are matched to the publishers if no flag is given.
    """
    parser.add_argument(
        '--qos-profile',
        choices=PROFILES,
        default=profile,
        help=f'Quality of service preset profile to {verb} with (default: {profile})',
    )
    parser.add_argument(
        '--qos-depth',
        metavar='N',
        type=int,
        default=-1,
        help=f'Queue size setting to {verb} with (overrides depth value of --qos-profile option)',
    )
    for policy, (what, choices) in _POLICIES.items():
        default = 'Automatically match existing publishers' if policy in matched else 'its value'
        parser.add_argument(
            f'--qos-{policy}',
            choices=choices,
            help=f'{what} setting to {verb} with (overrides {policy} value of --qos-profile '
            f'option, default: {default})',
        )
    parser.add_argument(
        '--qos-liveliness-lease-duration-seconds',
        type=float,
        help=f'Quality of service liveliness lease duration setting to {verb} with (overrides '
        'liveliness lease duration value of --qos-profile option, default: its value)',
    )


def any_override(args: Namespace) -> bool:
    """Return whether a flag other than ``--qos-profile`` was given."""
    lease = args.qos_liveliness_lease_duration_seconds
    policies = (getattr(args, f'qos_{policy}') for policy in _POLICIES)
    return args.qos_depth >= 0 or lease is not None or any(policies)
