# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The page of a simulation in this process: served beside it, and given what it shows between steps.

:meth:`ShownPage.serve` and what it calls are for the thread of the simulation.
"""

from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
import html
import logging
import math
import secrets
import time as wall

from amr_description.clock import NANOSECONDS
from amr_description.control.contracts import Input
from amr_description.control.samples import FlagSample
from amr_description.controllers.drives.wheeled_drive import EMERGENCY_STOP
from amr_description.errors import SimulationError
from amr_description.model.frames import Vector
from amr_description.sim.world import MujocoWorld
from amr_description.sim.wrenches import WorldWrench
from amr_description.simulation.api import SimulationApi
from amr_description.simulation.engine import SimulationEngine
from amr_description.simulation.page_backend import PageBackend, SIMULATOR
from amr_description.simulation.playing import Playing
from amr_description.simulation.robot import Robot
from amr_description.simulation.shown_scene import Scene, shown_robot, ShownRobot, world_of
from amr_description.viewer.access import Proxies
from amr_description.viewer.backend import Hold
from amr_description.viewer.protocol import ServerMessage, SimulationStatus, TimeReset, World
from amr_description.viewer.real_time import RealTimeFactor
from amr_description.viewer.server import Server, ServerSettings

_STILL_LINEAR, _STILL_ANGULAR = 0.01, 0.03
"""m/s and rad/s; a slower robot counts as standing."""
_STATUS_PERIOD = 0.25
_LOCK_PERIOD = 0.1
_SENSOR_PERIOD = 0.1
"""s of the wall clock between two samples of a sensor."""
_STATE_PERIOD = 1 / 60
"""s of the wall clock between two states while the program plays."""
_MOST_STEPS = 1000
_FLAGS = {False: b'\0\1\0\0\0', True: b'\0\1\0\0\1'}
"""std_msgs/msg/Bool, for a recording."""
LOCAL_PAGES = ('http://localhost:*', 'http://127.0.0.1:*')
"""In which the page may be a frame: notebooks on this host."""


class ShownPage:
    """The page of a simulation; a notebook shows it."""

    def __init__(
        self,
        simulation: SimulationApi[Robot],
        engine: SimulationEngine,
        playing: Playing,
        observers: list[Callable[[int], None]],
        *,
        port: int,
        token: bool,
    ) -> None:
        """
        Serve the page on the loopback.

        Args:
            simulation: That is shown.
            engine: Of it.
            playing: How time passes.
            observers: Of ends of cycles, at each of which STOP acts.
            port: To listen on, or the next one that is free; 0: any.
            token: Make a token part of the address: of the users of this host, only who has it
                may open the page.

        Raises:
            ViewerError: No port is free.
        """
        self._simulation, self._engine, self._playing = simulation, engine, playing
        self._backend = PageBackend(self)
        self._scene = Scene({}, -1)
        self._scenes = 0
        self._shown: tuple[list[Robot], str] = ([], '')
        """Of which robots, and in which world, the scene is."""
        self._world: World | None = None
        """The static shapes of that world."""
        self._speed = RealTimeFactor()
        self._time = 0
        self._told: tuple[str, float | None] = ('', None)
        """State and factor of the last status."""
        self._state_due = self._status_due = self._lock_due = 0.0
        self._sensor_due: dict[str, float] = {}
        self._locked: frozenset[str] = frozenset()
        settings = ServerSettings(
            port=port,
            token=secrets.token_urlsafe(18),
            always_token=token,
            proxies=Proxies(ancestors=LOCAL_PAGES),
        )
        log = logging.getLogger('amr_description.page')
        self._server = self._backend.server = Server(settings, self._backend, log.error)
        self.url = self._server.url
        """The address of the page, with its token if it has one."""
        self.refresh()
        self._server.start(is_daemon=True)  # a program may end without close()
        self._observers = observers
        observers.append(self._hold)

    def __repr__(self) -> str:
        return f'<the page is at {self.url}>'

    def _repr_html_(self) -> str:
        """Return the page in a frame, for a notebook."""
        self.refresh()
        address = html.escape(self.url)
        return f'<iframe src="{address}" width="100%" height="600" style="border: 0"></iframe>'

    def close(self) -> None:
        """End the server."""
        self._observers.remove(self._hold)
        self._server.stop()

    def refresh(self) -> None:
        """Show where everything is now, to a page that is opened while no time passes."""
        self._show(wall.monotonic())

    # --- between two steps --------------------------------------------------------------------

    def attend(self) -> None:
        """Do what pages have asked; once the program plays no more, they are told so."""
        calls = self._backend.calls
        while not calls.empty():
            calls.get_nowait()()
        self.serve()

    def serve(self) -> None:
        """Show pages what is new."""
        self._hold()
        if self._backend.has_pages:
            self._show(wall.monotonic())

    def _show(self, now: float) -> None:
        """Show where everything is: after each call of the program, at a rate while it plays."""
        if self._playing.is_on and now < self._state_due:
            return
        self._state_due = now + _STATE_PERIOD
        time = self._engine.loop.time
        messages: list[ServerMessage] = []
        if time < self._time:
            self._speed.clear()
            messages.append(TimeReset(time / NANOSECONDS))
        self._time = time
        self._speed.take(now, time)
        self._show_scene()
        status = self._status(time)
        told, self._told = self._told, (status.state, status.factor)
        if now >= self._status_due or messages or told != self._told:
            self._status_due = now + _STATUS_PERIOD
            messages.append(status)
        holds = {name: self._hold_of(each) for name, each in self._scene.robots.items()}
        self._backend.show_state(self._scene.state(time), messages, holds)
        for topic in self._backend.watched.sensors:
            if now >= self._sensor_due.get(topic, 0.0):
                self._sensor_due[topic] = now + _SENSOR_PERIOD
                if (sample := self._scene.sample(topic)) is not None:
                    self._backend.show_sample(sample)

    def _show_scene(self) -> None:
        """Show what there is, if that has changed."""
        robots, world = [*self._simulation.robots.values()], self._engine.world_name
        if (robots, world) == self._shown and self._scene.is_complete:
            return
        known = {each.robot: each for each in self._scene.robots.values()}
        views = self._engine.world
        made = [known.get(each) or shown_robot(each, views.robot(each.name)) for each in robots]
        self._scene = Scene({each.id: each for each in made}, self._scenes)
        self._scenes += 1
        if self._world is None or world != self._shown[1]:
            empty = MujocoWorld(world, settings=self._engine.settings.physics).engine
            self._world = world_of(empty, SIMULATOR)
        graph = self._scene.graph(SIMULATOR, world)
        described = {name: each.described for name, each in self._scene.robots.items()}
        self._backend.show_scene(graph, self._world, described, self._scene.layout)
        self._shown = robots, world

    def _status(self, time: int) -> SimulationStatus:
        playing = self._playing
        return SimulationStatus(
            SIMULATOR,
            'playing' if playing.is_on and not playing.is_paused else 'paused',
            time / NANOSECONDS,
            playing.factor,
            self._speed.value,
        )

    # --- STOP ---------------------------------------------------------------------------------

    def _hold(self, _time: int = 0) -> None:
        """Hold the robots that STOP holds, and release those that it does not hold any more."""
        held = self._backend.held
        if held == self._locked and not held:
            return
        now = wall.monotonic()
        if held == self._locked and now < self._lock_due:
            return
        self._lock_due = now + _LOCK_PERIOD
        for name in held | self._locked:
            if (each := self._scene.robots.get(name)) is None:
                continue
            locks = [*each.robot.ports(Input, _lock_topic(name))]
            for lock in locks:
                lock.put(FlagSample(name in held), _FLAGS[name in held])
            if name in held and not locks and each.robot.command_topic:
                with suppress(SimulationError):  # no controller takes it, so that none drives
                    self.drive(name, 0.0, 0.0, 0.0)
        self._locked = held

    def _hold_of(self, each: ShownRobot) -> Hold:
        truth = each.robot.truth
        linear = math.hypot(*truth.linear) / _STILL_LINEAR
        motion = max(linear, math.hypot(*truth.angular) / _STILL_ANGULAR)
        return Hold(motion, any(each.robot.ports(Input, _lock_topic(each.id))), (), ())

    # --- what pages do ------------------------------------------------------------------------

    @property
    def is_playing(self) -> bool:
        """Whether pages may do anything: the program is in ``sim.play()``; for any thread."""
        return self._playing.is_on

    def drive(self, robot: str, linear: float, angular: float, sideways: float) -> None:
        """Command a robot, m/s, rad/s and m/s to the left. Raises SimulationError."""
        each = self._scene.robots.get(robot)
        if each is None:
            raise SimulationError(f'{robot} has just gone')
        command = replace(each.robot.twist(linear, angular), lateral=sideways)
        self._simulation.send(each.robot.command_topic, command)
        each.command = (linear, angular, sideways)

    def push(self, entity: str, link: str, force: Vector, torque: Vector) -> None:
        """Push a link, N and N m in the axes of the world. Raises SimulationError."""
        self._engine.world.wrenches.hold(entity, link, WorldWrench(force, torque))

    def play(self, *, paused: bool) -> str:
        """Pause, or go on."""
        self._playing.is_paused = paused
        return 'paused' if paused else 'playing'

    def step(self, steps: int) -> str:
        """Make physics steps while it is paused. Raises SimulationError."""
        if not self._playing.is_paused:
            raise SimulationError('time is running; it is stepped while it is paused')
        if not 1 <= steps <= _MOST_STEPS:
            raise SimulationError(f'{steps} steps are asked; 1 to {_MOST_STEPS} will do')
        self._simulation.step(steps)
        return f'{steps} steps made'

    def reset(self) -> str:
        """Reset the simulation."""
        self._simulation.reset()
        return 'reset'

    def set_factor(self, factor: float) -> str:
        """Have time pass faster or slower. Raises SimulationError."""
        self._playing.set_factor(factor)
        return f'the real-time factor is {factor:g}'


def _lock_topic(robot: str) -> str:
    return f'{robot.rstrip("/")}/{EMERGENCY_STOP}'
