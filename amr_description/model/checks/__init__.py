# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The checker of robot descriptions, ``check_urdf``.

Faults of the text (XML, names, numbers, the tree, the ``<ros2_control>`` blocks) are found where
it is read. Rules find what can be read and is still broken. A rule is a pure function that takes a
:class:`~amr_description.model.checks.context.CheckContext`, which may be unsound, and yields
findings; it is listed in :data:`RULES` or :data:`RULES_OF_THE_WHOLE`. It ignores what a reader has
already reported, such as a text that is not a number (NaN).

===================  =============================================================================
module               what it holds
===================  =============================================================================
``context.py``       what a rule gets: ``CheckContext``, ``CheckInputs``, ``DriveSettings``
``markup.py``        unknown elements and attributes, names, files
``meshes.py``        mesh files: units, axes, closed surfaces
``shapes.py``        sizes, colours, missing and overlapping collision shapes
``inertia.py``       mass, inertia, and whether the robot tips over
``units.py``         lengths in millimetres, masses in grams
``joints.py``        limits, axes, mimics, wheels
``axles.py``         the axles of wheels that controllers name, and angles in degrees
``sensors.py``       lidars, cameras and contact sensors of ``<gazebo>`` blocks
``ros2_control.py``  ``<ros2_control>`` blocks, and what controllers assume about the robot
===================  =============================================================================
"""

from dataclasses import dataclass, replace
from itertools import islice

from amr_description.errors import DescriptionError
from amr_description.model.checks import (
    axles,
    inertia,
    joints,
    markup,
    meshes,
    ros2_control,
    sensors,
    shapes,
    units,
)
from amr_description.model.checks.context import CheckContext, CheckInputs, DriveSettings, Rule
from amr_description.model.findings import Finding, NO_SHAPE, Report, Severity
from amr_description.model.gazebo.tags import read_gazebo_plugins
from amr_description.model.origins import raise_error_of, relocated
from amr_description.model.robot import Robot
from amr_description.model.ros2_control_tag import read_hardware
from amr_description.model.urdf import is_urdf, read_robot
from amr_description.model.xml_reader import parse_xml

# Limits the time and the output for files with absurdly many faults.
MAX_FINDINGS = 1000
MAX_FINDINGS_OF_A_RULE = 100

_RULES_OF_DRIVES: tuple[Rule, ...] = (
    ros2_control.wheel_names_are_joints,
    axles.axles_are_across,
    ros2_control.base_frame_is_the_root,
)
_RULES_OF_WHOLE_DRIVES: tuple[Rule, ...] = (
    ros2_control.sides_are_not_swapped,
    ros2_control.wheel_radius_agrees,
    ros2_control.wheel_separation_agrees,
    ros2_control.scrubbing_is_accounted_for,
)

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
    units.lengths_are_in_metres,
    units.masses_are_in_kilograms,
    inertia.inertial_is_present,
    inertia.base_has_mass,
    inertia.mass_is_positive,
    inertia.inertia_is_possible,
    inertia.inertia_fits_the_shape,
    inertia.root_has_no_inertial,
    shapes.sizes_are_positive,
    shapes.collision_is_present,
    shapes.colors_are_visible,
    joints.limits_leave_a_range,
    joints.limits_let_it_move,
    joints.damping_takes_energy,
    joints.axis_is_a_unit_vector,
    joints.mimicked_joint_is_no_mimic,
    ros2_control.commanded_joints_have_a_position,
    ros2_control.components_offer_interfaces,
    ros2_control.plugins_are_spelt_right,
    ros2_control.interface_names_are_spelt_right,
    ros2_control.one_block_commands,
    joints.wheels_roll_forward,
    sensors.sensors_can_work,
    axles.angles_are_in_radians,
    *_RULES_OF_DRIVES,
)
"""The rules on single parts."""

RULES_OF_THE_WHOLE: tuple[Rule, ...] = (
    shapes.shapes_do_not_overlap,
    joints.sides_are_symmetric,
    inertia.mass_is_supported,
    *_RULES_OF_WHOLE_DRIVES,
)
"""The rules on the whole robot; checked only without errors, missing shapes and wrong units: one
fault would cause many."""

# KDL is in the robot_state_publisher, which says so itself.
_RULES_OF_SIMULATORS = tuple(each for each in RULES if each is not inertia.root_has_no_inertial)

NO_INPUTS = CheckInputs()


@dataclass(frozen=True, slots=True)
class Examination:
    """
    The outcome of a check: all findings, and the robot as far as it could be read.

    ``robot`` is None if the text is not XML; it is sound if there are no errors.
    """

    findings: tuple[Finding, ...]
    robot: Robot | None

    @property
    def errors(self) -> tuple[Finding, ...]:
        """The findings that make the description unusable."""
        return tuple(f for f in self.findings if f.severity is Severity.ERROR)

    @property
    def warnings(self) -> tuple[Finding, ...]:
        """The other findings."""
        return tuple(f for f in self.findings if f.severity is Severity.WARNING)


class _TooManyFindingsError(Exception):
    """Stops the reading of a file after :data:`MAX_FINDINGS`."""


def examine(
    text: str,
    source: str = '<string>',
    inputs: CheckInputs = NO_INPUTS,
    rules: tuple[Rule, ...] = RULES,
) -> Examination:
    """
    Return everything that is wrong with a URDF.

    After :data:`MAX_FINDINGS` the file is not read further, and there is no robot.

    Args:
        text: the URDF.
        source: names the file in messages.
        inputs: what it is checked against, such as its controllers.
        rules: those on single parts.
    """
    findings: list[Finding] = []

    def report(finding: Finding) -> None:
        findings.append(finding)
        if len(findings) >= MAX_FINDINGS:
            raise _TooManyFindingsError

    try:
        context = _read(text, source, inputs, report)
    except _TooManyFindingsError:
        last = findings[-1].line
        findings.append(Finding.error(source, last, f'{MAX_FINDINGS} findings; reading ends here'))
        return Examination(_relocated(findings, text, source), None)
    if context is None:
        return Examination(_relocated(findings, text, source), None)
    findings += _apply(context, rules)
    is_whole = not any(
        each.severity is Severity.ERROR or each.taken == NO_SHAPE for each in findings
    )
    if is_whole and not units.are_doubtful(context):
        findings += _apply(context, RULES_OF_THE_WHOLE)
    return Examination(_relocated(findings, text, source), context.robot)


def examine_drives(robot: Robot, drives: tuple[DriveSettings, ...]) -> tuple[Finding, ...]:
    """Return what only the controllers of a sound robot let find, as :func:`examine` does."""
    report = raise_error_of(robot.text, strict=False)
    context = _read(robot.text, robot.source, CheckInputs(drives=drives), report)
    if context is None:
        return ()
    findings = _apply(context, _RULES_OF_DRIVES)
    if not any(each.severity is Severity.ERROR for each in findings):
        findings += _apply(context, _RULES_OF_WHOLE_DRIVES)
    return tuple(findings)


def _relocated(findings: list[Finding], text: str, source: str) -> tuple[Finding, ...]:
    """Return findings at the lines of the files that the text was made of."""
    return tuple(relocated(each, text) if each.source == source else each for each in findings)


def _apply(context: CheckContext, rules: tuple[Rule, ...]) -> list[Finding]:
    return [each for rule in rules for each in islice(rule(context), MAX_FINDINGS_OF_A_RULE)]


def _read(text: str, source: str, inputs: CheckInputs, report: Report) -> CheckContext | None:
    """Return the context of the rules; None if the text is not that of a robot in XML."""
    xml = parse_xml(text, source, report)
    if xml is None or not is_urdf(xml, source, report):
        return None
    robot = read_robot(xml, text, source, report)
    hardware = read_hardware(xml, robot, report)
    plugins = read_gazebo_plugins(xml, source, report)
    return CheckContext(robot, hardware, plugins, xml, inputs)


def check(text: str, source: str = '<string>') -> list[Finding]:
    """Return the findings of :func:`examine`."""
    return list(examine(text, source).findings)


def require_sound(
    text: str, source: str = '<string>', strict: bool = True
) -> tuple[Robot, tuple[Finding, ...]]:
    """
    Return the robot of a URDF without errors, and the warnings about it that concern a simulator.

    Args:
        text: the URDF.
        source: names the file in messages.
        strict: False: faults that the simulator can live with become warnings, which say what it
            makes of them; True: they are refused, too.

    Raises:
        DescriptionError: there are errors: the first one, and how many more.
    """
    examination = examine(text, source, rules=_RULES_OF_SIMULATORS)
    refused = [each for each in examination.findings if each.is_refused(strict=strict)]
    if examination.robot is None or refused:
        first, *rest = refused
        more = f' (and {len(rest)} more; check_urdf lists them)' if rest else ''
        # Refused, it is not taken as anything, which the text of a warning says.
        raise DescriptionError(replace(first, severity=Severity.ERROR).text + more)
    taken = tuple(each.as_taken() for each in examination.errors)
    return examination.robot, (*taken, *examination.warnings)
