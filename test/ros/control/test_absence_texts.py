# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What keeps a program from its controller manager: each fault has its own words."""

from dataclasses import replace

import pytest

from amr_description.control.ros.absence_diagnosis import (
    ClockObservation,
    DescriptionObservation,
    explain,
    explain_clock,
    ManagerObservation,
)

NAME = '/left/controller_manager'
NOBODY = ManagerObservation(NAME, domain=7)
TOPIC = '/left/robot_description'
WAITS = f'{NAME} is there, and waits for a robot description on {TOPIC}'
SILENT = ClockObservation(0)
PAUSED = ClockObservation(1, (1_500_000_000, 1_500_000_000))
RUNNING = ClockObservation(1, (1_500_000_000, 1_510_000_000))


@pytest.mark.parametrize(
    ('found', 'said'),
    [
        (NOBODY, 'there is no controller manager in ROS domain 7; a simulator starts one'),
        (
            replace(NOBODY, simulators=('/mujoco_sim',)),
            'ROS domain 7; the simulator /mujoco_sim starts one as soon as a robot with a '
            '<ros2_control> block is spawned',
        ),
        (
            replace(NOBODY, others=('/controller_manager', '/right/controller_manager')),
            f'there is no node {NAME}, but /controller_manager, /right/controller_manager; name '
            'it with -c /controller_manager, or',
        ),
        (replace(NOBODY, is_there=True), f'{NAME} is there, but has no services yet'),
        (
            replace(NOBODY, is_there=True, others=('/controller_manager',)),
            f'{NAME} is there, but',
        ),
    ],
)
def test_no_manager(found, said):
    assert said in explain(found)


@pytest.mark.parametrize(
    ('description', 'said'),
    [
        (DescriptionObservation(TOPIC), 'which nobody publishes: start robot_state_publisher'),
        (
            DescriptionObservation(TOPIC, elsewhere=('/robot_description',)),
            'which nobody publishes; there is /robot_description: remap one of the two',
        ),
        (
            DescriptionObservation(TOPIC, 1),
            'whose publisher is VOLATILE: it must be TRANSIENT_LOCAL to reach it',
        ),
        (DescriptionObservation(TOPIC, 1, 1), 'which has 1 publisher: see its log'),
        (
            DescriptionObservation(TOPIC, 2, 1, errors=('no block.', 'Could not load')),
            'which has 2 publishers; its log says: no block. Could not load',
        ),
    ],
)
def test_no_description(description, said):
    assert explain(replace(NOBODY, is_there=True, description=description)).startswith(WAITS)
    assert said in explain(replace(NOBODY, is_there=True, description=description))


@pytest.mark.parametrize('needed', [True, False])
@pytest.mark.parametrize(
    ('clock', 'said'),
    [
        (ClockObservation(1), 'nothing comes from /clock, which has a publisher'),
        (PAUSED, '/clock stands still at 1.500 s: is the simulation paused?'),
        (RUNNING, ''),
        (ClockObservation(1, (2, 1)), ''),
    ],
)
def test_a_clock_that_is_there_must_run(clock, said, needed):
    assert explain_clock(clock, needed=needed).startswith(said)
    assert bool(explain_clock(clock, needed=needed)) == bool(said)


def test_a_clock_that_is_not_there_is_missed_only_where_it_is_needed():
    assert explain_clock(SILENT, needed=False) == ''
    assert 'nobody publishes /clock; start the simulation' in explain_clock(SILENT, needed=True)


def test_everything_that_is_missing_is_told_in_one_line():
    found = replace(
        NOBODY,
        is_there=True,
        description=DescriptionObservation(TOPIC),
        clock=SILENT,
        needs_clock=True,
    )
    assert explain(found) == (
        f'{WAITS}, which nobody publishes: start robot_state_publisher; there is no clock: '
        'use_sim_time is true, and nobody publishes /clock; start the simulation, or set '
        'use_sim_time to false'
    )
