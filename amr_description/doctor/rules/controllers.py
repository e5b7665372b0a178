# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Rules of the section ``controllers``."""

from collections.abc import Iterator, Mapping, Sequence
import math

from amr_description.doctor.findings import error, Finding, Rule, warning
from amr_description.doctor.observations import Observations
from amr_description.doctor.observations.controllers import (
    ObservedController,
    ObservedControllers,
    ObservedManager,
)
from amr_description.doctor.rules.machine import overloaded
from amr_description.former_parameters import is_on_former_parameter
from amr_description.model.checks import examine_drives
from amr_description.model.checks.context import DriveSettings
from amr_description.model.findings import Severity as UrdfSeverity, SourceLocation
from amr_description.text import did_you_mean

STATE_BROADCASTER = 'joint_state_broadcaster/JointStateBroadcaster'
DRIVE = 'diff_drive_controller/DiffDriveController'
_SHOWN = 3


def controller_manager_missing(seen: Observations) -> Iterator[Finding]:
    """
    Who waits for a controller manager finds one.

    A spawner waits, and no node offers ``list_controllers``. A simulator has a manager once a
    robot with ``<ros2_control>`` is spawned. On a real robot it is ``ros2_control_node``.
    """
    found = seen.controllers
    if found is None or found.managers or not found.spawners:
        return
    yield error(
        'controller_manager_missing',
        f'{_names(found.spawners)} waits for a controller manager, and there is none',
        'no controller is loaded, and nothing moves',
        'ros2 launch amr_description simulation, or, for a real robot, ros2 run '
        'controller_manager ros2_control_node; a simulator has one once a robot with a '
        '<ros2_control> block is spawned',
    )


def controller_manager_silent(seen: Observations) -> Iterator[Finding]:
    """
    The services of a controller manager answer; where the machine has the time for it.

    It waits for its description or hardware, or hangs in a driver. Its log says which.
    """
    if any(overloaded(seen)):
        return
    for each in _managers(seen):
        if not each.answers:
            yield error(
                'controller_manager_silent',
                f'{each.name} is there, but {each.name}/list_controllers does not answer',
                'it hangs, or waits for its robot or its hardware: no controller can be loaded',
                f'see its log, ros2 topic echo /rosout --filter "m.name=={_logger(each)!r}"'
                ', and restart it',
            )


def hardware_inactive(seen: Observations) -> Iterator[Finding]:
    """
    Hardware components are active.

    Only then are their command interfaces available. ``set_hardware_component_state`` activates
    one, unless it is finalized.
    """
    for manager in _managers(seen):
        for each in manager.components:
            if each.state == 'active':
                continue
            is_final = each.state == 'finalized'
            yield error(
                'hardware_inactive',
                f"the hardware component '{each.name}' ({each.plugin}) of {manager.name} is "
                f'{each.state}{_why(seen.controllers, manager, each.name)}',
                'its command interfaces are not available: controllers that need them cannot be '
                'activated, and nothing moves',
                f'restart {manager.name}: a finalized component cannot be activated again'
                if is_final
                else f'ros2 control set_hardware_component_state {each.name} active{_of(manager)}',
            )


def controller_type_unknown(seen: Observations) -> Iterator[Finding]:
    """
    The manager knows the types of the controllers that its parameters name.

    ``NAME.type`` is misspelt, or its package is not sourced.
    """
    for manager in _managers(seen):
        loaded = {each.name for each in manager.controllers}
        for name, kind in manager.wanted.items():
            if not manager.types or kind in manager.types or name in loaded or not kind:
                continue
            yield error(
                'controller_type_unknown',
                f"the controller '{name}' of {manager.name} is of the type '{kind}', which is not "
                'installed',
                'it cannot be loaded, and spawners that wait for it fail',
                f'ros2 param set {manager.name} {name}.type TYPE, with one of ros2 control '
                f'list_controller_types{_of(manager)}{did_you_mean(kind, manager.types)}',
            )


def controller_unconfigured(seen: Observations) -> Iterator[Finding]:
    """
    Loaded controllers are configured.

    Parameters were refused, or nobody has configured it. The finding has its log.
    """
    for manager in _managers(seen):
        for each in manager.controllers:
            if each.state not in ('unconfigured', 'finalized'):
                continue
            yield error(
                'controller_unconfigured',
                f"the controller '{each.name}' of {manager.name} is {each.state}"
                f'{_why(seen.controllers, manager, each.name)}',
                'it is loaded and does nothing; mostly a parameter is missing or wrong',
                f'mend its parameters, then {_again(each, manager)}',
            )


