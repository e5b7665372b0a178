# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A controller manager over fake wheels, served over real DDS, for tests of whoever asks it."""

from contextlib import contextmanager, ExitStack
from pathlib import Path

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from support.control_fakes import FakeHardware, WHEELS
from support.serving import serving

from amr_description.control.loop import Loop
from amr_description.control.ros.client import ManagerClient
from amr_description.control.ros.controller_manager_node import ControllerManagerNode
from amr_description.control.ros.loop_publisher import ClockedLoopPublisher
from amr_description.control.ros.loop_thread import CallQueue, LoopContext, LoopThread
from amr_description.control.ros.pacing import WallPacer
from amr_description.model.hardware_info import HardwareInfo, HardwareType
from amr_description.ros.log_thread import LogThread
from amr_description.ros.transport import udp_only

PERIOD = 10_000_000
YAML = f"""
controller_manager:
  ros__parameters:
    update_rate: 100
    joint_state_broadcaster: {{type: joint_state_broadcaster/JointStateBroadcaster}}
    diff_drive_controller:
      type: diff_drive_controller/DiffDriveController
      node_options_args: ["-r", "~/odom:=/odom"]
    bystander_1: {{type: joint_state_broadcaster/JointStateBroadcaster}}
    bystander_2: {{type: joint_state_broadcaster/JointStateBroadcaster}}
    rival_1: {{type: diff_drive_controller/DiffDriveController}}
    rival_2: {{type: diff_drive_controller/DiffDriveController}}
    wrong_number: {{type: diff_drive_controller/DiffDriveController}}
    slow: {{type: third_party/Slow}}
    broken: {{type: third_party/Broken}}
    nowhere: {{type: no_such_package/Nothing}}
/**:
  ros__parameters:
    left_wheel_names: [{WHEELS[0]}, {WHEELS[1]}]
    right_wheel_names: [{WHEELS[2]}, {WHEELS[3]}]
    wheel_separation: 0.3
    wheel_radius: 0.1
wrong_number:
  ros__parameters: {{wheel_radius: '0.1'}}
"""


class Clockwork:
    """A stepper: time, and nothing in it."""

    time = 0

    def advance(self, period):
        self.time += period
        return self.time


class HostHardware(FakeHardware):
    """Fake wheels, made as every component is."""

    newest = None

    def __init__(self, info, log, world):
        super().__init__(name=info.name, log=log)
        HostHardware.newest = self


class Host:
    """A process with one manager over fake wheels, and a client that knows only ROS."""

    def __init__(self, parameter_file):
        self.client_node = Node('client')
        self.node = Node('host')
        self.executor = SingleThreadedExecutor()
        self.logs = LogThread()
        publisher = ClockedLoopPublisher(self.node)
        calls = CallQueue()
        self.stepper = Clockwork()
        loop = Loop(self.stepper, WallPacer(1.0, calls), calls, publisher, PERIOD)
        self.loop_thread = LoopThread(calls, self.executor)
        self.loop_thread.loop = loop
        try:
            self.manager_node = ControllerManagerNode(
                LoopContext(self.loop_thread, publisher, self.logs),
                namespace='/',
                arguments=['--params-file', str(parameter_file)],
            )
        except Exception:
            self.logs.stop()
            raise
        info = HardwareInfo('hardware', HardwareType.SYSTEM, 'support.manager_host/HostHardware')
        prepared = self.manager_node.prepare(None, [info])
        loop.managers.append(prepared.bring_up(None, PERIOD))
        self.hardware = HostHardware.newest
        self.executor.add_node(self.node)
        self.executor.add_node(self.manager_node.node)
        self.running = prepared.serve(loop.managers[0])
        self.serving = ExitStack()

    def start(self):
        self.loop_thread.start()
        self.serving.enter_context(serving(self.executor))
        self.client = ManagerClient(self.client_node, 'controller_manager', timeout=20.0)

    def close(self):
        self.loop_thread.stop()
        self.serving.close()
        self.running.destroy()
        self.node.destroy_node()
        self.client_node.destroy_node()
        self.logs.stop()

    def activate(self, *names):
        for name in names:
            assert self.client.load(name)
            assert self.client.configure(name)
        assert self.client.switch(activate=names) is None

    def forget(self):
        """Deactivate and unload every controller."""
        states = self.client.states()
        active = [name for name, state in states.items() if state == 'active']
        assert self.client.switch(deactivate=active) is None
        assert all(self.client.unload(name) for name in states)


@contextmanager
def running_host(folder: Path, text: str = YAML):
    """A host that serves, with these parameters; rclpy must have been initialised."""
    (folder / 'controllers.yaml').write_text(text)
    host = Host(folder / 'controllers.yaml')
    host.start()
    try:
        yield host
    finally:
        host.close()


@contextmanager
def ros_in_this_process():
    """Have rclpy initialised while inside, as our programs do."""
    with udp_only():
        rclpy.init(args=[])
    try:
        yield
    finally:
        rclpy.try_shutdown()
