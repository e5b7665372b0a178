# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``create``: spawn a robot in the simulation, like the executable of ros_gz_sim.

The file of ``-file`` may be a xacro file, with its arguments: ``-file robot.urdf.xacro
wheel_radius:=0.2``.

Exit codes: 0 when the robot is spawned, 1 with the reason when the simulator refuses, 255 when no
description is given.
"""

import argparse
import sys

from rclpy.node import Node
from simulation_interfaces.msg import Result
from simulation_interfaces.srv import GetEntityState, SpawnEntity
from std_msgs.msg import String

from amr_description.errors import AmrError, UsageError
from amr_description.model.description_file import description_at, mappings_of
from amr_description.model.fixing import fixed_to_world
from amr_description.model.frames import Transform
from amr_description.ros.messages import fill_pose
from amr_description.ros.qos import LATCHED, SERVICE_CLIENT
from amr_description.ros.runtime import argument_errors, program, ros
from amr_description.ros.service_calls import ask_until_answered, call_with, wait_until
from amr_description.ros_arguments import other_arguments, ros_arguments
from amr_description.text import truth

_PATIENCE = 60.0
"""s, for an answer of the simulator; longer, where meshes are to be read."""
_SERVICE_TYPE = 'simulation_interfaces/srv/SpawnEntity'


class NoSourceError(UsageError):
    """No description was given; the exit code is that of the original."""

    exit_code = 255


def parser() -> argparse.ArgumentParser:
    """Return the parser; options have one dash or two, as in the original."""
    options = argparse.ArgumentParser(prog='create', description=__doc__, allow_abbrev=False)
    options.add_argument('-world', '--world', default='', help='simulator, if there are several')
    source = options.add_argument_group('description, the first that is given')
    source.add_argument('-file', '--file', help='path or URI of a URDF')
    source.add_argument('-param', '--param', help='ROS parameter that holds the URDF')
    source.add_argument('-string', '--string', help='the URDF itself')
    source.add_argument('-topic', '--topic', help='topic on which the URDF is latched')
    options.add_argument('-name', '--name', default='', help='default: the name in the URDF')
    options.add_argument(
        '-allow_renaming', '--allow_renaming', nargs='?', const=True, default=False, type=_bool
    )
    options.add_argument(
        '-robot_namespace',
        '--robot_namespace',
        default='',
        help='namespace of the robot, as with spawn_entity.py; default: that of this node',
    )
    for axis in 'xyz':
        options.add_argument(f'-{axis}', type=float, default=0.0, metavar='M')
    for axis, name in zip('RPY', ('roll', 'pitch', 'yaw'), strict=True):
        options.add_argument(f'-{axis}', type=float, default=0.0, metavar='RAD', help=name)
    options.add_argument(
        '-fixed',
        '--fixed',
        action='store_true',
        help='fix the root link to the world, as that of an arm',
    )
    options.add_argument(
        'arguments', nargs='*', metavar='NAME:=VALUE', help='arguments of a xacro file'
    )
    return options


def create(args: list[str] | None) -> int:
    """Call the simulator's spawn service; return the exit code."""
    given = sys.argv[1:] if args is None else args
    # Without NAME:=VALUE, which rcl would parse as remapping rules of ROS 1.
    with ros(['--ros-args', *ros_arguments(given)]):
        options = parser().parse_intermixed_args(other_arguments(given))
        with argument_errors():
            node = Node(
                'ros_gz_sim',
                allow_undeclared_parameters=True,
                automatically_declare_parameters_from_overrides=True,
            )
        try:
            text = _description(node, options)
            # Without a namespace of its own the robot is in the one that its URDF names.
            request = SpawnEntity.Request(
                name=options.name,
                allow_renaming=options.allow_renaming,
                entity_namespace=(options.robot_namespace or node.get_namespace()).strip('/'),
                uri=options.file or '',
                resource_string=fixed_to_world(text) if options.fixed else text,
            )
            pose = Transform.from_xyz_rpy(
                (options.x, options.y, options.z), (options.R, options.P, options.Y)
            )
            fill_pose(pose, request.initial_pose.pose)
            result = _spawn(node, _find_simulator(node, options.world), request)
            if result.result != Result.RESULT_OK:
                node.get_logger().error(f'Entity creation failed. {result.error_message}')
                return 1
            node.get_logger().info('Entity creation successfull.')
            return 0
        finally:
            node.destroy_node()