def interfaces_claimed(seen: Observations) -> Iterator[Finding]:
    """
    No controller has been refused because of another one's interfaces.

    ``switch_controllers`` deactivates the one and activates the other in one step.
    """
    for manager in _managers(seen):
        for each in _inactive(manager):
            owners = _owners(manager, each)
            line = _claim_line(seen.controllers, manager, each)
            if not owners or not line:
                continue
            names = _names([interface for found in owners.values() for interface in found])
            active = ' '.join(owners)
            yield error(
                'interfaces_claimed',
                f"the controller '{each.name}' of {manager.name} was not activated: {names} "
                f'{"are" if len(names.split(",")) > 1 else "is"} claimed by {_names([*owners])}',
                'one controller at a time commands an interface',
                f'ros2 control switch_controllers --deactivate {active} --activate {each.name}'
                f'{_of(manager)}',
            )


def controller_inactive(seen: Observations) -> Iterator[Finding]:
    """
    Controllers whose interfaces nobody else commands are active.

    Activate it, or unload it.
    """
    for manager in _managers(seen):
        if any(each.state != 'active' for each in manager.components):
            continue  # of that hardware_inactive tells
        for each in _inactive(manager):
            if each.is_chained or _owners(manager, each):
                continue
            what = 'nobody commands ' + _names(each.commands) if each.commands else 'it is silent'
            yield warning(
                'controller_inactive',
                f"the controller '{each.name}' ({each.type_name}) of {manager.name} is inactive"
                f'{_why(seen.controllers, manager, each.name)}',
                f'{what}: it neither takes commands nor publishes',
                f'ros2 control set_controller_state {each.name} active{_of(manager)}',
            )


def no_joint_state_broadcaster(seen: Observations) -> Iterator[Finding]:
    """
    Joints that are commanded have their states published.

    Without, the links that move have no frames.
    """
    for manager in _managers(seen):
        kinds = [each.type_name for each in manager.controllers]
        has_drive = any(c.commands and c.state == 'active' for c in manager.controllers)
        if STATE_BROADCASTER in kinds or not has_drive:
            continue
        topic = f'{manager.namespace}/joint_states'
        if seen.sensors is not None and any(each.topic == topic for each in seen.sensors.joints):
            continue
        yield error(
            'no_joint_state_broadcaster',
            f'{manager.name} has active controllers, but no joint_state_broadcaster, and nobody '
            f'publishes {topic}',
            'robot_state_publisher has no frames for the links that move, as the wheels',
            f'ros2 run controller_manager spawner joint_state_broadcaster -c {manager.name}',
        )


def drive_contradicts_description(seen: Observations) -> Iterator[Finding]:
    """
    Wheels, radius, separation and base frame of a drive are those of the description.

    The rules are those of check_urdf (docs/check_urdf.md).
    """
    if seen.description is None:
        return
    for manager in _managers(seen):
        robot = seen.description.robot_in(manager.namespace)
        if robot is None:
            continue
        for each in manager.controllers:
            drive = _drive(each, manager)
            for found in examine_drives(robot, (drive,)) if drive is not None else ():
                make = error if found.severity is UrdfSeverity.ERROR else warning
                seen_there = f': {found.found}' if found.found else ''
                expected = f', expected {found.expected}' if found.expected else ''
                yield make(
                    'drive_contradicts_description',
                    f'{found.what}{seen_there}{expected}',
                    'odometry and commands are of another robot than the one that is described',
                    (f'{found.fix}, ' if found.fix else 'mend it ')
                    + f'in the parameters of {each.name}, then {_again(each, manager)}',
                )


def former_parameters(seen: Observations) -> Iterator[Finding]:
    """
    No parameter is of an earlier release.

    It is one of Humble, Foxy or ROS 1. ROS ignores what no node declares; the controllers here say
    what they make of it.
    """
    if seen.controllers is None:
        return
    for line in seen.controllers.log:
        if is_on_former_parameter(line.text):
            yield warning(
                'former_parameters',
                f'{line.node}: {line.text}',
                'ROS ignores parameters that no node declares, without a word',
                'write what it says into the YAML file, and restart',
            )


RULES: tuple[Rule, ...] = (
    controller_manager_missing,
    controller_manager_silent,
    hardware_inactive,
    controller_type_unknown,
    drive_contradicts_description,
    former_parameters,
    controller_unconfigured,
    interfaces_claimed,
    no_joint_state_broadcaster,
    controller_inactive,
)


