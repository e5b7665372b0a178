# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
How busy the machine is besides the benchmark: figures in wall time need a quiet one.

Two things show it: processors that are busy before anything is started, and processor time that
the host has given to other guests (``steal``, proc(5)).
"""

from dataclasses import dataclass
from pathlib import Path
import time

_QUIET_BUSY = 0.15
"""Share of the processor time: above it, the machine was not quiet at the start."""
_QUIET_STEAL = 0.02
_QUIET_CHANGE = 0.1
"""By which ``mj_step`` alone may differ between two measurements."""
_BEFORE = 1.0
"""s of looking at the machine."""
_IDLE, _IOWAIT, _STEAL, _FIELDS = 3, 4, 7, 8


@dataclass(frozen=True)
class Usage:
    """Processor time of the machine so far, in ticks of the kernel."""

    total: int
    idle: int
    steal: int

    def since(self, before: 'Usage') -> 'Usage':
        """Return what was used since an earlier reading."""
        return Usage(self.total - before.total, self.idle - before.idle, self.steal - before.steal)

    @property
    def busy_share(self) -> float:
        """Of the processor time."""
        return 1.0 - self.idle / self.total if self.total else 0.0

    @property
    def steal_share(self) -> float:
        """Of the processor time."""
        return self.steal / self.total if self.total else 0.0


def usage_of(stat: str) -> Usage:
    """Return what the text of ``/proc/stat`` says."""
    fields = [int(word) for word in stat.splitlines()[0].split()[1 : _FIELDS + 1]]
    return Usage(sum(fields), fields[_IDLE] + fields[_IOWAIT], fields[_STEAL])


def usage() -> Usage:
    """Return the usage so far."""
    return usage_of(Path('/proc/stat').read_text(encoding='ascii'))


def usage_before(seconds: float = _BEFORE) -> Usage:
    """Return the usage by others for a while, in which this program does nothing."""
    before = usage()
    time.sleep(seconds)
    return usage().since(before)


def complaints(before: Usage, during: Usage, bare: tuple[float, float] | None) -> list[str]:
    """
    Return why figures in wall time are not to be trusted.

    Args:
        before: The usage before anything was started.
        during: That of the whole run.
        bare: Real-time factor of ``mj_step`` alone, first and last measurement.
    """
    lines = []
    if before.busy_share > _QUIET_BUSY:
        lines.append(f'{before.busy_share:.0%} of the processors were in use before the start')
    if during.steal_share > _QUIET_STEAL:
        lines.append(f'{during.steal_share:.0%} of the processor time went to other guests')
    if bare and abs(bare[1] / bare[0] - 1.0) > _QUIET_CHANGE:
        lines.append(f'mj_step alone ran at {bare[0]:.0f}, and at {bare[1]:.0f} later')
    return lines
