# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Start, run and end a ROS program: the one place of init, spin, shutdown and exit codes.

A node that only reacts, as most do::

    def main(args: list[str] | None = None) -> int:
        return run(MinimalPublisher, args)

A program that drives itself::

    def main(args: list[str] | None = None) -> int:
        return program(lambda: spawn(args))

    def spawn(args: list[str] | None) -> None:
        with ros(args):
            node = Node('spawner')
            ...  # Ctrl-C raises KeyboardInterrupt here, also out of rclpy's waits

A program with a loop of its own, which has to end in good order while ROS still works::

    with ros(args) as stop:
        ...
        with stop.on_stop(loop.stop):  # a request to stop calls loop.stop(), and that is all
            loop.run()
        publisher.publish(last_message)

How a program ends:

================================================  ================  ===========================
what happened                                     what it prints    exit code
================================================  ================  ===========================
``body`` returned                                 nothing           what it returned; None is 0
SIGINT, SIGTERM, SIGHUP, or the parent is gone    nothing           ``run``: 0, its normal end;
                                                                    ``program``: 128 + signal
an :class:`~amr_description.errors.AmrError`      one FATAL line    its ``exit_code``
wrong ROS arguments: ``-p``, ``-r``, names, ...   one FATAL line    1
any other exception: a bug                        its traceback     1
================================================  ================  ===========================

What a callback raises does not get that far: it is logged, and the node serves on, see
``firewall.py``.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
import ctypes
from functools import cache
import os
from pathlib import Path
import re
import sys
import threading

import rclpy
from rclpy.exceptions import NameValidationException, ParameterException
from rclpy.executors import Executor, ExternalShutdownException, SingleThreadedExecutor
from rclpy.experimental import EventsExecutor
from rclpy.logging import get_logger
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions
from rclpy.task import Future

from amr_description.errors import AmrError, CallbackError, ParameterError
from amr_description.ros.discovery import use_whole_graph
from amr_description.ros.firewall import caught, guard
from amr_description.ros.participant_end import bound_listener_wait
from amr_description.ros.rclpy_internals import (
    cancel_tasks,
    destroy_type_description_service,
    mend_parameter_services,
    RCLError,
    RCLInvalidROSArgsError,
    UnknownROSArgsError,
)
from amr_description.ros.signals import StopRequested, StopRequests
from amr_description.ros.transport import udp_only
from amr_description.ros_arguments import DOMAIN, is_domain, OF_DOMAINS
from amr_description.streams import print_traceback
from amr_description.text import unwrap


@cache
def skip_destructors() -> None:
    """
    Have this process end at once when Python has finished; call it after Fast DDS was used.

    Nothing of Python's own end is left out, and what C code has written is flushed. The exit code
    stays. A participant that is left then says no goodbye: its nodes are destroyed before.
    """
    libc = ctypes.CDLL(None)
    try:
        register = libc.on_exit  # of glibc; its functions are called in reverse order
    except AttributeError:
        return
    register(libc._exit, None)  # with the exit code as its argument
    register(libc.fcloseall, None)


# Only a bound, s: messages, timers and end_wait() end the wait at once.
_SPIN_TIMEOUT = 0.5
_LONG_TIMEOUT = 10.0
"""s: where :func:`end_wait` is always called. A wake-up takes a robot's executor 1 to 2 ms."""


def run(
    make_node: Callable[[], Node],
    args: list[str] | None = None,
    *,
    executor: Callable[[], Executor] = EventsExecutor,
) -> int:
    """
    Run one node until it is asked to stop; return the exit code of the process.

    :param make_node: Makes the node, once rclpy is initialised; a node class will do.
    :param args: The command line without the program's name; None: that of the process.
    :param executor: Makes the executor.

    In every way out ``destroy_node()`` is called while the node can still publish.

    EventsExecutor costs 2.6 % of a core for a 100 Hz timer, SingleThreadedExecutor 6.5 %
    (rclpy 7.1.6). A node with an ``async def`` service callback needs
    ``executor=SingleThreadedExecutor``: EventsExecutor dies of it with a TypeError.
    """

    def body() -> None:
        with ros(args) as stop:
            with argument_errors():
                node = make_node()
            guard(node)
            try:
                _spin_until_stopped(node, executor, stop)
            finally:
                stop.leave()
                node.destroy_node()

    return program(body, stopped=0)


