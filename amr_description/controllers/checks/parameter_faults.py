# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What is wrong in parameter files, by its cause, on its line.

ROS ignores what it does not know: a parameter or a section with a misspelt name is silently left
out, and what is reported in the end is its consequence, a parameter that is not set. Here the
names that nobody reads are compared with those that are missed. Only what is close to something
known is reported: a file may hold the parameters of any other node, too.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from importlib.util import find_spec
import math
from typing import Any

from amr_description.control.manager_parameters import (
    CommonParameters,
    ControllerEntry,
    ManagerTable,
)
from amr_description.controllers import CONTROLLERS
from amr_description.controllers.absent_types import CLASSES
from amr_description.controllers.checks.parameter_sections import (
    gives_type,
    listed_controllers,
    LocatedSection,
)
from amr_description.errors import ParameterError
from amr_description.former_parameters import understand
from amr_description.model.findings import Finding, Severity, SourceLocation
from amr_description.parameters import Spec, specs
from amr_description.text import closest_match, quote, quote_all

MANAGER = 'controller_manager'
_TYPE = '.type'
# Between a typing error ("wheel_seperation", 0.94) and another word.
_MISSPELT = 0.8
# Types have longer names, which share more: mecanum_ and diff_drive_controller, 0.87.
_MISSPELT_TYPE = 0.93
# Names of nodes that are meant alike: "drive_controller", "diff_drive_controller".
_LIKE = 0.6
# m; no wheel is farther away.
_LONGEST = 10.0
# What nodes have besides their tables.
_OF_EVERY_NODE = ('use_sim_time', 'type', 'start_type_description_service')


@dataclass
class ControllerParameters:
    """The parameters of one controller, with what was misspelt corrected, and its faults."""

    location: SourceLocation
    values: dict[str, Any] = field(default_factory=dict)
    locations: dict[str, SourceLocation] = field(default_factory=dict)
    faults: list[Finding] = field(default_factory=list)
    readings: list[Finding] = field(default_factory=list)
    """What is made of parameters of earlier releases, and of numbers of another type."""
    former: set[str] = field(default_factory=set)
    """Names of parameters of earlier releases."""
    is_sound: bool = True
    """Whether the values are good once they are corrected."""


def errors_of(faults: Sequence[Finding]) -> tuple[Finding, ...]:
    """Return those that keep a controller, or a manager, from running."""
    return tuple(each for each in faults if each.severity is Severity.ERROR)


def controller_parameters(
    found: Sequence[LocatedSection], node: str, kind: str, listed: SourceLocation
) -> ControllerParameters:
    """
    Return the parameters of a controller, and their faults.

    Args:
        found: the sections of all files.
        node: the full name of its node.
        kind: its type; one that is not shipped here has no table, and few faults.
        listed: where it is given its type.
    """
    name = node.rpartition('/')[2]
    mine = [each for each in found if each.section.is_of(node)]
    own = [each for each in mine if not each.is_for_every_node]
    read = ControllerParameters(own[-1].location if own else listed)
    if not own:
        for section, fault in _misnamed(found, node, _table(kind, {})):
            mine.append(section)
            read.location = section.location
            read.faults.append(fault)
    for each in mine:
        read.values |= each.values
        read.locations |= each.locations
    _understand(read, name, kind)
    rows = _table(kind, read.values)
    for each in mine:
        if rows and not each.is_for_every_node:
            read.faults += _misspelt(each, name, rows, read)
    is_empty = not any(row in read.values for row in rows)
    read.faults += _wrong_values(read, name, rows, is_empty=is_empty)
    return read


def _understand(read: ControllerParameters, name: str, kind: str) -> None:
    """Take what was given as the controller's node will, and keep what is to be said of it."""
    for table in _tables_of(kind):
        found = understand(table, read.values)
        read.values |= found.values
        read.former |= found.known
        for key, text in found.texts.items():
            read.readings.append(Finding.warning(*read.locations[key], f'{name}: {text}'))
            for each in found.values:
                read.locations.setdefault(each, read.locations[key])


def type_fault(name: str, kind: str, location: SourceLocation) -> tuple[str, Finding | None]:
    """Return the type that is meant, and what is wrong with one that is misspelt, or not there."""
    if kind in CONTROLLERS.names:
        return kind, None
    meant = closest_type(kind)
    if meant:
        text = f'{name}: there is no controller type {quote(kind)}'
        return meant, Finding.error(*location, text, fix=f'did you mean {quote(meant)}?')
    if _may_be_python(kind):
        return kind, None
    here = type_here(kind)
    if here != kind:
        return here, Finding.warning(*location, f'{name}: {taken_as(kind, here)}')
    return kind, Finding.warning(*location, f'{name}: {CONTROLLERS.absence(kind)}')


