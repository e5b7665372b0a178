# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A page that plots fields of a frequent topic: its memory is all taken in the first seconds."""

import numpy as np
import pytest
from test_page_memory import LongDrive
from test_viewer_pages import serving

from amr_description.viewer.protocol import Origin, Values
from amr_description.viewer.samples import encode_sample, Sample

TOPIC = '/joint_states'
PATHS = tuple(f'position[{index}]' for index in range(10))
RATE = 100  # Hz
FIRST, ALL = 30, 200  # states, one every 2 s
KEPT = 300 * RATE * len(PATHS)
MOST_GROWTH = 400_000
"""Bytes. Ten fields of 200 s are 3 MB."""


class PlottedDrive(LongDrive):
    """And ten numbers of a topic, for those who plot them."""

    def __init__(self):
        super().__init__()
        self.are_wanted = False
        self.sent = 0

    def watch(self, watched):
        self.are_wanted = TOPIC in watched.fields

    def take_samples(self, _):
        numbers = np.arange(self.sent, int(self.time * RATE))
        if not self.are_wanted or not len(numbers):
            return []
        stamps = numbers / RATE
        columns = [np.sin(stamps + index) for index in range(len(PATHS))]
        origin = Origin(TOPIC, '', float(stamps[-1]), RATE)
        head = Values(origin, PATHS, len(stamps), self.sent, {})
        self.sent += len(numbers)
        return [Sample(TOPIC, encode_sample(head, [stamps, *columns]), 'values')]


@pytest.mark.long
def test_what_is_plotted_takes_its_memory_at_once(browser):
    drive = PlottedDrive()
    plots = ','.join(f'{TOPIC}:{path}' for path in PATHS)
    with serving(drive, rate=30.0) as server:
        page = browser.open(f'{server.url}#plots=linear;{plots}', width=800, height=600)
        page.wait_until("amr.now.link === 'open' && amr.now.scene.frames > 0")
        drive.show(page, FIRST)
        page.wait_until(f'amr.now.samples >= {FIRST * RATE * len(PATHS)}')
        assert page.evaluate('amr.now.samples') < KEPT / 2
        before = page.held_bytes()
        drive.show(page, ALL)
        page.wait_until(f'amr.now.samples >= {KEPT}')
        after = page.held_bytes()
        page.close()
    assert after - before < MOST_GROWTH
    assert page.errors == []
