# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``ros2_control_node``: a controller manager by itself, for real or mock hardware.

Its loop is that of the simulator, paced by the system clock, or with ``use_sim_time`` by the
``/clock`` of another process. The robot is what the topic ``robot_description`` says. Parameters
beside those of the manager, as in controller_manager 4.x:

============================ ====================================================================
``overruns.manage``          leave out cycles that were missed, instead of catching up (true)
``thread_priority``          of the loop, by SCHED_FIFO, where Linux allows it (50)
``cpu_affinity``             cores that the loop may run on; none: all (an integer, or a list)
``lock_memory``              keep the process in RAM (false)
============================ ====================================================================
"""

from collections.abc import Sequence
import sys
from typing import Any

from rclpy.clock import Clock as SystemClock
from rclpy.clock_type import ClockType
from rclpy.executors import SingleThreadedExecutor
from rclpy.logging import get_logger
from rclpy.node import Node
from rclpy.parameter import Parameter
from rosgraph_msgs.msg import Clock

from amr_description.clock import NANOSECONDS
from amr_description.control.controller_manager import ControllerManager
from amr_description.control.loop import Loop
from amr_description.control.manager_parameters import ManagerTable
from amr_description.control.ros.controller_manager_node import (
    ControllerManagerNode,
    NODE_NAME,
    PreparedManagerNode,
    RunningManager,
)
from amr_description.control.ros.loop_publisher import LoopPublisher
from amr_description.control.ros.loop_thread import CallQueue, LoopContext, LoopThread
from amr_description.control.ros.pacing import SimTimePacer, SystemClockPacer
from amr_description.control.ros.realtime import lock_memory, set_cpu_affinity, set_fifo_priority
from amr_description.control.ros.robot_description import DescriptionSource
from amr_description.errors import HardwareStartError, ParameterError
from amr_description.log import Severity
from amr_description.model.hardware_info import HardwareInfo
from amr_description.model.robot import Robot
from amr_description.ros.endpoints import endpoint_node
from amr_description.ros.log_thread import LogThread
from amr_description.ros.messages import nanoseconds
from amr_description.ros.node_help import print_help
from amr_description.ros.qos import CLOCK
from amr_description.ros.runtime import argument_errors, end_wait, program, ros, serve
from amr_description.ros_arguments import ros_arguments
from amr_description.streams import never_wait_for_stderr

_OPTIONS = (
    'Also overruns.manage (true): leave out cycles that were missed; thread_priority (50): of the '
    'loop, by SCHED_FIFO; cpu_affinity: cores that the loop may run on; lock_memory (false).'
)


CLOCK_TIMEOUT = 3.0
"""s without a message on ``/clock`` after which a warning says so."""


class StandAloneManager:
    """One controller manager, its loop and what paces it."""

    def __init__(self, executor: SingleThreadedExecutor, arguments: Sequence[str]) -> None:
        """``arguments``: ROS arguments of the process. Raises ParameterError."""
        self.failure: HardwareStartError | None = None
        """What ended the start, see ``shutdown_on_initial_state_failure``."""
        self._executor = executor
        self._calls = CallQueue()
        self.loop_thread = LoopThread(self._calls, executor)
        self._context = LoopContext(
            self.loop_thread, LoopPublisher(get_logger(NODE_NAME)), LogThread()
        )
        try:
            self._manager_node = ControllerManagerNode(
                self._context, namespace='/', arguments=arguments
            )
        except Exception:
            self._context.logs.stop()
            raise
        self._latest: ControllerManagerNode | PreparedManagerNode | RunningManager
        """Has all nodes that were made so far."""
        self._latest = self._manager_node
        self.node, self._log = self._manager_node.node, self._manager_node.log
        self.loop_thread.log = self._log
        try:
            self._read_options()
            self._period = round(NANOSECONDS / self._manager_node.parameters.update_rate)
            self.loop_thread.loop = self._make_loop()
        except Exception:
            self.close()
            raise
        self.loop_thread.on_start = self._set_scheduling
        executor.add_node(self.node)

    def start(self) -> None:
        """Wait for a robot description, and start the loop."""
        DescriptionSource(self.node, self._log, self._bring_up)
        self._log(
            Severity.INFO,
            f'Spawning {self.node.get_name()} RT thread with scheduler priority: {self._priority}',
        )
        self.loop_thread.start()

    def close(self) -> None:
        """Stop the motors, then remove the nodes."""
        self.loop_thread.stop()
        self._latest.destroy()
        self._context.logs.stop()

    def _read_options(self) -> None:
        self._manages_overruns = option(self.node, 'overruns.manage', True, bool)
        self._priority = option(self.node, 'thread_priority', 50, int)
        self._locks_memory = option(self.node, 'lock_memory', False, bool)
        cores = option(self.node, 'cpu_affinity', (), int, list, tuple)
        self._cores = [cores] if isinstance(cores, int) else cores

    def _make_loop(self) -> Loop:
        rate = self._manager_node.parameters.update_rate
        self._log(Severity.INFO, f'update rate is {rate} Hz')
        if self.node.get_parameter('use_sim_time').value:
            return self._make_sim_time_loop()
        self._log(
            Severity.INFO,
            'Using Steady (Monotonic) clock for triggering controller manager cycles.',
        )
        manages = self._manages_overruns
        pacer = SystemClockPacer(self._calls, self._log, rate, manages_overruns=manages)
        self._log(Severity.INFO, f'Overruns handling is : {"enabled" if manages else "disabled"}')
        loop = self._loop_of(pacer)
        pacer.on_time_jump = loop.set_clock
        return loop

    def _make_sim_time_loop(self) -> Loop:
        pacer = SimTimePacer(self._calls)
        loop = self._loop_of(pacer)
        loop.pause()
        pacer.on_start = loop.resume
        pacer.on_time_jump = loop.reset
        self.node.create_subscription(
            Clock, '/clock', lambda message: pacer.receive(nanoseconds(message.clock)), CLOCK
        )
        self._watch_clock(pacer)
        return loop

    def _watch_clock(self, pacer: SimTimePacer) -> None:
        """Warn once if there is no time after a while."""

        def look() -> None:
            timer.cancel()
            if not pacer.has_begun:
                self._log(Severity.WARN, without_clock(self.node))

        steady = SystemClock(clock_type=ClockType.STEADY_TIME)
        timer = self.node.create_timer(CLOCK_TIMEOUT, look, clock=steady)

    def _loop_of(self, pacer: SystemClockPacer | SimTimePacer) -> Loop:
        self._pacer = pacer
        return Loop(pacer, pacer, self._calls, self._context.publisher, self._period)

    async def _bring_up(self, robot: Robot, hardware: Sequence[HardwareInfo]) -> None:
        prepared = self._latest = self._manager_node.prepare(robot, hardware)
        try:
            manager = await self.loop_thread.submit(lambda: self._add_manager(prepared))
        except HardwareStartError as error:
            self.failure = error
            end_wait(self._executor)
            return
        except Exception:
            prepared.release()
            self._latest = self._manager_node
            raise
        self._latest = prepared.serve(manager)

    def _add_manager(self, prepared: PreparedManagerNode) -> ControllerManager:
        """On the control thread; how long it takes is no overrun, as nothing ran before it."""
        try:
            manager = prepared.bring_up(None, self._period)
        finally:
            self._pacer.resume(0)
        manager.begin(self._pacer.time)
        self.loop_thread.loop.managers.append(manager)
        return manager

    def _set_scheduling(self) -> None:
        """On the control thread, before its first cycle."""
        set_fifo_priority(self._priority, self._log)
        set_cpu_affinity(self._cores, self._log)
        if self._locks_memory:
            lock_memory(self._log)


def without_clock(node: Node) -> str:
    """Say why the controllers stand still, and what would do."""
    publishers = {endpoint_node(each) for each in node.get_publishers_info_by_topic('/clock')}
    silent = ', '.join(sorted(filter(None, publishers)))
    cause = f'{silent} has published nothing on /clock' if silent else 'nobody publishes /clock'
    return (
        f'use_sim_time is true, and {cause}: the controllers stand still until time passes there; '
        'start the simulation, or set use_sim_time to false, as mock and real hardware go by the '
        'system clock'
    )


def option(node: Node, name: str, default: Any, *kinds: type) -> Any:
    """Return a parameter that the node need not have. Raises ParameterError: its type."""
    value = node.get_parameter_or(name, Parameter(name, value=default)).value
    if type(value) not in kinds:
        wanted = ' or '.join(kind.__name__ for kind in kinds)
        raise ParameterError(f"parameter '{name}' must be of type {wanted}, found {value!r}")
    return value


def control(args: list[str] | None) -> int:
    """
    Run until asked to stop; return 1 when the control thread failed, else 0.

    Raises HardwareStartError.
    """
    with ros(args) as stop:
        executor = SingleThreadedExecutor()
        with argument_errors():
            alone = StandAloneManager(
                executor, ros_arguments(sys.argv[1:] if args is None else args)
            )
        try:
            serve(
                executor,
                stop,
                alone.start,
                until=lambda: alone.loop_thread.failed or alone.failure,
            )
        finally:
            alone.close()
            executor.shutdown()
        if alone.failure is not None:
            raise alone.failure
    return 1 if alone.loop_thread.failed else 0


def main(args: list[str] | None = None) -> int:
    """Run the executable; return its exit code."""
    purpose = 'Run the controllers of a robot with real or mock hardware.'
    if print_help(args, 'ros2_control_node', purpose, ManagerTable, notes=_OPTIONS):
        return 0
    never_wait_for_stderr()
    return program(lambda: control(args), stopped=0)


if __name__ == '__main__':
    sys.exit(main())
