# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The checker of robot descriptions.

A fault of the text (XML, names, numbers, the tree, the ``<ros2_control>`` block) is found where it
is read. What can be read and is still broken is found by the rules: one function each, one line in
:data:`RULES`, or in :data:`RULES_OF_THE_WHOLE`. A rule is pure, takes a
:class:`~amr_description.model.checks.context.CheckContext`, which need not be sound, and yields findings; it
keeps silent on what a reader has reported already, such as a number that is none (NaN).
"""

from dataclasses import dataclass
from itertools import islice

from amr_description.errors import DescriptionError
from amr_description.model.checks import inertia, joints, markup, meshes, ros2_control, shapes
from amr_description.model.checks.context import CheckContext, CheckInputs, Rule
from amr_description.model.findings import Finding, Report, Severity
from amr_description.model.gazebo import read_gazebo_plugins
from amr_description.model.robot import Robot
from amr_description.model.ros2_control_tag import read_hardware
from amr_description.model.urdf import read_robot
from amr_description.model.xml_reader import parse_xml

# Nobody reads more; and a made-up file may hold a million.
MAX_FINDINGS = 1000
MAX_FINDINGS_OF_A_RULE = 100

RULES: tuple[Rule, ...] = (
    markup.xacro_is_expanded,
    markup.markup_is_known,
    markup.one_shape_counts,
    markup.names_are_usable,
    markup.gazebo_refers_to_something,
    markup.files_are_there,
    markup.paths_hold_everywhere,
    meshes.meshes_can_be_read,
    meshes.meshes_are_in_metres,
    meshes.meshes_have_z_up,
    meshes.collision_meshes_are_closed,
    meshes.collision_meshes_fill_their_hull,
    inertia.inertial_is_present,
    inertia.base_has_mass,
    inertia.mass_is_positive,
    inertia.inertia_is_possible,
    inertia.inertia_fits_the_shape,
    inertia.root_has_no_inertial,
    shapes.sizes_are_positive,
    shapes.collision_is_present,
    shapes.colors_are_visible,
    joints.limits_are_ordered,
    joints.limits_let_it_move,
    joints.damping_takes_energy,
    joints.axis_is_a_unit_vector,
    joints.mimicked_joint_exists,
    ros2_control.commanded_joints_have_a_position,
    ros2_control.components_offer_interfaces,
    ros2_control.interface_names_are_spelt_right,
    ros2_control.one_block_commands,
    joints.wheels_roll_forward,
    ros2_control.wheel_names_are_joints,
    ros2_control.base_frame_is_the_root,
)
"""What is true of each part, whatever the others are."""

RULES_OF_THE_WHOLE: tuple[Rule, ...] = (
    shapes.shapes_do_not_overlap,
    joints.sides_are_symmetric,
    inertia.mass_is_supported,
    ros2_control.sides_are_not_swapped,
    ros2_control.wheel_radius_agrees,
    ros2_control.wheel_separation_agrees,
    ros2_control.scrubbing_is_accounted_for,
)
"""What shows in the parts together; only of a robot without errors, or one fault brings many."""

NO_SURROUNDINGS = CheckInputs()


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
    text: str, source: str = '<string>', surroundings: CheckInputs = NO_SURROUNDINGS
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


def _read(
    text: str, source: str, surroundings: CheckInputs, report: Report
) -> CheckContext | None:
    """Return what the rules look at; None when the text is no XML."""
    xml = parse_xml(text, source, report)
    if xml is None:
        return None
    robot = read_robot(xml, text, source, report)
    hardware = read_hardware(xml, robot, report)
    plugins = read_gazebo_plugins(xml, source, report)
    return CheckContext(robot, hardware, plugins, xml, surroundings)


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
