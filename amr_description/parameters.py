# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The parameters of a component as one table: name, type, default, unit, bounds, meaning.

The table is a frozen dataclass whose fields are made by :func:`parameter`; a field made by
:func:`group` holds another table below a dotted prefix::

    @dataclass(frozen=True)
    class DriveParameters:
        wheel_radius: float = parameter(0.0, 'Radius of a wheel', unit='m', above=0.0)
        linear: SpeedLimits = group('linear.x', SpeedLimits)

From it are made the declarations and descriptors of the ROS node, the check when a parameter is
set, and the checked object for the component, which never reads from a node.

A field made by :func:`keyed_group` holds one table for each element of a list parameter, by its
name, as ``__map_…`` of generate_parameter_library does::

    @dataclass(frozen=True)
    class PidParameters:
        dof_names: tuple[str, ...] = parameter((), 'Degrees of freedom')
        gains: Mapping[str, Gains] = keyed_group('gains', 'dof_names', Gains)  # gains.<dof>.p
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
import dataclasses
from dataclasses import dataclass
import functools
import math
import re
from typing import Any, get_type_hints, TypeAlias, TypeVar

from amr_description.errors import ParameterError

Table = TypeVar('Table')

Value: TypeAlias = bool | int | float | str | tuple[Any, ...]

TYPE_NAMES: dict[Any, str] = {
    bool: 'bool',
    int: 'integer',
    float: 'double',
    str: 'string',
    tuple[str, ...]: 'string_array',
    tuple[float, ...]: 'double_array',
    tuple[bool, ...]: 'bool_array',
}
"""The Python types of fields, and their names in ROS."""

_ELEMENT_TYPES = {'string_array': str, 'double_array': float, 'bool_array': bool}
_KEY = 'amr_description.parameter'
_NO_VALUES: Mapping[str, Any] = {}
_WITH_A_COMMA = re.compile(r'[-+]?(0,\d+|\d+,(\d{1,2}|\d{4,}))')
"""A decimal comma; that of 1,000 may be between thousands."""
_NUMBER = re.compile(r'[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?')


@dataclass(frozen=True, slots=True)
class Bounds:
    """
    The constraints on a value.

    Numbers must be finite unless ``nan`` is true; NaN then satisfies every bound on size.
    ``length``, ``fewer_than``, ``unique`` and ``elements`` are about the elements of an array.

    ``magnitude`` holds the smallest and the greatest absolute value of a number other than 0 that
    a robot can have. Beyond it computations overflow. It is not in the descriptor of the
    parameter, as ROS 2 has no such bounds.
    """

    minimum: float | None = None
    maximum: float | None = None
    above: float | None = None
    magnitude: tuple[float, float] | None = None
    not_zero: bool = False
    choices: tuple[str, ...] = ()
    length: int | None = None
    fewer_than: int | None = None
    not_empty: bool = False
    unique: bool = False
    elements: tuple[str, ...] = ()
    nan: bool = False

    def complaint(self, value: Value) -> str:
        """Return what the value should be; '' if it is valid."""
        if self.not_empty and value in ((), ''):
            return 'must not be empty'
        if self.length is not None and isinstance(value, tuple) and len(value) != self.length:
            return f'must have {self.length} elements'
        elements = value if isinstance(value, tuple) else ()
        if self.fewer_than is not None and len(elements) >= self.fewer_than:
            return f'must have fewer than {self.fewer_than} elements'
        if self.unique and len(set(elements)) < len(elements):
            return 'must not hold anything twice'
        if self.elements and not set(elements) <= set(self.elements):
            return f'must hold only {", ".join(self.elements)}'
        if self.choices and value not in self.choices:
            return f'must be one of {", ".join(self.choices)}'
        numbers = value if isinstance(value, tuple) else (value,)
        complaints = (self._complaint_on_number(n) for n in numbers if type(n) in (int, float))
        return next(filter(None, complaints), '')

    def _complaint_on_number(self, value: float) -> str:
        if not self.nan and not math.isfinite(value):
            return 'must be a finite number'
        if math.isnan(value):
            return ''
        if self.not_zero and value == 0:
            return 'must not be zero'
        if self.above is not None and not value > self.above:
            return f'must be greater than {self.above:g}'
        if self.minimum is not None and not value >= self.minimum:
            return f'must be at least {self.minimum:g}'
        if self.maximum is not None and not value <= self.maximum:
            return f'must be at most {self.maximum:g}'
        return self._complaint_on_magnitude(value)

    def _complaint_on_magnitude(self, value: float) -> str:
        if self.magnitude is None or value == 0:
            return ''
        smallest, greatest = self.magnitude
        away, back = ('at least', 'at most') if value > 0 else ('at most', 'at least')
        sign = 1 if value > 0 else -1
        if abs(value) > greatest:
            return f'must be {back} {sign * greatest:g}'
        if abs(value) < smallest:
            takes_zero = not self.not_zero and self.above is None
            return f'must be {"0 or " if takes_zero else ""}{away} {sign * smallest:g}'
        return ''


