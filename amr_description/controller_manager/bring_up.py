# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A controller manager with its hardware, which is started."""

from collections.abc import Sequence
from functools import partial

from amr_description.control.contracts import World
from amr_description.control.controller_manager import ControllerManager
from amr_description.control.resource_manager import ResourceManager
from amr_description.control.statistics import Stopwatch, unmeasured
from amr_description.controller_manager.parameters import ManagerParameters
from amr_description.hardware import HARDWARE
from amr_description.hardware.in_simulator import class_in_simulator
from amr_description.log import Log, Severity
from amr_description.model.hardware_info import HardwareInfo
from amr_description.model.robot import Robot


def bring_up(
    parameters: ManagerParameters,
    log: Log,
    robot: Robot | None,
    hardware: Sequence[tuple[HardwareInfo, Log]],
    *,
    world: World | None,
    period: int,
    simulates_mocks: bool = False,
    stopwatch: Stopwatch = unmeasured,
) -> ControllerManager:
    """
    Make components and manager, and start the hardware; on the control thread.

    Args:
        parameters: Of the manager.
        log: Of the manager.
        robot: Its joints' limits are enforced, if that is wanted.
        hardware: What its ``<ros2_control>`` blocks say, each with the log of its component.
        world: As simulated components see it; None: the hardware is real.
        period: Between two cycles, ns.
        simulates_mocks: Mock hardware is simulated, if there is a world.
        stopwatch: Measures how long everything takes; by default nothing does.

    Returns:
        The manager, for the control loop.

    Raises:
        HardwareError: A component cannot be started; the others are shut down again.
        Exception: Whatever a third party's component raises; likewise.
    """
    enforce = parameters.start.enforce_command_limits
    initial = parameters.start.hardware_components_initial_state
    if not enforce:
        log(
            Severity.INFO,
            'Enforcing command limits is disabled. Command limits from URDF will be ignored.',
        )
    resources = ResourceManager(log, robot, enforce, stopwatch)
    try:
        for info, component_log in hardware:
            find = HARDWARE.find
            if world is not None:
                find = partial(class_in_simulator, info, component_log, simulates_mocks)
            resources.load(info, find, world, component_log)
        resources.start_components(
            initial.unconfigured,
            initial.inactive,
            initial.shutdown_on_initial_state_failure,
        )
    except Exception:
        resources.shut_down()
        raise
    manager = ControllerManager(
        resources, parameters.update_rate, log, period, parameters.defaults()
    )
    for name in resources.components:
        log(Severity.INFO, f'Registering statistics for : {name}')
    return manager
