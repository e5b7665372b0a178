# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""All that is known of a manager at one instant: its snapshot, and what was measured."""

from collections.abc import Mapping
from dataclasses import dataclass

from amr_description.control.controller_manager import ControllerManager
from amr_description.control.snapshots import ManagerSnapshot
from amr_description.control.statistics import CycleStatistic, Statistic


@dataclass(frozen=True, slots=True)
class Measurements:
    """Of one manager at ``update_rate`` Hz; cycles by the names of who ran."""

    snapshot: ManagerSnapshot
    update_rate: int
    periodicity: Statistic
    """Of the manager's ticks, Hz."""
    updates: Mapping[str, CycleStatistic]
    reads: Mapping[str, CycleStatistic]
    writes: Mapping[str, CycleStatistic]
    """Without sensors, which are never written."""


def take_measurements(manager: ControllerManager) -> Measurements:
    """Copy what was measured so far; on the owner's thread."""
    components = manager.resources.components
    return Measurements(
        snapshot=manager.snapshot,
        update_rate=manager.update_rate,
        periodicity=manager.periodicity.result(),
        updates={loaded.name: loaded.statistic.result() for loaded in manager.loaded},
        reads={name: owned.read_statistic.result() for name, owned in components.items()},
        writes={
            name: owned.write_statistic.result()
            for name, owned in components.items()
            if not owned.is_sensor
        },
    )
