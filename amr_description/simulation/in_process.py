# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The simulation in this process: the same physics, hardware, controllers and sensors, and no ROS.

No other process, and no thread but that of the page, if it is shown: time passes in the calls that
let it pass. What can be done with
it is said in :mod:`amr_description.simulation.api`; ``amr_description.testing`` does the same over
DDS, with the same bits.

A command is a sample, as controllers use them (:mod:`amr_description.control.samples`), or a dict
in the form of the message::

    sim.send('/diff_drive_controller/cmd_vel', TwistSample(0, linear=0.5, angular=0.0))
    sim.send('/diff_drive_controller/cmd_vel', {'twist': {'linear': {'x': 0.5}}})
"""

from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager, ExitStack
from dataclasses import replace
from functools import partial
import math
from pathlib import Path
from typing import Any, TYPE_CHECKING

from amr_description.control.contracts import Action, Goal, Input, Service
from amr_description.control.controller_manager import ControllerManager
from amr_description.control.loop import Pacer, Publisher, Stepper
from amr_description.controller_manager.requests import run_at_once
from amr_description.errors import SimulationError
from amr_description.log import Severity
from amr_description.model.controller_files import declared_controllers
from amr_description.model.frames import Transform, Vector
from amr_description.model.gazebo.builder import GazeboTranslation
from amr_description.parameters import build
from amr_description.plugin_errors import describe
from amr_description.sim.world import MujocoWorld
from amr_description.simulation.alterations import Alterations
from amr_description.simulation.api import SimulationApi
from amr_description.simulation.engine import SimulationEngine, Spawned
from amr_description.simulation.local_manager import LocalHost, LocalManager, LogLines
from amr_description.simulation.parameters import SimulationParameters
from amr_description.simulation.playing import play, Playing
from amr_description.simulation.plugin_controllers import start_controllers
from amr_description.simulation.published import Published
from amr_description.simulation.readings import Image
from amr_description.simulation.robot import Robot
from amr_description.simulation.sensors import Instruments, RobotSensors
from amr_description.simulation.spawned_controllers import spawn_declared, Topics, topics_of
from amr_description.simulation.topics.link_transforms import SpawnedRobot
from amr_description.simulation.tracebacks import is_for_the_test

if TYPE_CHECKING:  # most simulations neither drive a bag again nor serve the page
    from amr_description.messages.commands import PlainCommand
    from amr_description.simulation.recorded_run import RecordedRun
    from amr_description.simulation.shown import ShownPage

__tracebackhide__ = is_for_the_test

_NODE = '/mujoco_sim'
MAX_SIDE = 8192
"""Pixels, of a picture."""
PLOTTED = 20.0
"""Hz, at which a plot has points."""
NO_FIELDS: Mapping[str, Any] = {}
_TAKES = {Input: 'subscribes to', Service: 'has the service', Action: 'has the action'}


class Simulation(SimulationApi[Robot]):
    """See :class:`~amr_description.simulation.api.SimulationApi`, and the module."""

    # --- beginning and end --------------------------------------------------------------------

    def _start(self, stack: ExitStack) -> None:
        self._lines = LogLines()
        self._log = self._lines.log_of(_NODE)
        settings = replace(build(SimulationParameters, self._parameters), paused=True)
        self._engine = SimulationEngine(
            settings,
            self._log,
            _Calls(),
            lambda world: self._ports(world, settings),
            remedy='run() and step() let time go on, reset() begins anew',
        )
        self._loop, self.world = self._engine.loop, self._engine.world
        """The physics; for the model and the state of MuJoCo."""
        self._published.loop = self._loop
        observers = self._published.publisher.observers
        self.altered = Alterations(self.world, self._loop, self._manager_of, observers, self._log)
        """What a test changes, until the next reset."""
        self._instruments = Instruments(self.world, settings.camera_renderer, self._log)
        self._playing = Playing(self._rtf or 1.0)
        self._page: ShownPage | None = None
        stack.callback(self._end)

    def _ports(
        self, world: MujocoWorld, settings: SimulationParameters
    ) -> tuple[Stepper, Pacer, Publisher]:
        self._published = Published(world, self._log, settings)
        return world, _NeverPaced(), self._published.publisher

    def _begin(self) -> None:
        """Every robot is there, at time 0."""

    def _end(self) -> None:
        """Stop the motors; hardware and controllers of others may have what has to be closed."""
        with ExitStack() as ending:  # whatever one raises, the next one has to be stopped too
            ending.callback(self._instruments.close)
            ending.callback(self._close_page)
            for manager in reversed(self._loop.managers):
                ending.callback(manager.shut_down, self._loop.time)
            ending.callback(self._published.close)  # first: their end is not part of the run

    # --- robots -------------------------------------------------------------------------------

    def _insert(self, name: str, pose: Transform) -> Robot:
        try:
            return self._spawn(name, name or self._name, pose)
        except Exception as error:
            self._log(Severity.ERROR, describe(error))
            raise

    def _spawn(self, namespace: str, name: str, pose: Transform) -> Robot:
        """``name``: of the entity; empty: that of the URDF."""
        self.altered.model.require_none()
        engine, log = self._engine, self._log
        robot = engine.read(self._description, name or 'robot_description', namespace)
        host = LocalHost(self._lines, lambda: self.world.time, self._published.publisher)
        spawned: Spawned[LocalManager] = run_at_once(
            engine.spawn(host, name, robot, pose, namespace)
        )
        given, translation, inside = spawned.name, spawned.translation, spawned.namespace
        manager, topics = None, Topics()
        if spawned.running is not None:
            manager, _ = spawned.running
            try:
                topics = self._start_controllers(manager, translation)
            except BaseException:
                engine.remove(given)
                manager.destroy()
                raise
        log(Severity.INFO, f"Spawned '{given}'")
        view = self.world.robot(given)
        sensors = RobotSensors(
            self._instruments, view, translation.sensors, inside, self.altered.scans
        )
        known = SpawnedRobot(given, inside, robot, pose)
        self._published.add(known, translation.sensors)
        return Robot(view, known, namespace, manager, topics, sensors)

    def _manager_of(self, robot: str) -> ControllerManager | None:
        """Return that of a robot, by the name of its entity; None: it has none."""
        (found,) = [each.manager for each in self._robots.values() if each.name == robot]
        return found.requests.manager if found else None

    def _start_controllers(self, manager: LocalManager, translation: GazeboTranslation) -> Topics:
        """Start what stands for plugins, then the controllers; return the topics of all."""
        plugins, inside = translation.controllers, manager.namespace
        run_at_once(start_controllers(manager.requests, plugins, inside, self._log))
        name = manager.name.rpartition('/')[2]
        declared = declared_controllers(self._files, inside, name)
        log = self._lines.log_of('/spawner')
        spawn_declared(log, manager, declared, self._activate)
        served = manager.served
        return topics_of(
            manager,
            lambda controller, kind: next(served[controller].subscribed(kind), ''),
            lambda controller, kind: next(served[controller].published(kind), ''),
            translation,
            inside,
        )

    def _delete(self, robot: Robot) -> None:
        self.altered.model.require_none()
        robot.close()
        self._published.remove(robot.name)
        self._engine.remove(robot.name)
        if robot.manager is not None:
            robot.manager.destroy()

    # --- time ---------------------------------------------------------------------------------

    @property
    def _time(self) -> int:
        self._require_running()
        return self.world.time

    @property
    def _timestep(self) -> int:
        self._require_running()
        return self.world.timestep

    def _advance(self, count: int) -> None:
        self._require_running()
        try:
            missing = self._loop.step_through(count * self.world.timestep)
        except BaseException:  # Ctrl-C; what comes next begins a step of its own
            self._loop.pause()
            raise
        if missing:
            raise SimulationError(
                f'{self._engine.missing_steps(missing)} of {count} steps were not made: the '
                'simulation was played, paused, reset or ended meanwhile'
            )
        self._serve()

    def reset(self, *, seed: int | None = None) -> None:
        """
        Reset: time 0, robots where they were spawned, odometry at zero, nothing altered.

        Args:
            seed: Of the noise of all sensors from now on, 0 or above; None: the same again.
        """
        self._require_running()
        if seed is not None:
            self.world.seed = seed
        self.world.faults.release()  # first: what is frozen has changed the model, too
        self.altered.undo()
        self._published.restart()
        self._engine.reset()
        for robot in self._robots.values():
            robot.forget()
        self._serve()

    def play(self, seconds: float = math.inf) -> None:
        """
        Let time pass as the wall clock goes, until Ctrl-C; pages drive the robots meanwhile.

        Args:
            seconds: Of the wall clock, after which it ends by itself.
        """
        self._require_running()
        playing = self._playing
        play(playing, self._advance, self.timestep, self._attend, seconds)

    def _serve(self) -> None:
        if self._page is not None:
            self._page.serve()

    def _attend(self) -> None:
        if self._page is not None:
            self._page.attend()

    # --- topics, services, actions, frames -----------------------------------------------------

    def send_all(self, messages: Mapping[str, Any]) -> None:
        """
        Send on several topics at the same instant, as by :meth:`send`.

        A message is a sample, or a dict in the form of the message.
        """
        from amr_description.messages.commands import command_of  # with samples of all kinds

        time = self.world.time
        made = {  # before any is sent, and whatever becomes of the messages meanwhile
            topic: [
                (each, command_of(each.port, message, time))
                for each in self._ports_of(Input, topic)
            ]
            for topic, message in messages.items()
        }
        for topic, commands in made.items():
            self.altered.send(partial(self._put, topic, commands))

    def _repeat(self, topic: str, message: Any) -> None:
        from amr_description.messages.commands import recorded_command

        inputs = self._ports_of(Input, topic)
        self._put(topic, [(each, recorded_command(each.port, message)) for each in inputs])

    def call(self, service: str, request: Any = NO_FIELDS) -> Any:
        """
        Call a service of a controller; return its response, a sample. No time passes.

        Args:
            service: Its name.
            request: A sample, or a dict in the form of the request.

        Raises:
            SimulationError: No controller has it, or its controller cannot answer.
            AmrError: A value of the request does not fit.
        """
        (port, *_), sample = self._asked(Service, service, 'request', request)
        try:
            return port.answer(sample)
        except Exception as error:  # a third party's
            reason = f"Could not answer '{service}': {describe(error)}"
            self._log(Severity.ERROR, reason)
            raise SimulationError(reason) from error

    def send_goal(self, action: str, goal: Any = NO_FIELDS) -> Goal[Any, Any, Any]:
        """
        Send a goal to an action of a controller, which follows it while time passes.

        Args:
            action: Its name.
            goal: A sample, or a dict in the form of the goal.

        Returns:
            The accepted goal: ``is_live`` until ``outcome`` has its status and result;
            ``feedback`` is the newest. ``is_cancel_requested = True`` asks for its end.

        Raises:
            SimulationError: No controller has it, or its controller rejects the goal.
            AmrError: A value of the goal does not fit.
        """
        (port, *_), sample = self._asked(Action, action, 'goal', goal)
        try:
            reason = port.refusal(sample, self.world.time)
        except Exception as error:  # a third party's
            reason = f"Cannot accept a goal of '{action}': {describe(error)}"
        if reason:
            self._log(Severity.ERROR, reason)
            raise SimulationError(f"the goal for '{action}' is rejected: {reason}")
        accepted: Goal[Any, Any, Any] = Goal(sample)
        port.put(accepted)
        return accepted

    def _asked(self, kind: type, name: str, part: str, message: Any) -> tuple[list[Any], Any]:
        """Return the ports of a service or action, and the sample that one of them is asked."""
        from amr_description.messages.commands import command_of  # with samples of all kinds
        from amr_description.messages.readers import part_of

        ports = self._ports_of(kind, name)
        return ports, command_of(part_of(ports[0].port, part), message, self.world.time).sample

    def transform(self, target: str, source: str) -> Transform:
        """Return the pose of a frame in another one; see :meth:`Robot.transform`."""
        return self.robot.transform(target, source)

    def _ports_of(self, kind: type, name: str) -> list[Any]:
        """Return the ports of a name, one at least. Raises SimulationError."""
        self._require_running()
        full = name if name.startswith('/') else f'/{name}'
        robots = self._robots.values()
        found = [port for robot in robots for port in robot.ports(kind, full)]
        if not found:
            known = ', '.join(each for robot in robots for each in robot.names_of(kind))
            raise SimulationError(
                f"no controller {_TAKES[kind]} '{full}'; there are: {known or 'none'}"
            )
        return found

    def _put(self, topic: str, commands: Iterable[tuple[Input[Any], 'PlainCommand']]) -> None:
        """Send a command to each input of a topic."""
        time, taken = self.world.time, False
        reasons: list[str] = []
        for each, command in commands:
            reason = each.check(command.sample, time) if each.check else ''
            if reason:
                reasons.append(reason)
            elif each.put(command.sample, command.serialized() if each.on_drain else b''):
                taken = True
        if not taken:
            raise SimulationError(
                f"no controller takes what is sent on '{topic}'; "
                f'{"; ".join(reasons) or "is its controller active?"}'
            )

    # --- pictures ------------------------------------------------------------------------------

    def picture(
        self,
        position: Vector | None = None,
        target: Vector | None = None,
        *,
        width: int = 640,
        height: int = 480,
    ) -> Image:
        """
        Return a picture of the world at this instant; a notebook shows it, ``save`` writes it.

        It needs no display, no OpenGL and no camera on a robot.

        Args:
            position: Of the camera in the world, m; None: such that all robots are in the picture.
            target: What it looks at, m; None: the middle of the robots.
            width: Pixels.
            height: Pixels.
        """
        self._require_running()
        if not (1 <= width <= MAX_SIDE and 1 <= height <= MAX_SIDE):
            raise SimulationError(
                f'a picture of {width} x {height} pixels; each side has 1 to {MAX_SIDE}'
            )
        return self._instruments.measuring.picture(position, target, width, height)

    @contextmanager
    def film(
        self,
        path: str | Path,
        position: Vector | None = None,
        target: Vector | None = None,
        *,
        rate: float = 10.0,
        width: int = 320,
        height: int = 240,
    ) -> Iterator[None]:
        """
        Film what happens in a ``with`` block; the file is written at its end.

        Args:
            path: Of the file: ``.webp`` and ``.gif`` need Pillow, ``.mp4`` needs ffmpeg.
            position: As of :meth:`picture`, as all that follows.
            target: What the camera looks at, m.
            rate: Pictures per s of simulated time.
            width: Pixels.
            height: Pixels.

        Raises:
            SimulationError: What it needs is not there, or it cannot be written.
        """
        from amr_description.simulation.films import Film, observed  # for who films

        self._require_running()
        film = Film(Path(path), rate)

        def shoot() -> None:
            film.add(self.picture(position, target, width=width, height=height))

        with observed(self._published.publisher.observers, rate, shoot):
            yield
        film.write()

    @contextmanager
    def plot(self, path: str | Path) -> Iterator[None]:
        """
        Draw where the robots drive in a ``with`` block: in truth, and by their odometry.

        Args:
            path: Of the file: ``.png``, ``.svg`` or what else matplotlib writes, which it needs.

        Raises:
            SimulationError: It is not there, or the file cannot be written.
        """
        from amr_description.simulation.films import observed, Plot

        self._require_running()
        plot = Plot(Path(path))

        def note() -> None:
            for robot in self._robots.values():
                places = {f'{robot.name}, truth': robot.truth}
                if robot.has_odometry:
                    places[f'{robot.name}, odometry'] = robot.odometry
                plot.add({name: (each.x, each.y) for name, each in places.items()})

        with observed(self._published.publisher.observers, PLOTTED, note):
            yield
        plot.write()

    def show(self, *, port: int = 8080, token: bool = False, wait: bool = False) -> 'ShownPage':
        """
        Serve the page of the viewer on this host, and return it; a notebook shows it.

        It shows what the program does. While the program is in :meth:`play` it drives, too.

        Args:
            port: To listen on, or the next one that is free; 0: any.
            token: Make a token part of the address: not every user of this host may open it.
            wait: Say where the page is, and :meth:`play`.
        """
        self._require_running()
        if self._page is None:
            try:
                from amr_description.simulation.shown import ShownPage
            except ModuleNotFoundError as error:
                if (error.name or '').partition('.')[0] != 'websockets':
                    raise
                raise SimulationError(
                    'show() serves a page, and needs websockets: python -m pip install websockets'
                ) from error
            observers = self._published.publisher.observers
            self._page = ShownPage(
                self, self._engine, self._playing, observers, port=port, token=token
            )
        else:
            self._page.refresh()
        if wait:
            print(f'The page is at {self._page.url}; Ctrl-C ends it', flush=True)
            self.play()
        return self._page

    def _close_page(self) -> None:
        if self._page is not None:
            self._page.close()
            self._page = None

    # --- recordings, log ----------------------------------------------------------------------

    def record(self, folder: str | Path) -> None:
        """Record from now on; see the base class."""
        self._require_running()
        self._published.record(folder)

    def end_recording(self) -> None:
        """Complete the bag, if there is one."""
        self._published.end_recording()

    def _read_run(self, bag: str | Path) -> 'RecordedRun':
        from amr_description.simulation.recorded_run import read_run  # with what reads bags

        return read_run(bag)

    @property
    def log(self) -> str:
        """What simulator, managers and controllers have logged; also in :mod:`logging`."""
        self._require_running()
        return ''.join(f'{line}\n' for line in self._lines)

    @property
    def is_alive(self) -> bool:
        """Whether it runs."""
        return self._is_running


class _NeverPaced:
    """A pacer that waits for no clock."""

    def pace(self, time: int) -> bool:
        """Go on."""
        return True

    def resume(self, time: int) -> None:
        """Go on."""


class _Calls:
    """Calls between two cycles, of this same thread."""

    def __init__(self) -> None:
        self._calls: list[Callable[[], None]] = []

    def put(self, call: Callable[[], None]) -> None:
        """Have a call made before the next cycle."""
        self._calls.append(call)

    def take(self) -> Iterable[Callable[[], None]]:
        """Return the queued calls, oldest first."""
        if not self._calls:
            return ()
        calls, self._calls = self._calls, []
        return calls

    def wait(self) -> object:
        """Return: nobody else could put a call."""
        return None
