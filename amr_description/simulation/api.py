# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What a simulation and its robots can do, wherever they run: in this process, or over ROS.

::

    with Simulation('my_robot.urdf', 'controllers.yaml', world='ramp') as sim:
        sim.drive(0.5, 0.0, seconds=2)
        assert sim.truth.x == pytest.approx(1.0, rel=0.01)
        assert sim.odometry.x == pytest.approx(sim.truth.x, abs=0.02)

Time passes only in :meth:`SimulationApi.drive`, :meth:`SimulationApi.run` and
:meth:`SimulationApi.step`: the same calls give the same bits, in both.

Several robots, each in the namespace of its name::

    poses = {'robot1': Transform(), 'robot2': Transform((0.0, 2.0, 0.0))}
    with Simulation('my_robot.urdf', 'controllers.yaml', robots=poses) as sim:
        sim.drive_all({'robot1': (0.5, 0.2), 'robot2': (0.3, -0.3)}, seconds=2)
        assert sim.robots['robot2'].odometry.x == pytest.approx(0.5, abs=0.02)
"""

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from contextlib import ExitStack
import math
from pathlib import Path
import time as wall
from types import MappingProxyType, TracebackType
from typing import Any, Generic, Protocol, Self, TYPE_CHECKING, TypeVar
import warnings

from amr_description.clock import NANOSECONDS
from amr_description.errors import SimulationError
from amr_description.model.controller_files import files_of, manager_of
from amr_description.model.frames import Transform
from amr_description.model.gazebo.bridge import bridge_of
from amr_description.model.gazebo.translation import translate
from amr_description.model.robot import Robot as Description
from amr_description.model.ros2_control_tag import hardware_of
from amr_description.model.urdf import parse as parse_urdf
from amr_description.parameter_files import file_names, given_files
from amr_description.simulation.given import GivenDescription
from amr_description.simulation.readings import Contact, Image, Joint, Motion, Points, Scan
from amr_description.simulation.tracebacks import is_for_the_test, without_frames
from amr_description.text import did_you_mean

if TYPE_CHECKING:  # with what reads bags
    from amr_description.simulation.recorded_run import RecordedRun

__tracebackhide__ = is_for_the_test

AT_ORIGIN = Transform()
COMMAND_PERIOD = 0.1
"""s between two commands of a drive: well below the usual command timeout of 0.5 s."""
PACING_PERIOD = 0.02
"""s of simulated time between two readings of the wall clock, with a real-time factor."""
BRAKING_TIMEOUT = 10.0
"""s; the longest braking at the end of a drive."""
STILL = 1e-3
"""m/s and rad/s; a slower robot counts as standing."""


class SensorReadings(Protocol):
    """What the sensors of a robot see at the present instant, of a topic or the only one."""

    def scan(self, topic: str = '') -> Scan: ...
    def image(self, topic: str = '') -> Image: ...
    def depth(self, topic: str = '') -> Image: ...
    def points(self, topic: str = '') -> Points: ...
    def contacts(self, topic: str = '') -> list[Contact]: ...
    def close(self) -> None: ...


class RobotApi(ABC):
    """
    One robot of a simulation: its odometry, its joint states, its sensors, and the ground truth.

    Every method raises SimulationError, in one line, when the simulator refuses or has ended.
    """

    name: str
    """Of the entity."""
    namespace: str
    command_topic: str
    """Of the controller that drives, or of a plugin of Gazebo; empty: there is none."""
    _sensors: SensorReadings

    @abstractmethod
    def twist(self, linear: float, angular: float) -> Any:
        """Return a command, m/s and rad/s, for :attr:`command_topic`."""

    @property
    @abstractmethod
    def truth(self) -> Motion:
        """How the robot's root link really moves in the world, at this instant."""

    @property
    @abstractmethod
    def odometry(self) -> Motion:
        """The last odometry of the drive, with its own stamp (:attr:`Motion.time`)."""

    @property
    @abstractmethod
    def joints(self) -> dict[str, Joint]:
        """The last state of each joint, by name, from the JointStateBroadcaster."""

    @property
    def scan(self) -> Scan:
        """What the robot's lidar sees at this instant; see :meth:`scan_of`."""
        return self.scan_of('')

    def scan_of(self, topic: str) -> Scan:
        """Return what the lidar with a topic sees at this instant, whatever its rate."""
        return self._sensors.scan(topic)

    def image(self, topic: str = '') -> Image:
        """Return the colours that the camera, or that with a topic, sees at this instant."""
        return self._sensors.image(topic)

    def depth(self, topic: str = '') -> Image:
        """Return the depths that the camera, or that with a topic, sees at this instant."""
        return self._sensors.depth(topic)

    def points(self, topic: str = '') -> Points:
        """Return the cloud that the sensor, or that with a topic, sees at this instant."""
        return self._sensors.points(topic)

    def contacts(self, topic: str = '') -> list[Contact]:
        """Return what touches the contact sensor, or that with a topic, at this instant."""
        return self._sensors.contacts(topic)

    @property
    def is_moving(self) -> bool:
        """Whether it moves, by the ground truth."""
        truth = self.truth
        return math.hypot(*truth.linear) > STILL or math.hypot(*truth.angular) > STILL


