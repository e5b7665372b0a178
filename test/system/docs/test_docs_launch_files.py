# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""docs/launch_files.md: its two files, written, and its lines, typed."""

import importlib
import inspect
import re

import pytest
from support import shells
from support.doc_pages import Page

from amr_description.launch_api.modules import UNDERSTOOD

PAGE = Page('launch_files.md')


@pytest.fixture
def folder(tmp_path):
    (tmp_path / 'pair.launch.py').write_text(PAGE.blocks('python')[0])
    (tmp_path / 'listener.launch.xml').write_text(PAGE.blocks('xml')[0])
    return tmp_path


def test_its_lines_do_what_it_says(folder):
    with shells.newcomer(f'source scripts/activate\n{PAGE.text}', folder, folder=folder) as shell:
        assert "        Their namespace.\n        (default: 'left')" in shell.run(
            'ros2 launch pair.launch.py --show'
        )
        printed = shell.run('ros2 launch pair.launch.py --print')
        assert 'talker-1: at once' in printed
        assert 'listener' not in printed
        assert '-r __ns:=/right' in shell.run('ros2 launch listener.launch.xml')
        shell.start('ros2 launch pair.launch.py side')
        shell.see(
            r'demo_nodes_py talker \(demo_talker\), demo_nodes_py listener \(demo_listener\)'
        )
        shell.see(r'\[launch.user\]: talks on the right')
        shell.see(r'\[right.listener\]: I heard: \[Hello World: \d+\]')
        shell.interrupt()


def test_its_test_passes_by_both_commands(tmp_path):
    (tmp_path / 'test_talker.py').write_text(PAGE.blocks('python')[1])
    with shells.newcomer(
        f'source scripts/activate\n{PAGE.text}', tmp_path, folder=tmp_path
    ) as shell:
        assert 'test_it_ended_well' in shell.run('launch_test test_talker.py')
        assert '1 passed' in shell.run('python -m pytest test_talker.py')


def test_the_names_on_the_page_are_understood():
    text = PAGE.text.partition('## What is understood')[2].partition('Whatever else')[0]
    importlib.import_module('controller_manager.launch_utils')
    known = {name for names in UNDERSTOOD.values() for name in names}
    processes = UNDERSTOOD['launch.actions']['ExecuteProcess']
    known |= {
        'autostart',
        'controller_manager.launch_utils',
        *inspect.signature(processes.__init__).parameters,
    }
    named = {*re.findall(r'`([^`]+)`', text)}
    assert {'Node', 'ComposableNode'} <= named <= known
