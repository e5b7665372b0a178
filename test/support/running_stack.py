# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A controller manager over mock hardware, its robot and its controllers, as real processes."""

from contextlib import contextmanager
import signal

from rcl_interfaces.srv import DescribeParameters, GetParameters, ListParameters
from rclpy.node import Node
from rclpy.parameter import parameter_value_to_python
from support.preloaded import Popen
from support.ros_processes import command, environment, PATIENCE, run

from amr_description.ros.service_calls import call

YAML = """
controller_manager:
  ros__parameters:
    update_rate: 100
    joint_state_broadcaster: {type: joint_state_broadcaster/JointStateBroadcaster}
    diff_drive_controller: {type: diff_drive_controller/DiffDriveController}
"""
CONTROLLERS_YAML = """
diff_drive_controller:
  ros__parameters:
    left_wheel_names: [joint_wheel_front_left, joint_wheel_back_left]
    right_wheel_names: [joint_wheel_front_right, joint_wheel_back_right]
    wheel_separation: 0.3
    wheel_radius: 0.1
joint_state_broadcaster: {ros__parameters: {}}
"""
NAMES = ('joint_state_broadcaster', 'diff_drive_controller')


class Graph:
    """What a node sees of the others, in the words of test/fixtures/control/live_stack.json."""

    def __init__(self, node: Node):
        self.node = node
        self._me = node.get_name()

    def nodes(self):
        full = (
            f'{ns.rstrip("/")}/{name}' for name, ns in self.node.get_node_names_and_namespaces()
        )
        return sorted(name for name in full if name != f'/{self._me}')

    def topics(self):
        found = {}
        for name, (type_name,) in self.node.get_topic_names_and_types():
            ends = {
                'pub': self.node.get_publishers_info_by_topic(name),
                'sub': self.node.get_subscriptions_info_by_topic(name),
            }
            ends = {way: self._described(infos) for way, infos in ends.items()}
            if any(ends.values()):
                found[name] = {'type': type_name, **ends}
        return found

    def _described(self, infos):
        return sorted(
            [i.node_name, i.qos_profile.reliability.name, i.qos_profile.durability.name]
            for i in infos
            if i.node_name != self._me
        )

    def services(self):
        found = {}
        for name, (type_name,) in self.node.get_service_names_and_types():
            if not name.startswith(f'/{self._me}/'):
                found[name] = type_name
        return found

    def parameters(self, node):
        """Name → [type, value, read-only], and the names of those with a range."""

        def ask(service_type, **fields):
            request = service_type.Request(**fields)
            snake = {ListParameters: 'list', GetParameters: 'get', DescribeParameters: 'describe'}
            service = f'/{node}/{snake[service_type]}_parameters'
            return call(self.node, service_type, service, request)

        names = sorted(ask(ListParameters).result.names)
        found = ask(GetParameters, names=names).values
        described = ask(DescribeParameters, names=names).descriptors
        bounded = [
            d.name
            for d in described
            if d.additional_constraints or d.integer_range or d.floating_point_range
        ]
        table = {
            name: [value.type, _plain(value), descriptor.read_only]
            for name, value, descriptor in zip(names, found, described, strict=True)
        }
        assert [(d.name, d.type) for d in described] == [
            (name, kind) for name, (kind, *_) in table.items()
        ]
        return table, bounded


def _plain(value):
    """The value as JSON has it."""
    plain = parameter_value_to_python(value)
    if plain != plain:
        return 'nan'
    return list(plain) if hasattr(plain, '__iter__') and not isinstance(plain, str) else plain


@contextmanager
def running_stack(folder, urdf, controllers=CONTROLLERS_YAML, manager=YAML):
    """
    Manager, robot_state_publisher and both controllers, active; yields the manager's log file.

    At the end all of them must leave with 0.
    """
    (folder / 'manager.yaml').write_text(manager)
    (folder / 'controllers.yaml').write_text(controllers)
    (folder / 'robot.urdf').write_text(urdf)
    log = folder / 'manager.log'
    parameters = ('--ros-args', '--params-file', str(folder / 'manager.yaml'))
    lines = (
        command('ros2_control_node', *parameters),
        command('robot_state_publisher', str(folder / 'robot.urdf')),
    )
    processes = []
    try:
        with log.open('w') as stream:
            for line in lines:
                processes.append(
                    Popen(line, stderr=stream, env=environment(), start_new_session=True)
                )
        ended = run('spawner', *NAMES, '-p', str(folder / 'controllers.yaml'))
        assert ended.returncode == 0, ended.stderr
        yield log
        for process in processes:
            process.send_signal(signal.SIGINT)
            assert process.wait(PATIENCE) == 0, log.read_text()
    finally:
        for process in processes:
            if process.poll() is None:
                process.kill()
                process.wait()
