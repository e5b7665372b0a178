# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The duration of each phase of a start-up, from the output of the bring-up. Pure."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
import re
import statistics

from amr_description.errors import BringupError
from benchmarks.figures import Figures

PHASES = (
    ('bring-up has started its processes', r'^\[INFO\] \[mujoco_sim-\d+\]: process started'),
    ('mujoco_sim is up', r'^\[mujoco_sim-\d+\] .*waiting for robots'),
    ('the robot is in the world', r'^\[INFO\] \[create-\d+\]: process has finished cleanly'),
    ('joint_state_broadcaster is active', r'Configured and activated .*joint_state_broadcaster'),
    ('diff_drive_controller is active', r'Configured and activated .*diff_drive_controller'),
    ('ready', r'^\[INFO\] \[launch\]: ready in'),
)
"""Name of each phase and the line at its end, in the order in which they end."""

BOTH_ACTIVE = ('joint_state_broadcaster is active', 'diff_drive_controller is active')
"""The phases that end a start for the goal."""


@dataclass(frozen=True, slots=True)
class StartupPhase:
    """A phase that ended ``at`` s after the start and ``took`` s since the previous one."""

    name: str
    at: float
    took: float


def phases_of(lines: Sequence[tuple[float, str]]) -> tuple[StartupPhase, ...]:
    """
    Return the phases of a start-up.

    Args:
        lines: Each with the time since the start, s, and its text.

    Raises:
        BringupError: A phase was not completed; with its name and the last line.
    """
    phases: list[StartupPhase] = []
    before = 0.0
    for name, pattern in PHASES:
        at = _first(lines, pattern)
        if at is None:
            last = lines[-1][1] if lines else 'nothing'
            raise BringupError(f"the start-up did not come to '{name}'; its last line: {last}")
        phases.append(StartupPhase(name, at, at - before))
        before = at
    return tuple(phases)


def table(phases: Iterable[StartupPhase]) -> str:
    """Return the phases as text, one a line."""
    head = f'{"warm start-up":36} {"at":>8} {"took":>8}'
    rows = (f'{phase.name:36} {phase.at:6.2f} s {phase.took:6.2f} s' for phase in phases)
    return '\n'.join((head, *rows))


def _first(lines: Sequence[tuple[float, str]], pattern: str) -> float | None:
    return next((at for at, text in lines if re.search(pattern, text)), None)


def start_figures(starts: Sequence[Sequence[StartupPhase]]) -> Figures:
    """Return the median of warm starts, and the phases of the last one."""

    def both_active(phases: Sequence[StartupPhase]) -> float:
        return max(phase.at for phase in phases if phase.name in BOTH_ACTIVE)

    warm = statistics.median(map(both_active, starts))
    return Figures({'warm': warm}, table(starts[-1]))
