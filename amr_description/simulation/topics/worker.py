# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The thread that measures what takes long: cameras, and lidars of many rays.

A sensor asks for a measurement while the control thread reports a cycle; the measurement begins
when all of that cycle is published, so that nothing overtakes ``/clock`` and the transforms of its
instant. As long as cycles wait for the wall clock (``is_paced``) the control thread goes on
meanwhile, and a measurement that is asked for while the one before is not done is left out, which
is logged. Else it waits, and none is left out.
"""

from collections import deque
from collections.abc import Callable
import threading
import time as wall

from amr_description.log import Log, Severity
from amr_description.plugin_errors import describe, log_traceback

_LOG_PERIOD = 10.0
"""s between two lines of a sensor whose measurements are left out."""
_END_TIMEOUT = 0.5
"""s that a measurement in work has to be finished at the end."""
_PATIENCE = 2.0
"""s that the first measurement of a sensor may take without a line."""


class SensorWorker:
    """
    One thread for all sensors of a world; it starts with the first measurement.

    :meth:`stop` and :meth:`close` are called on the ROS thread, everything else on the control
    thread.
    """

    def __init__(
        self,
        followers: list[Callable[[], None]],
        log: Log,
        is_paced: Callable[[], bool],
        begin_thread: Callable[[], None] | None,
    ) -> None:
        """
        Begin measurements at the end of control cycles.

        Args:
            followers: Called when a cycle is published.
            log: Of the simulator.
            is_paced: Whether cycles wait for the wall clock, so that the control thread must not
                wait for a measurement. While it is False (real-time factor 0, or in a step) time
                has to wait for measurements, which are all made.
            begin_thread: What the thread does first; None: there is no thread, and measurements
                are made on that of the control loop. Then no cycle waits for the wall clock.
        """
        self.log = log
        self.is_paced = is_paced
        self._requested: list[tuple[SensorTask, Callable[[], None]]] = []
        """Of this cycle."""
        self._queue: deque[SensorTask | None] = deque()
        self._changed = threading.Condition()
        self._thread: threading.Thread | None = None
        self._is_closed = False
        self._at_end: Callable[[], None] = lambda: None
        self._begin_thread = begin_thread
        followers.append(self._begin)

    def task(self, name: str, remedy: str) -> 'SensorTask':
        """
        Return what a sensor asks for measurements.

        Args:
            name: Of the sensor, as it is called in a line of log.
            remedy: What would do if they take too long.
        """
        return SensorTask(self, name, remedy)

    def request(self, task: 'SensorTask', measure: Callable[[], None]) -> None:
        """Have a task call ``measure`` when this cycle is published."""
        self._requested.append((task, measure))

    def wait_for(self, task: 'SensorTask') -> None:
        """Wait until the measurement of a sensor is done, if one is in work."""
        if task.is_busy:
            with self._changed:
                self._changed.wait_for(lambda: self._is_closed or not task.is_busy)

    def stop(self) -> None:
        """Begin no measurement any more, and have nobody wait for one; from any thread."""
        with self._changed:
            self._is_closed = True
            self._queue.clear()
            self._changed.notify_all()

    def close(self, at_end: Callable[[], None]) -> None:
        """
        End the thread, as soon as a measurement that it makes is finished.

        One that takes longer is left to the end of the process.

        Args:
            at_end: What the thread does last, if it was there.
        """
        self.stop()
        if self._begin_thread is None:
            at_end()
            return
        with self._changed:
            self._at_end = at_end
            self._queue.append(None)
            self._changed.notify_all()
        if self._thread is not None:
            self._thread.join(_END_TIMEOUT)

    def _begin(self) -> None:
        """Hand what was asked for in this cycle to the thread; wait for it if time waits."""
        if not self._requested:
            return
        requested, self._requested = self._requested, []
        begin_thread = self._begin_thread
        if begin_thread is None:
            for task, measure in requested:
                task.begin(measure)
                self._make(task)
                task.is_busy = False
            return
        for task, _ in requested:
            self.wait_for(task)  # it began while the control thread did not wait
        with self._changed:
            if self._is_closed:
                return
            if self._thread is None:
                self._thread = threading.Thread(
                    target=self._run, args=(begin_thread,), name='sensors', daemon=True
                )
                self._thread.start()
            for task, measure in requested:
                task.begin(measure)
                self._queue.append(task)
            self._changed.notify_all()
        if not self.is_paced():
            for task, _ in requested:
                self.wait_for(task)

    def _run(self, begin: Callable[[], None]) -> None:
        begin()
        while True:
            with self._changed:
                self._changed.wait_for(lambda: self._queue)
                task = self._queue.popleft()
            if task is None:
                self._at_end()
                return
            self._make(task)
            with self._changed:
                task.is_busy = False
                self._changed.notify_all()

    def _make(self, task: 'SensorTask') -> None:
        try:
            task.make()
        except Exception as error:  # of one sensor; the others go on
            self.log(
                Severity.ERROR,
                f'{task.name} has measured nothing: {describe(error)}',
                throttle=_LOG_PERIOD,
            )
            log_traceback(self.log, error)


class SensorTask:
    """The measurements of one sensor that another thread makes; made by the worker."""

    def __init__(self, worker: SensorWorker, name: str, remedy: str) -> None:
        self.name = name
        self.is_busy = False
        """Whether a measurement was asked for that is not yet done."""
        self._worker, self._remedy = worker, remedy
        self._measure: Callable[[], None] | None = None
        self._duration = self._processor_time = 0.0
        """Of the latest measurement, s."""
        self._made = self._left_out = 0
        self._asked = self._next_line = 0.0

    def request(self, measure: Callable[[], None]) -> None:
        """
        Have a measurement made when this cycle is published.

        Args:
            measure: Measures from a copy, and publishes; on another thread.
        """
        if self.is_busy and self._worker.is_paced():
            self._leave_out()
            return
        self._made += 1
        self._worker.request(self, measure)

    def begin(self, measure: Callable[[], None]) -> None:
        """Note what is to be made next."""
        self.is_busy, self._measure, self._asked = True, measure, wall.monotonic()

    def make(self) -> None:
        """Make the measurement; on the thread of the worker."""
        measure = self._measure
        assert measure is not None
        begin, processor_begin = wall.monotonic(), wall.thread_time()
        measure()
        self._processor_time = wall.thread_time() - processor_begin
        self._duration = wall.monotonic() - begin

    def _leave_out(self) -> None:
        now = wall.monotonic()
        if not self._duration and now < self._asked + _PATIENCE:  # the first loads the scene
            return
        self._left_out += 1
        if now < self._next_line:
            return
        self._next_line = now + _LOG_PERIOD
        total = self._made + self._left_out
        taken = f'more than {(now - self._asked) * 1e3:.0f} ms'
        if self._duration:
            own = self._processor_time * 1e3
            taken = f'{self._duration * 1e3:.0f} ms, {own:.0f} ms of them of processor time'
        self._worker.log(
            Severity.WARN,
            f'{self.name}: {self._left_out} of {total} measurements were left out, as one takes '
            f'{taken}; {self._remedy}',
        )
        self._made = self._left_out = 0