def _managers(seen: Observations) -> tuple[ObservedManager, ...]:
    return () if seen.controllers is None else seen.controllers.managers


def _inactive(manager: ObservedManager) -> list[ObservedController]:
    return [each for each in manager.controllers if each.state == 'inactive']


def _owners(manager: ObservedManager, controller: ObservedController) -> dict[str, list[str]]:
    """Return who commands what a controller would command, and what of it."""
    found = {}
    for other in manager.controllers:
        both = [name for name in controller.commands if name in other.commands]
        if both and other.state == 'active' and other.name != controller.name:
            found[other.name] = both
    return found


def _claim_line(
    found: ObservedControllers | None, manager: ObservedManager, controller: ObservedController
) -> str:
    """Return what the manager has logged of the conflict; empty: nobody has tried."""
    for line in found.log if found is not None else ():
        if (
            line.node == manager.name
            and 'claimed' in line.text
            and (controller.name in line.text or any(c in line.text for c in controller.commands))
        ):
            return line.text
    return ''


def _why(found: ObservedControllers | None, manager: ObservedManager, name: str) -> str:
    """Return the last error that is logged of a controller or component, as an addition."""
    own = f'{manager.namespace}/{name}'
    lines = [
        line.text
        for line in (found.log if found is not None else ())
        if line.is_error
        and (line.node == own or (line.node == manager.name and name in line.text))
    ]
    return f'; its log says: {lines[-1]}' if lines else ''


def _logger(manager: ObservedManager) -> str:
    """Return the name that a manager logs by."""
    return manager.name.strip('/').replace('/', '.')


def _of(manager: ObservedManager) -> str:
    """Return the option of ``ros2 control`` that names a manager."""
    return '' if manager.name == '/controller_manager' else f' -c {manager.name}'


def _again(controller: ObservedController, manager: ObservedManager) -> str:
    """Return what has a controller read its parameters again."""
    if controller.state == 'finalized':  # no transition leads from there
        unload = f'ros2 control unload_controller {controller.name}{_of(manager)}'
        spawn = f'ros2 run controller_manager spawner {controller.name} -c {manager.name}'
        return f'{unload} && {spawn}'
    verbs = {
        'active': ('set_controller_state {} inactive', 'cleanup_controller {}'),
        'inactive': ('cleanup_controller {}',),
    }.get(controller.state, ())
    last = ('set_controller_state {} inactive', 'set_controller_state {} active')
    commands = (each.format(controller.name) for each in (*verbs, *last))
    return ' && '.join(f'ros2 control {each}{_of(manager)}' for each in commands)


def _drive(controller: ObservedController, manager: ObservedManager) -> DriveSettings | None:
    """Return the parameters of a diff_drive_controller; None: it is another, or they are wrong."""
    values = controller.parameters
    left, right = (_texts(values.get(f'{side}_wheel_names')) for side in ('left', 'right'))
    if controller.type_name != DRIVE or not left or not right:
        return None
    name = f'{manager.namespace}/{controller.name}'
    below = {each.name for each in manager.controllers}
    return DriveSettings(
        name=name,
        location=SourceLocation(name, 0),
        left_wheels=_joints(left, below),
        right_wheels=_joints(right, below),
        separation=_number(values, 'wheel_separation'),
        radius=_number(values, 'wheel_radius'),
        separation_multiplier=_number(values, 'wheel_separation_multiplier'),
        base_frame=str(values.get('base_frame_id', '')),
        odom_frame=str(values.get('odom_frame_id', '')),
        publishes_transform=values.get('enable_odom_tf') is True,
        position_feedback=values.get('position_feedback') is True,
        open_loop=values.get('open_loop') is True,
    )


def _joints(wheels: Sequence[str], below: set[str]) -> tuple[str, ...]:
    """Return the joints of wheels, some of which are commanded through another controller."""
    split = ((wheel, *wheel.partition('/')) for wheel in wheels)
    return tuple(rest if above in below else whole for whole, above, _, rest in split)


def _texts(value: object) -> tuple[str, ...]:
    return tuple(map(str, value)) if isinstance(value, Sequence) and value else ()


def _number(values: Mapping[str, object], name: str) -> float:
    value = values.get(name)
    return float(value) if isinstance(value, int | float) else math.nan


def _names(names: Sequence[str]) -> str:
    found = [*dict.fromkeys(names)]
    more = f' and {len(found) - _SHOWN} more' if len(found) > _SHOWN else ''
    return ', '.join(found[:_SHOWN]) + more