def type_here(kind: str) -> str:
    """
    Return the type of ours that stands for one of a vendor; itself where none does.

    ``vendor/Class`` is taken by its class, if one of ours has it and no package of Python is
    called ``vendor``.
    """
    package, _, name = kind.replace('::', '/').rpartition('/')
    if kind in CONTROLLERS.names or not package or closest_type(kind) or _may_be_python(kind):
        return kind
    ours = [known for known in CONTROLLERS.names if known.rpartition('/')[2] == name]
    return ours[0] if len(ours) == 1 else CLASSES.get(name, kind)


def taken_as(kind: str, here: str) -> str:
    """Return that a type of a vendor is taken as one of ours."""
    return (
        f'controller type {quote(kind)} is not here, and is taken as {quote(here)}: parameters '
        'that this one has not have no effect'
    )


def _may_be_python(kind: str) -> bool:
    """Return whether a type may be a class of a Python package, which is not imported here."""
    module = kind.partition('/')[0]
    if '.' in module:
        return True
    try:
        return find_spec(module) is not None
    except (ImportError, ValueError):
        return False


def closest_type(kind: str) -> str:
    """
    Return the type of the table that a misspelt one means; '' if there is none.

    ``my_diff_drive_controller/…`` and ``my_package.drive/…`` are types of others.
    """
    written = kind.replace('::', '/')
    for known in CONTROLLERS.names:
        if written in (known, known.rpartition('/')[2]):
            return known
    meant = closest_match(written, CONTROLLERS.names, _MISSPELT_TYPE)
    return '' if '.' in written or meant in written else meant


def manager_faults(found: Sequence[LocatedSection], manager: str) -> Iterator[Finding]:
    """
    Yield what keeps a manager from its parameters, and what is wrong with these.

    Args:
        found: the sections of all files.
        manager: the full name of its node.
    """
    name = manager.rpartition('/')[2]
    mine = [each for each in found if each.section.is_of(manager) and not each.is_for_every_node]
    for each in mine:
        yield from _faults_in_manager(each, name)
    if mine:
        return
    for each in found:
        if each.name == name:
            yield _other_namespace(each, manager)
        elif closest_match(each.name, [name], _MISSPELT) and _lists_controllers(each):
            yield _of_no_node(each, name, 'the controller manager', [name])


def _faults_in_manager(section: LocatedSection, name: str) -> Iterator[Finding]:
    rows = {spec.name: spec for spec in specs(ManagerTable)}
    entries = [spec.name for spec in specs(ControllerEntry)]
    for key, value in section.values.items():
        controller, dot, below = key.rpartition('.')
        location = section.locations[key]
        if key in rows:
            fault = _value_fault(rows[key], value, location, name)
            if fault is not None:
                yield fault
        elif dot and f'{controller}{_TYPE}' not in section.values:
            meant = closest_match(below, entries, 0.7)
            if meant == 'type' and below != meant and isinstance(value, str) and '/' in value:
                yield _unknown(location, name, key, f'{controller}{_TYPE}', is_missed=True)
        elif f'{controller}{_TYPE}' not in section.values and key not in _OF_EVERY_NODE:
            meant = closest_match(key, rows.keys(), _MISSPELT)
            if meant and meant not in section.values:
                yield _unknown(location, name, key, meant, is_missed=False)


def _tables_of(kind: str) -> tuple[type, ...]:
    """Return the tables of a shipped controller; none for others."""
    kind = type_here(kind)
    if kind not in CONTROLLERS.names:
        return ()
    return CONTROLLERS.find(kind).parameters_type, CommonParameters


def _table(kind: str, values: Mapping[str, Any]) -> dict[str, Spec]:
    """Return the parameters of a shipped controller, with those that its lists make."""
    return {spec.name: spec for table in _tables_of(kind) for spec in specs(table, '', values)}


def _misnamed(
    found: Sequence[LocatedSection], node: str, rows: dict[str, Spec]
) -> Iterator[tuple[LocatedSection, Finding]]:
    """Yield the section that is meant for a controller that has none, and its fault."""
    name = node.rpartition('/')[2]
    namesakes = [each for each in found if each.name == name]
    if namesakes:
        yield namesakes[-1], _other_namespace(namesakes[-1], node)
        return
    controllers = [each.node for each in listed_controllers(found)]
    orphans = [
        each
        for each in found
        if not each.is_for_every_node
        and not _lists_controllers(each)
        and not any(each.section.is_of(controller) for controller in controllers)
        and set(each.values) & rows.keys() - set(_OF_EVERY_NODE)
    ]
    meant = closest_match(name, [each.name for each in orphans], _LIKE)
    alike = [each for each in orphans if each.name == meant or _is_whole(each, rows)]
    if alike:
        yield alike[0], _of_no_node(alike[0], name, 'the controllers', _names(controllers))


