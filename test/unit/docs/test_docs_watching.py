# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""docs/stacks.md: its commands exist, its events are those of the code."""

import json
import re

from support.doc_pages import Page, ROOT

from amr_description.bringup import run_log
from amr_description.bringup.run_commands import COMMANDS
from amr_description.bringup.stacks import STACKS

PAGE, EVENTS = Page('stacks.md'), Page('api/events.md')


def events_of_page():
    """Event → the words of its row that may be keys."""
    rows = re.findall(r'^\| `(\w+)` \| (.*) \|$', EVENTS.text, re.MULTILINE)
    keys_of = {event: set(re.findall(r'`(\w+)`', keys)) for event, keys in rows}
    del keys_of['event']  # the head of the table
    return keys_of


def test_the_events_are_those_that_the_code_notes():
    folder = ROOT / 'amr_description/bringup'
    code = (folder / 'reporter.py').read_text() + (folder / 'main.py').read_text()
    noted = re.findall(r"note\(\s*'(\w+)'((?:[^()]|\([^()]*\))*)\)", code)
    assert {event for event, _ in noted} == events_of_page().keys()
    for event, arguments in noted:
        assert set(re.findall(r'\b([a-z_]+)=', arguments)) <= events_of_page()[event]


def test_the_page_and_the_module_name_the_same_events():
    documented = re.findall(r'^``(\w+)`` ', run_log.__doc__.split('event  ')[-1], re.MULTILINE)
    assert set(documented) == events_of_page().keys()


def test_the_example_is_a_line_of_the_file():
    (block,) = PAGE.blocks('json')
    event = json.loads(block)
    assert list(event) == ['time', 'since_start', 'event', 'node', 'pid']
    assert set(event) - {'time', 'since_start', 'event', 'node'} <= events_of_page()['started']


def test_the_commands_are_there():
    words = re.findall(r'bringup (status|stop)\b', PAGE.text)
    assert set(words) == COMMANDS.keys()
    assert set(re.findall(r'ros2 launch amr_description (\w+)', PAGE.text)) <= STACKS.keys()
