# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Parameters as one table a component: name, type, default, unit, bounds, meaning.

The table is a frozen dataclass whose fields are made by :func:`parameter`; a field made by
:func:`group` holds another table below a dotted prefix::

    @dataclass(frozen=True)
    class DriveParameters:
        wheel_radius: float = parameter(0.0, 'Radius of a wheel', unit='m', above=0.0)
        linear: SpeedLimits = group('linear.x', SpeedLimits)

From it come the declarations and descriptors of the ROS node, the check when a parameter is set,
and the checked object that the component is given: a component never reads a node.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
import dataclasses
from dataclasses import dataclass
import math
from typing import Any

from amr_description.errors import ParameterError

type Value = bool | int | float | str | tuple[Any, ...]

TYPE_NAMES: dict[Any, str] = {
    bool: 'bool',
    int: 'integer',
    float: 'double',
    str: 'string',
    tuple[str, ...]: 'string_array',
    tuple[float, ...]: 'double_array',
}
"""Python types of the fields, and what ROS calls them."""

_ELEMENT_TYPES = {'string_array': str, 'double_array': float}
_KEY = 'amr_description.parameter'


@dataclass(frozen=True, slots=True)
class Bounds:
    """What a value must satisfy; a NaN satisfies every bound on size where ``nan`` is true."""

    minimum: float | None = None
    maximum: float | None = None
    above: float | None = None
    choices: tuple[str, ...] = ()
    length: int | None = None
    not_empty: bool = False
    nan: bool = False

    def complaint(self, value: Value) -> str:
        """Say what the value should be, or nothing when it is good."""
        if self.not_empty and value in ((), ''):
            return 'must not be empty'
        if self.length is not None and isinstance(value, tuple) and len(value) != self.length:
            return f'must have {self.length} elements'
        if self.choices and value not in self.choices:
            return f'must be one of {", ".join(self.choices)}'
        if isinstance(value, float) and math.isnan(value):
            return '' if self.nan else 'must be a number'
        if isinstance(value, int | float) and not isinstance(value, bool):
            return self._complaint_on_size(value)
        return ''

    def _complaint_on_size(self, value: float) -> str:
        if self.above is not None and not value > self.above:
            return f'must be greater than {self.above:g}'
        if self.minimum is not None and not value >= self.minimum:
            return f'must be at least {self.minimum:g}'
        if self.maximum is not None and not value <= self.maximum:
            return f'must be at most {self.maximum:g}'
        return ''


@dataclass(frozen=True, slots=True)
class Spec:
    """One row of a table; ``name`` is the full dotted name, ``type`` as ROS calls it."""

    name: str
    type: str
    default: Value
    doc: str
    unit: str
    bounds: Bounds
    read_only: bool

    def check(self, value: Any) -> Value:
        """Return the value in the table's type. Raises ParameterError."""
        element = _ELEMENT_TYPES.get(self.type)
        if element is not None:
            good = isinstance(value, Sequence) and not isinstance(value, str)
            good = good and all(type(item) is element for item in value)
            value = tuple(value) if good else value
        else:
            good = TYPE_NAMES.get(type(value)) == self.type
        if not good:
            raise ParameterError(
                f"parameter '{self.name}' must be of type {self.type}, found {value!r}"
                + (f'; write {value}.0' if self.type == 'double' and type(value) is int else '')
            )
        complaint = self.bounds.complaint(value)
        if complaint:
            unit = f' {self.unit}' if self.unit else ''
            shown = list(value) if isinstance(value, tuple) else value
            raise ParameterError(f"parameter '{self.name}' {complaint}, found {shown}{unit}")
        return value


def parameter(
    default: Value, doc: str, *, unit: str = '', read_only: bool = False, **bounds: Any
) -> Any:
    """Make a field: default, meaning, unit (SI) and the keywords of :class:`Bounds`."""
    row = {'doc': doc, 'unit': unit, 'read_only': read_only, 'bounds': Bounds(**bounds)}
    return dataclasses.field(default=default, metadata={_KEY: row})


def group(prefix: str, table: Callable[[], Any]) -> Any:
    """Make a field that holds another table, whose names stand below ``prefix``."""
    return dataclasses.field(default_factory=table, metadata={_KEY: prefix})


def specs(table: type, prefix: str = '') -> Iterator[Spec]:
    """Yield the rows of a table, groups flattened, in the order of its fields."""
    for field in dataclasses.fields(table):
        row = field.metadata[_KEY]
        if isinstance(row, str):
            yield from specs(field.default_factory, f'{prefix}{row}.')
        else:
            yield _spec(field, prefix)


def build[Table](table: type[Table], values: Mapping[str, Any], prefix: str = '') -> Table:
    """
    Make the checked dataclass from dotted names; what is not given keeps its default.

    Defaults are checked too: a parameter that has no useful default (a wheel radius of 0) is so
    made mandatory. Names that are not in the table are left alone: a node has other parameters.
    Raises ParameterError.
    """
    arguments: dict[str, Any] = {}
    for field in dataclasses.fields(table):
        row = field.metadata[_KEY]
        if isinstance(row, str):
            arguments[field.name] = build(field.default_factory, values, f'{prefix}{row}.')
        else:
            spec = _spec(field, prefix)
            arguments[field.name] = spec.check(values.get(spec.name, spec.default))
    return table(**arguments)


def _spec(field: dataclasses.Field[Any], prefix: str) -> Spec:
    return Spec(
        name=prefix + field.name,
        type=TYPE_NAMES[field.type],
        default=field.default,
        **field.metadata[_KEY],
    )
