# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""docs/bags.md, typed as it stands."""

import pytest
from support.doc_pages import Page
from support.page_lines import typed
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
