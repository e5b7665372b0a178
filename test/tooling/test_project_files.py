# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The files at the top that are for hosts, agents and containers: they say what is so."""

import json
import re
import subprocess

import pytest
from support.doc_pages import Page
from support.paths import ROOT
import yaml

AGENTS = Page('../AGENTS.md')
PLACEHOLDER = re.compile(r'\bOWNER\b(?!\.md)')


def tracked():
    names = subprocess.check_output(['git', 'ls-files', '-z'], cwd=ROOT, text=True)
    return [ROOT / name for name in names.split('\0') if name]


def test_each_page_of_the_documentation_is_in_llms_txt():
    text = (ROOT / 'llms.txt').read_text()
    linked = set(re.findall(r'\]\((docs/\S+\.md)\)', text))
    pages = {f'docs/{path.name}' for path in (ROOT / 'docs').glob('*.md')}
    assert linked == pages - {'docs/README.md'}


def test_each_placeholder_is_on_the_owners_list():
    listed = (ROOT / '.github' / 'OWNER.md').read_text()
    for path in tracked():
        name = path.relative_to(ROOT).as_posix()
        if name.startswith('test/') or name == '.github/OWNER.md':
            continue
        if path.suffix in {'.md', '.yml', '.yaml', '.cff', '.json', '.toml', '.xml'}:
            assert f'`{name}`' in listed or not PLACEHOLDER.search(path.read_text()), name
    for name in re.findall(r'`([\w./-]+\.(?:cff|yml|md))`', listed):
        assert name == 'release.yml' or PLACEHOLDER.search((ROOT / name).read_text()), name


def test_the_files_of_hosts_can_be_read():
    for path in (ROOT / '.github').rglob('*.yml'):
        assert yaml.safe_load(path.read_text()), path
    citation = yaml.safe_load((ROOT / 'CITATION.cff').read_text())
    version = re.search(r'<version>(.*?)</version>', (ROOT / 'package.xml').read_text())[1]
    assert (citation['cff-version'], citation['version']) == ('1.2.0', version)


def test_every_action_is_named_by_its_commit():
    for path in (ROOT / '.github' / 'workflows').glob('*.yml'):
        for used in re.findall(r'uses: (\S+.*)', path.read_text()):
            assert re.fullmatch(r'[\w./-]+@[0-9a-f]{40} # v[\d.]+', used), used


def test_the_container_has_the_versions_of_the_lock_file():
    lock = (ROOT / 'scripts' / 'requirements.lock').read_text()
    pins = (ROOT / 'docker' / 'requirements.txt').read_text().splitlines()
    for pin in pins:
        assert pin.startswith(('#', 'numpy<2')) or f'\n{pin} \\' in lock, pin
    container = json.loads((ROOT / '.devcontainer' / 'devcontainer.json').read_text())
    assert (ROOT / '.devcontainer' / container['build']['dockerfile']).is_file()
    copied = re.findall(r'^COPY (\S+)', (ROOT / 'docker' / 'Dockerfile').read_text(), re.MULTILINE)
    assert all((ROOT / path).exists() for path in copied)


def test_what_agents_are_told_is_so():
    (block,) = AGENTS.blocks('python')
    AGENTS.run(block)
    for link in re.findall(r'\]\(([^):#]+)', AGENTS.text):
        assert (ROOT / link).exists(), link


@pytest.mark.parametrize(
    'command',
    [
        ['check_urdf', 'urdf/amr.urdf', '--strict', '--json'],
        ['ros2', 'doctor', '--json'],
        ['bringup', 'status', '--json'],
    ],
    ids=' '.join,
)
def test_its_commands_print_json(command):
    assert ' '.join(command).replace('urdf/amr.urdf', 'robot.urdf') in AGENTS.text
    json.loads(subprocess.run(command, cwd=ROOT, text=True, stdout=-1, check=False).stdout)
