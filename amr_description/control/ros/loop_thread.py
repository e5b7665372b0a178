# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The control thread: it alone runs the :class:`~amr_description.control.loop.Loop` of a process.

Other threads hand it calls with :meth:`LoopThread.submit`, to be made between two cycles, and get
an rclpy future for the result; nothing else is shared. Times are in ns, timeouts in s.
"""

from collections import deque
from collections.abc import Callable, Iterable
from dataclasses import dataclass
import gc
import threading
import traceback

from rclpy.executors import Executor
from rclpy.task import Future

from amr_description.control.controller_manager import ControllerManager
from amr_description.control.loop import Loop
from amr_description.control.ros.loop_publisher import LoopPublisher
from amr_description.ros.log_thread import LogThread


class CallQueue:
    """Calls for the control thread (``Commands`` of the loop); any thread may put one."""

    def __init__(self, timeout: float | None = None) -> None:
        """``timeout``: the longest :meth:`wait`, s; None: without end."""
        self._timeout = timeout
        self._calls: deque[Callable[[], None]] = deque()
        self._arrived = threading.Event()

    def put(self, call: Callable[[], None]) -> None:
        """Queue a call, and wake the control thread if it waits."""
        self._calls.append(call)
        self._arrived.set()

    def wake(self) -> None:
        """End a wait without a call."""
        self._arrived.set()

    def take(self) -> Iterable[Callable[[], None]]:
        """Return the calls that wait; one that is put by a call is left for the next cycle."""
        self._arrived.clear()  # before the calls are taken: one put in between wakes again
        return [self._calls.popleft() for _ in range(len(self._calls))]

    def wait(self, timeout: float | None = None) -> bool:
        """
        Block until a call arrives; return whether one has.

        Args:
            timeout: s; None: the queue's own.
        """
        return self._arrived.wait(self._timeout if timeout is None else timeout)


class LoopThread:
    """
    Runs the loop in a thread of its own; when it ends, every manager is shut down, motors first.

    An exception out of the loop is a bug: its traceback is printed, ``failed`` is set and
    ``on_failure`` is called, so that the process ends instead of leaving robots uncontrolled.
    """

    loop: Loop
    """Set before :meth:`start`: its pacer may depend on parameters of a node that needs us."""

    def __init__(self, calls: CallQueue, executor: Executor) -> None:
        """
        Make the thread, which :meth:`start` starts.

        Args:
            calls: The queue that the loop takes its commands from.
            executor: Serves the callbacks that await what they :meth:`submit`.
        """
        self.failed = False
        """The loop has ended by a bug; so shall the process."""
        self.on_failure: Callable[[], None] = executor.wake
        self.on_start: Callable[[], None] = lambda: None
        """Called on the control thread, before the first cycle."""
        self._calls = calls
        self._executor = executor
        self._thread = threading.Thread(target=self._run, name='control_loop')

    def start(self) -> None:
        """Start the thread."""
        self._thread.start()

    def stop(self) -> None:
        """End the loop after the present cycle, if it was started, and join the thread."""
        if self._thread.ident is not None:
            self._calls.put(self.loop.stop)
            self._thread.join()

    def fail(self) -> None:
        """End the process because of a bug; called by the thread that found it."""
        self.failed = True
        self.on_failure()

    def submit[Result](
        self, call: Callable[[], Result], executor: Executor | None = None
    ) -> Future:
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
            self.loop.run()
        except BaseException:  # sys.exit() in a plugin, too: nobody else would see it
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


@dataclass(frozen=True)
class LoopContext:
    """What a process with a control loop lends to the nodes of its controller managers."""

    loop_thread: LoopThread
    publisher: LoopPublisher
    logs: LogThread
