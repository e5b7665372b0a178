# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``ros2_control_node``: a controller manager by itself, for real or mock hardware.

The loop is the simulator's, paced by the machine's clock, or with ``use_sim_time`` by the
``/clock`` of another process. The robot is what the topic ``robot_description`` says. Parameters
beside those of the manager, as in controller_manager 4.x:

============================ ====================================================================
``overruns.manage``          leave out cycles that were missed, instead of hurrying after (true)
``thread_priority``          of the loop, by SCHED_FIFO, where Linux allows it (50)
``cpu_affinity``             cores that the loop may run on; none: all (an integer, or a list)
``lock_memory``              keep the process in RAM (false)
============================ ====================================================================
"""

from collections.abc import Sequence
import sys
from typing import Any

from rclpy.executors import SingleThreadedExecutor
from rclpy.logging import get_logger
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rosgraph_msgs.msg import Clock

from amr_description.clock import NANOSECONDS
from amr_description.control.contracts import Severity
from amr_description.control.loop import Loop
from amr_description.control.ros.controller_manager_node import ControllerManagerNode, NODE_NAME
from amr_description.control.ros.loop_publisher import LoopPublisher
from amr_description.control.ros.loop_thread import CallQueue, LoopThread
from amr_description.control.ros.pacing import SimTimePacer, SystemClockPacer
from amr_description.control.ros.realtime import lock_memory, set_cpu_affinity, set_fifo_priority
from amr_description.control.ros.robot_description import DescriptionSource
from amr_description.errors import HardwareStartError, ParameterError
from amr_description.model.hardware_info import HardwareInfo
from amr_description.model.robot import Robot
from amr_description.ros.arguments import ros_arguments
from amr_description.ros.log_thread import LogThread
from amr_description.ros.runtime import argument_errors, program, ros, spin

_CLOCK_QOS = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)


class StandAlone:
    """One manager, its loop and what paces it."""

    def __init__(self, executor: SingleThreadedExecutor, arguments: Sequence[str]) -> None:
        """``arguments``: ROS arguments of the process. Raises ParameterError."""
        self.failure: HardwareStartError | None = None
        """What ended the start, see ``shutdown_on_initial_state_failure``."""
        self._executor = executor
        self._mailbox = CallQueue()
        self.logs = LogThread()
        self._outgoing = LoopPublisher(get_logger(NODE_NAME))
        self.owner = LoopThread(self._mailbox, executor)
        try:
            self._manager = ControllerManagerNode(
                self.owner, self._outgoing, self.logs, namespace='/', arguments=arguments
            )
        except Exception:
            self.logs.stop()
            raise
        self.node, self._log = self._manager.node, self._manager.log
        try:
            self._read_options()
            self._period = round(NANOSECONDS / self._manager.parameters.update_rate)
            self.owner.loop = self._make_loop()
        except Exception:
            self.close()
            raise
        self.owner.on_start = self._ask_linux
        executor.add_node(self.node)

    def start(self) -> None:
        """Wait for a robot, and let time begin."""
        DescriptionSource(self.node, self._log, self._bring_up)
        self._log(
            Severity.INFO,
            f'Spawning {self.node.get_name()} RT thread with scheduler priority: {self._priority}',
        )
        self.owner.start()

    def close(self) -> None:
        """Stop the motors, then remove the nodes."""
        self.owner.stop()
        self._manager.destroy()
        self.logs.stop()

    def _read_options(self) -> None:
        self._manages_overruns = option(self.node, 'overruns.manage', True, bool)
        self._priority = option(self.node, 'thread_priority', 50, int)
        self._locks_memory = option(self.node, 'lock_memory', False, bool)
        cores = option(self.node, 'cpu_affinity', (), int, list, tuple)
        self._cores = [cores] if isinstance(cores, int) else cores

    def _make_loop(self) -> Loop:
        rate = self._manager.parameters.update_rate
        self._log(Severity.INFO, f'update rate is {rate} Hz')
        if self.node.get_parameter('use_sim_time').value:
            clock = SimTimePacer(self._mailbox)
        else:
            self._log(
                Severity.INFO,
                'Using Steady (Monotonic) clock for triggering controller manager cycles.',
            )
            manages = self._manages_overruns
            clock = SystemClockPacer(self._mailbox, self._log, rate, manages_overruns=manages)
            self._log(
                Severity.INFO, f'Overruns handling is : {"enabled" if manages else "disabled"}'
            )
        self._clock = clock
        loop = Loop(clock, clock, self._mailbox, self._outgoing, self._period)
        clock.on_step = loop.set_clock
        if isinstance(clock, SimTimePacer):
            clock.on_step = loop.reset
            loop.pause()
            clock.on_start = loop.resume
            self.node.create_subscription(
                Clock, '/clock', lambda m: clock.hear(_nanoseconds(m)), _CLOCK_QOS
            )
        return loop

    async def _bring_up(self, robot: Robot, hardware: Sequence[HardwareInfo]) -> None:
        self._manager.prepare(robot, hardware)
        try:
            await self.owner.submit(self._take_manager)
        except HardwareStartError as error:
            self.failure = error
            self._executor.wake()
            return
        except Exception:
            self._manager.forget_hardware()
            raise
        self._manager.start()

    def _take_manager(self) -> None:
        """On the owner's thread; how long it takes is no overrun, as nothing ran before it."""
        try:
            manager = self._manager.bring_up(None, self._period)
        finally:
            self._clock.resume(0)
        manager.begin(self._clock.time)
        self.owner.loop.managers.append(manager)

    def _ask_linux(self) -> None:
        """On the owner's thread, before its first turn."""
        set_fifo_priority(self._priority, self._log)
        set_cpu_affinity(self._cores, self._log)
        if self._locks_memory:
            lock_memory(self._log)


def _nanoseconds(message: Clock) -> int:
    return message.clock.sec * NANOSECONDS + message.clock.nanosec


def option(node: Node, name: str, default: Any, *kinds: type) -> Any:
    """Return a parameter that the node need not have. Raises ParameterError: its type."""
    value = node.get_parameter_or(name, Parameter(name, value=default)).value
    if type(value) not in kinds:
        wanted = ' or '.join(kind.__name__ for kind in kinds)
        raise ParameterError(f"parameter '{name}' must be of type {wanted}, found {value!r}")
    return value


def serve(args: list[str] | None) -> int:
    """Run until asked to stop; 1 when the owner's thread failed. Raises HardwareStartError."""
    with ros(args) as stop:
        executor = SingleThreadedExecutor()
        with argument_errors():
            robot = StandAlone(executor, ros_arguments(sys.argv[1:] if args is None else args))
        is_stopping = False

        def wake() -> None:
            nonlocal is_stopping
            is_stopping = True
            executor.wake()

        try:
            with stop.on_stop(wake):
                robot.start()
                spin(executor, lambda: is_stopping or robot.owner.failed or robot.failure)
        finally:
            robot.close()
            executor.shutdown()
        if robot.failure is not None:
            raise robot.failure
    return 1 if robot.owner.failed else 0


def main(args: list[str] | None = None) -> int:
    """Run the executable; return its exit code."""
    return program(lambda: serve(args), stopped=0)


if __name__ == '__main__':
    sys.exit(main())
