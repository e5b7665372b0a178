# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The control thread: it alone runs the :class:`~amr_description.control.loop.Loop` of a process.

Other threads hand it calls with :meth:`LoopThread.submit`, to be made between two cycles, and get
an rclpy future for the result; nothing else is shared. Times are in ns, timeouts in s.
"""

from collections import deque
from collections.abc import Callable, Iterable
from contextlib import suppress
from dataclasses import dataclass
import gc
import os
from pathlib import Path
import sys
import threading
from types import FrameType
from typing import TypeVar

from rclpy.executors import Executor
from rclpy.task import Future

from amr_description.control.controller_manager import ControllerManager
from amr_description.control.loop import Loop
from amr_description.control.ros.loop_publisher import LoopPublisher
from amr_description.control.ros.loop_watchdog import (
    describe_call,
    is_in,
    LoopWatchdog,
    WALL_CLOCK,
    WatchdogClock,
)
from amr_description.control.ros.realtime import set_time_slice, SHORT_SLICE
from amr_description.log import Log, null_log
from amr_description.ros.log_thread import LogThread
from amr_description.streams import print_traceback

Result = TypeVar('Result')

_STOP_PERIOD = 0.05
"""s between two looks at a control thread that is to end."""

_STOP_MOTORS = 0.2
"""s that hardware has for it when the process ends without its control thread."""

_STDERR = 2


class CallQueue:
    """Calls for the control thread (``Commands`` of the loop); any thread may put one."""

    def __init__(self, timeout: float | None = None) -> None:
        """``timeout``: the longest :meth:`wait`, s; None: without end."""
        self._timeout = timeout
        self._calls: deque[Callable[[], None]] = deque()
        self._arrived = threading.Event()
        self.cycles = 0
        """How often :meth:`take` was called, which a cycle begins with."""
        self.has_calls = False
        """Whether there was something to take, the last time."""
        self.is_waiting = False
        """Whether the control thread has nothing to do."""

    def put(self, call: Callable[[], None]) -> None:
        """Queue a call, and wake the control thread if it waits."""
        self._calls.append(call)
        self._arrived.set()

    def wake(self) -> None:
        """End a wait without a call."""
        self._arrived.set()

    def take(self) -> Iterable[Callable[[], None]]:
        """Return the calls that wait; one that is put by a call is left for the next cycle."""
        self.cycles += 1
        if not self._arrived.is_set():  # at most times; to clear it takes a lock
            self.has_calls = False
            return ()
        self._arrived.clear()  # before the calls are taken: one put in between wakes again
        calls = [self._calls.popleft() for _ in range(len(self._calls))]
        self.has_calls = bool(calls)
        return calls

    def wait(self, timeout: float | None = None) -> bool:
        """
        Block until a call arrives; return whether one has.

        Args:
            timeout: s; None: the queue's own.
        """
        self.is_waiting = True
        has_arrived = self._arrived.wait(self._timeout if timeout is None else timeout)
        self.is_waiting = False
        return has_arrived


class LoopThread:
    """
    Runs the loop in a thread of its own; when it ends, every manager is shut down, motors first.

    An exception out of the loop is a bug: its traceback is printed, ``failed`` is set and
    ``on_failure`` is called, so that the process ends instead of leaving robots uncontrolled.
    """

    loop: Loop
    """Set before :meth:`start`: its pacer may depend on parameters of a node that needs us."""

    def __init__(
        self,
        calls: CallQueue,
        executor: Executor,
        *,
        watchdog_clock: WatchdogClock = WALL_CLOCK,
    ) -> None:
        """
        Make the thread, which :meth:`start` starts.

        Args:
            calls: The queue that the loop takes its commands from.
            executor: Serves the callbacks that await what they :meth:`submit`.
            watchdog_clock: By which the loop is found to stand.
        """
        self.failed = False
        """The loop has ended by a bug; so shall the process."""
        self.on_failure: Callable[[], None] = executor.wake
        self.on_start: Callable[[], None] = lambda: None
        """Called on the control thread, before the first cycle."""
        self.log: Log = null_log
        """Of the watchdog; set before :meth:`start`."""
        self._calls = calls
        self._executor = executor
        self._thread = threading.Thread(target=self._run, name='control_loop')
        self._watchdog = LoopWatchdog(
            calls, lambda severity, text, *, throttle=0.0: self.log(severity, text), watchdog_clock
        )

    def start(self) -> None:
        """Start the thread."""
        self._thread.start()

    @property
    def is_alive(self) -> bool:
        """Whether it takes calls."""
        return self._thread.is_alive()

    def stop(self) -> None:
        """
        End the loop after the present cycle, if it was started, and join the thread.

        A loop that stands will not end: then the motors are stopped, as far as that is possible
        from here, and the process ends at once, with exit code 1.
        """
        if self._thread.ident is None:
            return
        self._calls.put(self.loop.stop)
        while self._thread.is_alive():
            self._thread.join(_STOP_PERIOD)
            if frame := self._watchdog.frame_standing():
                self._abandon(frame)

    def fail(self) -> None:
        """End the process because of a bug; called by the thread that found it."""
        self.failed = True
        self.on_failure()

    def submit(self, call: Callable[[], Result], executor: Executor | None = None) -> Future:
        """
        Have the control thread make a call between two cycles.

        Args:
            call: What it raises, the future raises.
            executor: That of the async callback which awaits the future; None: the one that the
                thread was made with.

        Returns:
            A future for what the call returns.
        """
        executor = executor or self._executor
        future = Future(executor=executor)

        def make() -> None:
            try:
                result = call()
            except Exception as error:  # raised again where the future is awaited
                future.set_exception(error)
            else:
                future.set_result(result)
            executor.wake()  # a task that awaits is looked at only when the executor wakes

        self._calls.put(make)
        return future

    async def step(self, period: int) -> int:
        """
        While paused, let ``period`` ns pass; see :meth:`Loop.step`.

        Returns:
            How much of the period has not passed in the end, ns.

        Raises:
            SimulationError: Time is running, or another step is not done.
        """
        ended = Future(executor=self._executor)

        def done(missing: int) -> None:
            ended.set_result(missing)
            self._executor.wake()

        await self.submit(lambda: self.loop.step(period, done))
        return await ended

    def _run(self) -> None:
        # What the start has made lives as long as the process: keep the collector off it.
        gc.collect()
        gc.freeze()
        try:
            self.on_start()
            self._watchdog.start()
            set_time_slice(SHORT_SLICE)
            self.loop.run()
        except BaseException:  # sys.exit() in a plugin, too: nobody else would see it
            print_traceback()
            self.fail()
        finally:
            self._watchdog.stop()
            for manager in self.loop.managers:
                self._shut_down(manager)

    def _abandon(self, frame: FrameType) -> None:
        """End the process though the control thread does not come back from ``frame``."""
        call, is_free = describe_call(frame), not is_in(frame, ControllerManager.tick)
        if is_free:  # nobody uses the hardware now
            stopping = threading.Thread(target=self._stop_motors, daemon=True)
            stopping.start()
            stopping.join(_STOP_MOTORS)
        line = (
            f'[FATAL] [{Path(sys.argv[0]).stem}]: the control loop stands in {call}; this process '
            f'ends without it; motors: {"stopped" if is_free else "left to their own watchdog"}\n'
        )
        with suppress(OSError):  # nobody reads it
            os.write(_STDERR, line.encode())
        os._exit(1)

    def _stop_motors(self) -> None:
        for manager in self.loop.managers:
            manager.resources.shut_down()

    def _shut_down(self, manager: ControllerManager) -> None:
        """Stop one robot; whatever it raises, the next one has to be stopped too."""
        try:
            manager.shut_down(self.loop.time)
        except BaseException:
            print_traceback()
            self.failed = True


@dataclass(frozen=True)
class LoopContext:
    """What a process with a control loop lends to the nodes of its controller managers."""

    loop_thread: LoopThread
    publisher: LoopPublisher
    logs: LogThread