@dataclass(frozen=True, slots=True)
class Spec:
    """One row of a table; ``name`` is the full dotted name, ``type`` that of ROS."""

    name: str
    type: str
    default: Value
    doc: str
    unit: str
    bounds: Bounds
    read_only: bool

    def adopt(self, value: Any) -> Any:
        """
        Return a number, or a list of numbers, in the type of the table; all else as it is.

        An integer for a double is what files have most often of a wrong type: ``wheel_radius: 1``.
        """
        match self.type, value:
            case 'double', int() if not isinstance(value, bool):
                return float(value)
            case 'integer', float() if value.is_integer():
                return int(value)
            case 'double_array', Sequence() if not isinstance(value, str):
                # rcl refuses a file with a list of both.
                if value and all(type(item) is int for item in value):
                    return [float(item) for item in value]
        return value

    def check(self, value: Any) -> Value:
        """Return the value in the type of the table. Raises ParameterError."""
        element = _ELEMENT_TYPES.get(self.type)
        if element is not None:
            good = isinstance(value, Sequence) and not isinstance(value, str)
            good = good and all(type(item) is element for item in value)
            value = tuple(value) if good else value
        else:
            good = TYPE_NAMES.get(type(value)) == self.type
        if not good:
            raise ParameterError(
                f"parameter '{self.name}' must be of type {self.type}, found {value!r}, "
                f'{_kind_of(value)}{_rewritten(value, self.type)}'
            )
        complaint = self.bounds.complaint(value)
        if complaint:
            unit = f' {self.unit}' if self.unit else ''
            shown = list(value) if isinstance(value, tuple) else value if value != '' else "''"
            raise ParameterError(f"parameter '{self.name}' {complaint}, found {shown}{unit}")
        return value


def _kind_of(value: Any) -> str:
    """Return the type of a value in words, as YAML has it."""
    match value:
        case None:
            return 'no value'
        case str() | bool() | int() | float():
            name = TYPE_NAMES[type(value)]
            return f'an {name}' if name == 'integer' else f'a {name}'
        case Sequence() if len(value) > 0:
            kinds = {_kind_of(item).split()[-1] for item in value}
            return f'a list of {kinds.pop()}s' if len(kinds) == 1 else 'a list of various types'
        case Sequence():
            return 'an empty list'
    return 'a table'


