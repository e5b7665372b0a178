# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Start, run and end a ROS program: the one place of init, spin, shutdown and exit codes.

A node that only reacts (most of them)::

    def main(args: list[str] | None = None) -> int:
        return run(MinimalPublisher, args)

A program that drives itself::

    def main(args: list[str] | None = None) -> int:
        return program(lambda: spawn(args))

    def spawn(args: list[str] | None) -> int:
        with ros(args):
            node = Node('spawner')
            ...  # Ctrl-C, SIGTERM and SIGHUP raise KeyboardInterrupt here, also out of rclpy's waits
        return 0

A program with a loop of its own that must end in good order, the ROS context still alive::

    with ros(args) as stop:
        ...
        with stop.on_stop(loop.stop):  # a request to stop calls loop.stop(), and nothing else
            loop.run()
        publisher.publish(last_message)

How a program ends:

================================================== ===================================== =========
what happened                                      what is printed                       exit code
================================================== ===================================== =========
its work is done                                   nothing                               0, or what it returns
asked to stop (``run``: that is its normal end)    nothing                               0; ``program``: 128 + signal
an :class:`~amr_description.errors.AmrError`       one FATAL line                        its ``exit_code``
wrong ROS arguments (``-p``, ``-r``, names …)      one FATAL line                        1
any other exception                                its traceback (it is a bug)           1
================================================== ===================================== =========
"""

import re
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import rclpy
from rclpy.exceptions import NameValidationException, ParameterException
from rclpy.executors import Executor, ExternalShutdownException
from rclpy.experimental import EventsExecutor
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.logging import get_logger
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions

from amr_description.errors import AmrError, ParameterError
from amr_description.nodes.stop_requests import StopRequested, StopRequests

# Measured with a 100 Hz timer on rclpy 7.1.6: EventsExecutor 2.6 % of a core, SingleThreadedExecutor 6.5 %; a request to
# stop ends either within 10 ms. EventsExecutor has two faults there: spin() and spin_once() without a time-out never
# run a callback (hence spin() below), and an `async def` service callback raises TypeError: such a node asks for
# executor=SingleThreadedExecutor.
_SPIN_TIMEOUT = 0.5  # s; only a bound: messages, timers and Executor.wake() end the wait at once


def run(
    make_node: Callable[[], Node],
    args: list[str] | None = None,
    *,
    executor: Callable[[], Executor] = EventsExecutor,
) -> int:
    """
    Run one node until it is asked to stop; return the exit code of the process.

    :param make_node: Makes the node, once rclpy is initialised; the node's class will do.
    :param args: The command line without the program's name; None: that of the process.
    :param executor: Makes the executor.

    ``node.destroy_node()`` is called in every way out, while the context is still valid: the place for last messages.
    """

    def body() -> int:
        with ros(args) as stop:
            with argument_errors():
                node = make_node()
            try:
                spin_node(node, executor(), stop)
            finally:
                stop.leave()
                node.destroy_node()
        return 0

    return program(body, stopped=0)


def program(body: Callable[[], int | None], *, stopped: int | None = None) -> int:
    """
    Call ``body`` and return the exit code of the process, as the table above says.

    :param stopped: The exit code of a program that was asked to stop before it was done; None: 128 + the signal, so
        that whoever waits for its success does not go on.
    """
    try:
        return body() or 0
    except StopRequested as request:
        return 128 + request.signum if stopped is None else stopped
    except AmrError as error:
        get_logger(Path(sys.argv[0]).stem or 'python').fatal(str(error))
        return error.exit_code


@contextmanager
def ros(args: list[str] | None = None) -> Iterator[StopRequests]:
    """
    Initialise rclpy's default context, and shut it down in every way out.

    :param args: The command line without the program's name; None: that of the process.
    :raises ParameterError: The ROS arguments cannot be understood.

    Yields the requests to stop. One that finds the program outside of ``stop.on_stop`` raises ``KeyboardInterrupt``
    in the main thread and shuts the context down, which ends every wait inside rclpy.
    """
    with StopRequests(wake=rclpy.try_shutdown) as stop:
        try:
            with argument_errors():
                rclpy.init(args=args, signal_handler_options=SignalHandlerOptions.NO)
            yield stop
        finally:
            stop.leave()
            rclpy.try_shutdown()


def spin_node(node: Node, executor: Executor, stop: StopRequests) -> None:
    """Serve the callbacks of ``node`` until a request to stop; the executor is shut down afterwards."""
    stopped = threading.Event()

    def wake() -> None:
        stopped.set()
        executor.wake()

    executor.add_node(node)
    try:
        with stop.on_stop(wake):
            spin(executor, stopped.is_set)
    finally:
        executor.shutdown()


def spin(executor: Executor, until: Callable[[], bool]) -> None:
    """
    Serve the executor's callbacks in this thread until ``until()`` is true or the context is shut down.

    ``until`` is asked after each callback and twice a second; call ``executor.wake()`` to have it asked at once.
    """
    try:
        while not until():
            executor.spin_once(timeout_sec=_SPIN_TIMEOUT)
    except ExternalShutdownException:
        pass


@contextmanager
def argument_errors() -> Iterator[None]:
    """Turn what rclpy raises about wrong ROS arguments, names and parameters into :class:`ParameterError`."""
    try:
        yield
    except rclpy_implementation.UnknownROSArgsError as error:
        raise ParameterError(
            f'unknown ROS arguments {error}: between --ros-args and -- stand -r from:=to, -p name:=value, '
            '--params-file file, --log-level level'
        ) from error
    except (
        rclpy_implementation.RCLError,
        rclpy_implementation.RCLInvalidROSArgsError,
        ParameterException,
        NameValidationException,
    ) as error:
        raise ParameterError(_one_line(str(error))) from error


def _one_line(text: str) -> str:
    """Drop the positions in rcl's C sources (``, at /project/src/rcl/arguments.c:352``) and the line breaks."""
    return ' '.join(re.sub(r',? at /\S+:\d+', '', text).split())
