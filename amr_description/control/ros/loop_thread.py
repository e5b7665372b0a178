# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The owner's thread, its queue and its pace: how the loop of ``control`` lives in a process.

Other threads ask with :meth:`LoopThread.submit` and get an rclpy future; nothing else is shared.
"""

from collections import deque
from collections.abc import Callable, Iterable
import gc
import threading
import time
import traceback

from rclpy.executors import Executor
from rclpy.task import Future

from amr_description.clock import NANOSECONDS
from amr_description.control.controller_manager import ControllerManager
from amr_description.control.loop import Loop

_HOPELESSLY_LATE = 0.1
"""s: beyond it the pacer starts anew, instead of making good what was missed in a burst."""

_SHARE = 0.005
"""s: how long the owner keeps going, as fast as possible, before it yields."""


class CallQueue:
    """The queue of commands; any thread puts, the owner takes (``Commands`` of the loop)."""

    def __init__(self, patience: float | None = None) -> None:
        """``patience``: the longest wait for something, s; None: no end."""
        self._patience = patience
        self._calls: deque[Callable[[], None]] = deque()
        self._arrived = threading.Event()

    def put(self, call: Callable[[], None]) -> None:
        """Queue a call, and wake the owner if it waits."""
        self._calls.append(call)
        self._arrived.set()

    def wake(self) -> None:
        """End a wait, though there is nothing to do."""
        self._arrived.set()

    def take(self) -> Iterable[Callable[[], None]]:
        """Return what has arrived; what a call puts while it runs waits for the next turn."""
        self._arrived.clear()  # before the calls are taken: what comes in between wakes again
        return [self._calls.popleft() for _ in range(len(self._calls))]

    def wait(self, timeout: float | None = None) -> bool:
        """
        Block until something arrives, at most ``timeout`` s; tell whether something has.

        Without ``timeout``: as patient as it was made.
        """
        return self._arrived.wait(self._patience if timeout is None else timeout)


class WallPacer:
    """
    Keeps simulated time at ``factor`` times the wall clock; 0: as fast as possible.

    Deadlines are absolute, so that the error of one sleep does not add up. Being late costs
    real-time factor, never results. A call that arrives in ``mailbox`` ends a sleep.
    """

    def __init__(self, factor: float, mailbox: CallQueue) -> None:
        self.factor = factor
        """The one it keeps to; :meth:`set_factor` sets it."""
        self._mailbox = mailbox
        self._wall_start = self._start = 0.0
        self._yielded = 0.0

    def set_factor(self, factor: float, time_now: int) -> None:
        """Keep to another factor from now on, simulated time being ``time_now``, ns."""
        self.factor = factor
        self.resume(time_now)

    def resume(self, time_now: int) -> None:
        """Count from now on, simulated time being ``time_now``, ns."""
        self._wall_start = time.monotonic()
        self._start = time_now / NANOSECONDS

    def pace(self, time_due: int) -> bool:
        """Sleep until the instant ``time_due`` (ns) is due; False: a call came before."""
        if self.factor == 0.0:
            self._yield()
            return True
        due = self._wall_start + (time_due / NANOSECONDS - self._start) / self.factor
        delay = due - time.monotonic()
        if delay > 0.0:
            return not self._mailbox.wait(delay)
        if delay < -_HOPELESSLY_LATE:
            self.resume(time_due)
        return True

    def _yield(self) -> None:
        """Let the ROS thread have the interpreter's lock now and then; each time costs."""
        now = time.monotonic()
        if now - self._yielded > _SHARE:
            time.sleep(0)
            self._yielded = time.monotonic()


class LoopThread:
    """
    Runs the loop in a thread of its own; when it ends, every manager is shut down, motors first.

    When the loop raises, that is a bug: the traceback is printed, ``failed`` is set and
    ``on_failure`` is called, so that the process ends instead of standing still.
    """

    loop: Loop
    """Set before :meth:`start`: what paces it may depend on parameters of a node that needs us."""

    def __init__(self, mailbox: CallQueue, executor: Executor) -> None:
        self.failed = False
        """What keeps the robots going has ended by a bug; so shall the process."""
        self.on_failure: Callable[[], None] = executor.wake
        self.on_start: Callable[[], None] = lambda: None
        """Called in the owner's thread, before the first turn."""
        self._mailbox = mailbox
        self._executor = executor
        self._thread = threading.Thread(target=self._run, name='owner')

    def start(self) -> None:
        """Begin to turn."""
        self._thread.start()

    def stop(self) -> None:
        """End the loop after the turn that it is in, if it has begun, and wait for that."""
        if self._thread.ident is not None:
            self._mailbox.put(self.loop.stop)
            self._thread.join()

    def fail(self) -> None:
        """End the process instead of letting it stand still; from the thread that found a bug."""
        self.failed = True
        self.on_failure()

    def submit[Result](
        self, call: Callable[[], Result], executor: Executor | None = None
    ) -> Future:
        """
        Have the owner make a call between two turns; await the result in an async callback.

        What the call raises, the future raises. ``executor``: that of the callback; None: the one
        that the owner was made with.
        """
        executor = executor or self._executor
        future = Future(executor=executor)

        def make() -> None:
            try:
                result = call()
            except Exception as error:  # belongs to whoever awaits it
                future.set_exception(error)
            else:
                future.set_result(result)
            executor.wake()  # a task that awaits is looked at only when the executor wakes

        self._mailbox.put(make)
        return future

    async def step(self, period: int) -> int:
        """
        Have ``period`` ns pass while paused; return what is missing of it in the end, ns.

        See :meth:`Loop.step`. Raises SimulationError.
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
            self.loop.run()
        except BaseException:  # sys.exit() in a stranger's class, too: nobody else would see it
            traceback.print_exc()
            self.fail()
        finally:
            for manager in self.loop.managers:
                self._shut_down(manager)

    def _shut_down(self, manager: ControllerManager) -> None:
        """Stop one robot; whatever it raises, the next one has to be stopped too."""
        try:
            manager.shut_down(self.loop.time)
        except BaseException:
            traceback.print_exc()
            self.failed = True
