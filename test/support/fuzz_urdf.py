# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Mutated robot descriptions, and what must hold for each: findings come out, and nothing else.

``scripts/fuzz_urdf --count 20000`` runs many, ``test_fuzz_urdf.py`` a few. A seed gives the same
mutation on every machine.
"""

import argparse
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
import json
import math
import random
import re
import signal
import time

from lxml import etree
from support.paths import ROOT

from amr_description.cli.check_urdf import exit_code
from amr_description.cli.urdf_report import refusal, to_json, tree_lines
from amr_description.controllers.checks.drive_files import read_drives
from amr_description.errors import AmrError
from amr_description.model import checks, kinematics, urdf
from amr_description.model.checks.context import CheckInputs
from amr_description.model.ros2_control_tag import hardware_of
from amr_description.sim.drop_test import drop_test

FIXTURES = ROOT / 'test/fixtures'
GOOD = [
    path.read_text()
    for path in (
        ROOT / 'urdf/amr.urdf',
        FIXTURES / 'tutorial/amr.urdf',
        FIXTURES / 'urdf/arm.urdf',
        *sorted((FIXTURES / 'urdf_good').glob('*.urdf')),
    )
]
BROKEN = [path.read_text() for path in sorted((FIXTURES / 'urdf_broken').glob('*.urdf'))]
DRIVES = read_drives(str(ROOT / 'config/controllers.yaml'))
FINDING = re.compile(r'(error|warning): \S+:[1-9]\d*: \S.*')
LONGEST = 10
"""s; whoever takes longer over one description hangs."""

NASTY = (
    '', ' ', '0', '-1', '1e-300', '1e300', '-1e308', '1e400', 'nan', 'inf', '0x10', '1,5', '1 2',
    '0 0 0', '1e300 1e300 1e300', '1e-300 0 0', 'true', 'world', '/', '..', 'package://', '//[',
    'file://', '\u0661', '\U0001f916', 'a' * 300, '${x}', '%s{}', 'fixed', 'floating', 'planar',
)  # fmt: skip


def mutation(seed: int) -> str:
    """Return the description of a seed: some robot, changed in one to three places."""
    chance = random.Random(seed)
    text = chance.choice(chance.choice((GOOD, GOOD, BROKEN)))
    # A changed text is seldom XML; most faults are to be found behind that door.
    change = chance.choices((_change_tree, _change_text), (5, 1))[0]
    for _ in range(chance.randrange(1, 4)):
        text = change(text, chance)
    return text


def _change_text(text: str, chance: random.Random) -> str:
    """Delete, double or replace a slice."""
    if not text:
        return chance.choice(GOOD)
    start = chance.randrange(len(text))
    end = min(len(text), start + int(math.exp(chance.uniform(0.0, 6.0))))
    other = chance.randrange(len(text))
    rubbish = chance.choice(('', '"', '<', '0', '-1e308', 'nan', text[other : other + 40]))
    piece = chance.choice((rubbish, text[start:end] * 2))
    return text[:start] + piece + text[end:]


def _change_tree(text: str, chance: random.Random) -> str:
    """Change an element or an attribute; a text that is no XML any more stays."""
    try:
        parser = etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=False)
        root = etree.fromstring(text.encode(), parser)
    except (etree.XMLSyntaxError, UnicodeEncodeError):
        return text
    elements = list(root.iter(etree.Element))
    element, other = chance.choice(elements), chance.choice(elements)
    attributes = [(each, name) for each in elements for name in each.attrib]
    try:
        match chance.randrange(7):
            case 0 if element is not root:
                element.getparent().remove(element)
            case 1:
                other.append(etree.fromstring(etree.tostring(element, with_tail=False)))
            case 2:
                element.tag = other.tag
            case 3:
                element.attrib[chance.choice(attributes)[1]] = chance.choice(NASTY)
            case 4:
                where, name = chance.choice(attributes)
                where.attrib[name] = chance.choice(NASTY)
            case 5:
                where, name = chance.choice(attributes)
                whence, its_name = chance.choice(attributes)
                where.attrib[name] = whence.attrib[its_name]
            case _:
                where, name = chance.choice(attributes)
                del where.attrib[name]
    except (ValueError, IndexError):  # lxml takes no such name or value; no attribute is left
        return text
    return etree.tostring(root, encoding='unicode')


def judge(text: str, *, drop: bool = False) -> int:
    """
    Check a description all the way, and see that the result holds together; return the exit code.

    ``drop``: drop it, too, if it is sound.
    """
    drives = DRIVES if DRIVES[0].left_wheels[0] in text else ()
    beside = CheckInputs(file_exists=lambda uri: 'wedge' in uri, drives=drives)
    examination = checks.examine(text, 'f', beside)
    for finding in examination.findings:
        assert FINDING.fullmatch(str(finding)), str(finding)
    code = exit_code(examination, None, strict=False)
    told = json.loads(to_json('f', examination, None, code))
    assert told['exit_code'] == code
    assert len(told['findings']) == len(examination.findings)
    if code == 255:
        assert refusal(examination).endswith('ERROR: Model Parsing the xml failed')
    elif examination.robot is not None:
        assert tree_lines(examination.robot)[0].startswith('robot name is: ')
    if not checks.examine(text, 'f').errors:
        robot = urdf.parse(text, 'f')
        assert len(kinematics.link_poses(robot)) == len(robot.links)
        assert hardware_of(robot) == hardware_of(examination.robot)
        if drop:
            _drop(robot)
    return code


def _drop(robot: urdf.Robot) -> None:
    """Drop a sound robot; it may fail, or be refused in a line, but nothing else."""
    try:
        report = drop_test(robot)
    except AmrError as error:
        assert '\n' not in str(error)
        return
    assert all(line and '\n' not in line for line in report.failures)


@contextmanager
def bounded(seconds: int) -> Iterator[None]:
    """Raise TimeoutError out of what takes longer."""

    def stop(*_: object) -> None:
        raise TimeoutError(f'still at it after {seconds} s')

    before = signal.signal(signal.SIGALRM, stop)
    signal.alarm(seconds)
    try:
        yield
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, before)


def main() -> int:
    """Judge mutations from the command line; 1 when one of them breaks the checker."""
    parser = argparse.ArgumentParser(description='Check mutated robot descriptions.')
    parser.add_argument('--count', type=int, default=20_000)
    parser.add_argument('--seed', type=int, default=0, help='of the first mutation')
    parser.add_argument('--drop-every', type=int, default=50, metavar='N', help='0: drop none')
    arguments = parser.parse_args()
    codes: Counter[int] = Counter()
    broken, slowest, start = [], 0.0, time.perf_counter()
    for seed in range(arguments.seed, arguments.seed + arguments.count):
        begin = time.perf_counter()
        drop = bool(arguments.drop_every) and seed % arguments.drop_every == 0
        try:
            with bounded(LONGEST):
                codes[judge(mutation(seed), drop=drop)] += 1
        except Exception as error:  # what is looked for
            broken.append(seed)
            print(f'seed {seed}: {type(error).__name__}: {error}')
        slowest = max(slowest, time.perf_counter() - begin)
    seconds = time.perf_counter() - start
    print(
        f'{arguments.count} descriptions in {seconds:.0f} s, the slowest {slowest:.2f} s; exit '
        f'codes {dict(sorted(codes.items()))}; broken {len(broken)}: {broken[:20]}'
    )
    return 1 if broken else 0


if __name__ == '__main__':
    raise SystemExit(main())
