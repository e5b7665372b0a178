# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What counts as waiting, and what does not."""

from types import SimpleNamespace

import pytest

from amr_description.ros import wait_clock


@pytest.mark.parametrize(
    ('took', 'worked', 'counted'),
    [(0.02, 0.0, 0.02), (0.3, 0.0, 0.02), (0.3, 0.1, 0.12), (0.01, 0.01, 0.01)],
)
def test_time_in_which_a_verb_cannot_run_is_not_waited(monkeypatch, took, worked, counted):
    """s; it waits for 0.02 s at most, and what its callbacks compute is time that passes."""
    now = {'wall': 5.0, 'processor': 1.0}
    fake = SimpleNamespace(monotonic=lambda: now['wall'], thread_time=lambda: now['processor'])
    monkeypatch.setattr(wait_clock, 'time', fake)
    clock = wait_clock.WaitClock()
    began = clock.now()

    def wait(_timeout):
        now['wall'] += took
        now['processor'] += worked

    for _ in range(2):
        clock.wait(0.02, wait)
    assert clock.now() - began == pytest.approx(2 * counted)
