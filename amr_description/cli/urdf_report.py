# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What ``check_urdf`` prints: the tree, urdfdom's refusal, the drop in numbers, or JSON."""

from dataclasses import asdict
import json
import math
from typing import TYPE_CHECKING

from amr_description.model.checks import Examination
from amr_description.model.findings import Finding
from amr_description.model.robot import Robot
from amr_description.text import one_line

if TYPE_CHECKING:
    from amr_description.model.footprint import Footprint
    from amr_description.sim.drop_test import DropReport

REFUSED = 'ERROR: Model Parsing the xml failed'
# Levels of the tree that are indented: a made-up chain of 60,000 links would print gigabytes.
_INDENTED_LEVELS = 100


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


def refusal(examination: Examination) -> str:
    """Return what urdfdom prints; it stops at its first error, which may be several messages."""
    lines = []
    first = refused_for(examination)
    if first is not None:
        for words in first.urdfdom.split('\n'):
            lines.append(f'Error:   {one_line(words)}')
            lines.append(f'         at line {first.line} in {first.source}')
    return '\n'.join((*lines, REFUSED))


def refused_for(examination: Examination) -> Finding | None:
    """Return the first finding for which urdfdom refuses the file, too."""
    return next((finding for finding in examination.errors if finding.urdfdom), None)


def drop_lines(report: 'DropReport') -> list[str]:
    """Return the numbers of a drop, one a line; those that were not reached are left out."""
    rows = (
        ('comes to rest in', report.rest_time, 1.0, 's'),
        ('fastest on the way', report.fastest, 1.0, 'm/s'),
        ('tilt at rest', report.tilt, math.degrees(1.0), '°'),
        ('drift in 1 s at rest', report.drift, 1000.0, 'mm'),
        ('pushed sideways with', report.push_force, 1.0, 'N'),
        ('... moves', report.push_travel, 1000.0, 'mm'),
        ('... tilts at most', report.push_tilt, math.degrees(1.0), '°'),
        ('0.5 s forward: x', report.ahead, 1000.0, 'mm'),
        ('... y', report.aside, 1000.0, 'mm'),
        ('... yaw', report.veer, math.degrees(1.0), '°'),
        ('1 s turning left: yaw', report.turn, math.degrees(1.0), '°'),
    )
    return [
        'stands fixed, watched for 1 s:' if report.stands_fixed else 'dropped from 20 cm:',
        *(
            # No "-0.00": a sign means a direction here.
            f'    {name:<24}{round(value * scale, 2) + 0.0:9.2f} {unit}'
            for name, value, scale, unit in rows
            if value is not None
        ),
        *(f'    {line}' for line in report.left_out),
        *_verdict(report),
    ]


def _verdict(report: 'DropReport') -> list[str]:
    """Return the last line of a drop; none for a robot that passes as far as it was tried."""
    if report.failures:
        return ['    failed']
    return [] if report.left_out else ['    passed']


def to_json(source: str, examination: Examination, drop: 'DropReport | None', code: int) -> str:
    """Return everything in one JSON object; SI units."""
    robot, first = examination.robot, refused_for(examination)
    refused = examination.robot is None or first is not None
    return json.dumps(
        {
            'file': source,
            'exit_code': code,
            'urdfdom': {
                'accepts': not refused,
                'errors': first.urdfdom.split('\n') if first is not None else [],
            },
            'robot': None if robot is None or refused else _summary(robot),
            'findings': [_as_dict(finding) for finding in examination.findings],
            'drop': None if drop is None else _finite(asdict(drop)),
        },
        indent=2,
    )


def failure_to_json(file: str, error: str, code: int) -> str:
    """Return the JSON object of a description that could not be checked at all."""
    return json.dumps({'file': file, 'exit_code': code, 'error': error}, indent=2)


def _finite(values: dict[str, object]) -> dict[str, object]:
    """Return the values, with None for infinity and NaN, which JSON does not have."""
    return {
        name: None if isinstance(value, float) and not math.isfinite(value) else value
        for name, value in values.items()
    }


def _summary(robot: Robot) -> dict[str, object]:
    masses = [link.inertial.mass for link in robot.links if link.inertial is not None]
    mass = math.fsum(masses) if all(map(math.isfinite, masses)) else None
    return {
        'name': robot.name,
        'root': robot.root.name,
        'links': len(robot.links),
        'joints': len(robot.joints),
        'mass': mass,
    }


def _as_dict(finding: Finding) -> dict[str, object]:
    return {
        'severity': str(finding.severity),
        'file': finding.source,
        'line': finding.line,
        'what': finding.what,
        'found': finding.found,
        'expected': finding.expected,
        'taken': finding.taken,
        'fix': finding.fix,
    }


def footprint_yaml(found: 'Footprint') -> str:
    """Return the line of a parameter file of Nav2, and what is to be known of it as a comment."""
    warning = (
        ''
        if found.holds_origin
        else f'# {found.frame} is outside of the robot: costmaps turn it about there\n'
    )
    return (
        f'# in {found.frame}: inscribed radius {found.inscribed_radius:.3f} m, '
        f'circumscribed radius {found.circumscribed_radius:.3f} m\n'
        f'{warning}footprint: "{found.text}"'
    )


def footprint_json(found: 'Footprint') -> str:
    """Return the same as one JSON object; m."""
    values = asdict(found) | {
        'inscribed_radius': found.inscribed_radius,
        'circumscribed_radius': found.circumscribed_radius,
        'holds_origin': found.holds_origin,
    }
    return json.dumps(values, indent=2)
