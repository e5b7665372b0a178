# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The lock file: complete, installed, and with the pins that must not move."""

from importlib.metadata import distributions
from pathlib import Path
import re
import sys
import sysconfig

from environment import SetupError
from environment.locks import (
    canonical,
    parse,
    Pin,
    pinned_versions,
    pins_of,
    PYTHONS,
    WITHOUT_HASHES,
)
import pytest
from support.paths import ROOT

LOCK = (ROOT / 'scripts' / 'requirements.lock').read_text()
IN_PIP_UNDERLAY = Path(sys.prefix) == ROOT / '.venv'
pytestmark = pytest.mark.skipif(not IN_PIP_UNDERLAY, reason='needs .venv')


PINNED = {canonical(name): version for name, version in pinned_versions(LOCK).items()}
LEFT_OUT = {canonical(name) for name in re.findall(r'^# without (\S+)$', LOCK, re.MULTILINE)}


def installed():
    """
    Distributions by name; the ROS wheels carry a second, older record beside their own.

    An old pip leaves only such a one of what it has built from sources.
    """
    found = [*distributions(path=[sysconfig.get_path('purelib')])]
    found.sort(key=lambda each: each._path.name.endswith('.dist-info'))
    return {canonical(each.metadata['Name']): each for each in found}


def required(name, found, extras=frozenset()):
    """Yield (name, extras) of all that a distribution requires here, given its own extras."""
    from packaging.requirements import Requirement

    for text in found[name].requires or ():
        requirement = Requirement(text)
        marker = requirement.marker
        if not marker or any(marker.evaluate({'extra': extra}) for extra in extras | {''}):
            yield canonical(requirement.name), frozenset(requirement.extras)


def test_what_is_locked_is_installed():
    versions = {name: found.version for name, found in installed().items()}
    assert {name: versions.get(name) for name in PINNED} == PINNED
    assert 'amr-description-interfaces' in versions


def test_lock_is_closed_but_for_what_it_leaves_out():
    found = installed()
    missing, seen, pending = set(), set(), [(name, frozenset()) for name in PINNED]
    while pending:
        name, extras = pending.pop()
        if name not in found:
            missing.add(name)
        elif (name, extras) not in seen:
            seen.add((name, extras))
            pending += required(name, found, extras)
    assert missing == LEFT_OUT


def test_pins_that_keep_things_working():
    # From 72 on `colcon test` runs no test of a package of Jazzy (test_stock_package.py); from 80
    # on `colcon build --symlink-install` copies.
    assert int(PINNED['setuptools'].split('.')[0]) < 72
    # Later ones belong to later distributions, and mix without a word.
    assert PINNED['ros-jazzy-rclpy'].startswith('7.1.')
    assert PINNED['ros-jazzy-common-interfaces'].startswith('5.3.')
    assert PINNED['ros-rmw-fastrtps-cpp'].startswith('8.4.')
    assert PINNED['ros-fastrtps'].startswith('2.14.')


def test_a_line_that_pins_nothing_is_refused():
    with pytest.raises(SetupError, match=r"requirements.lock:2: want one NAME==VERSION, .*'b>=2'"):
        pinned_versions('a==1\nb>=2  # no\n')
    with pytest.raises(SetupError, match=r'want one version of a, got two'):
        pinned_versions('a==1\na==2\n')
    with pytest.raises(SetupError, match=r"requirements.lock:1: .*'a==1 ; os_name"):
        pinned_versions('a==1 ; os_name == "posix"\n')


def test_a_marker_chooses_the_pythons_that_a_line_is_for():
    lock = 'a==1 ; python_version < "3.12"\na==2 ; python_version >= "3.12"  # newer\nb==3\n'
    assert pinned_versions(lock, (3, 11)) == {'a': '1', 'b': '3'}
    assert pinned_versions(lock, (3, 12)) == pinned_versions(lock, (3, 14)) == {'a': '2', 'b': '3'}


def test_what_is_written_is_what_was_read():
    lines = [each if isinstance(each, str) else each.text() for each in parse(LOCK)]
    assert '\n'.join([*lines, '']) == LOCK


LOCKS = {path.name for path in (ROOT / 'scripts').glob('*.lock')} - {*WITHOUT_HASHES}


@pytest.mark.parametrize('name', sorted(LOCKS))
def test_every_package_has_hashes_for_every_python(name):
    lock = (ROOT / 'scripts' / name).read_text()
    assert all(pin.hashes for pin in parse(lock) if isinstance(pin, Pin))
    for python in PYTHONS:
        assert pins_of(lock, python)


def test_developers_lock_pins_what_the_other_one_does_not_have_or_the_same():
    pinned = pinned_versions((ROOT / 'scripts' / 'developers.lock').read_text())
    assert 'mypy' in pinned
    both = {canonical(name): version for name, version in pinned.items()}
    assert {name: PINNED.get(name, version) for name, version in both.items()} == both


def test_the_actions_of_others_are_pinned_to_commits():
    """A tag can be moved to other code; the version is for who reads it."""
    used = [
        line.strip().removeprefix('- ')
        for path in sorted((ROOT / '.github' / 'workflows').glob('*.yml'))
        for line in path.read_text(encoding='utf-8').splitlines()
        if line.strip().removeprefix('- ').startswith('uses:')
    ]
    assert used
    pinned = re.compile(r'uses: [\w.-]+/[\w./-]+@[0-9a-f]{40} # v\d+\.\d+\.\d+')
    assert [each for each in used if not pinned.fullmatch(each)] == []
    versions = {each.split('@')[0]: set() for each in used}
    for each in used:
        versions[each.split('@')[0]].add(each)
    assert {len(each) for each in versions.values()} == {1}, 'one version of each'