def _is_whole(section: LocatedSection, rows: dict[str, Spec]) -> bool:
    """Return whether a section holds all that a controller of this table cannot do without."""
    needed = {row for row, spec in rows.items() if spec.bounds.complaint(spec.default)}
    return bool(needed) and needed <= section.values.keys()


def _lists_controllers(section: LocatedSection) -> bool:
    return any(map(gives_type, section.values))


def _names(nodes: Sequence[str]) -> list[str]:
    return list(dict.fromkeys(node.rpartition('/')[2] for node in nodes))


def _of_no_node(section: LocatedSection, meant: str, what: str, known: Sequence[str]) -> Finding:
    return Finding.error(
        *section.location,
        f'the section {quote(section.label)} is for no node',
        expected=f'the name of {what}: {quote_all(known)}',
        fix=f'did you mean {quote(meant)}?',
    )


def _other_namespace(section: LocatedSection, node: str) -> Finding:
    namespace = node.rpartition('/')[0] or '/'
    name = node.rpartition('/')[2]
    return Finding.error(
        *section.location,
        f'the section {quote(section.label)} is for the node {section.node}, and there is {node}, '
        f'in the namespace {namespace}',
        fix=f'write /**/{name}: for any namespace',
    )


def _misspelt(
    section: LocatedSection, name: str, rows: dict[str, Spec], read: ControllerParameters
) -> Iterator[Finding]:
    """Yield the parameters of a section that nobody reads; their values count as meant."""
    known = [row for row in rows if row not in section.values]
    passed = {*rows, *_OF_EVERY_NODE, *read.former}
    for key, value in section.values.items():
        if key in passed or '*' in key:
            continue
        meant = _closest_parameter(key, known)
        if meant:
            spec = rows[meant]
            is_missed = meant not in read.values and bool(spec.bounds.complaint(spec.default))
            yield _unknown(section.locations[key], name, key, meant, is_missed=is_missed)
            read.values.setdefault(meant, value)
            read.locations.setdefault(meant, section.locations[key])


def _closest_parameter(key: str, known: Sequence[str]) -> str:
    """
    Return the parameter that a misspelt one means; '' if there is none.

    Where the group is right, the rest has to be alike: gains.joint_1.x is not gains.joint_1.p.
    """
    group, dot, rest = key.rpartition('.')
    beside = [each.removeprefix(group + dot) for each in known if each.startswith(group + dot)]
    if dot and beside:
        meant = closest_match(rest, [each for each in beside if '.' not in each], _MISSPELT)
        return f'{group}.{meant}' if meant else ''
    return closest_match(key, known, _MISSPELT)


def _unknown(
    location: SourceLocation, name: str, key: str, meant: str, *, is_missed: bool
) -> Finding:
    """Return the fault of a parameter that nobody reads; an error if its default cannot be."""
    report = Finding.error if is_missed else Finding.warning
    what = f'{name}: there is no parameter {quote(key)}, and it is ignored'
    return report(*location, what, fix=f'did you mean {quote(meant)}?')


def _wrong_values(
    read: ControllerParameters, name: str, rows: dict[str, Spec], *, is_empty: bool
) -> Iterator[Finding]:
    """Yield what the table refuses, and what is not set though there is no default for it."""
    missing = []
    for row, spec in rows.items():
        if row in read.values:
            fault = _value_fault(spec, read.values[row], read.locations[row], name)
            if fault is not None:
                read.is_sound = False
                yield fault
        elif spec.bounds.complaint(spec.default):
            missing.append(spec)
    read.is_sound &= not missing
    if missing and is_empty:
        yield Finding.error(
            *read.location,
            f'{name}: no section has its parameters, of which it needs '
            f'{quote_all([spec.name for spec in missing])}',
            fix=f'write them below {name}: ros__parameters:',
        )
        return
    for spec in missing:
        yield Finding.error(
            *read.location,
            f"{name}: parameter '{spec.name}' is not set, and "
            f'{spec.bounds.complaint(spec.default)}',
            fix=f'add {spec.name}: ({spec.doc}{f", {spec.unit}" if spec.unit else ""})',
        )


def _value_fault(spec: Spec, value: Any, location: SourceLocation, name: str) -> Finding | None:
    try:
        spec.check(value)
    except ParameterError as error:
        is_long = spec.unit == 'm' and isinstance(value, float) and _LONGEST < value < math.inf
        unit = f': millimetres? write {value * 0.001:g}' if is_long else ''
        return Finding.error(*location, f'{name}: {error}{unit}')
    return None
