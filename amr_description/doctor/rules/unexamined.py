# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What could not be examined, so that nobody takes silence for health."""

from collections.abc import Iterator

from amr_description.doctor.findings import Finding, Rule, warning
from amr_description.doctor.observations import Observations


def unexamined(seen: Observations) -> Iterator[Finding]:
    """
    Every section can be observed, and every rule applied to it.

    What is named here was not examined, so silence about it is no health. Please report the line.
    """
    for what, why in (seen.faults or {}).items():
        yield warning(
            'unexamined',
            f'{what} could not be examined: {why}',
            'nothing is found there, whatever is wrong; all else was examined',
            'examine again: ros2 doctor; if it stays, it is a fault of the doctor: report it with '
            'this line and ros2 doctor --report',
        )


RULES: tuple[Rule, ...] = (unexamined,)
