# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The simulation in a process: the world, the control thread, the robots, and the state.

The states are those of ``simulation_interfaces/msg/SimulationState``:

========  ===========================================================================
PLAYING   time passes
PAUSED    time passes only in steps that are requested; everything else works:
          services, spawners, parameters
STOPPED   as PAUSED, at time 0 and without the spawned robots; it can be played or
          paused, and stepped once it is paused
QUITTING  the process ends
========  ===========================================================================
"""

from collections.abc import Callable, Sequence
import enum

from rclpy.executors import Executor
from rclpy.node import Node
from rclpy.parameter import Parameter

from amr_description.bag.run_description import RunDescription
from amr_description.control.loop import Pacer, Publisher, Stepper
from amr_description.control.ros.loop_publisher import ClockedLoopPublisher, NodeTopics
from amr_description.control.ros.loop_thread import CallQueue, LoopContext, LoopThread
from amr_description.control.ros.pacing import WallPacer
from amr_description.control.ros.realtime import set_time_slice, USUAL_SLICE
from amr_description.parameters import specs
from amr_description.ros.log_thread import LogThread
from amr_description.ros.parameters import add_validation_callback, values
from amr_description.ros.runtime import end_wait
from amr_description.sim.ros.entities import EntityManager
from amr_description.sim.ros.loop_timing import LoopProfiler
from amr_description.sim.ros.run_recording import on_loop, RosRunRecording
from amr_description.sim.ros.spawned_topics import SpawnedTopics
from amr_description.sim.world import MujocoWorld
from amr_description.simulation.engine import SimulationEngine
from amr_description.simulation.parameters import SimulationParameters
from amr_description.simulation.run_recording import describe_run
from amr_description.simulation.topics.ground_truth import GroundTruth
from amr_description.simulation.topics.link_transforms import LinkTransforms, SpawnedRobot
from amr_description.simulation.topics.sensor_manager import SensorManager

PAUSED_CLOCK_PERIOD = 0.1
"""s of the wall clock between two messages on ``/clock`` while paused."""


_PARAMETERS = tuple(specs(SimulationParameters))


class SimulationState(enum.IntEnum):
    """See the module. The numbers are those of the message."""

    STOPPED = 0
    PLAYING = 1
    PAUSED = 2
    QUITTING = 3
    NO_WORLD = 4
    LOADING_WORLD = 5


class Simulation:
    """
    World, control loop and robots.

    The coroutines run on the ROS thread and await the control thread.
    """

    on_world: Callable[[], None] | None = None
    """Called when there is another world."""

    def __init__(
        self,
        node: Node,
        executor: Executor,
        parameters: SimulationParameters,
        ros_args: Sequence[str],
    ) -> None:
        """
        Load the world; time begins with :meth:`start`.

        Args:
            node: Publishes ``/clock``; has the parameters and the logger.
            executor: Of the ROS thread.
            parameters: Of ``node``, at the start.
            ros_args: ROS arguments for every controller manager and controller.

        Raises:
            SimulationError: There is no such world, or MuJoCo rejects it.
        """
        self._node = node
        self._is_stopped = self._is_quitting = False
        self._executor = executor
        self.logs = LogThread()
        try:
            self.log = self.logs.log_of(node.get_logger())
            publisher = self.publisher = ClockedLoopPublisher(node)
            publisher.adopt(node)
            topics = NodeTopics(node, publisher)
            calls = CallQueue(PAUSED_CLOCK_PERIOD)
            self._pacer = WallPacer(parameters.real_time_factor, calls)
            self.engine = SimulationEngine(
                parameters,
                self.log,
                calls,
                self._ports,
                ros_args=ros_args,
                remedy='~/set_simulation_state lets time go on, ~/reset_simulation begins anew',
            )
            self.world = self.engine.world
            self._ground_truth = GroundTruth(
                topics, self.world, parameters.ground_truth_rate, self._has_ticked
            )
            self.loop_thread = LoopThread(calls, executor)
            self.loop_thread.log = self.log
            self.loop_thread.loop = self.engine.loop
            self._sensors = self._sensor_manager(topics)
            context = LoopContext(self.loop_thread, publisher, self.logs)
            parts = self._ground_truth, self._sensors, executor, self.log
            self.entities = EntityManager(context, self.engine, *parts)
            self.recording = self._recording(calls)
        except Exception:
            self.logs.stop()
            raise
        if parameters.record:
            self.recording.begin(parameters.record)
        add_validation_callback(node, SimulationParameters)
        node.add_post_set_parameters_callback(self._on_parameters_set)

    def _ports(self, world: MujocoWorld) -> tuple[Stepper, Pacer, Publisher]:
        profiler = LoopProfiler(self.log, world, self._pacer, self.publisher)
        return profiler, profiler, profiler

    def _sensor_manager(self, topics: NodeTopics) -> SensorManager:
        sensors = SensorManager(
            topics,
            self.world,
            self.log,
            self._is_paced,
            self._has_ticked,
            self.engine.settings.camera_renderer,
            begin_thread=_begin_measuring,
        )
        sensors.on_first = self._serve_measurements
        return sensors

    def _recording(self, calls: CallQueue) -> RosRunRecording:
        recording = RosRunRecording(
            self._node,
            self.publisher,
            on_loop=on_loop(calls.put, lambda: self.loop_thread.is_alive),
            time=lambda: self.world.time,
            has_ticked=self._has_ticked,
            is_paced=self._is_paced,
            describe=self._describe_run,
            robots=self._spawned,
            transforms=LinkTransforms(self.world),
            log=self.log,
        )
        recording.on_begin = self._ground_truth.restart
        spawned = SpawnedTopics(self._node, lambda: self.entities)

        def on_change() -> None:
            recording.update()
            spawned.update()

        self.entities.on_change = on_change
        return recording

    def _spawned(self) -> list[SpawnedRobot]:
        return [
            SpawnedRobot(each.name, origin.namespace, origin.robot, origin.pose)
            for each in self.entities
            if (origin := each.origin)
        ]

    def _describe_run(self) -> RunDescription:
        values = {each.name: self._node.get_parameter(each.name).value for each in _PARAMETERS}
        values['controllers'] = self.engine.settings.controllers
        return describe_run(values.__getitem__, self.engine.world_name, self._spawned())

    def _is_paced(self) -> bool:
        """Whether cycles wait for the wall clock: neither at factor 0 nor in a step."""
        return self._pacer.factor > 0.0 and self.loop_thread.loop.is_running

    def _serve_measurements(self) -> None:
        from amr_description.sim.ros.measure_service import MeasureService

        loop = self.loop_thread.loop

        def is_standing_still() -> bool:
            return not (loop.is_running or loop.is_stepping)

        MeasureService(self._node, self._sensors, self.loop_thread.submit, is_standing_still)

    def _has_ticked(self, time: int) -> bool:
        """Whether the controllers have ticked at ``time``, ns: not yet at the end of a step."""
        return self.loop_thread.loop.latest_tick == time

    def start(self) -> None:
        """Start the control thread; time begins to pass, unless paused."""
        self.loop_thread.start()

    def close(self) -> None:
        """Stop the control thread; then destroy the robots' nodes."""
        self.recording.detach()  # the end of the controllers is not part of the run
        self._sensors.stop()
        self.loop_thread.stop()
        self.recording.close()  # a slow disk does not keep motors running
        self._sensors.close()
        self.entities.destroy()
        self.logs.stop()

    @property
    def state(self) -> SimulationState:
        """The present state."""
        if self._is_quitting:
            return SimulationState.QUITTING
        if self.loop_thread.loop.is_running:
            return SimulationState.PLAYING
        return SimulationState.STOPPED if self._is_stopped else SimulationState.PAUSED

    @property
    def has_ended(self) -> bool:
        """Whether the process shall end: by QUITTING, or by a bug."""
        return self._is_quitting or self.loop_thread.failed

    async def play(self) -> None:
        """Let time pass."""
        await self.loop_thread.submit(self.loop_thread.loop.resume)
        self._is_stopped = False

    async def pause(self) -> None:
        """Stop time."""
        await self.loop_thread.submit(self.loop_thread.loop.pause)
        self._is_stopped = False

    async def stop(self) -> None:
        """Stop time, remove all robots and reset."""
        await self.loop_thread.submit(self.loop_thread.loop.pause)
        await self.entities.remove_all()
        await self.reset()
        self._is_stopped = True

    async def load_world(self, world: str) -> None:
        """
        Stop, and load a world in the place of the present one. Raises SimulationError.

        The file is read first, so that the present world and its robots stay where it is no world.
        """
        await self.loop_thread.submit(lambda: self.engine.check_world(world))
        await self.stop()
        await self.loop_thread.submit(lambda: self.engine.load_world(world))
        self.recording.update()
        if self.on_world is not None:
            self.on_world()

    async def quit(self) -> None:
        """Stop, and end the process."""
        await self.stop()
        self._is_quitting = True
        end_wait(self._executor)

    async def step(self, count: int) -> int:
        """
        Make ``count`` physics steps while paused; return how many were not made.

        Steps are left out when the simulation is played, paused or reset meanwhile. Raises
        SimulationError: it is not paused, or is already stepping.
        """
        missing = await self.loop_thread.step(count * self.world.timestep)
        return self.engine.missing_steps(missing)

    async def reset(self, *, time: bool = True, state: bool = True) -> None:
        """
        Reset; the simulation stays playing or paused, active controllers stay active.

        Args:
            time: Set the time to 0.
            state: Put every robot where it was spawned, at rest, with odometry at zero.
        """

        def reset() -> None:
            self._ground_truth.restart()
            if time:
                self._sensors.restart()
            self.recording.restart()
            self.engine.reset(time=time, state=state)

        await self.loop_thread.submit(reset)

    def _on_parameters_set(self, _: Sequence[Parameter]) -> None:
        """Apply ``real_time_factor`` and ``on_fault``; the others are read-only."""
        now = values(self._node, SimulationParameters)
        self.engine.pauses_on_fault = now.on_fault == 'pause'
        if now.real_time_factor != self._pacer.factor:
            loop = self.loop_thread.loop
            self.loop_thread.submit(
                lambda: self._pacer.set_factor(now.real_time_factor, loop.time)
            )


def _begin_measuring() -> None:
    """Have the control thread, which starts the one that measures, go first."""
    set_time_slice(USUAL_SLICE)