def program(body: Callable[[], int | None], *, stopped: int | None = None) -> int:
    """
    Call ``body`` and return the exit code of the process, as the table of this module says.

    :param stopped: The exit code when it was asked to stop; None: 128 + the signal's number, so
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
    Initialise rclpy's default context; shut it down in every way out. Yields the stop requests.

    :param args: The command line without the program's name; None: that of the process.
    :raises ParameterError: The ROS arguments cannot be understood.
    :raises StopRequested: (a KeyboardInterrupt) The program was asked to stop outside of
        ``stop.on_stop``. The context is shut down then, which ends every wait inside rclpy.
    """
    with StopRequests(wake=rclpy.try_shutdown) as stop:
        try:
            use_whole_graph()
            mend_parameter_services()
            if (domain := os.environ.get(DOMAIN, '')) and not is_domain(domain):
                raise ParameterError(f'{DOMAIN}={domain}: {OF_DOMAINS}')  # rcl says nothing of it
            with argument_errors(), udp_only():
                rclpy.init(args=args, signal_handler_options=SignalHandlerOptions.NO)
            bound_listener_wait()
            yield stop
        finally:
            stop.leave()
            rclpy.try_shutdown()
            skip_destructors()


def spin(executor: Executor, until: Callable[[], bool], *, timeout: float = _SPIN_TIMEOUT) -> None:
    """
    Serve the executor's callbacks in this thread until ``until()``, or a shutdown of the context.

    ``until`` is asked after every callback and each ``timeout`` s; :func:`end_wait` has it asked
    at once. What a callback raises is logged; CallbackError: too much is. (In rclpy 7.1.6
    ``EventsExecutor.spin()``, and ``spin_once()`` without a time-out, never run a callback. This
    loop is right for every executor.)
    """
    while executor.context.ok() and not until():
        try:
            executor.spin_once(timeout_sec=timeout)
        except ExternalShutdownException:
            return
        except CallbackError:
            raise
        except Exception as error:
            if executor.context.ok():  # otherwise: it was shut down while the wait was set up
                caught(error, 'a callback')


def end_wait(executor: Executor) -> None:
    """
    Have ``spin_once()`` return at once; from any thread.

    ``Executor.wake()`` does not: in rclpy 7.1.6 the executor then looks at what it has to wait
    for, and waits on.
    """
    executor.create_task(_nothing)


def _nothing() -> None: ...


def serve(
    executor: Executor,
    stop: StopRequests,
    start: Callable[[], object],
    *,
    until: Callable[[], object] = lambda: False,
) -> None:
    """
    Spin an executor until the program is asked to stop, or ``until()``.

    Args:
        executor: Its callbacks run in this thread.
        stop: Yielded by :func:`ros`; requests are ignored afterwards.
        start: Called first; a request to stop does not interrupt it.
        until: Asked as by :func:`spin`.
    """
    is_stopping = False

    def end() -> None:
        nonlocal is_stopping
        is_stopping = True
        end_wait(executor)

    with stop.on_stop(end):
        start()
        spin(executor, lambda: is_stopping or bool(until()))


@contextmanager
def spinning(
    node: Node, *, executor: Callable[[], Executor] = EventsExecutor
) -> Iterator[Executor]:
    """
    Serve the callbacks of ``node`` in a thread while inside; ``destroy_node()`` in every way out.

    For programs whose main thread has something else to wait for.
    """
    server = executor()
    ended = threading.Event()
    server.add_node(node)
    thread = threading.Thread(target=spin, args=(server, ended.is_set), name='spinning')
    thread.start()
    try:
        yield server
    finally:
        ended.set()
        end_wait(server)
        thread.join()
        server.shutdown()
        node.destroy_node()


