# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""docs/localisation.md, "Maps", and the footprint of docs/check_urdf.md, typed as they stand."""

import re

import pytest
from support import shells
from support.doc_pages import Page, ROOT

MAPS = re.search(r'^## Maps$.*?(?=^## )', Page('localisation.md').text, re.DOTALL | re.MULTILINE)[
    0
]
CHECK_URDF = Page('check_urdf.md').text


@pytest.fixture
def terminal(tmp_path):
    """A function that opens a terminal in an empty folder."""
    return lambda: shells.newcomer(f'source scripts/activate\n{MAPS}', tmp_path, folder=tmp_path)


def test_a_map_is_made_served_and_saved_again(terminal, tmp_path):
    with terminal() as shell, terminal() as server:
        printed = shell.run('ros2 run amr_description map_of_world warehouse')
        assert printed.startswith('warehouse.pgm, warehouse.yaml: 264 x 184 cells of 0.05 m')
        server.start('ros2 run nav2_map_server map_server')
        server.see('Activating')
        shell.run('ros2 run nav2_map_server map_saver_cli')
        server.interrupt()
    first, again = ((tmp_path / f'{name}.pgm').read_bytes() for name in ('warehouse', 'again'))
    assert first == again
    texts = [(tmp_path / f'{name}.yaml').read_text() for name in ('warehouse', 'again')]
    assert texts[0] == texts[1].replace('again.pgm', 'warehouse.pgm')


def test_the_map_is_published(terminal):
    with terminal() as shell:
        shell.type('ros2 run amr_description map_of_world warehouse --publish')
        shell.see('Published a map of 264 x 184 cells')
        shell.interrupt()


def test_the_footprint_is_printed_as_it_stands(tmp_path):
    block = re.search(
        r'^\$ (check_urdf --footprint .*)\n((?:.+\n)+?)```', CHECK_URDF, re.MULTILINE
    )
    with shells.newcomer('source scripts/activate\n', tmp_path, folder=ROOT) as shell:
        shell.book = block[1]
        assert shell.run('check_urdf --footprint') == block[2]
