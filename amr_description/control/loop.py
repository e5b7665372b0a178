# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The owner's loop: the one thread that steps the world and ticks the managers.

It sees the outside through ports: a stepper (a simulated world, or nothing), a pacer (the wall
clock, or nothing), a queue of commands from other threads, and a publisher. With a stepper that
is the wall clock itself, this same loop drives a real robot.

One turn, at simulated time t::

    drain the queue            # spawn, switch, pause, reset …; while paused: wait on it
    set the clocks to t
    tick the managers due at t # read, update, write
    publish /clock, then what the controllers said at t
    step the world to the next instant at which something is due
    pace                       # what the queue brings meanwhile is done at once

While paused a stretch of time can be asked for (:meth:`Loop.step`): the same turns, not paced,
and the last one ends where the stretch does.
"""

from collections.abc import Callable, Iterable
from typing import NamedTuple, Protocol

from amr_description.control.controller_manager import ControllerManager
from amr_description.errors import SimulationError


class Stepper(Protocol):
    """The world that is advanced."""

    @property
    def time(self) -> int:
        """Present time, ns."""

    def advance(self, period: int) -> None:
        """Advance by ``period`` (ns), as nearly as its steps allow."""


class Pacer(Protocol):
    """Whatever holds the loop back."""

    def pace(self, time: int) -> bool:
        """
        Wait until the instant ``time`` (ns) is due, not at all when it is over; return True.

        False: it is not due yet, but a command has come.
        """

    def resume(self, time: int) -> None:
        """Time begins, or goes on after a pause or a jump, at ``time`` (ns)."""


class Commands(Protocol):
    """Calls that other threads ask the owner to make; a call never raises."""

    def take(self) -> Iterable[Callable[[], None]]:
        """Return those that wait, oldest first."""

    def wait(self) -> None:
        """Block until there is one, or until the clock should be heard again."""


class Publisher(Protocol):
    """What goes out of a turn."""

    def set_clocks(self, time: int) -> None:
        """Set the clocks of the nodes in this process to ``time``, ns."""

    def publish(self, time: int) -> None:
        """Publish ``/clock``, and then what was sent since the last call."""


class StepRequest(NamedTuple):
    """Time that passes while paused."""

    end: int
    """ns."""
    done: Callable[[int], None]


class Loop:
    """
    See the module. ``managers`` is a list, one entry a robot; only commands may change it.

    ``clock_period``: ns, the longest time between two turns and so between two ``/clock``.
    """

    def __init__(
        self,
        stepper: Stepper,
        pacer: Pacer,
        commands: Commands,
        publisher: Publisher,
        clock_period: int,
    ) -> None:
        self._stepper = stepper
        self._pacer = pacer
        self._commands = commands
        self._publisher = publisher
        self._clock_period = clock_period
        self._is_stopped = False
        self._is_running = True
        self._stretch: StepRequest | None = None
        self.managers: list[ControllerManager] = []

    @property
    def time(self) -> int:
        """Present time, ns."""
        return self._stepper.time

    @property
    def is_running(self) -> bool:
        """False while paused, also during a :meth:`step`."""
        return self._is_running

    @property
    def is_stepping(self) -> bool:
        """True while a stretch of time passes that was asked for."""
        return self._stretch is not None

    def run(self) -> None:
        """Turn until :meth:`stop`."""
        self._pacer.resume(self.time)
        while not self._is_stopped:
            self.run_once()

    def run_once(self) -> None:
        """Do one turn; while paused, only what the queue asks."""
        self._run_calls()
        if self._is_stopped:
            return
        if self._stretch is not None:
            self._step(self._stretch)
            return
        if not self._is_running:
            self._show_time()
            self._commands.wait()
            return
        self.tick()
        self._stepper.advance(self._time_to_next_tick(self.time))
        # In slow motion the next instant may be far off; nobody has to wait for it to be heard.
        while not self._pacer.pace(self.time):
            self._run_calls()
            if self._is_stopped or not self._is_running:
                return

    def tick(self) -> None:
        """Tick the managers due now, and publish."""
        time = self.time
        self._publisher.set_clocks(time)
        for manager in self.managers:
            if manager.is_due(time):
                manager.tick(time)
        self._publisher.publish(time)

    def stop(self) -> None:
        """End :meth:`run`; for commands."""
        self._is_stopped = True
        self._give_up_stretch()

    def pause(self) -> None:
        """Let time stand still; for commands."""
        self._is_running = False
        self._give_up_stretch()

    def step(self, period: int, done: Callable[[int], None]) -> None:
        """
        While paused, let ``period`` ns pass as fast as they can, and stand still again.

        Managers tick when they are due, at the beginning of the stretch too, but not at its end:
        that tick is the next stretch's, and takes the commands that have come by then. ``done`` is
        called at the end with what is missing of the period, ns: 0, unless a stop, a pause, a
        resume or a jump came between. For commands. Raises SimulationError.
        """
        if self._is_running:
            raise SimulationError('time is running; it is stepped while it is paused')
        if self._stretch is not None:
            raise SimulationError(
                f'{self._stretch.end - self.time} ns of another step are still to pass'
            )
        if period <= 0:
            done(0)
            return
        self._stretch = StepRequest(self.time + period, done)

    def resume(self) -> None:
        """Let time go on; for commands."""
        self._give_up_stretch()
        if not self._is_running:
            self._is_running = True
            self._pacer.resume(self.time)

    def reset(self) -> None:
        """Tell everybody that the stepper's world began anew; for commands."""
        self._jump(lambda manager, time: manager.reset(time))

    def set_clock(self) -> None:
        """Tell everybody that the stepper's clock was set; for commands."""
        self._jump(lambda manager, time: manager.set_clock(time))

    def _jump(self, tell: Callable[[ControllerManager, int], None]) -> None:
        self._give_up_stretch()
        time = self.time
        self._publisher.set_clocks(time)
        for manager in self.managers:
            tell(manager, time)
        self._pacer.resume(time)

    def _step(self, stretch: StepRequest) -> None:
        """Do one turn of a stretch of time."""
        self.tick()
        self._stepper.advance(min(self._time_to_next_tick(self.time), stretch.end - self.time))
        if self.time >= stretch.end:
            self._stretch = None
            self._show_time()  # before whoever waits for the end hears of it
            stretch.done(0)

    def _give_up_stretch(self) -> None:
        stretch, self._stretch = self._stretch, None
        if stretch is not None:
            stretch.done(stretch.end - self.time)

    def _show_time(self) -> None:
        """Have the time known where nothing ticks."""
        self._publisher.set_clocks(self.time)  # a command may have brought a new node
        self._publisher.publish(self.time)

    def _run_calls(self) -> None:
        for command in self._commands.take():
            command()

    def _time_to_next_tick(self, time: int) -> int:
        """Time to the next instant at which a manager or ``/clock`` is due, ns; above 0."""
        next_clock = time - time % self._clock_period + self._clock_period
        return min([next_clock, *(manager.next_tick for manager in self.managers)]) - time