def await_executor(node: Node) -> None:
    """
    Wait, in another thread, until the node's executor has done all that it had to do before.

    It has then let go of what was destroyed: EventsExecutor keeps a publisher or a subscription
    until it has looked at the node again, and the callback of an event keeps it, too.
    """
    assert node.executor is not None, 'it has been added to one'
    done = threading.Event()
    node.executor.create_task(done.set)
    done.wait()


class ExecutorThread:
    """
    A thread that serves the nodes of one robot among many; they are added to its ``executor``.

    SingleThreadedExecutor looks at every entity it has at each wake-up: some 100 a robot, 1.5 ms.
    With ten robots in one executor each message would cost ten times that.
    """

    def __init__(self, name: str, on_failure: Callable[[], object]) -> None:
        """``on_failure``: called in the thread when callbacks raise again and again."""
        self.executor = SingleThreadedExecutor()
        self._on_failure = on_failure
        self._ending = threading.Event()
        self._thread = threading.Thread(target=self._run, name=name)

    def start(self) -> None:
        """Begin to serve."""
        self._thread.start()

    def ask_to_end(self) -> None:
        """Let no other callback begin."""
        self._ending.set()
        end_wait(self.executor)

    def end(self) -> None:
        """
        Wait for the callback that runs, and cancel the coroutines that await something.

        Whatever they await may still wake the executor: shut it down after that.
        """
        self.ask_to_end()
        self._thread.join()
        cancel_tasks(self.executor)  # it would keep them for ever

    def _run(self) -> None:
        try:
            spin(self.executor, self._ending.is_set, timeout=_LONG_TIMEOUT)
        except CallbackError as error:
            get_logger(self._thread.name).fatal(str(error))
            self._on_failure()
        except BaseException:  # sys.exit() in a plugin, too: nobody else would see it
            print_traceback()
            self._on_failure()


@contextmanager
def argument_errors() -> Iterator[None]:
    """Turn what rclpy raises about ROS arguments, names and parameters into ParameterError."""
    try:
        yield
    except UnknownROSArgsError as error:
        raise ParameterError(
            f'unknown ROS arguments {error}: between --ros-args and -- stand -r from:=to, '
            '-p name:=value, --params-file file and --log-level level'
        ) from error
    except UnicodeEncodeError as error:  # a word of the command line
        raise ParameterError(f'not valid UTF-8: {error.object!a}') from error
    except (
        RCLError,
        RCLInvalidROSArgsError,
        ParameterException,
        NameValidationException,
    ) as error:
        raise ParameterError(_without_places(str(error))) from error


def _spin_until_stopped(
    node: Node, make_executor: Callable[[], Executor], stop: StopRequests
) -> None:
    stopped = threading.Event()
    executor: Executor | None = None

    def end_spin() -> None:
        stopped.set()
        if executor is not None:
            end_wait(executor)

    # A half-made executor complains when it is interrupted, so it is made where nothing raises.
    with stop.on_stop(end_spin):
        executor = make_executor()
        executor.add_node(node)
        try:
            spin(executor, stopped.is_set)
        finally:
            executor.shutdown()


def _without_places(text: str) -> str:
    """Drop line breaks and the places in rcl's sources: ``, at /project/src/.../x.c:352``."""
    return unwrap(re.sub(r',? at /\S+:\d+', '', text))


def run_in_thread(call: Callable[[], None], executor: Executor, name: str) -> Future:
    """
    Make a call in a new thread called ``name``; await its end, however it ends, in an async
    callback.

    The thread is a daemon: a call that never returns does not keep the process from ending.
    """
    future = Future(executor=executor)

    def run() -> None:
        try:
            call()
        finally:
            future.set_result(None)
            executor.wake()  # a task that awaits is looked at only when the executor wakes

    threading.Thread(target=run, name=name, daemon=True).start()
    return future


def destroy_node(node: Node) -> None:
    """
    Remove a node with all that it has, in a process that goes on.

    On the thread of its executor, which has let it go.
    """
    destroy_type_description_service(node)
    node.destroy_node()
