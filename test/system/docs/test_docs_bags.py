# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""docs/bags.md, typed as it stands."""

from contextlib import ExitStack
import signal

import pytest
from support.doc_pages import Page
from support.page_lines import command, typed
from support.running_programs import Program
from support.small_bags import LATCHED, topic, write_bag

PAGE = Page('bags.md')


@pytest.fixture(scope='module')
def folder(tmp_path_factory):
    """A folder with my_bag."""
    made = tmp_path_factory.mktemp('bags')
    topics = [topic('/scan'), topic('/robot_description', LATCHED)]
    texts = [(0, '/robot_description', 'robot'), *((n * 100, '/scan', 'x') for n in range(15))]
    write_bag(made / 'my_bag', topics, texts)
    return made


@pytest.mark.parametrize(
    'beginning',
    [
        'ros2 bag play my_bag',
        'ros2 bag play my_bag --rate 4',
        'ros2 bag play my_bag --topics /scan',
        'ros2 bag burst my_bag',
    ],
)
def test_a_bag_is_played(folder, beginning):
    typed(PAGE, beginning, folder)


def test_recordings_begin_and_end(folder):
    lines = (
        'ros2 bag record --topics /scan',
        'ros2 bag record --all',
        'ros2 bag record --regex',
    )
    with ExitStack() as stack:
        programs = [
            stack.enter_context(Program(*command(PAGE, line), cwd=folder)) for line in lines
        ]
        for program in programs:
            program.expect('Recording...')
        for program in programs:
            program.signal(signal.SIGINT)
        assert [program.end() for program in programs] == [0, 0, 0]
    assert (folder / 'drive' / 'metadata.yaml').exists()


def test_a_bag_is_looked_at(folder):
    assert 'Messages:          16\n' in typed(PAGE, 'ros2 bag info my_bag', folder)
    assert 'Size Contribution' in typed(PAGE, 'ros2 bag info my_bag --verbose', folder)
    assert typed(PAGE, 'ros2 bag reindex my_bag', folder) == ''
