# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A page of a simulation in this process, without a browser: what it is sent, and what it asks."""

import _thread
from http.client import HTTPConnection
import itertools
import json
import math
import struct
import subprocess
import sys
import threading
from urllib.parse import urlsplit

import numpy as np
from support.page import Page

from amr_description.simulation.page_backend import SIMULATOR
from amr_description.viewer.samples import HEAD_AT, SAMPLE_KIND
from amr_description.viewer.states import HEADER_BYTES, POSE_FLOATS, STATE_KIND


class ShownPage(Page):
    """It asks without counting, and knows what its binary frames say."""

    def __init__(self, url):
        self._ids = itertools.count(1)
        super().__init__(url)

    def newest(self, kind):
        """Wait for a message of a type, and return the newest."""
        return self.wait(lambda: self.last(kind))

    def asked(self, kind, **fields):
        """Send a request; return whether it was done, and the line that says so."""
        reply = self.ask(kind, next(self._ids), **fields)
        return reply['ok'], reply['message']

    @property
    def samples(self):
        """Head and data of all samples so far."""
        found = [each for each in [*self.states] if each[0] == SAMPLE_KIND]
        ends = [HEAD_AT + struct.unpack_from('<H', each, 2)[0] for each in found]
        return [
            (json.loads(each[HEAD_AT:end]), each[end:])
            for each, end in zip(found, ends, strict=True)
        ]

    def truth(self, robot='/'):
        """Return x, y, z of a robot by the newest state, whose layout has come; NaN: not yet."""
        layouts = {each['id']: each for each in self.of('layout')}
        state = next((s for s in reversed([*self.states]) if s[0] == STATE_KIND), None)
        layout = state and layouts.get(struct.unpack_from('<H', state, 2)[0])
        if not layout:
            return (math.nan,) * 3
        floats = np.frombuffer(state, '<f4', offset=HEADER_BYTES)
        at = POSE_FLOATS * len(layout['frames'])
        for each in layout['robots']:
            begin = at + 3 * len(each['joints']) + 10
            if each['id'] == robot:
                return tuple(floats[begin : begin + 3].tolist())
            at = begin + 10 + 3
        return (math.nan,) * 3


def play(sim, page, act):
    """Let time pass while ``act`` does what a person does at a page, then press Ctrl-C."""
    found = []

    def person():
        try:
            # The state that a page is told may be that of the play before.
            page.wait(lambda: page.asked('set_factor', simulator=SIMULATOR, factor=1.0)[0])
            found.append(act())
        except BaseException as error:
            found.append(error)
        finally:
            _thread.interrupt_main()

    thread = threading.Thread(target=person)
    thread.start()
    sim.play()
    thread.join()
    if isinstance(found[0], BaseException):
        raise found[0]
    return found[0]


def request(url, **headers):
    """Return the response to a GET of an address."""
    parts = urlsplit(url)
    connection = HTTPConnection(parts.netloc, timeout=10)
    try:
        connection.request('GET', f'/?{parts.query}', headers=headers)
        return connection.getresponse()
    finally:
        connection.close()


def run(code):
    """Run a program in a process of its own; return what it prints."""
    done = subprocess.run(
        [sys.executable, '-c', code], stdout=subprocess.PIPE, check=True, text=True
    )
    return done.stdout
