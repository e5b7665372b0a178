# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A controller from its class and its parameters, wherever these are kept."""

from amr_description.control.contracts import Controller, ControllerContext
from amr_description.control.manager_parameters import CommonParameters
from amr_description.controller_manager.parameter_store import ParameterStore
from amr_description.log import Log, Severity
from amr_description.model.robot import Robot
from amr_description.model.ros2_control_tag import hardware_of


def make_controller(
    controller_class: type[Controller],
    store: ParameterStore,
    *,
    name: str,
    namespace: str,
    log: Log,
    update_rate: int,
    robot: Robot | None,
) -> Controller:
    """
    Declare the parameters of a controller, and make it; what is set later counts at the next
    configure.

    Args:
        controller_class: Called with a :class:`ControllerContext`.
        store: Of its node.
        name: Of the controller.
        namespace: Of the manager.
        log: Of the controller.
        update_rate: Of the manager, Hz.
        robot: Handed to the controller.

    Raises:
        ParameterError: A parameter has another type, or is out of its bounds.
        Exception: Whatever the constructor of a third party's controller raises.
    """
    table = controller_class.parameters_type
    joints, others = _names_of(robot)
    for line in store.adopt(table, CommonParameters, joints=joints, others=others):
        log(Severity.WARN, line)
    store.declare(table)
    store.values(table)
    store.declare(CommonParameters, defaults={'update_rate': update_rate})
    common = store.values(CommonParameters)
    store.check_sets(table, CommonParameters)
    if common.is_async:
        log(
            Severity.WARN,
            'is_async is true: the controller is updated in the control loop all the same',
        )
    return controller_class(
        ControllerContext(
            name=name,
            log=log,
            namespace=namespace,
            update_rate=common.update_rate or update_rate,
            robot=robot,
        )
    )


def _names_of(robot: Robot | None) -> tuple[list[str], list[str]]:
    """Return the joints of a robot, and its links, sensors and GPIOs: what parameters may name."""
    if robot is None:
        return [], []
    parts = [part.name for info in hardware_of(robot) for part in (*info.sensors, *info.gpios)]
    joints = [joint.name for joint in robot.joints]
    return joints, [link.name for link in robot.links] + parts
