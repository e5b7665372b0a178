# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What happens in a run, one event a line, for programs: ``events.jsonl`` in its log folder.

Each line is a JSON object that is on disk, or with the kernel, as soon as the event was:

=============== ==========================================================================
``time``        s since 1970 by the clock of the machine
``since_start`` s since the start of the run; never goes back
``event``       one of those below
``node``        its name on the screen, ``create-3``; not in events of the whole run
=============== ==========================================================================

================== =================================== ======================================
event              of                                  more keys
================== =================================== ======================================
``begun``          the run                             ``stack``, ``run``, ``pid``, ``domain``,
                                                       ``log_folder``
``waiting``        a node, at the begin                ``condition`` in words; ``null``: none
``condition_held`` a node                              ``condition``
``started``        a node                              ``pid``
``not_started``    a node                              ``reason``
``exited``         a node                              ``pid``, ``exit_code`` or ``signal``
``respawn``        a node that is to be started again  in ``seconds``; ``restarts`` in a row
``never``          a node that can never start         ``condition``
``ready``          the run                             ``seconds`` it took
``never_ready``    the run, which goes on              ``condition`` that it lacks
``stop_requested`` the run                             ``signal``
``shutdown``       the run, which a handler stops      ``reason``
``signal_sent``    a node                              ``pid``, ``signal``
``failure``        the node that stopped the run       ``reason``
``stopped``        the run, last of all                ``exit_code``
================== =================================== ======================================

Signals are names, ``SIGINT``; more keys and events may come.
"""

from collections.abc import Callable, Mapping
import json
import time

FILE = 'events.jsonl'

type Event = Mapping[str, object]


class EventLog:
    """Hands each event to those who keep it, in their order."""

    def __init__(self, *listeners: Callable[[Event], None]) -> None:
        """``listeners``: called with each event, at once."""
        self._listeners = listeners
        self._begin = time.monotonic()

    def note(self, event: str, node: str | None = None, **more: object) -> None:
        """Note that something has happened just now."""
        entry = {
            'time': round(time.time(), 6),
            'since_start': round(time.monotonic() - self._begin, 6),
            'event': event,
            **({} if node is None else {'node': node}),
            **more,
        }
        for listener in self._listeners:
            listener(entry)


def json_line(event: Event) -> str:
    """Return the line of the file for an event."""
    return json.dumps(event, ensure_ascii=False)
