# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""How long each stage of a start-up took, read from what the bring-up printed. Pure."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
import re

from amr_description.errors import BringupError

STAGES = (
    ('bring-up has started its processes', r'^\[INFO\] \[mujoco_sim-\d+\]: process started'),
    ('mujoco_sim is up', r'^\[mujoco_sim-\d+\] .*waiting for robots'),
    ('the robot is in the world', r'^\[INFO\] \[create-\d+\]: process has finished cleanly'),
    ('joint_state_broadcaster is active', r'Configured and activated .*joint_state_broadcaster'),
    ('diff_drive_controller is active', r'Configured and activated .*diff_drive_controller'),
    ('ready', r'^\[INFO\] \[launch\]: ready in'),
)
"""Name of each stage and the line that ends it, in the order in which they end."""


@dataclass(frozen=True, slots=True)
class StartupPhase:
    """A stage ended ``at`` s after the start; it ``took`` the time since the one before, s."""

    name: str
    at: float
    took: float


def stages_of(lines: Sequence[tuple[float, str]]) -> tuple[StartupPhase, ...]:
    """
    The stages of a start-up; ``lines``: when each came, s since the start, and its text.

    Raises BringupError naming the stage that was not reached, with the last line printed.
    """
    stages: list[StartupPhase] = []
    before = 0.0
    for name, pattern in STAGES:
        at = _first(lines, pattern)
        if at is None:
            last = lines[-1][1] if lines else 'nothing'
            raise BringupError(f"the start-up did not come to '{name}'; its last line: {last}")
        stages.append(StartupPhase(name, at, at - before))
        before = at
    return tuple(stages)


def table(stages: Iterable[StartupPhase]) -> str:
    """The stages as text, one a line."""
    head = f'{"warm start-up":36} {"at":>8} {"took":>8}'
    rows = (f'{stage.name:36} {stage.at:6.2f} s {stage.took:6.2f} s' for stage in stages)
    return '\n'.join((head, *rows))


def _first(lines: Sequence[tuple[float, str]], pattern: str) -> float | None:
    return next((at for at, text in lines if re.search(pattern, text)), None)
