# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""PublishGate: which updates publish, if fewer than all."""

import pytest
from support.control_fakes import VECTORS

from amr_description.clock import NANOSECONDS
from amr_description.controllers.drives.diff_drive_controller import PublishGate

SCHEDULES = [
    (name, [int(number) for number in name.removeprefix('update').split('_pub')], indices)
    for name, indices in VECTORS['publish_gate'].items()
    if name.startswith('update')
]


def passing(gate, period, count, start=0):
    return [i for i in range(count) if gate.passes(start + i * period)]


@pytest.mark.parametrize(('name', 'rates', 'indices'), SCHEDULES)
@pytest.mark.parametrize('start', [0, 1_001_190_000_000])
def test_schedules(name, rates, indices, start):
    update_rate, publish_rate = rates
    gate = PublishGate(int(NANOSECONDS / publish_rate))
    period = NANOSECONDS // update_rate
    assert passing(gate, period, indices[-1] + 1, start) == indices


def test_in_the_long_run_the_rate_is_the_one_asked_for():
    gate = PublishGate(NANOSECONDS // 50)
    assert len(passing(gate, NANOSECONDS // 1000, 100_000)) == 5000


def test_after_a_gap_it_catches_up_at_every_update():
    gate = PublishGate(20)
    assert gate.passes(0)
    assert passing(gate, 10, 12, start=100) == [0, 1, 2, 3, 4, 5, 6, 7, 9, 11]


def test_after_a_reset_the_next_update_passes_even_if_time_went_back():
    gate = PublishGate(20)
    assert gate.passes(1000)
    assert not gate.passes(5)
    gate.reset()
    assert gate.passes(5)
    assert not gate.passes(25)
    assert gate.passes(26)
