# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``check_urdf FILE [NAME:=VALUE …]``: print the tree of a robot description, and what is wrong.

The tree on stdout and the refusals on stderr are those of urdfdom 4.0.2, so that scripts made for
it go on working. Where urdfdom names a line of its own C++ code, the line of the file stands. All
findings follow on stderr, one a line: ``error|warning: file:line: what, found, expected, fix``.

Exit code:

==== ==========================================================================================
0    sound; there may be warnings
255  urdfdom refuses it, too: not readable, no XML, no tree, a malformed joint
1    urdfdom would let it pass, tree and all, but it cannot be used: a link without mass, a circle
     of joints, a ``<ros2_control>`` joint that does not exist …; or it failed the drop; or, with
     ``--strict``, there are warnings
==== ==========================================================================================
"""

import argparse
from collections.abc import Sequence
import math
import sys
from typing import TYPE_CHECKING

from amr_description.argument_types import finite, positive
from amr_description.cli.urdf_report import (
    drop_lines,
    failure_to_json,
    refusal,
    refused_for,
    to_json,
    tree_lines,
)
from amr_description.errors import (
    AmrError,
    DescriptionError,
    ParameterError,
    ResourceError,
    SimulationError,
    UsageError,
)
from amr_description.hardware import HARDWARE
from amr_description.model.checks import Examination, examine
from amr_description.model.checks.context import CheckInputs, DriveSettings
from amr_description.model.description_file import located_text, mappings_of
from amr_description.model.findings import Finding
from amr_description.model.mesh_uses import FindFile
from amr_description.model.urdf import parse
from amr_description.model.xml_reader import read_stream
from amr_description.text import one_line

if TYPE_CHECKING:
    from pathlib import Path

    from amr_description.sim.drop_test import DropReport

OK = 0
UNUSABLE = 1
REFUSED_BY_URDFDOM = 255

_NO_ARGUMENT = 'Expect URDF xml file to parse. Use - for stdin'
_STDIN = '<stdin>'
# A file may hold a fault per element; nobody reads more of them.
_SHOWN_FINDINGS = 100


def main(argv: list[str]) -> int:
    """Run the command with the arguments after its name; return the exit code."""
    arguments = _parser().parse_args(argv)
    if arguments.file is None:
        print(_NO_ARGUMENT, file=sys.stderr)
        return REFUSED_BY_URDFDOM
    try:
        text, source = _read(arguments.file, arguments.mappings)
    except (DescriptionError, ResourceError) as error:
        return _fail(error, REFUSED_BY_URDFDOM, arguments)
    try:
        drives, faults = _drives(arguments.controllers, text, source)
    except ParameterError as error:
        return _fail(error, UNUSABLE, arguments)
    find_file = _file_finder(source)
    if arguments.inertia is not None:
        return _print_inertial(text, source, find_file, arguments)
    if arguments.mass or arguments.density:
        raise UsageError('--mass and --density are of the link that --inertia LINK names')
    if arguments.footprint:
        return _print_footprint(text, source, find_file, arguments)
    if arguments.heights or arguments.frame:
        raise UsageError('--heights and --frame are of --footprint')
    inputs = CheckInputs(
        file_exists=lambda uri: _is_there(find_file, uri),
        find_file=find_file,
        drives=drives,
        hardware_plugins=HARDWARE.names,
    )
    examined = examine(text, source, inputs)
    # What is wrong in the parameters comes first: the rest may be its consequence.
    found = (*faults, *examined.findings, *_own_views(examined))
    examination = Examination(found, examined.robot)
    wheels = [wheel for drive in drives for wheel in drive.wheels]
    drop = _drop(examination, wheels) if arguments.drop else None
    code = exit_code(examination, drop, strict=arguments.strict)
    if arguments.json:
        print(to_json(source, examination, drop, code))
    else:
        _print(examination, drop)
    if arguments.drop and drop is None:
        print('not dropped: the description has errors', file=sys.stderr)
    return code


def _fail(error: AmrError, code: int, arguments: argparse.Namespace) -> int:
    """Say why nothing was checked; return the exit code."""
    line = one_line(str(error))
    if arguments.json:
        print(failure_to_json(arguments.file, line, code))
    else:
        print(f'error: {line}', file=sys.stderr)
    return code


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog='check_urdf',
        description='Print the tree of a robot description, and what is wrong with it.',
        epilog='Exit code: 0 sound; 255 urdfdom refuses it, too; 1 it passes urdfdom and cannot '
        'be used, or fails what else was asked.',
    )
    add = parser.add_argument
    add('file', nargs='?', metavar='FILE', help='a URDF or .xacro file, or - for stdin')
    add('mappings', nargs='*', metavar='NAME:=VALUE', help='arguments of a xacro file')
    add(
        '--controllers',
        metavar='YAML',
        action='append',
        default=[],
        help='also check this parameter file, and the robot against its diff_drive_controllers '
        '(without it, of those that the URDF names); given more than once, the files are read one '
        'over the other',
    )
    add('--strict', action='store_true', help='exit with 1 when there are warnings')
    add('--json', action='store_true', help='print one JSON object instead of the tree')
    add(
        '--drop',
        action='store_true',
        help='also drop, push, roll and turn the robot in the simulator, and report in numbers',
    )
    add(
        '--inertia',
        metavar='LINK',
        help='print the <inertial> of this link instead, from its collision shapes and meshes',
    )
    weight = parser.add_mutually_exclusive_group()
    about = 'of the link of --inertia; without it, the mass that the description gives it'
    weight.add_argument('--mass', metavar='KG', type=positive, help=f'mass {about}')
    weight.add_argument('--density', metavar='KG/M3', type=positive, help=f'density {about}')
    add(
        '--footprint',
        action='store_true',
        help='print the polygon on the ground for costmaps of Nav2 instead, from the collisions',
    )
    add(
        '--heights',
        metavar=('LOW', 'HIGH'),
        nargs=2,
        type=finite,
        help='of what is in the footprint, m above the lowest collision (default: everything)',
    )
    add('--frame', metavar='LINK', help='of the footprint (default: base_link, base_footprint …)')
    return parser


def _print_inertial(
    text: str, source: str, find_file: FindFile, arguments: argparse.Namespace
) -> int:
    """Print the ``<inertial>`` of a link; return the exit code."""
    from amr_description.cli.inertia import inertial_element

    try:
        robot = parse(text, source)
        print(
            inertial_element(
                robot, arguments.inertia, arguments.mass, arguments.density, find_file
            )
        )
    except UsageError:
        raise
    except AmrError as error:
        return _fail(error, UNUSABLE, arguments)
    return OK


def _print_footprint(
    text: str, source: str, find_file: FindFile, arguments: argparse.Namespace
) -> int:
    """Print the footprint of the robot; return the exit code."""
    from amr_description.cli.urdf_report import footprint_json, footprint_yaml
    from amr_description.model.footprint import footprint

    low, high = arguments.heights or (-math.inf, math.inf)
    if low > high:
        raise UsageError(f'--heights {low:g} {high:g}: the first must not be above the second')
    try:
        found = footprint(
            parse(text, source), find_file, frame=arguments.frame, heights=(low, high)
        )
    except AmrError as error:
        return _fail(error, UNUSABLE, arguments)
    print(footprint_json(found) if arguments.json else footprint_yaml(found))
    return OK


def _read(path: str, words: list[str]) -> tuple[str, str]:
    """
    Return the text, and what messages call the file.

    ``words`` are arguments of a xacro file. Raises DescriptionError, ResourceError, UsageError.
    """
    if path.startswith('package://'):
        from amr_description.ament_index import path_of  # as in _file_finder: not at the top

        path = str(path_of(path))
    mappings = mappings_of(words)
    if path == '-' and not mappings:
        return read_stream(sys.stdin.buffer, _STDIN), _STDIN
    return located_text(path, mappings, warn=_warn), path


def _warn(line: str) -> None:
    print(f'warning: {line}', file=sys.stderr)


def _file_finder(source: str) -> FindFile:
    """Return what finds the files that the description names; relative ones lie beside it."""

    def find_file(uri: str) -> 'Path':
        # Not at the top: a description that names no file need not wait for ament.
        from pathlib import Path

        from amr_description.ament_index import resolve_uri

        return resolve_uri(uri, Path() if source == _STDIN else Path(source).parent)

    return find_file


def _is_there(find_file: FindFile, uri: str) -> bool:
    try:
        return find_file(uri).is_file()
    except OSError as error:  # such as a name that no file can have
        raise ResourceError(error.strerror or str(error)) from error


def _drives(
    paths: list[str], text: str, source: str
) -> tuple[tuple[DriveSettings, ...], tuple[Finding, ...]]:
    """
    Return the differential drives of parameter files and plugins, and what is wrong with others.

    Without ``paths``, the files are those that the URDF names. Raises ParameterError: one of
    ``paths`` cannot be read, or they list no controller.
    """
    files = _drives_of_files(paths, text, source)
    if '<plugin' not in text:
        return files
    from amr_description.controllers.checks.drive_files import plugins_in

    plugins = plugins_in(text, source)
    return (*files[0], *plugins.drives), (*files[1], *plugins.faults)


def _drives_of_files(
    paths: list[str], text: str, source: str
) -> tuple[tuple[DriveSettings, ...], tuple[Finding, ...]]:
    """Return those of parameter files, as :func:`_drives` does."""
    if not paths and '<parameters>' not in text:
        return (), ()
    from amr_description.controllers.checks.drive_files import (
        drives_named_by,
        examine_drive_files,
        manager_names,
        named_files,
        no_drive,
    )
    from amr_description.controllers.checks.wheeled_drive_files import wheeled_drive_faults

    if paths:
        found = examine_drive_files(paths, manager_names(text, source))
        if not found.controllers and not found.faults:
            raise ParameterError(no_drive(paths))
        return found.drives, found.faults + wheeled_drive_faults(text, source, paths)
    try:
        found = drives_named_by(text, source)
    except ParameterError as error:  # it is no fault of the description
        _warn(one_line(str(error)))
        return (), ()
    others = wheeled_drive_faults(text, source, named_files(text, source))
    return found.drives, found.faults + others


def _own_views(examination: Examination) -> Sequence[Finding]:
    """Return what lidars see of a sound robot that carries them."""
    robot = examination.robot
    if robot is None or examination.errors or '<sensor' not in robot.text:
        return ()
    from amr_description.sim.own_views import own_views

    return own_views(robot)


def _drop(examination: Examination, wheels: list[str]) -> 'DropReport | None':
    """Return how the robot falls, and drives by its ``wheels``; None when it is not sound."""
    if examination.robot is None or examination.errors:
        return None
    from amr_description.sim.drop_test import drop_test, DropReport

    try:
        return drop_test(examination.robot, wheels)
    except SimulationError as error:
        return DropReport(failures=(str(error),))


def exit_code(examination: Examination, drop: 'DropReport | None', *, strict: bool) -> int:
    """Return what the command ends with; see the table above."""
    if examination.robot is None or refused_for(examination) is not None:
        return REFUSED_BY_URDFDOM
    is_bad = examination.errors or (strict and examination.warnings)
    return UNUSABLE if is_bad or (drop is not None and drop.failures) else OK


def _print(examination: Examination, drop: 'DropReport | None') -> None:
    """Print tree and drop on stdout, what is wrong on stderr."""
    if examination.robot is None or refused_for(examination) is not None:
        print(refusal(examination), file=sys.stderr)
    else:
        print('\n'.join(tree_lines(examination.robot)), flush=True)
    _print_findings(examination.findings)
    if drop is not None:
        print('\n'.join(drop_lines(drop)), flush=True)
        for failure in drop.failures:
            print(f'error: dropped: {one_line(failure)}', file=sys.stderr)


def _print_findings(findings: tuple[Finding, ...]) -> None:
    for finding in findings[:_SHOWN_FINDINGS]:
        print(finding, file=sys.stderr)
    if len(findings) > _SHOWN_FINDINGS:
        print(f'… and {len(findings) - _SHOWN_FINDINGS} more', file=sys.stderr)
