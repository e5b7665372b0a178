# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A simulation in lock-step with a test.

::

    with Simulation('my_robot.urdf', 'controllers.yaml', world='ramp') as sim:
        sim.drive(0.5, 0.0, seconds=2)
        assert sim.truth.x == pytest.approx(1.0, rel=0.01)
        assert sim.odometry.x == pytest.approx(sim.truth.x, abs=0.02)

The simulator is the real one, in a process and a ROS domain of its own, used over DDS. Time
passes only in :meth:`Simulation.drive`, :meth:`Simulation.run` and :meth:`Simulation.step`: the
same calls give the same bits, on a busy machine too. At the end of the block, in whatever way it
is left, everything has ended.

Several robots, each in the namespace of its name::

    poses = {'robot1': Transform(), 'robot2': Transform((0.0, 2.0, 0.0))}
    with Simulation('my_robot.urdf', 'controllers.yaml', robots=poses) as sim:
        sim.drive_all({'robot1': (0.5, 0.2), 'robot2': (0.3, -0.3)}, seconds=2)
        assert sim.robots['robot2'].odometry.x == pytest.approx(0.5, abs=0.02)
"""

from collections.abc import Mapping, Sequence
from contextlib import AbstractContextManager, ExitStack, nullcontext
import math
import os
from pathlib import Path
import time as wall
from types import MappingProxyType, TracebackType
from typing import Any, Self
import warnings

import rclpy
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from simulation_interfaces.srv import DeleteEntity

from amr_description.ament_index import path_of
from amr_description.clock import NANOSECONDS
from amr_description.errors import SimulationError
from amr_description.model.controller_files import files_of
from amr_description.model.description_file import description_at
from amr_description.model.frames import Transform
from amr_description.model.gazebo_bridge import bridged, NO_BRIDGE, read_bridge
from amr_description.model.gazebo_translation import translate
from amr_description.model.ros2_control_tag import hardware_of
from amr_description.model.urdf import parse as parse_urdf
from amr_description.ros.discovery import use_whole_graph
from amr_description.ros.local_participants import is_on_the_network
from amr_description.ros.participant_end import bound_listener_wait
from amr_description.ros.transport import udp_only
from amr_description.testing import bags
from amr_description.testing.lock_step import Condition, LockStep
from amr_description.testing.program import DOMAIN, own_domain, require_alone, simulator
from amr_description.testing.readings import Joint, Motion
from amr_description.testing.recorded_run import read_run, RecordedRun
from amr_description.testing.robot import (
    namespace_of,
    Robot,
    spawn,
    spawn_controllers,
    Topics,
)
from amr_description.testing.sensors import Contact, Image, Points, RobotReadings, Scan
from amr_description.testing.tracebacks import is_for_the_test, without_frames

__tracebackhide__ = is_for_the_test

_AT_ORIGIN = Transform()
_COMMAND_PERIOD = 0.1
"""s between two commands of a drive: well below the usual command timeout of 0.5 s."""
_PACING_PERIOD = 0.02
"""s of simulated time between two readings of the wall clock, with a real-time factor."""
_DISCOVERY_STEPS = 20
"""Physics steps between two checks for the first messages, at the beginning."""
_BRAKING_TIMEOUT = 10.0
"""s; the longest braking at the end of a drive."""


class Simulation:
    """
    One robot or several in a world, ready to drive inside the ``with`` block, at time 0.

    Every method raises SimulationError, in one line, when the simulator reports an error or has
    ended.
    """

    def __init__(
        self,
        urdf: str | Path,
        controllers: str | Path | None = None,
        *,
        world: str | Path = 'empty',
        rtf: float = 0.0,
        activate: Sequence[str] | None = None,
        name: str = '',
        pose: Transform = _AT_ORIGIN,
        robots: Mapping[str, Transform] | None = None,
        parameters: Mapping[str, Any] | None = None,
        record: str | Path | None = None,
    ) -> None:
        """
        Describe the simulation; it is started by ``with``.

        Args:
            urdf: A URDF or xacro file, a ``package://`` URI, or the text itself.
            controllers: Parameter file of the controller manager; None: those that the URDF
                names, else that of this package, if it is for this robot.
            world: A shipped name or an MJCF file.
            rtf: Real-time factor, to watch the simulation; 0: as fast as possible. The results
                are the same.
            activate: The controllers to spawn, in order; None: all of the parameter file. One
                that cannot be, or claims what another one has claimed, is then left out or
                inactive, with a warning.
            name: Of the robot in the world; empty: that of the URDF, with _ for blanks and the
                like.
            pose: Transform from the robot's root link to the world. A robot that would be inside
                the ground is lifted until it is free.
            robots: Several robots instead of one: name → pose. Each is in the namespace of its
                name, which the parameter file has to cover (``/**/controller_manager: …``).
            parameters: Further parameters of ``mujoco_sim``.
            record: The folder of a bag to be made; see :meth:`record`.
        """
        if not (math.isfinite(rtf) and rtf >= 0.0):
            raise SimulationError(f'rtf is {rtf}; a real-time factor is 0 or above')
        self._urdf = str(urdf)
        self._activate = activate
        if name and robots is not None:
            raise SimulationError(f"name is '{name}', and robots have the names of robots")
        self._name = name
        self._poses: Mapping[str, Transform] = {'': pose} if robots is None else robots
        self._rtf = rtf
        self._record = record
        self._parameters: dict[str, Any] = {
            'world': _absolute(world),
            'paused': True,
            'real_time_factor': float(rtf),
            'controllers': str(path_of(str(controllers))) if controllers else '',
            'camera_renderer': 'rays',  # as exact, and the same, on any machine
            **(parameters or {}),
        }
        self._stack = ExitStack()
        self._lock_step: LockStep | None = None
        self._robots: dict[str, Robot] = {}
        own = self._parameters.get('record')
        self.recording = bags.Recording(self._set_record, lambda: self.is_alive, own)

    # --- beginning and end --------------------------------------------------------------------

    @without_frames
    def __enter__(self) -> Self:
        with ExitStack() as stack:
            self._description = self._read_description()
            # Before anything is started: what is wrong with it is told at once.
            self._robot_model = parse_urdf(self._description)
            self._is_controlled = bool(hardware_of(translate(self._robot_model).robot))
            self._files = self._parameter_files()
            given = str(self._parameters.get('bridge', ''))
            self._bridge = read_bridge(path_of(given)) if given else NO_BRIDGE
            self._domain = domain = stack.enter_context(own_domain())
            self._simulator = stack.enter_context(simulator(self._parameters))
            context = self._ros(stack, domain)
            self._lock_step = LockStep(self.node, self._simulator)
            self._running.connect()
            require_alone(domain, self._simulator.process.pid)
            self._readings = _node('simulation_readings', context)
            stack.callback(self._readings.destroy_node)
            for name, pose in self._poses.items():
                self._spawn(name, pose)
            self._begin()
            if self._record is not None:
                self.record(self._record)
            bags.begin(self.recording)
            self._stack = stack.pop_all()
        return self

    @without_frames
    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self._lock_step = None
        self._stack.__exit__(kind, error, traceback)

    def enter_domain(self) -> None:
        """
        Have processes and contexts that are started from now on be in its ROS domain.

        As at its start: another simulation that was started since has put them in its own.
        """
        os.environ[DOMAIN] = str(self._domain)

    @property
    def _running(self) -> LockStep:
        if self._lock_step is None:
            raise SimulationError(
                "a simulation runs inside its block: 'with Simulation(…) as sim:'"
            )
        return self._lock_step

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

    def _read_description(self) -> str:
        if self._urdf.lstrip().startswith('<'):
            return self._urdf
        return description_at(self._urdf, warn=lambda text: warnings.warn(text, stacklevel=6))

    def _parameter_files(self) -> list[Path]:
        """Return the parameter files that the simulator reads, by the same rule."""
        given = self._parameters['controllers']
        if given:
            return [Path(given)]
        return files_of(self._robot_model)

    def _spawn(self, name: str, pose: Transform) -> Robot:
        """``name``: of the entity and its namespace; empty: that of the URDF, no namespace."""
        lock_step, namespace = self._running, name
        name = spawn(lock_step, self._description, pose, name or self._name, namespace)
        topics = Topics()
        if self._is_controlled:
            topics = spawn_controllers(
                lock_step,
                self._robot_model,
                self._files,
                self._activate,
                namespace,
                self._bridge,
            )
        sensors = RobotReadings(
            lock_step,
            self._readings,
            name,
            bridged(translate(self._robot_model), self._bridge).sensors,
            namespace_of(self._robot_model, namespace),
        )
        self._robots[name] = Robot(lock_step, self._readings, name, namespace, topics, sensors)
        return self._robots[name]

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

    # --- robots -------------------------------------------------------------------------------

    @property
    def robots(self) -> Mapping[str, Robot]:
        """All robots, by name."""
        _ = self._running  # raises outside of the block
        return MappingProxyType(self._robots)

    @property
    def robot(self) -> Robot:
        """The robot, of a simulation that has one."""
        if len(self.robots) == 1:
            return next(iter(self._robots.values()))
        names = ', '.join(self._robots) or 'none'
        raise SimulationError(f'there is not one robot but: {names}; see robots')

    @property
    def name(self) -> str:
        """The name of the robot's entity."""
        return self.robot.name

    @without_frames
    def spawn(self, name: str, pose: Transform = _AT_ORIGIN) -> Robot:
        """
        Add a robot, in the namespace ``name``; no time passes.

        Discovery may take some milliseconds, so that the very first messages of a new name may be
        missed.
        """
        if name in self.robots or not name:
            raise SimulationError(
                f"a robot '{name}' cannot be added; another name will do (there are: "
                f'{", ".join(self._robots)})'
            )
        return self._spawn(name, pose)

    def remove(self, name: str) -> None:
        """Remove a robot, with its controller manager and its topics."""
        robot = self._find(name)
        self.ask(DeleteEntity, entity=name)
        self._running.forget(robot.namespace)
        robot.close()
        del self._robots[name]

    def _find(self, name: str) -> Robot:
        try:
            return self.robots[name]
        except KeyError:
            raise SimulationError(
                f"there is no robot '{name}'; there are: {', '.join(self._robots) or 'none'}"
            ) from None

    # --- time ---------------------------------------------------------------------------------

    @property
    def time(self) -> float:
        """Simulated time, s."""
        return self._running.time / NANOSECONDS

    def step(self, count: int = 1) -> None:
        """Make ``count`` physics steps; each lasts :attr:`timestep`."""
        if count < 0:
            raise SimulationError(f'{count} steps are asked; time goes on, and back by reset()')
        begin, start = self._running.time, wall.monotonic()
        while count > 0:
            steps = count
            if self._rtf:
                steps = min(
                    count, max(1, round(_PACING_PERIOD * NANOSECONDS / self._running.timestep))
                )
            self._running.step(steps)
            count -= steps
            self._running.time += steps * self._running.timestep
            if self._rtf:
                passed = (self._running.time - begin) / NANOSECONDS
                self._spin_until(start + passed / self._rtf)

    def run(self, seconds: float) -> None:
        """Let time pass, to the nearest physics step; the last commands stay until they expire."""
        self.step(self._steps_in(seconds))

    def drive(self, linear: float, angular: float, *, seconds: float, stop: bool = True) -> None:
        """
        Drive the robot, with ten commands a second of simulated time, then stop it.

        The distance lost by accelerating is made up by braking, so that the robot goes as far as
        the command says.

        Args:
            linear: m/s, forward.
            angular: rad/s, to the left.
            seconds: Duration of the command.
            stop: Then command rest until the robot stands, for ten seconds at most; False: the
                last command stays until the controller's timeout.
        """
        self.drive_all({self.robot.name: (linear, angular)}, seconds=seconds, stop=stop)

    def drive_all(
        self, commands: Mapping[str, tuple[float, float]], *, seconds: float, stop: bool = True
    ) -> None:
        """Drive several robots at once, as by :meth:`drive`: name → ``linear``, ``angular``."""
        robots = {self._find(name): twist for name, twist in commands.items()}
        self._command(robots, self._steps_in(seconds))
        end = self.time + _BRAKING_TIMEOUT
        while stop and self.time < end and any(robot.is_moving for robot in robots):
            self._command(dict.fromkeys(robots, (0.0, 0.0)), self._steps_in(_COMMAND_PERIOD))

    def _command(self, commands: Mapping[Robot, tuple[float, float]], count: int) -> None:
        """Command robots for ``count`` physics steps."""
        for robot in commands:
            if not robot.command_topic:
                raise SimulationError(
                    f"no controller that drives '{robot.name}' is active; send() commands others"
                )
        steps = max(1, self._steps_in(_COMMAND_PERIOD))
        while count > 0:
            self.send_all(
                {robot.command_topic: robot.twist(*twist) for robot, twist in commands.items()}
            )
            self.step(min(steps, count))
            count -= steps

    def send(self, topic: str, message: Any) -> None:
        """
        Send a message to a controller; it has arrived on return and acts from the next step on.

        A header without a stamp gets the simulated time.
        """
        self.send_all({topic: message})

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
        """
        Record from now on: all that the simulator publishes, and the commands that act.

        Nothing is lost, and the same calls give the same files, byte for byte. A reset begins a
        new file of the bag. It is complete after :meth:`end_recording`, or after the block. That
        of ``--ros-bag`` ends before.

        Args:
            folder: Of the bag, which must not be there.
        """
        self.recording.begin_own(Path(folder))

    def _set_record(self, folder: str) -> None:
        self._running.set_parameter('record', folder)

    def end_recording(self) -> None:
        """Complete the bag, if there is one; not that of ``--ros-bag``."""
        self.recording.end_own()

    def replay(self, bag: str | Path | RecordedRun) -> None:
        """
        Reset, and drive as recorded: each command of a bag at the simulated time of its record.

        The robots are to be those of the bag, with the same controllers active; then every bit
        is, too. :func:`amr_description.testing.replay.simulation_of` makes such a simulation.

        Args:
            bag: A recording of the simulator that begins at time 0; a folder or a file, or what
                :func:`~amr_description.testing.recorded_run.read_run` has read.

        Raises:
            BagError: It is none.
        """
        run = bag if isinstance(bag, RecordedRun) else read_run(Path(bag))
        self.reset()
        for instant in run.instants:
            self.step((instant.time - self._running.time) // self._running.timestep)
            for topic, message in instant.commands:
                self._running.send_all({topic: message}, as_they_are=True)
        self.step()  # so that controllers tick at the last instant

    def wait(self, condition: Condition, what: str, timeout: float | None = None) -> Any:
        """
        Spin ``node`` until a condition holds; return what it returned. No time passes.

        Args:
            condition: Called repeatedly; holds when its result is true.
            what: What is waited for, for the error.
            timeout: s of the wall clock; 30 by default.
        """
        return self._running.wait(condition, what, timeout)

    # --- what is read -------------------------------------------------------------------------

    @property
    def timestep(self) -> float:
        """A physics step, s."""
        return self._running.timestep / NANOSECONDS

    @property
    def truth(self) -> Motion:
        """How the robot's root link really moves in the world, at this instant."""
        return self.robot.truth

    @property
    def odometry(self) -> Motion:
        """The last odometry of the drive, with its own stamp (:attr:`Motion.time`)."""
        return self.robot.odometry

    @property
    def joints(self) -> dict[str, Joint]:
        """The last state of each joint, by name, from the JointStateBroadcaster."""
        return self.robot.joints

    @property
    def scan(self) -> Scan:
        """What the robot's lidar sees at this instant."""
        return self.robot.scan

    def scan_of(self, topic: str) -> Scan:
        """Return what the lidar with a topic sees at this instant, whatever its rate."""
        return self.robot.scan_of(topic)

    def image(self, topic: str = '') -> Image:
        """Return the colours that the camera, or that with a topic, sees at this instant."""
        return self.robot.image(topic)

    def depth(self, topic: str = '') -> Image:
        """Return the depths that the camera, or that with a topic, sees at this instant."""
        return self.robot.depth(topic)

    def points(self, topic: str = '') -> Points:
        """Return the cloud that the sensor, or that with a topic, sees at this instant."""
        return self.robot.points(topic)

    def contacts(self, topic: str = '') -> list[Contact]:
        """Return what touches the contact sensor, or that with a topic, at this instant."""
        return self.robot.contacts(topic)

    @property
    def log(self) -> str:
        """The output of the simulator so far."""
        return self._simulator.log

    @property
    def is_alive(self) -> bool:
        """Whether the simulator runs."""
        return not self._simulator.has_ended

    def _steps_in(self, seconds: float) -> int:
        if not (math.isfinite(seconds) and seconds >= 0.0):
            raise SimulationError(f'{seconds} s are asked; a finite time, not below 0, will do')
        return round(seconds * NANOSECONDS / self._running.timestep)

    def _spin_until(self, instant: float) -> None:
        """Spin the node until an instant of ``time.monotonic``, s."""
        while (delay := instant - wall.monotonic()) > 0.0:
            self.node.executor.spin_once(timeout_sec=delay)


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


def _absolute(world: str | Path) -> str:
    """Return a name as it is, and the absolute path of a Path, which is always a file."""
    return str(world.absolute()) if isinstance(world, Path) else world