def _rewritten(value: Any, kind: str) -> str:
    """Return ``; write …`` with the value in the type that it should have; '' if it has none."""
    match kind, value:
        case 'double', int() if not isinstance(value, bool):
            return f'; write {value}.0'
        case 'double', str() if _NUMBER.fullmatch(value):
            return f'; write {float(value)!r}, without quotes'
        case 'double', str() if _WITH_A_COMMA.fullmatch(value):
            return f'; write {float(value.replace(",", ".", 1))!r}, with a point'
        case 'integer', float() if value.is_integer():
            return f'; write {int(value)}'
        case 'integer', str() if value.isdecimal():
            return f'; write {value}, without quotes'
        case 'bool', str() if value.lower() in ('true', 'false'):
            return f'; write {value.lower()}, without quotes'
        case 'string', bool() | int() | float():
            return f"; write '{value}', in quotes"
        case 'string_array', str() if value:
            return f'; write [{value}]'
        case 'double_array', Sequence() if all(type(item) in (int, float) for item in value):
            return f'; write {[float(item) for item in value]}'
    return ''


def parameter(
    default: Value, doc: str, *, unit: str = '', read_only: bool = False, **bounds: Any
) -> Any:
    """Make a field: default, meaning, unit (SI) and the keywords of :class:`Bounds`."""
    row = {'doc': doc, 'unit': unit, 'read_only': read_only, 'bounds': Bounds(**bounds)}
    return dataclasses.field(default=default, metadata={_KEY: row})


def group(prefix: str, table: Callable[[], Any]) -> Any:
    """Make a field that holds another table, whose names begin with ``prefix``."""
    return dataclasses.field(default_factory=table, metadata={_KEY: prefix})


def keyed_group(prefix: str, keys: str, table: Callable[[], Any]) -> Any:
    """
    Make a field, a mapping, that holds another table for each element of a list parameter, for
    a name, or for each name that is given.

    Args:
        prefix: in front of the elements, ``gains`` for ``gains.<element>.p``; '': nothing.
        keys: the field of the list, or of the name, which stands above this one; '': there is
            none, ``<prefix>.<element>.<parameter>`` alone tells the elements.
        table: the dataclass of one element.
    """
    return dataclasses.field(default_factory=dict, metadata={_KEY: _Keys(prefix, keys, table)})


def numbered_group(prefix: str, table: Callable[[], Any]) -> Any:
    """
    Make a field, a mapping, that holds other tables by their numbers, from '1' on.

    As many as are given: ``<prefix>1.<name>``, ``<prefix>2.<name>`` …
    """
    return dataclasses.field(default_factory=dict, metadata={_KEY: _Numbers(prefix, table)})


def specs(table: type, prefix: str = '', values: Mapping[str, Any] = _NO_VALUES) -> Iterator[Spec]:
    """
    Yield the rows of a table, groups flattened, in the order of its fields.

    ``values``: by dotted name; those of lists say which elements keyed groups have. They are read
    no earlier than the rows below them are asked for.
    """
    for _, row in _rows(table, prefix):
        match row:
            case _Group():
                yield from specs(row.table, row.prefix, values)
            case _KeyedGroup() | _NumberedGroup():
                for each in row.groups(values).values():
                    yield from specs(each.table, each.prefix, values)
            case _:
                yield row


def tables(
    table: type, values: Mapping[str, Any] = _NO_VALUES, prefix: str = ''
) -> Iterator[tuple[str, type]]:
    """Yield (prefix, table) of a table and of those in its groups; see :func:`specs`."""
    yield prefix, table
    for _, row in _rows(table, prefix):
        if isinstance(row, _Group):
            yield from tables(row.table, values, row.prefix)
        elif isinstance(row, _KeyedGroup | _NumberedGroup):
            for each in row.groups(values).values():
                yield from tables(each.table, values, each.prefix)


def build(table: type[Table], values: Mapping[str, Any], prefix: str = '') -> Table:
    """
    Make the checked dataclass of some values; the others keep their defaults.

    Defaults are checked too, which makes a parameter without a useful default (a wheel radius of
    0) mandatory.

    Args:
        table: the dataclass.
        values: by dotted name; names that are not in the table are ignored, as a node has other
            parameters.
        prefix: in front of the names of the table, with its dot.

    Raises:
        ParameterError: a value has the wrong type or violates its bounds.
    """
    arguments: dict[str, Any] = {}
    for field, row in _rows(table, prefix):
        match row:
            case _Group():
                arguments[field] = build(row.table, values, row.prefix)
            case _KeyedGroup() | _NumberedGroup():
                groups = row.groups(values)
                arguments[field] = {
                    key: build(each.table, values, each.prefix) for key, each in groups.items()
                }
            case _:
                arguments[field] = row.check(values.get(row.name, row.default))
    return table(**arguments)