RobotType = TypeVar('RobotType', bound=RobotApi)


class _Robots(dict[str, RobotType]):
    """Name → robot; a name that is not there is told those that are."""

    def __missing__(self, name: str) -> RobotType:
        """Raise SimulationError."""
        raise SimulationError(
            f"there is no robot '{name}'{did_you_mean(name, self)}; there are: "
            + (', '.join(self) or 'none')
        )


class SimulationApi(ABC, Generic[RobotType]):
    """
    One robot or several in a world, ready to drive inside the ``with`` block, at time 0.

    Every method raises SimulationError, in one line, when the simulator reports an error or has
    ended.
    """

    def __init__(
        self,
        urdf: str | Path,
        controllers: str | Path | Sequence[str | Path] | None = None,
        *,
        world: str | Path = 'empty',
        rtf: float = 0.0,
        activate: Sequence[str] | None = None,
        name: str = '',
        pose: Transform = AT_ORIGIN,
        robots: Mapping[str, Transform] | None = None,
        parameters: Mapping[str, Any] | None = None,
        record: str | Path | None = None,
        xacro_args: str | Mapping[str, Any] = '',
        fixed: bool = False,
    ) -> None:
        """
        Describe the simulation; it is started by ``with``, or by :meth:`start`.

        Args:
            urdf: A URDF or xacro file, a ``package://`` URI, or the text itself.
            controllers: Parameter file of the controller manager, or several; None: those that
                the URDF names, else that of this package, if it is for this robot.
            world: A shipped name or an MJCF file.
            rtf: Real-time factor, to watch the simulation; 0: as fast as possible. The results
                are the same.
            activate: The controllers to spawn, in order; None: all of the parameter file. One
                that cannot be, or claims what another one has claimed, is then left out or
                inactive, with a warning.
            name: Of the robot in the world; empty: that of the URDF, with _ for blanks.
            pose: Transform from the robot's root link to the world; in the ground it is lifted.
            robots: Several robots instead of one: name → pose. Each is in the namespace of its
                name, which the parameter file has to cover (``/**/controller_manager: …``).
            parameters: Further parameters of ``mujoco_sim``.
            record: The folder of a bag to be made; see :meth:`record`.
            xacro_args: Of a xacro file: ``{'dof': 7}``, or ``'dof:=7 hand:=true'``.
            fixed: Whether the root link is fixed to the world, as that of an arm.
        """
        if not (math.isfinite(rtf) and rtf >= 0.0):
            raise SimulationError(f'rtf is {rtf}; a real-time factor is 0 or above')
        self._given = GivenDescription(str(urdf), xacro_args, fixed)
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
            'controllers': ','.join(map(str, given_files(controllers))),
            'camera_renderer': 'rays',  # as exact, and the same, on any machine
            **(parameters or {}),
        }
        self._stack = ExitStack()
        self._is_running = False
        self._robots = _Robots[RobotType]()

    # --- beginning and end --------------------------------------------------------------------

    @without_frames
    def __enter__(self) -> Self:
        self.start()
        return self

    @without_frames
    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self._is_running = False
        self._stack.__exit__(kind, error, traceback)

    def start(self) -> None:
        """Start, as ``with`` does; :meth:`close` has to be called then."""
        if self._is_running:
            raise SimulationError('the simulation has been started already')
        with ExitStack() as stack:
            self._description = self._given.text(lambda text: warnings.warn(text, stacklevel=7))
            # Before anything is started: what is wrong with it is told at once.
            self._robot_model = parse_urdf(self._description)
            self._files = self._parameter_files()
            translated = translate(self._robot_model, self._files).robot
            self._is_controlled = bool(hardware_of(translated))
            self._bridge = bridge_of(str(self._parameters.get('bridge', '')))
            self._robots.clear()
            self._is_running = True
            stack.callback(self._stop)
            self._start(stack)
            for name, pose in self._poses.items():
                self._add(name, pose)
            self._begin()
            if self._record is not None:
                self.record(self._record)
            self._started()
            self._stack = stack.pop_all()

    def close(self) -> None:
        """End, as the end of the ``with`` block does."""
        self._stack.close()

    def _stop(self) -> None:
        self._is_running = False

    def _require_running(self) -> None:
        if not self._is_running:
            raise SimulationError(
                "a simulation runs inside its block: 'with Simulation(…) as sim:'"
            )

    def _parameter_files(self) -> list[Path]:
        """Return the parameter files that the simulator reads, by the same rule."""
        given = self._parameters['controllers']
        if given:
            return [Path(each) for each in file_names(given)]
        return files_of(self._robot_model)

    @abstractmethod
    def _start(self, stack: ExitStack) -> None:
        """Make the simulator, whose time stands at 0; ``stack``: has what ends it."""

    def _started(self) -> None:
        """Do what is left to do once all is there; if it fails, all ends."""

    @abstractmethod
    def _begin(self) -> None:
        """Do what is needed when the first robots are there; time is 0 then."""

    # --- robots -------------------------------------------------------------------------------

    @property
    def robots(self) -> Mapping[str, RobotType]:
        """All robots, by name."""
        self._require_running()
        return MappingProxyType(self._robots)

    @property
    def robot(self) -> RobotType:
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
    def spawn(self, name: str, pose: Transform = AT_ORIGIN) -> RobotType:
        """Add a robot, in the namespace ``name``; no time passes."""
        if name in self.robots or not name:
            raise SimulationError(
                f"a robot '{name}' cannot be added; another name will do (there are: "
                f'{", ".join(self._robots)})'
            )
        return self._add(name, pose)

    def remove(self, name: str) -> None:
        """Remove a robot, with its controller manager and its topics."""
        self._delete(self.robots[name])
        del self._robots[name]

    def _add(self, name: str, pose: Transform) -> RobotType:
        robot = self._insert(name, pose)
        self._robots[robot.name] = robot
        return robot

    @abstractmethod
    def _insert(self, name: str, pose: Transform) -> RobotType:
        """
        Spawn a robot, and its controllers.

        Args:
            name: Of the entity and its namespace; empty: those of the URDF.
            pose: Transform from the root link to the world.
        """

    @abstractmethod
    def _delete(self, robot: RobotType) -> None:
        """Remove a robot from the world."""

    # --- time ---------------------------------------------------------------------------------

    @property
    @abstractmethod
    def _time(self) -> int:
        """Simulated time, ns. Raises SimulationError outside of the block."""

    @property
    @abstractmethod
    def _timestep(self) -> int:
        """A physics step, ns."""

    @abstractmethod
    def _advance(self, count: int) -> None:
        """Make physics steps, as fast as possible."""

    @property
    def time(self) -> float:
        """Simulated time, s."""
        return self._time / NANOSECONDS

    @property
    def timestep(self) -> float:
        """A physics step, s."""
        return self._timestep / NANOSECONDS

    def step(self, count: int = 1) -> None:
        """Make ``count`` physics steps; each lasts :attr:`timestep`."""
        if count < 0:
            raise SimulationError(f'{count} steps are asked; time goes on, and back by reset()')
        if not self._rtf:
            self._advance(count)
            return
        begin, start = self._time, wall.monotonic()
        most = max(1, round(PACING_PERIOD * NANOSECONDS / self._timestep))
        while count > 0:
            steps = min(count, most)
            self._advance(steps)
            count -= steps
            passed = (self._time - begin) / NANOSECONDS
            self._wait_until(start + passed / self._rtf)

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
        robots = {self.robots[name]: twist for name, twist in commands.items()}
        self._command(robots, self._steps_in(seconds))
        end = self.time + BRAKING_TIMEOUT
        while stop and self.time < end and any(robot.is_moving for robot in robots):
            self._command(dict.fromkeys(robots, (0.0, 0.0)), self._steps_in(COMMAND_PERIOD))

    def _command(self, commands: Mapping[RobotType, tuple[float, float]], count: int) -> None:
        """Command robots for ``count`` physics steps."""
        for robot in commands:
            if not robot.command_topic:
                raise SimulationError(
                    f"no controller that drives '{robot.name}' is active; send() commands others"
                )
        steps = max(1, self._steps_in(COMMAND_PERIOD))
        while count > 0:
            self.send_all(
                {robot.command_topic: robot.twist(*twist) for robot, twist in commands.items()}
            )
            self.step(min(steps, count))
            count -= steps

    def _steps_in(self, seconds: float) -> int:
        if not (math.isfinite(seconds) and seconds >= 0.0):
            raise SimulationError(f'{seconds} s are asked; a finite time, not below 0, will do')
        return round(seconds * NANOSECONDS / self._timestep)

    def _wait_until(self, instant: float) -> None:
        """Wait until an instant of ``time.monotonic``, s."""
        wall.sleep(max(0.0, instant - wall.monotonic()))

    def send(self, topic: str, message: Any) -> None:
        """
        Send a message to a controller; it has arrived on return and acts from the next step on.

        A dict in the form of the message will do: ``{'twist': {'linear': {'x': 0.5}}}``. A header
        without a stamp gets the simulated time.
        """
        self.send_all({topic: message})

    @abstractmethod
    def send_all(self, messages: Mapping[str, Any]) -> None:
        """Send messages on several topics at the same instant, as by :meth:`send`."""

    @abstractmethod
    def reset(self) -> None:
        """Reset: time 0, robots where they were spawned, odometry at zero; takes a few ms."""

    # --- recordings ---------------------------------------------------------------------------

    @abstractmethod
    def record(self, folder: str | Path) -> None:
        """
        Record from now on: all that is published, and the commands that act.

        Nothing is lost, and the same calls give the same files, byte for byte. A reset begins a
        new file of the bag. It is complete after :meth:`end_recording`, or after the block.

        Args:
            folder: Of the bag, which must not be there.
        """

    @abstractmethod
    def end_recording(self) -> None:
        """Complete the bag, if there is one."""

    def replay(self, bag: 'str | Path | RecordedRun') -> None:
        """
        Reset, and drive as recorded: each command of a bag at the simulated time of its record.

        The robots are to be those of the bag, with the same controllers active; then every bit
        is, too. :func:`~amr_description.simulation.recorded_run.simulation_of` makes such a
        simulation. It does not matter which way the bag was recorded.

        Args:
            bag: A recording that begins at time 0; a folder or a file, or what
                :func:`~amr_description.simulation.recorded_run.read_run` has read.

        Raises:
            BagError: It is none.
        """
        run = self._read_run(bag) if isinstance(bag, str | Path) else bag
        self.reset()
        for instant in run.instants:
            self.step((instant.time - self._time) // self._timestep)
            for topic, message in instant.commands:
                self._repeat(topic, message)
        self.step()  # so that controllers tick at the last instant

    @abstractmethod
    def _read_run(self, bag: str | Path) -> 'RecordedRun':
        """Return the run of a bag. Raises BagError: it cannot be run again."""

    @abstractmethod
    def _repeat(self, topic: str, message: Any) -> None:
        """Send a recorded command as it is; a header without a stamp stays so."""

    # --- what is read -------------------------------------------------------------------------

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
    @abstractmethod
    def log(self) -> str:
        """The output of the simulator so far."""

    @property
    @abstractmethod
    def is_alive(self) -> bool:
        """Whether the simulator runs."""


def namespace_of(description: Description, namespace: str = '') -> str:
    """Return the namespace of a robot, absolute: that which is given, or what its URDF says."""
    return f'/{namespace.strip("/")}' if namespace else manager_of(description)[0]


def _absolute(world: str | Path) -> str:
    """Return a name as it is, and the absolute path of a Path, which is always a file."""
    return str(world.absolute()) if isinstance(world, Path) else world
