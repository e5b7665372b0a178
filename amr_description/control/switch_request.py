# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What one switch is about: who comes, who goes, and which mode that means for the others."""

from dataclasses import dataclass, field

from amr_description.control.controller_list import ControllerList
from amr_description.control.loaded_controller import LoadedController


@dataclass(slots=True)
class SwitchRequest:
    """The controllers there are, and those of them to activate and to deactivate, as asked."""

    controllers: ControllerList
    entering: list[LoadedController] = field(default_factory=list)
    leaving: list[LoadedController] = field(default_factory=list)

    def will_be_active(self, controller: LoadedController) -> bool:
        """Tell whether it stays active or becomes it."""
        stays = controller.is_active and controller not in self.leaving
        return stays or controller in self.entering

    def will_be_chained(self, controller: LoadedController) -> bool:
        """Tell whether somebody will command it."""
        return any(map(self.will_be_active, self.controllers.commanding(controller)))

    def restart_what_changes_mode(self) -> frozenset[str]:
        """
        Add to both lists whoever stays active but is commanded from now on, or no longer.

        A controller changes its mode only while it is inactive. Returns their names.
        """
        changing = [
            each
            for each in self.controllers.active
            if each not in self.leaving
            and each.controller.is_chained != self.will_be_chained(each)
        ]
        self.leaving += changing
        self.entering += changing
        return frozenset(each.name for each in changing)
