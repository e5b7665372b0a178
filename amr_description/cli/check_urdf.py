# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``check_urdf FILE``: print the tree of a robot description, and what is wrong with it.

The tree on stdout and the refusals on stderr are those of urdfdom 4.0.2, so that scripts made for
it go on working. Where urdfdom names a line of its own C++ code, the line of the file stands. All
findings follow on stderr, one a line: ``error|warning: file:line: what, found, expected, fix``.

Exit code:

==== ==========================================================================================
0    sound; there may be warnings
255  urdfdom refuses it, too: not readable, no XML, no tree, a malformed joint
1    urdfdom would let it pass, tree and all, but it cannot be used: a link without mass, a circle
     of joints, a ``<ros2_control>`` joint that does not exist …
==== ==========================================================================================
"""

import argparse
import sys

from amr_description.errors import DescriptionError
from amr_description.model.checks import Examination, examine
from amr_description.model.findings import Finding, one_line
from amr_description.model.robot import Robot
from amr_description.model.xml_source import read_file, read_stream

OK = 0
UNUSABLE = 1
REFUSED_BY_URDFDOM = 255

_NO_ARGUMENT = 'Expect URDF xml file to parse. Use - for stdin'
_REFUSED = 'ERROR: Model Parsing the xml failed'
# A file may hold a fault per element; nobody reads more of them.
_SHOWN_FINDINGS = 100
# Levels of the tree that are indented: a made-up chain of 60,000 links would print gigabytes.
_INDENTED_LEVELS = 100


def main(argv: list[str]) -> int:
    """Run the command with the arguments after its name; return the exit code."""
    arguments = _parser().parse_args(argv)
    if arguments.file is None:
        print(_NO_ARGUMENT, file=sys.stderr)
        return REFUSED_BY_URDFDOM
    try:
        text, source = _read(arguments.file)
    except DescriptionError as error:
        print(f'error: {one_line(str(error))}', file=sys.stderr)
        return REFUSED_BY_URDFDOM
    examination = examine(text, source)
    code = _exit_code(examination)
    if code == REFUSED_BY_URDFDOM:
        print(_refusal(examination), file=sys.stderr)
    elif examination.robot is not None:
        print('\n'.join(tree_lines(examination.robot)), flush=True)
    _print_findings(examination.findings)
    return code


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog='check_urdf',
        description='Print the tree of a robot description, and what is wrong with it.',
        epilog='Exit code: 0 sound, 255 urdfdom refuses it, too, 1 it passes urdfdom, unusable.',
    )
    parser.add_argument('file', nargs='?', metavar='FILE', help='a URDF file, or - for stdin')
    return parser


def _read(path: str) -> tuple[str, str]:
    """Return the text, and what messages call the file."""
    if path == '-':
        return read_stream(sys.stdin.buffer, '<stdin>'), '<stdin>'
    return read_file(path), path


def _exit_code(examination: Examination) -> int:
    if examination.robot is None or any(finding.urdfdom for finding in examination.errors):
        return REFUSED_BY_URDFDOM
    return UNUSABLE if examination.errors else OK


def _refusal(examination: Examination) -> str:
    """Return what urdfdom prints; it stops at its first error, which may be several messages."""
    lines = []
    first = next((finding for finding in examination.errors if finding.urdfdom), None)
    if first is not None:
        for words in first.urdfdom.split('\n'):
            lines.append(f'Error:   {one_line(words)}')
            lines.append(f'         at line {first.line} in {first.source}')
    return '\n'.join((*lines, _REFUSED))


def tree_lines(robot: Robot) -> list[str]:
    """Return the tree as urdfdom prints it: children ordered by the names of their joints."""
    root = robot.root.name
    lines = [
        f'robot name is: {robot.name}',
        '---------- Successfully Parsed XML ---------------',
        f'root Link: {root} has {len(robot.child_joints(root))} child(ren)',
    ]
    numbers: dict[str, int] = {}
    for depth, joint in robot.walk():
        numbers[joint.parent] = numbers.get(joint.parent, 0) + 1
        indent = '    ' * min(depth, _INDENTED_LEVELS)
        lines.append(f'{indent}child({numbers[joint.parent]}):  {joint.child}')
    return [one_line(line) for line in lines]


def _print_findings(findings: tuple[Finding, ...]) -> None:
    for finding in findings[:_SHOWN_FINDINGS]:
        print(finding, file=sys.stderr)
    if len(findings) > _SHOWN_FINDINGS:
        print(f'… and {len(findings) - _SHOWN_FINDINGS} more', file=sys.stderr)
