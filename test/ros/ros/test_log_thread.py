# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The log of components: in order, off the caller's thread, and never without bounds."""

import threading

import pytest

from amr_description.log import Severity
from amr_description.ros import log_thread
from amr_description.ros.log_thread import LogThread


class Logger:
    """Keeps what it is told; ``is_open``: until then it takes nothing, as a terminal held up."""

    def __init__(self):
        self.texts = []
        self.is_open = threading.Event()
        self.taken = threading.Semaphore(0)

    def take(self, text):
        self.is_open.wait()
        self.texts.append(text)
        self.taken.release()

    debug = info = warning = error = fatal = take


def test_lines_come_in_the_order_in_which_they_were_said():
    logger, logs = Logger(), LogThread()
    logger.is_open.set()
    log = logs.log_of(logger)
    for number in range(100):
        log(Severity.INFO, f'line {number}')
    logs.stop()
    assert logger.texts == [f'line {number}' for number in range(100)]


@pytest.mark.parametrize(
    ('said', 'text'), [('port \udcff', r'port \udcff'), (None, 'None'), ('µ\n', 'µ\n')]
)
def test_whatever_is_said_the_lines_behind_it_come_too(said, text):
    logger, logs = Logger(), LogThread()
    logger.is_open.set()
    log = logs.log_of(logger)
    log(Severity.ERROR, said)
    log(Severity.INFO, 'and on')
    logs.stop()
    assert logger.texts == [text, 'and on']


def test_a_storm_is_cut_short_and_that_is_said(monkeypatch):
    monkeypatch.setattr(log_thread, '_MOST_WAITING', 10)
    logger, logs = Logger(), LogThread()
    log = logs.log_of(logger)
    for number in range(1000):
        log(Severity.INFO, f'line {number}')
    logger.is_open.set()
    for _ in range(10):
        assert logger.taken.acquire(timeout=10.0)
    log(Severity.INFO, 'behind the storm')
    logs.stop()
    kept = [text for text in logger.texts if text.startswith('line')]
    assert kept == [f'line {number}' for number in range(len(kept))]
    assert 10 <= len(kept) <= 11  # one may be with the thread already
    assert logger.texts[-2:] == [
        f'{1000 - len(kept)} lines of the log were dropped: more is said than can be written',
        'behind the storm',
    ]


def test_a_terminal_that_takes_nothing_does_not_keep_the_process_from_ending(monkeypatch):
    monkeypatch.setattr(log_thread, '_STOP_TIMEOUT', 0.01)
    logger, logs = Logger(), LogThread()
    logs.log_of(logger)(Severity.INFO, 'never written')
    logs.stop()
    assert logger.texts == []
    logger.is_open.set()
