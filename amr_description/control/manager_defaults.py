# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What the parameters ``defaults.…`` of a controller manager decide."""

from dataclasses import dataclass
import math

from amr_description.control.contracts import Log, Severity
from amr_description.control.switching import Strictness


@dataclass(frozen=True, slots=True)
class ManagerDefaults:
    """The parameters ``defaults.…`` of a ``controller_manager`` node."""

    strictness: Strictness = Strictness.BEST_EFFORT
    """``switch_controller.strictness``: of a request that leaves it open."""
    allow_controller_activation_with_inactive_hardware: bool = False
    """True: controllers may command hardware that is not active."""
    deactivate_controllers_on_hardware_self_deactivate: bool = True
    """False: controllers go on commanding hardware that asked to be made inactive."""

    def choose_strictness(self, requested: int, log: Log) -> Strictness:
        """Return how strict a request is: 0 leaves it open, and only two levels are there."""
        if requested in (Strictness.STRICT, Strictness.BEST_EFFORT):
            return Strictness(requested)
        if requested == 0:
            log(
                Severity.WARN,
                'Controller Manager: to switch controllers you need to specify a strictness level '
                'of controller_manager_msgs::SwitchController::STRICT (2) or ::BEST_EFFORT (1). '
                f'When unspecified, the default is {self.strictness.name.lower()}',
                throttle=math.inf,
            )
            return self.strictness
        known = [level.name for level in Strictness if level == requested]
        log(
            Severity.WARN,
            f'Controller Manager: strictness {"".join(known) or requested} is not implemented. '
            'Defaulting to BEST_EFFORT',
        )
        return Strictness.BEST_EFFORT
