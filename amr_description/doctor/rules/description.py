# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Rules of the section ``description``."""

from collections.abc import Iterator

from amr_description.doctor.findings import error, Finding, Rule
from amr_description.doctor.observations import Observations
from amr_description.doctor.observations.controllers import ObservedManager
from amr_description.doctor.observations.description import DescriptionTopic, examined, robot_of
from amr_description.doctor.rules.wording import passes_on
from amr_description.model.robot import Robot
from amr_description.model.ros2_control_tag import hardware_of

_OF_JOINTS = ('position', 'velocity', 'acceleration', 'effort')
_LONGEST = 3
"""So many names are told."""


def description_missing(seen: Observations) -> Iterator[Finding]:
    """
    Who subscribes to a description gets one.

    Nobody publishes ``robot_description``, or somebody does so in another namespace. Start
    ``robot_state_publisher`` with the URDF in the namespace of who waits, or remap.
    """
    for topic in _topics(seen):
        waiting = [each for each in topic.subscribers if not passes_on(each)]
        if topic.publishers or not waiting:
            continue
        elsewhere = [each.topic for each in _topics(seen) if each.publishers]
        inside = f' --ros-args -r __ns:={topic.namespace}' if topic.namespace else ''
        yield error(
            'description_missing',
            f'{_names(waiting)} subscribes to {topic.topic}, which nobody publishes'
            + (f'; there is {_names(elsewhere)}' if elsewhere else ''),
            'without a description it waits: there are no controllers, no robot and no frames',
            f'restart it with -r {topic.topic}:={elsewhere[0]}'
            if elsewhere
            else f'ros2 run robot_state_publisher robot_state_publisher FILE.urdf{inside}',
        )


def description_not_latched(seen: Observations) -> Iterator[Finding]:
    """
    A description is kept for whoever comes later.

    It is sent once, with durability ``TRANSIENT_LOCAL``. A volatile publisher does not even match
    who asks for that.
    """
    for topic in _topics(seen):
        if topic.volatile:
            yield error(
                'description_not_latched',
                f'{_names(topic.volatile)} publishes {topic.topic} with durability VOLATILE',
                'who subscribes with TRANSIENT_LOCAL, as RViz and controller managers do, never '
                'gets it',
                f'publish {topic.topic} with TRANSIENT_LOCAL, depth 1, as robot_state_publisher '
                f'does, in the place of {_names(topic.volatile)}',
            )


def description_invalid(seen: Observations) -> Iterator[Finding]:
    """
    A description has no error of ``check_urdf``.

    It lists all of them with their lines (docs/check_urdf.md).
    """
    for topic in _topics(seen):
        for text in topic.texts:
            errors = examined(text).errors
            if not errors:
                continue
            first, more = errors[0], len(errors) - 1
            rest = f', and {more} more error{"s" if more > 1 else ""}' if more else ''
            yield error(
                'description_invalid',
                f'the description on {topic.topic}, published by {_names(topic.publishers)}, has '
                f'an error: {first.text}{rest}',
                'simulators, controller managers and RViz refuse it, or show another robot',
                f'ros2 topic echo --once --full-length --field data {topic.topic} > robot.urdf; '
                'check_urdf robot.urdf',
            )


def descriptions_differ(seen: Observations) -> Iterator[Finding]:
    """
    There is one description on a topic, and robot_state_publisher has the same.

    End one publisher, or give each robot a namespace.
    """
    if seen.description is None:
        return
    for topic in _topics(seen):
        if len(topic.texts) > 1:
            yield error(
                'descriptions_differ',
                f'{len(topic.texts)} different descriptions are published on {topic.topic}, by '
                f'{_names(topic.publishers)}',
                'which robot a program shows or drives depends on which of them it heard last',
                f'end all of these nodes but one, or start one with -r __ns:=/robot2: '
                f'{_names(topic.publishers)}',
            )
            continue
        for node, text in seen.description.of_state_publishers.items():
            if node.rpartition('/')[0] != topic.namespace or not (topic.texts and text):
                continue
            if node in topic.publishers and text.strip() != topic.texts[0].strip():
                yield error(
                    'descriptions_differ',
                    f'the parameter robot_description of {node} is not what it has published on '
                    f'{topic.topic}',
                    'its transforms are of one robot, and what others have got is another one',
                    f'restart {node}, and what has read {topic.topic}',
                )


def description_of_another_robot(seen: Observations) -> Iterator[Finding]:
    """
    The hardware of a controller manager is that of the published description.

    The file was changed, or one of two programs was restarted. Restart both with the same file.
    """
    if seen.description is None or seen.controllers is None:
        return
    for manager in seen.controllers.managers:
        text = seen.description.text_in(manager.namespace)
        robot = robot_of(text) if text else None
        if robot is None or not manager.components:
            continue
        unknown, missing = _joints_apart(manager, robot)
        if not unknown and not missing:
            continue
        told = [f'{manager.name} has the joints {_names(unknown)}'] if unknown else []
        told += [f'the description has the joints {_names(missing)}'] if missing else []
        yield error(
            'description_of_another_robot',
            f'{manager.namespace}/robot_description is not of the robot that {manager.name} '
            f'drives: {" and ".join(told)}, and the other one does not',
            'controllers move joints that frames and pictures do not have, or the other way round',
            f'restart the simulator, or {manager.name}, and robot_state_publisher with the same '
            'file',
        )


RULES: tuple[Rule, ...] = (
    description_missing,
    description_not_latched,
    descriptions_differ,
    description_invalid,
    description_of_another_robot,
)


def _joints_apart(manager: ObservedManager, robot: Robot) -> tuple[list[str], list[str]]:
    """Return the joints of the hardware that a description lacks, and the other way round."""
    interfaces = [name.rpartition('/') for each in manager.components for name in each.interfaces]
    simulated = {joint for joint, _, kind in interfaces if kind in _OF_JOINTS}
    commanded = {
        component.name
        for hardware in hardware_of(robot)
        for component in hardware.joints
        if component.command_interfaces or component.state_interfaces
    }
    known = {component.name for each in hardware_of(robot) for component in each.components}
    known |= {joint.name for joint in robot.joints}
    return sorted(simulated - known), sorted(commanded - simulated)


def _topics(seen: Observations) -> tuple[DescriptionTopic, ...]:
    return () if seen.description is None else seen.description.topics


def _names(names: tuple[str, ...] | list[str]) -> str:
    found = [*dict.fromkeys(names)]
    more = f' and {len(found) - _LONGEST} more' if len(found) > _LONGEST else ''
    return ', '.join(found[:_LONGEST]) + more
