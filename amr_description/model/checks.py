# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The checker of robot descriptions.

A fault of the text (XML, names, numbers, the tree, the ``<ros2_control>`` block) is found where it
is read. What can be read and is still broken is found by the rules: one function each, one line in
:data:`RULES`. A rule is pure, takes a :class:`~amr_description.model.subject.Subject`, which need
not be sound, and yields findings; it keeps silent on what a reader has reported already, such as a
number that is none (NaN).
"""

from dataclasses import dataclass

from amr_description.errors import DescriptionError
from amr_description.model import rules_drive, rules_joints, rules_mass
from amr_description.model.findings import Finding, Report, Severity
from amr_description.model.gazebo_tag import read_gazebo_plugins
from amr_description.model.robot import Robot
from amr_description.model.ros2_control_tag import read_hardware
from amr_description.model.subject import Rule, Subject
from amr_description.model.urdf import read_robot
from amr_description.model.xml_source import parse_xml

# Nobody reads more; and a made-up file may hold a million.
MAX_FINDINGS = 1000

RULES: tuple[Rule, ...] = (
    rules_mass.inertial_is_present,
    rules_mass.base_has_mass,
    rules_mass.mass_is_positive,
    rules_mass.inertia_is_possible,
    rules_joints.limits_are_ordered,
    rules_joints.mimicked_joint_exists,
    rules_drive.wheels_roll_forward,
)


@dataclass(frozen=True, slots=True)
class Examination:
    """
    The outcome of a check: all findings, and the robot as far as it could be read.

    ``robot`` is None when the text is no XML at all; it is sound when there are no errors.
    """

    findings: tuple[Finding, ...]
    robot: Robot | None

    @property
    def errors(self) -> tuple[Finding, ...]:
        """The findings that forbid use."""
        return tuple(f for f in self.findings if f.severity is Severity.ERROR)

    @property
    def warnings(self) -> tuple[Finding, ...]:
        """The findings that do not."""
        return tuple(f for f in self.findings if f.severity is Severity.WARNING)


class _TooManyFindingsError(Exception):
    """Ends the reading of a file that is wrong all over."""


def examine(text: str, source: str = '<string>') -> Examination:
    """
    Return everything that is wrong with a URDF; ``source`` names the file in messages.

    Beyond :data:`MAX_FINDINGS` the file is not read on, and there is no robot.
    """
    findings: list[Finding] = []

    def report(finding: Finding) -> None:
        findings.append(finding)
        if len(findings) >= MAX_FINDINGS:
            raise _TooManyFindingsError

    try:
        robot = _examine(text, source, report)
    except _TooManyFindingsError:
        robot = None
        findings.append(
            Finding.error(source, findings[-1].line, f'{MAX_FINDINGS} findings; reading ends here')
        )
    return Examination(tuple(findings), robot)


def _examine(text: str, source: str, report: Report) -> Robot | None:
    xml = parse_xml(text, source, report)
    if xml is None:
        return None
    robot = read_robot(xml, text, source, report)
    hardware = read_hardware(xml, robot, report)
    plugins = read_gazebo_plugins(xml, source, report)
    subject = Subject(robot, hardware, plugins, xml)
    for rule in RULES:
        for finding in rule(subject):
            report(finding)
    return robot


def check(text: str, source: str = '<string>') -> list[Finding]:
    """Return the findings of :func:`examine`."""
    return list(examine(text, source).findings)


def require_sound(text: str, source: str = '<string>') -> tuple[Robot, tuple[Finding, ...]]:
    """
    Return the robot of a URDF without errors and the warnings about it, for the simulator.

    DescriptionError with the first error, and how many more there are, if there is any.
    """
    examination = examine(text, source)
    if examination.robot is None or examination.errors:
        first, *rest = examination.errors
        more = f' (and {len(rest)} more; check_urdf lists them)' if rest else ''
        raise DescriptionError(first.text + more)
    return examination.robot, examination.warnings
