# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The checker of robot descriptions.

A fault of the text (XML, names, numbers, the tree, the ``<ros2_control>`` block) is found where it
is read. What can be read and is still broken is found by the rules: one function each, one line in
:data:`RULES`, or in :data:`RULES_OF_THE_WHOLE`. A rule is pure, takes a
:class:`~amr_description.model.subject.Subject`, which need not be sound, and yields findings; it
keeps silent on what a reader has reported already, such as a number that is none (NaN).
"""

from dataclasses import dataclass
from itertools import islice

from amr_description.errors import DescriptionError
from amr_description.model import (
    rules_controllers,
    rules_drive,
    rules_files,
    rules_hardware,
    rules_inertia,
    rules_joints,
    rules_markup,
    rules_mass,
    rules_names,
    rules_shapes,
    rules_support,
)
from amr_description.model.findings import Finding, Report, Severity
from amr_description.model.gazebo_tag import read_gazebo_plugins
from amr_description.model.robot import Robot
from amr_description.model.ros2_control_tag import read_hardware
from amr_description.model.subject import Rule, Subject, Surroundings
from amr_description.model.urdf import read_robot
from amr_description.model.xml_source import parse_xml

# Nobody reads more; and a made-up file may hold a million.
MAX_FINDINGS = 1000
MAX_FINDINGS_OF_A_RULE = 100

RULES: tuple[Rule, ...] = (
    rules_markup.xacro_is_expanded,
    rules_markup.markup_is_known,
    rules_markup.one_shape_counts,
    rules_names.names_are_usable,
    rules_names.gazebo_refers_to_something,
    rules_files.files_are_there,
    rules_files.paths_hold_everywhere,
    rules_mass.inertial_is_present,
    rules_mass.base_has_mass,
    rules_mass.mass_is_positive,
    rules_mass.inertia_is_possible,
    rules_inertia.inertia_fits_the_shape,
    rules_inertia.root_has_no_inertial,
    rules_shapes.sizes_are_positive,
    rules_shapes.collision_is_present,
    rules_shapes.colors_are_visible,
    rules_joints.limits_are_ordered,
    rules_joints.limits_let_it_move,
    rules_joints.damping_takes_energy,
    rules_joints.axis_is_a_unit_vector,
    rules_joints.mimicked_joint_exists,
    rules_hardware.commanded_joints_have_a_position,
    rules_hardware.components_offer_interfaces,
    rules_hardware.interface_names_are_spelt_right,
    rules_hardware.one_block_commands,
    rules_drive.wheels_roll_forward,
    rules_controllers.wheel_names_are_joints,
    rules_controllers.base_frame_is_the_root,
)
"""What is true of each part, whatever the others are."""

RULES_OF_THE_WHOLE: tuple[Rule, ...] = (
    rules_shapes.shapes_do_not_overlap,
    rules_drive.sides_are_symmetric,
    rules_support.mass_is_supported,
    rules_controllers.sides_are_not_swapped,
    rules_controllers.wheel_radius_agrees,
    rules_controllers.wheel_separation_agrees,
    rules_controllers.scrubbing_is_accounted_for,
)
"""What shows in the parts together; only of a robot without errors, or one fault brings many."""

NO_SURROUNDINGS = Surroundings()


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


def examine(
    text: str, source: str = '<string>', surroundings: Surroundings = NO_SURROUNDINGS
) -> Examination:
    """
    Return everything that is wrong with a URDF; ``source`` names the file in messages.

    ``surroundings``: what it is checked against beyond itself, such as its controllers.
    Beyond :data:`MAX_FINDINGS` the file is not read on, and there is no robot.
    """
    findings: list[Finding] = []

    def report(finding: Finding) -> None:
        findings.append(finding)
        if len(findings) >= MAX_FINDINGS:
            raise _TooManyFindingsError

    try:
        subject = _read(text, source, surroundings, report)
    except _TooManyFindingsError:
        last = findings[-1].line
        findings.append(Finding.error(source, last, f'{MAX_FINDINGS} findings; reading ends here'))
        return Examination(tuple(findings), None)
    if subject is None:
        return Examination(tuple(findings), None)
    for rules in (RULES, RULES_OF_THE_WHOLE):
        if rules is RULES or not any(each.severity is Severity.ERROR for each in findings):
            for rule in rules:
                findings += islice(rule(subject), MAX_FINDINGS_OF_A_RULE)
    return Examination(tuple(findings), subject.robot)


def _read(text: str, source: str, surroundings: Surroundings, report: Report) -> Subject | None:
    """Return what the rules look at; None when the text is no XML."""
    xml = parse_xml(text, source, report)
    if xml is None:
        return None
    robot = read_robot(xml, text, source, report)
    hardware = read_hardware(xml, robot, report)
    plugins = read_gazebo_plugins(xml, source, report)
    return Subject(robot, hardware, plugins, xml, surroundings)


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
