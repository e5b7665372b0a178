# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What the probe of :mod:`benchmarks.probed_simulator` finds out, and how it is shown. Pure."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Self

from benchmarks.call_tree import CallTree

_LEAST = 0.5
"""µs: what takes less is not printed."""


@dataclass(frozen=True)
class Profile:
    """What the probe has found out about a cycle."""

    cycle: float
    """Processor time of the control thread for one cycle, µs."""
    bare: float
    """That of ``mj_step`` alone, for the same period, µs."""
    batches: int
    period: float
    """Simulated time of a cycle, s."""
    speed: float
    """The greatest speed of a degree of freedom at the end: it is driven."""
    tree: CallTree
    """Of one cycle; µs."""

    @property
    def besides(self) -> float:
        """Processor time of a cycle besides the physics, µs."""
        return self.cycle - self.bare

    def as_json(self) -> Mapping[str, Any]:
        """Return it as JSON has it."""
        return {**self.__dict__, 'tree': self.tree.as_json()}

    @classmethod
    def from_json(cls, read: Mapping[str, Any]) -> Self:
        """Return what :meth:`as_json` was made of."""
        return cls(**{**read, 'tree': CallTree.from_json(read['tree'])})


@dataclass(frozen=True)
class Speed:
    """Real-time factors, in turn: of the full stack, and of ``mj_step`` alone meanwhile paused."""

    full: tuple[float, ...]
    bare: tuple[float, ...]

    @property
    def ratio(self) -> float:
        """The median of the ratios of the rounds, each to the mean of its two neighbours."""
        ratios = sorted(
            full / ((before + after) / 2)
            for full, before, after in zip(self.full, self.bare, self.bare[1:], strict=False)
        )
        return ratios[len(ratios) // 2]


def profile_text(heard: str, profile: Profile) -> str:
    """Return the cycle by part as text."""
    modules = profile.tree.by_module()
    rest = profile.cycle - sum(modules.values())
    return '\n'.join(
        (
            f'a cycle of {profile.period * 1e3:g} ms, processor time of the control thread; '
            f'heard: {heard}',
            f'{profile.cycle:8.1f} µs a cycle',
            f'{profile.bare:8.1f} µs mj_step alone, {profile.bare / profile.cycle:.3f} of it',
            f'{profile.besides:8.1f} µs besides the physics',
            '',
            f'{"total µs":>8} {"own µs":>8} {"calls":>6}',
            *profile.tree.lines(_LEAST),
            '',
            'own µs of the functions of a module',
            *(f'{took:8.1f} {name}' for name, took in modules.items() if took >= _LEAST),
            f'{rest:8.1f} the rest',
        )
    )
