# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Start-up phases from the output of a bring-up."""

import pytest

from amr_description.errors import BringupError
from benchmarks.startup import BOTH_ACTIVE, phases_of, start_figures, StartupPhase, table

LINES = [
    (0.1, '[INFO] [mujoco_sim-1]: process started with pid [10]'),
    (0.1, '[INFO] [create-3]: process started with pid [12]'),
    (0.9, "[mujoco_sim-1] [INFO] [1.0] [mujoco_sim]: World 'empty'; waiting for robots on x"),
    (1.4, '[INFO] [create-3]: process has finished cleanly [pid 12]'),
    (2.0, '[spawner-4] [INFO] [2.0] [s]: Configured and activated joint_state_broadcaster'),
    (2.1, '[INFO] [spawner-4]: process has finished cleanly [pid 13]'),
    (2.9, '[spawner-5] [INFO] [3.0] [s]: \x1b[32mConfigured and activated diff_drive_controller'),
    (3.0, '[INFO] [launch]: ready in 3.0 s: drive with, in another shell,'),
]


def test_phases():
    phases = phases_of(LINES)
    assert [(phase.name, phase.at) for phase in phases] == [
        ('bring-up has started its processes', 0.1),
        ('mujoco_sim is up', 0.9),
        ('the robot is in the world', 1.4),
        ('joint_state_broadcaster is active', 2.0),
        ('diff_drive_controller is active', 2.9),
        ('ready', 3.0),
    ]
    assert sum(phase.took for phase in phases) == pytest.approx(3.0)


@pytest.mark.parametrize(
    'end, name', [(0, 'bring-up has'), (2, 'mujoco_sim is up'), (6, 'diff_drive_controller is')]
)
def test_phase_that_was_not_reached_is_named(end, name):
    last = LINES[end - 1][1] if end else 'nothing'
    with pytest.raises(BringupError, match=f"did not come to '{name}.*its last line: ") as error:
        phases_of(LINES[:end])
    assert str(error.value).endswith(last)


def test_table():
    assert table([StartupPhase('ready', 3.0, 0.25)]).splitlines() == [
        'warm start-up                              at     took',
        'ready                                  3.00 s   0.25 s',
    ]


def test_the_start_is_the_median_of_when_both_controllers_are_active():
    starts = [
        [StartupPhase(name, at, 0.0) for name, at in zip(BOTH_ACTIVE, ends, strict=True)]
        for ends in ((1.0, 2.0), (3.0, 2.5), (9.0, 1.0))
    ]
    figures = start_figures(starts)
    assert figures.values == {'warm': 3.0}
    assert 'is active' in figures.text
