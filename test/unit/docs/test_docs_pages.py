# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Every page of the documentation: its links, its commands and its examples are there."""

import inspect
import re

import pytest
from support.animation import chunks, size_of
from support.doc_pages import Page, ROOT
from support.paths import EXECUTABLES

from amr_description.bringup.stacks import STACKS
from amr_description.registry import resolve
from amr_description.sim.world_file import load_world

FRONT, INDEX, CONTRIBUTING = '../README.md', 'README.md', '../CONTRIBUTING.md'
NAMES = [FRONT, CONTRIBUTING, *sorted(path.name for path in (ROOT / 'docs').glob('*.md'))]
PAGES = pytest.mark.parametrize('page', [*map(Page, NAMES)], ids=NAMES)
GLOSSARY = Page('glossary.md')
MESSAGES = {'troubleshooting.md': '## Messages', 'set_up_fails.md': '## What it says'}


def anchors(path):
    """The anchors of the headings of a page, as GitHub makes them."""
    headings = re.findall(r'^#+ (.*)$', path.read_text(), re.MULTILINE)
    return {re.sub(r'[^\w\- ]', '', text.lower()).replace(' ', '-') for text in headings}


@PAGES
def test_links_lead_somewhere(page):
    links = re.findall(r'\]\(([^)\s]+)\)', page.text)
    for link in links:
        if link.startswith('https://'):
            continue
        file, _, anchor = link.partition('#')
        target = (page.path.parent / file).resolve() if file else page.path.resolve()
        assert target.exists(), link
        assert not anchor or anchor in anchors(target), link
    assert links


@PAGES
def test_commands_are_there(page):
    assert set(re.findall(r'ros2 run amr_description (\w+)', page.text)) <= {*EXECUTABLES, 'NAME'}
    for line in re.findall(r'(?:ros2 launch amr_description|scripts/run) ([a-z].*)', page.text):
        name, *words = line.strip('`.,;)(').replace('`', ' ').split()
        name = {'gazebo.launch.py': 'simulation', 'display.launch.py': 'display'}.get(name, name)
        if ':=' in name:
            name, words = 'simulation', [name, *words]
        assert name in STACKS, line
        known = inspect.signature(resolve(STACKS[name])).parameters
        given = {word.partition(':=')[0] for word in words if re.match(r'\w+:=', word)}
        assert given <= known.keys(), line
    for name in re.findall(r'(?<![\w./])scripts/([\w.]*\w)', page.text):
        assert (ROOT / 'scripts' / name).exists(), name


def test_the_index_names_every_page():
    index = Page(INDEX).text
    assert [name for name in NAMES if name != INDEX and f']({name})' not in index] == [FRONT]


def test_the_front_page_is_one():
    text = Page(FRONT).text
    assert text.count('\n') <= 116
    assert text.index('scripts/run ') < text.index('scripts/test ') < text.index('## Drive it')
    assert 'What is not here' in text
    first_screen = text[: text.index('## ')]
    doors = (
        '[learn](#learn)',
        '[my robot](#my-robot)',
        '[CI](#ci)',
        'a course',
        'on Linux',
        'without ROS',
        'docs/images/',
        'scripts/test ',
    )
    assert [each for each in doors if each not in first_screen] == []
    assert first_screen.count('\n') <= 30


def test_the_picture_moves():
    file = (ROOT / 'docs/images/driving.webp').read_bytes()
    assert len(file) <= 1_000_000
    assert size_of(file) == (1100, 640)
    assert sum(name == b'ANMF' for name, _ in chunks(file)) > 20


@pytest.mark.parametrize('name', ['your_own_package.md', 'your_own_robot.md', 'ci.md', FRONT])
def test_what_is_shown_of_an_example_is_in_it(name):
    files = [path for path in (ROOT / 'examples').rglob('*') if path.is_file()]
    text = ''.join(path.read_text() for path in files)
    kinds = ('yaml',) if name == FRONT else ('python', 'text', 'xml', 'yaml')
    shown = [block for kind in kinds for block in Page(name).blocks(kind)]
    assert shown
    assert [block for block in shown if block not in text] == []


def test_the_world_of_the_page_is_one(tmp_path):
    (block,) = Page('simulator.md').blocks('xml')
    (tmp_path / 'my_world.xml').write_text(block)
    world = load_world(str(tmp_path / 'my_world.xml')).compile()
    assert world.body('ball').id > 0
    assert world.geom('box').id > 0


def test_the_glossary_is_used_and_in_order():
    entries = re.findall(r'^## (.*)$', GLOSSARY.text, re.MULTILINE)
    assert entries == sorted(entries, key=str.lower)
    texts = ''.join(Page(name).text for name in NAMES)
    unused = {each for each in anchors(GLOSSARY.path) if f'glossary.md#{each})' not in texts}
    assert unused == {'glossary'}


# Pages for readers who may not know the words.
FOR_NEWCOMERS = [FRONT, 'tutorial.md', 'your_own_robot.md', 'simulator.md', 'install.md']
WORDS = {
    'MJCF': 'mjcf', r'TF\b(?! tree)': 'tf', 'QoS': 'qos', 'type hash': 'type-hash',
    r'\brtf\b(?!:)': 'real-time-factor', r'\bscrub': 'scrub', 'claimed': 'claimed',
    r'(?<!`)STRICT': 'strict-best_effort', '[Ff]allback': 'fallback',
}  # fmt: skip


@pytest.mark.parametrize('name', [*FOR_NEWCOMERS, 'ros2_control.md', 'ci.md', 'ros2_command.md'])
def test_a_word_is_explained_where_it_first_stands(name):
    page = Page(name)
    prose = re.sub(r'```.*?```|`[^`\n]*`', '', page.text, flags=re.DOTALL)
    for word, anchor in WORDS.items():
        if re.search(word, prose):
            assert f'glossary.md#{anchor})' in prose, word


@pytest.mark.parametrize(('name', 'head'), MESSAGES.items(), ids=MESSAGES)
def test_messages_are_those_of_the_code(name, head):
    code = ''.join(
        path.read_text()
        for folder in ('amr_description', 'scripts')
        for path in (ROOT / folder).rglob('*')
        if path.suffix in ('.py', '') and path.is_file()
    )
    table = Page(name).text.partition(head)[2].partition('## ')[0]
    messages = re.findall(r'^\| `(.*?)`', table, re.MULTILINE)
    assert len(messages) > 6
    parts = [part.strip() for each in messages for part in each.split('…')]
    assert [part for part in parts if part not in code] == []


@pytest.mark.parametrize('name', [name for name in NAMES if '/' not in name])
def test_a_sentence_is_one_thought(name):
    """It has at most twenty words; a piece of code counts as one."""
    text = re.sub(r'^```.*?^```$|^\|.*?$|^#.*?$', '', Page(name).text, flags=re.S | re.M)
    text = re.sub(r'`[^`]*`', 'code', re.sub(r'\]\([^)]*\)', ']', text))
    sentences = [
        ' '.join(sentence.split())
        for paragraph in re.split(r'\n\s*\n|\n(?=- |\d\. )', text)
        for sentence in re.split(r'(?<=[.!?:])\**\s+(?=[A-Z\[*(]|code)', paragraph)
    ]
    long = [each for each in sentences if len(re.findall(r'\S*\w\S*', each)) > 20]
    assert long == []