def _spawn(node: Node, service: str, request: SpawnEntity.Request) -> Result:
    """
    Send the request, only once: a second one would spawn a second robot.

    A simulator that has not discovered this client yet would drop its response. So a harmless
    service of the simulator is called first, by a client that is created later.
    """
    client = node.create_client(SpawnEntity, service, qos_profile=SERVICE_CLIENT)
    probe = f'{service.rpartition("/")[0]}/get_entity_state'
    if probe in dict(node.get_service_names_and_types()):
        harmless = node.create_client(GetEntityState, probe)
        ask_until_answered(node, harmless, GetEntityState.Request(), timeout=_PATIENCE)
    return call_with(node, client, request, timeout=_patience(request.resource_string)).result


def _patience(text: str) -> float:
    """Return how long to wait for the answer to a spawn, s."""
    if '<mesh' not in text:
        return _PATIENCE
    from amr_description.simulation.spawn_cost import patience_with  # 0.1 s

    return patience_with(text, _PATIENCE)


def _description(node: Node, options: argparse.Namespace) -> str:
    """Return the URDF from the source in the options. Raises NoSourceError, UsageError."""
    mappings = mappings_of(options.arguments)
    if options.file:
        try:
            return description_at(options.file, mappings, warn=node.get_logger().warning)
        except AmrError as error:
            raise UsageError(f'-file {options.file}: {error}') from error
    if mappings:
        raise UsageError(f'{options.arguments[0]} is for a xacro file, and there is no -file')
    if options.param:
        value = node.get_parameter_or(options.param).value
        if not isinstance(value, str):
            raise UsageError(
                f"-param {options.param}: the node has no string parameter '{options.param}'; "
                f'give it with --ros-args -p {options.param}:=…'
            )
        return value
    if options.string:
        return options.string
    if options.topic:
        return _latched(node, options.topic)
    raise NoSourceError('Must specify either -file, -param, -string or -topic')


def _latched(node: Node, topic: str) -> str:
    """Wait for a message on a latched topic; return the description."""
    texts: list[str] = []
    subscription = node.create_subscription(
        String, topic, lambda message: texts.append(message.data), LATCHED
    )
    warn = node.get_logger().warning
    wait_until(
        node,
        lambda: texts or None,
        lambda: warn(f'Waiting messages on topic [{subscription.topic_name}].'),
        every=1.0,
        of_message=True,
    )
    return texts[-1]


def _find_simulator(node: Node, world: str) -> str:
    """
    Wait for a spawn service; return the only one, or that of the simulator ``world``.

    Raises UsageError if there are several and none is chosen.
    """

    def services() -> list[str] | None:
        found = sorted(
            name for name, types in node.get_service_names_and_types() if _SERVICE_TYPE in types
        )
        chosen = [name for name in found if not world or world in name.split('/')]
        return chosen or (found if world and found else None)

    def warn() -> None:
        node.get_logger().warning(f'Waiting for service [{_SERVICE_TYPE}] to become available ...')

    found = wait_until(node, services, warn, every=5.0) or []
    if len(found) > 1:
        raise UsageError(
            f'several simulators can create an entity: {", ".join(found)}; choose one by '
            'its node with -world'
        )
    return found[0]


def _bool(text: str) -> bool:
    if (value := truth(text)) is None:
        raise argparse.ArgumentTypeError(f'{text!r} is neither true nor false')
    return value


def main(args: list[str] | None = None) -> int:
    """Run the executable; return its exit code."""
    return program(lambda: create(args))


if __name__ == '__main__':
    sys.exit(main())
