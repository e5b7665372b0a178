# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The control loop: the one thread that steps the world and ticks the controller managers.

It depends on four protocols: a stepper (the simulated world), a pacer (waits for the wall clock,
or not), a queue of calls from other threads, and a publisher. With the system clock as the
stepper, the same loop drives a real robot.

One cycle, at simulated time t::

    run the queued calls         # spawn, switch, pause, reset …; while paused: wait for one
    set the clocks to t
    tick the managers due at t   # read, update, write
    publish /clock, then the samples that controllers have sent at t
    step the world to the next instant at which something is due
    pace                         # calls that are queued meanwhile run at once

While paused, a period can be stepped (:meth:`Loop.step`): the same cycles, not paced, the last one
cut short at the end of the period.
"""

from collections.abc import Callable, Iterable
from typing import NamedTuple, Protocol

from amr_description.control.controller_manager import ControllerManager
from amr_description.errors import SimulationError


class Stepper(Protocol):
    """The world that is stepped."""

    @property
    def time(self) -> int:
        """Present time, ns."""

    def advance(self, period: int) -> None:
        """Advance by ``period`` (ns), as closely as its steps allow."""


class Pacer(Protocol):
    """Keeps the loop from running ahead of a clock."""

    def pace(self, time: int) -> bool:
        """
        Wait until the instant ``time`` (ns) is due; return at once if it is past.

        Returns False if it is not due yet, but a call was queued.
        """

    def resume(self, time: int) -> None:
        """Start, or go on after a pause or a jump, at ``time`` (ns)."""


class Commands(Protocol):
    """The queue of calls that other threads have the control thread make; a call never raises."""

    def take(self) -> Iterable[Callable[[], None]]:
        """Return the queued calls, oldest first."""

    def wait(self) -> object:
        """Block until a call is queued, or until ``/clock`` should be published again."""


class Publisher(Protocol):
    """Publishes the results of a cycle."""

    def set_clocks(self, time: int) -> None:
        """Set the clocks of the nodes in this process to ``time``, ns."""

    def publish(self, time: int) -> None:
        """Publish ``/clock``, and then the samples sent since the last call."""


class StepRequest(NamedTuple):
    """A period to step while paused."""

    end: int
    """ns."""
    done: Callable[[int], None]
    """Called with the missing part of the period, ns."""


class Loop:
    """
    Runs the cycles, on the control thread; see the module.

    All methods but :meth:`run`, :meth:`run_once` and :meth:`tick` are for queued calls.
    """

    def __init__(
        self,
        stepper: Stepper,
        pacer: Pacer,
        commands: Commands,
        publisher: Publisher,
        clock_period: int,
    ) -> None:
        """``clock_period``: longest time between two cycles, and so between two ``/clock``, ns."""
        self._stepper = stepper
        self._pacer = pacer
        self._commands = commands
        self._publisher = publisher
        self._clock_period = clock_period
        self._is_stopped = False
        self._is_running = True
        self._step_request: StepRequest | None = None
        self.managers: list[ControllerManager] = []
        """One for each robot; changed by queued calls only."""
        self.latest_tick: int | None = None
        """When managers have last ticked, ns; the end of a step is published before its tick."""

    @property
    def time(self) -> int:
        """Present time, ns."""
        return self._stepper.time

    @property
    def is_running(self) -> bool:
        """False while paused, even during a :meth:`step`."""
        return self._is_running

    @property
    def is_stepping(self) -> bool:
        """True during a :meth:`step`."""
        return self._step_request is not None

    def run(self) -> None:
        """Run cycles until :meth:`stop`."""
        self._pacer.resume(self.time)
        while not self._is_stopped:
            self.run_once()

    def run_once(self) -> None:
        """Run one cycle; while paused, only the queued calls."""
        self._run_calls()
        if self._is_stopped:
            return
        if self._step_request is not None:
            self._continue_step(self._step_request)
            return
        if not self._is_running:
            self._publish_time(self.time)
            self._commands.wait()
            return
        self._stepper.advance(self._time_to_next_tick(self.tick()))
        # In slow motion the next instant may be far off: queued calls do not wait for it.
        while not self._pacer.pace(self.time):
            self._run_calls()
            if self._is_stopped or not self._is_running:
                return

    def tick(self) -> int:
        """Tick the managers due now, and publish; return the time, ns."""
        time = self.latest_tick = self.time
        self._publisher.set_clocks(time)
        for manager in self.managers:
            if manager.is_due(time):
                manager.tick(time)
        self._publisher.publish(time)
        return time

    def stop(self) -> None:
        """End :meth:`run`."""
        self._is_stopped = True
        self._cancel_step()

    def pause(self) -> None:
        """Stop time, and a step that is under way."""
        self._is_running = False
        self._cancel_step()

    def step(self, period: int, done: Callable[[int], None]) -> None:
        """
        While paused, step a period as fast as possible.

        Managers tick when they are due, at the start of the period too, but not at its end: that
        tick belongs to the next step, and uses the commands that have arrived by then.

        Args:
            period: ns.
            done: called at the end with the missing part of the period, ns: 0 unless a stop, a
                pause, a resume or a jump has cut it short.

        Raises:
            SimulationError: time is running, or another step is under way.
        """
        if self._is_running:
            raise SimulationError('time is running; it is stepped while it is paused')
        if self._step_request is not None:
            raise SimulationError(
                f'{self._step_request.end - self.time} ns of another step are still to pass'
            )
        if period <= 0:
            done(0)
            return
        self._step_request = StepRequest(self.time + period, done)

    def step_through(self, period: int) -> int:
        """
        While paused, step a period before this returns, on the control thread; see :meth:`step`.

        Returns:
            The missing part of the period, ns.

        Raises:
            SimulationError: as :meth:`step`.
        """
        missing: list[int] = []
        self.step(period, missing.append)
        while self._step_request is not None:
            self._run_calls()
            if self._step_request is not None:
                self._continue_step(self._step_request)
        return missing[0]

    def resume(self) -> None:
        """Let time go on after a pause."""
        self._cancel_step()
        if not self._is_running:
            self._is_running = True
            self._pacer.resume(self.time)

    def reset(self) -> None:
        """Reset the managers, after the simulated world was reset."""
        self._jump(lambda manager, time: manager.reset(time))

    def set_clock(self) -> None:
        """Have the managers follow a jump of the stepper's clock."""
        self._jump(lambda manager, time: manager.set_clock(time))

    def _jump(self, notify: Callable[[ControllerManager, int], None]) -> None:
        self._cancel_step()
        self.latest_tick, time = None, self.time
        self._publisher.set_clocks(time)
        for manager in self.managers:
            notify(manager, time)
        self._pacer.resume(time)

    def _continue_step(self, request: StepRequest) -> None:
        """Run one cycle of a step."""
        time = self.tick()
        self._stepper.advance(min(self._time_to_next_tick(time), request.end - time))
        time = self.time  # looked up a few times only: it is three calls
        if time >= request.end:
            self._step_request = None
            self._publish_time(time)  # before anybody is told that the step is done
            request.done(0)

    def _cancel_step(self) -> None:
        request, self._step_request = self._step_request, None
        if request is not None:
            request.done(request.end - self.time)

    def _publish_time(self, time: int) -> None:
        """Publish the time without a tick."""
        self._publisher.set_clocks(time)  # a call may have added a node
        self._publisher.publish(time)

    def _run_calls(self) -> None:
        for call in self._commands.take():
            call()

    def _time_to_next_tick(self, time: int) -> int:
        """Return the time until a manager or ``/clock`` is due, ns; above 0."""
        following = time - time % self._clock_period + self._clock_period
        for manager in self.managers:
            if manager.next_tick < following:
                following = manager.next_tick
        return following - time
