# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A signal while a verb runs callbacks: it ends the verb between two of them."""

import os
import signal
import threading
import time

import pytest
from rclpy.executors import SingleThreadedExecutor
from rclpy.experimental import EventsExecutor
from support.running_programs import PATIENCE

from amr_description.cli.session import open_session
from amr_description.ros import signals
from amr_description.ros.signals import STOP_SIGNALS, StopRequested

EXECUTORS = pytest.mark.parametrize('executor', [SingleThreadedExecutor, EventsExecutor])
SIGNALS = pytest.mark.parametrize('signum', [signal.SIGINT, signal.SIGTERM])


@pytest.fixture(autouse=True)
def handlers():
    """Undo what is for a process that ends soon: it ignores further signals."""
    before = {signum: signal.getsignal(signum) for signum in STOP_SIGNALS}
    yield
    for signum, handler in before.items():
        signal.signal(signum, handler)


@EXECUTORS
@SIGNALS
def test_a_callback_is_finished_before_the_verb_ends(executor, signum, capfd):
    calls = []

    def callback():
        calls.append('begun')
        os.kill(os.getpid(), signum)
        time.monotonic()  # where Python would handle the signal
        calls.append('done')

    with pytest.raises(StopRequested) as stopped, open_session(executor=executor) as session:
        session.node.create_timer(0.001, callback)
        session.serve()
    assert stopped.value.signum == signum
    assert calls == ['begun', 'done']
    assert 'FATAL' not in capfd.readouterr().err


@EXECUTORS
def test_a_wait_for_callbacks_ends_at_once(executor, monkeypatch):
    monkeypatch.setattr(signals, '_PATIENCE', PATIENCE)  # it is not needed
    with pytest.raises(StopRequested), open_session(executor=executor) as session:
        timer = threading.Timer(0.05, lambda: os.kill(os.getpid(), signal.SIGINT))
        timer.start()
        session.spin(lambda: False, poll=PATIENCE)


@EXECUTORS
def test_a_callback_that_does_not_return_is_interrupted(executor, capfd):
    """As one that prints into a pipe that nobody reads."""

    def callback():
        os.kill(os.getpid(), signal.SIGINT)
        threading.Event().wait(PATIENCE)
        raise AssertionError('it was not interrupted')

    with pytest.raises(KeyboardInterrupt), open_session(executor=executor) as session:
        session.node.create_timer(0.001, callback)
        session.serve()


def test_what_finishes_after_a_signal_goes_on_running_callbacks():
    served = []
    with pytest.raises(StopRequested), open_session() as session:
        session.node.create_timer(0.001, lambda: served.append(1))
        with session.finishing() as is_stopping:
            os.kill(os.getpid(), signal.SIGINT)
            session.serve(is_stopping)
            before = len(served)
            session.serve(lambda: len(served) > before)
