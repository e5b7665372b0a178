# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What a user would type next, by the topics of the controllers of the robot."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
import os
from typing import Any, TYPE_CHECKING

from amr_description.bringup.environment import setup_command
from amr_description.bringup.stacks.controllers import SpawnPlan

if TYPE_CHECKING:  # see controllers.py
    from amr_description.model.controller_files import DeclaredController
    from amr_description.model.robot import Robot

STAMPED = 'geometry_msgs/msg/TwistStamped'
_GROUPS = (
    'ForwardCommandController',
    'JointGroupEffortController',
    'JointGroupPositionController',
    'JointGroupVelocityController',
)
_STEP = 0.3
"""rad, m, rad/s …: a command that is seen and does no harm."""
_END = 'Ctrl-C stops all.'


@dataclass(frozen=True)
class VelocityTopic:
    """The topic that drives a robot."""

    name: str
    is_stamped: bool = True
    """Whether its type is TwistStamped, not Twist."""


AMR_TOPIC = VelocityTopic('/diff_drive_controller/cmd_vel')


def velocity_topic(plan: SpawnPlan) -> VelocityTopic | None:
    """Return the topic that drives the robot; None: none of its controllers drives."""
    if plan.is_that_of_amr:
        return AMR_TOPIC
    from amr_description.model.controller_files import TWIST_MUX

    for each in sorted(plan.declared, key=lambda each: each.class_name != TWIST_MUX):
        if each.velocity_topic:
            return VelocityTopic(_topic(plan, each, each.velocity_topic))
    return VelocityTopic(plan.plugin_twist, is_stamped=False) if plan.plugin_twist else None


def how_to_drive(viewer: bool, topic: VelocityTopic = AMR_TOPIC) -> str:
    """Return the next steps with a robot that drives; ``viewer``: whether the page is served."""
    page = 'open the page whose address comes below, or ' if viewer else ''
    stamped = '-p stamped:=true ' if topic.is_stamped else ''
    arguments = f' --ros-args {stamped}\\\n        -r /cmd_vel:={topic.name}'
    if topic == VelocityTopic('/cmd_vel', is_stamped=False):
        arguments = ''  # what it publishes anyway
    kind = STAMPED if topic.is_stamped else 'geometry_msgs/msg/Twist'
    twist = '{linear: {x: 0.5}, angular: {z: 0.0}}'
    if topic.is_stamped:
        twist = f'{{header: {{frame_id: base_link}}, twist: {twist}}}'
    return f"""{page}drive with, in another shell,
    {setup_command('amr_description', os.environ)}
    ros2 run amr_description teleop_twist_keyboard{arguments}
or for one command
    ros2 topic pub --once {topic.name} {kind} \\
        "{twist}"
{_END}"""


def next_steps_of(viewer: bool, plan: SpawnPlan, description: str) -> str:
    """Return the next steps with the robot of a description; ``viewer``: whether it is served."""
    if plan.is_that_of_amr:
        return how_to_drive(viewer)
    from amr_description.model.urdf import parse

    return how_to_go_on(viewer, plan, parse(description))


def how_to_go_on(viewer: bool, plan: SpawnPlan, robot: 'Robot') -> str:
    """Return the next steps with any robot; ``viewer``: whether the page is served."""
    topic = velocity_topic(plan)
    if topic is not None:
        return how_to_drive(viewer, topic)
    commands = [*_commands(plan, robot)]
    page = 'open the page whose address comes below' if viewer else ''
    if not commands:
        return f'{page or "look around with  ros2 topic list"}\n{_END}'
    begin = f'{page}, or move it with' if page else 'move it with'
    lines = '\nor\n'.join(f'    {command}' for command in commands)
    return f"""{begin}, in another shell,
    {setup_command('amr_description', os.environ)}
{lines}
{_END}"""


def _commands(plan: SpawnPlan, robot: 'Robot') -> Iterator[str]:
    """Yield a command for the first controller of each kind that moves joints."""
    kinds = set()
    for each in plan.declared:
        kind = each.class_name
        if kind in kinds:
            continue
        kinds.add(kind)
        joints = [str(name) for name in each.parameters.get('joints') or ()]
        if kind == 'JointTrajectoryController' and joints:
            yield _trajectory(_topic(plan, each, '~/joint_trajectory'), joints, robot)
        elif kind in _GROUPS and joints:
            numbers = _list_of(_target(robot, joint) for joint in joints)
            topic = f'{_topic(plan, each, "~/commands")} std_msgs/msg/Float64MultiArray'
            yield f'ros2 topic pub --once {topic} "{{data: {numbers}}}"'
        elif kind == 'GripperActionController':
            target = _target(robot, str(each.parameters.get('joint', '')))
            action = _topic(plan, each, '~/gripper_cmd')
            parallel = each.type.startswith('parallel_gripper')
            kind_of_goal = 'ParallelGripperCommand' if parallel else 'GripperCommand'
            position = f'[{target:g}]' if parallel else f'{target:g}'
            yield (
                f'ros2 action send_goal {action} control_msgs/action/{kind_of_goal} '
                f'"{{command: {{position: {position}}}}}"'
            )


def _trajectory(topic: str, joints: Sequence[str], robot: 'Robot') -> str:
    numbers = _list_of(_target(robot, joint) for joint in joints)
    return (
        f'ros2 topic pub --once {topic} trajectory_msgs/msg/JointTrajectory \\\n'
        f'        "{{joint_names: [{", ".join(joints)}], points: [{{positions: {numbers}, '
        'time_from_start: {sec: 2}}]}"'
    )


def _target(robot: 'Robot', name: str) -> float:
    """Return a position near 0 that a joint can take, rad or m."""
    limit = robot.joint(name).limit if robot.has_joint(name) else None
    if limit is None or limit.lower >= limit.upper:
        return _STEP
    # Within the range, and off its ends.
    margin = 0.1 * (limit.upper - limit.lower)
    return round(min(max(_STEP, limit.lower + margin), limit.upper - margin), 4)


def _list_of(numbers: Iterator[float]) -> str:
    return f'[{", ".join(f"{number:g}" for number in numbers)}]'


def _topic(plan: SpawnPlan, controller: 'DeclaredController', local: str) -> str:
    """Return the full name of a topic ``~/…`` of a controller, after its remappings."""
    inside = plan.namespace.rstrip('/')

    def expanded(name: str) -> str:
        if name.startswith('~'):
            return f'{inside}/{controller.name}{name[1:]}'
        return name if name.startswith('/') else f'{inside}/{name}'

    rules: Any = (*controller.remappings, *plan.remappings)
    found = (expanded(new) for old, new in rules if expanded(old) == expanded(local))
    return next(found, expanded(local))
