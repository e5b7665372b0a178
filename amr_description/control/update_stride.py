# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""How often a controller is updated: at every so manieth tick of its manager."""

from amr_description.control.contracts import Controller, Log, Severity
from amr_description.errors import ControllerError


def stride_of(controller: Controller, manager_rate: int, log: Log) -> int:
    """
    Return the ticks of the manager (``manager_rate``, Hz) for each update of the controller.

    What cannot be had exactly is warned of. Raises ControllerError: its rate is not positive.
    """
    name, rate = controller.context.name, controller.context.update_rate
    if rate <= 0:
        raise ControllerError(
            f"The update rate of controller '{name}' must be above 0 Hz, found {rate}"
        )
    if rate > manager_rate:
        log(
            Severity.WARN,
            f"The update rate of controller '{name}', {rate} Hz, is above that of the controller "
            f'manager, {manager_rate} Hz, and is set to it',
        )
        return 1
    stride = (2 * manager_rate + rate) // (2 * rate)  # half away from zero, as C++ rounds
    if manager_rate % rate:
        log(
            Severity.WARN,
            f"The update rate of controller '{name}', {rate} Hz, is not achievable with a "
            f'controller manager at {manager_rate} Hz; it runs at {manager_rate / stride:g} Hz',
        )
    return stride
