# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A simulation in lock-step with a test, over real ROS.

What it can do is said in :mod:`amr_description.simulation.api`. Here the simulator is in a process
and a ROS domain of its own, and is used over DDS. What only ROS can do is here alone: nodes and
services of the test, and other programs. At the end of the block, in whatever way it is left,
everything has ended.
"""

from collections.abc import Mapping
from contextlib import AbstractContextManager, ExitStack, nullcontext, suppress
from functools import cached_property
import os
from pathlib import Path
import time as wall
from typing import Any

import rclpy
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.serialization import deserialize_message
from simulation_interfaces.srv import DeleteEntity

from amr_description.errors import AmrError, SimulationError
from amr_description.model.frames import Transform
from amr_description.model.gazebo.bridge import bridged
from amr_description.model.gazebo.translation import translate
from amr_description.ros.discovery import use_whole_graph
from amr_description.ros.local_participants import is_on_the_network
from amr_description.ros.message_types import message_type
from amr_description.ros.participant_end import bound_listener_wait
from amr_description.ros.transport import udp_only
from amr_description.simulation.api import namespace_of, SimulationApi
from amr_description.simulation.recorded_run import read_run, RecordedRun
from amr_description.simulation.spawned_controllers import Topics
from amr_description.simulation.tracebacks import is_for_the_test
from amr_description.testing import bags
from amr_description.testing.lock_step import Condition, LockStep
from amr_description.testing.program import DOMAIN, own_domain, require_alone, simulator
from amr_description.testing.robot import Robot, spawn, spawn_controllers
from amr_description.testing.sensors import RobotReadings

__tracebackhide__ = is_for_the_test

_DISCOVERY_STEPS = 20
"""Physics steps between two checks for the first messages, at the beginning."""


class Simulation(SimulationApi[Robot]):
    """See :class:`~amr_description.simulation.api.SimulationApi`, and the module."""

    _lock_step: LockStep | None = None

    @cached_property
    def recording(self) -> bags.Recording:
        """Its own bag, and that of ``--ros-bag``."""
        own = self._parameters.get('record')
        return bags.Recording(self._set_record, lambda: self.is_alive, own)

    # --- beginning and end --------------------------------------------------------------------

    def _start(self, stack: ExitStack) -> None:
        self._domain = domain = stack.enter_context(own_domain())
        self._simulator = stack.enter_context(simulator({'record_below': '/'} | self._parameters))
        context = self._ros(stack, domain)
        self._lock_step = LockStep(self.node, self._simulator)
        stack.callback(self._forget_lock_step)
        self._running.connect()
        require_alone(domain, self._simulator.process.pid)
        self._readings = _node('simulation_readings', context)
        stack.callback(self._readings.destroy_node)

    def _started(self) -> None:
        bags.begin(self.recording)

    def enter_domain(self) -> None:
        """
        Have processes and contexts that are started from now on be in its ROS domain.

        As at its start: another simulation that was started since has put them in its own.
        """
        os.environ[DOMAIN] = str(self._domain)

    @property
    def _running(self) -> LockStep:
        self._require_running()
        assert self._lock_step is not None, 'it runs'
        return self._lock_step

    def _forget_lock_step(self) -> None:
        self._lock_step = None

    def _ros(self, stack: ExitStack, domain: int) -> Context:
        """Make a context and a node; the test may have initialised rclpy itself, or not."""
        use_whole_graph()
        context, self.node = _client(udp_only())
        """For the test's own subscriptions, publishers and clients; :meth:`wait` spins it."""
        if is_on_the_network(domain):
            # Fast DDS reads its profile once in a process, and the test had a node before: so it
            # knows none that keeps a participant without shared memory on this host.
            self.node.destroy_node()
            context.shutdown()
            context, self.node = _client(nullcontext())
        stack.callback(context.try_shutdown)
        executor = SingleThreadedExecutor(context=context)
        stack.callback(executor.shutdown)
        stack.callback(self.node.destroy_node)
        executor.add_node(self.node)
        return context

    def _insert(self, name: str, pose: Transform) -> Robot:
        """
        ``name``: of the entity and its namespace; empty: that of the URDF, no namespace.

        Discovery may take some milliseconds, so that the very first messages of a new name may be
        missed.
        """
        lock_step, namespace = self._running, name
        name = spawn(lock_step, self._description, pose, name or self._name, namespace)
        topics = Topics()
        if self._is_controlled:
            try:
                topics = spawn_controllers(
                    lock_step,
                    self._robot_model,
                    self._files,
                    self._activate,
                    namespace,
                    self._bridge,
                )
            except AmrError:
                with suppress(SimulationError):  # the simulator may have ended
                    self.ask(DeleteEntity, entity=name)
                raise
        sensors = RobotReadings(
            lock_step,
            self._readings,
            name,
            bridged(translate(self._robot_model, self._files), self._bridge).sensors,
            namespace_of(self._robot_model, namespace),
        )
        return Robot(lock_step, self._readings, name, namespace, topics, sensors)

    def _begin(self) -> None:
        """Let time pass until every topic has been received (discovery takes a while); reset."""
        lock_step = self._running
        lock_step.measure_timestep(next(iter(self._robots)))

        def silent_topics() -> list[str]:
            return [topic for robot in self._robots.values() for topic in robot.silent_topics()]

        def all_received() -> bool:
            lock_step.step(_DISCOVERY_STEPS)
            return not silent_topics()

        lock_step.wait(all_received, ' and '.join(silent_topics()))
        self.reset()

    def _delete(self, robot: Robot) -> None:
        self.ask(DeleteEntity, entity=robot.name)
        self._running.forget(robot.namespace)
        robot.close()

    # --- time ---------------------------------------------------------------------------------

    @property
    def _time(self) -> int:
        return self._running.time

    @property
    def _timestep(self) -> int:
        return self._running.timestep

    def _advance(self, count: int) -> None:
        self._running.step(count)
        self._running.time += count * self._running.timestep

    def _wait_until(self, instant: float) -> None:
        """Spin the node until an instant of ``time.monotonic``, s."""
        while (delay := instant - wall.monotonic()) > 0.0:
            self.node.executor.spin_once(timeout_sec=delay)

    def send_all(self, messages: Mapping[str, Any]) -> None:
        """Send messages on several topics at the same instant, as by :meth:`send`."""
        self._running.send_all(messages)

    def ask(self, service_type: Any, **fields: Any) -> Any:
        """
        Call a service of the simulator, of ``simulation_interfaces``; return the response.

        After time has passed by it, call :meth:`reset` before the next step.

        Args:
            service_type: Type of the service; its name follows from that.
            **fields: Of the request.
        """
        return self._running.ask(service_type, **fields)

    def reset(self) -> None:
        """Reset: time 0, robots where they were spawned, odometry at zero; takes a few ms."""
        self._running.reset()
        for robot in self._robots.values():
            robot.forget()

    def record(self, folder: str | Path) -> None:
        """Record from now on; see the base class. The bag of ``--ros-bag`` ends before."""
        self.recording.begin_own(Path(folder))

    def _set_record(self, folder: str) -> None:
        self._running.set_parameter('record', folder)

    def end_recording(self) -> None:
        """Complete the bag, if there is one; not that of ``--ros-bag``."""
        self.recording.end_own()

    def _read_run(self, bag: str | Path) -> RecordedRun:
        return read_run(bag, deserialized)

    def _repeat(self, topic: str, message: Any) -> None:
        self._running.send_all({topic: message}, as_they_are=True)

    def wait(self, condition: Condition, what: str, timeout: float | None = None) -> Any:
        """
        Spin ``node`` until a condition holds; return what it returned. No time passes.

        Args:
            condition: Called repeatedly; holds when its result is true.
            what: What is waited for, for the error.
            timeout: s of the wall clock; 30 by default.
        """
        return self._running.wait(condition, what, timeout)

    @property
    def log(self) -> str:
        """The output of the simulator so far."""
        return self._simulator.log

    @property
    def is_alive(self) -> bool:
        """Whether the simulator runs."""
        return not self._simulator.has_ended


def deserialized(type_name: str, data: bytes) -> Any:
    """Return the message of bytes. Raises RuntimeError, ValueError or AmrError: there is none."""
    return deserialize_message(data, message_type(type_name))


def _client(transport: AbstractContextManager[None]) -> tuple[Context, Node]:
    """Return a node of the test, in a context that is initialised with ``transport``."""
    context = Context()
    with transport:
        rclpy.init(args=[], context=context)
    bound_listener_wait()
    return context, _node('simulation_client', context)


def _node(name: str, context: Context) -> Node:
    """Make a node without /rosout: two simulations of a test have nodes of the same names."""
    return Node(name, context=context, use_global_arguments=False, enable_rosout=False)