@dataclass(frozen=True, slots=True)
class _Group:
    table: Any
    prefix: str


@dataclass(frozen=True, slots=True)
class _Keys:
    """What :func:`keyed_group` was given."""

    prefix: str
    keys: str
    table: Any


@dataclass(frozen=True, slots=True)
class _KeyedGroup:
    table: Any
    prefix: str
    keys: str
    """The full name of the list parameter; '': of none."""

    def groups(self, values: Mapping[str, Any]) -> dict[str, _Group]:
        """Return the group of each element."""
        keys = values.get(self.keys, ()) if self.keys else self._given(values)
        if isinstance(keys, str):
            keys = [keys] if keys else []
        if not isinstance(keys, Sequence):
            return {}
        return {str(key): _Group(self.table, f'{self.prefix}{key}.') for key in keys}

    def _given(self, values: Mapping[str, Any]) -> list[str]:
        below = [name[len(self.prefix) :] for name in values if name.startswith(self.prefix)]
        return list(dict.fromkeys(name.partition('.')[0] for name in below if '.' in name))


@dataclass(frozen=True, slots=True)
class _Numbers:
    """What :func:`numbered_group` was given."""

    prefix: str
    table: Any


@dataclass(frozen=True, slots=True)
class _NumberedGroup:
    table: Any
    prefix: str

    def groups(self, values: Mapping[str, Any]) -> dict[str, _Group]:
        """Return the group of each number."""
        found: dict[str, _Group] = {}
        names = [name for name in values if name.startswith(self.prefix)]
        while any(name.startswith(f'{self.prefix}{len(found) + 1}.') for name in names):
            number = str(len(found) + 1)
            found[number] = _Group(self.table, f'{self.prefix}{number}.')
        return found


_Row: TypeAlias = Spec | _Group | _KeyedGroup | _NumberedGroup


# A table is read again and again: as its parameters are declared, checked, listed and built. Its
# rows are fixed with its class: 0.1 us instead of 100 for those of diff_drive_controller.
@functools.lru_cache(maxsize=1024)
def _rows(table: type, prefix: str) -> tuple[tuple[str, _Row], ...]:
    """Return (field, row) of each. Raises ParameterError for a type that no ROS parameter has."""
    # Those of the fields are strings in a module with deferred annotations.
    types = get_type_hints(table)
    rows: list[tuple[str, _Row]] = []
    for field in dataclasses.fields(table):
        row, kind = field.metadata[_KEY], types[field.name]
        if isinstance(row, str):
            rows.append((field.name, _Group(field.default_factory, f'{prefix}{row}.')))
        elif isinstance(row, _Numbers):
            rows.append((field.name, _NumberedGroup(row.table, prefix + row.prefix)))
        elif isinstance(row, _Keys):
            inner = f'{prefix}{row.prefix}.' if row.prefix else prefix
            keys = prefix + row.keys if row.keys else ''
            rows.append((field.name, _KeyedGroup(row.table, inner, keys)))
        elif kind in TYPE_NAMES:
            spec = Spec(prefix + field.name, TYPE_NAMES[kind], field.default, **row)
            rows.append((field.name, spec))
        else:
            known = ', '.join(t.__name__ if isinstance(t, type) else str(t) for t in TYPE_NAMES)
            raise ParameterError(
                f"parameter '{prefix}{field.name}' of {table.__name__} is annotated as {kind}, "
                f'which is none of {known}'
            )
    return tuple(rows)
