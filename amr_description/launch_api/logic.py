# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Substitutions that are 'true' or 'false', IfElseSubstitution, and PythonExpression."""

import importlib
import math
from typing import Any

from amr_description.launch_api.context import LaunchContext
from amr_description.launch_api.locations import refusal
from amr_description.launch_api.substitutions import (
    described,
    is_a_substitution,
    normalize_to_list_of_substitutions,
    perform_substitutions,
    SomeSubstitutions,
    Substitution,
)

_TRUE = ('true', 'yes', 'on', 'y', '1')
_FALSE = ('false', 'no', 'off', 'n', '0')


def _word(value: bool) -> str:
    return 'true' if value else 'false'


class _Logic(Substitution):
    """A substitution over others that are true or false."""

    def __init__(self, *parts: SomeSubstitutions) -> None:
        self.parts = [normalize_to_list_of_substitutions(each) for each in parts]

    def describe(self) -> str:
        return f'{type(self).__name__}({" ".join(described(each) for each in self.parts)})'

    def truth(self, context: LaunchContext, part: list[Substitution]) -> bool:
        """Return the value of a part. Raises SubstitutionFailure."""
        text = perform_substitutions(context, part)
        if text.lower() not in (*_TRUE, *_FALSE):
            name = type(self).__name__
            raise self.failure(f"{name}: {described(part)} is '{text}'; it takes true or false")
        return text.lower() in _TRUE

    def values(self, context: LaunchContext) -> list[bool]:
        """Return the values of all parts."""
        return [self.truth(context, part) for part in self.parts]


class NotSubstitution(_Logic):
    """Not."""

    def __init__(self, value: SomeSubstitutions) -> None:
        super().__init__(value)

    def perform(self, context: LaunchContext) -> str:
        return _word(not self.values(context)[0])


class AllSubstitution(_Logic):
    """Whether all are true."""

    def perform(self, context: LaunchContext) -> str:
        return _word(all(self.values(context)))


class AnySubstitution(_Logic):
    """Whether one is true."""

    def perform(self, context: LaunchContext) -> str:
        return _word(any(self.values(context)))


class AndSubstitution(AllSubstitution):
    """Whether both are true."""

    def __init__(self, left: SomeSubstitutions, right: SomeSubstitutions) -> None:
        super().__init__(left, right)


class OrSubstitution(AnySubstitution):
    """Whether one of two is true."""

    def __init__(self, left: SomeSubstitutions, right: SomeSubstitutions) -> None:
        super().__init__(left, right)


def _as_text(value: Any) -> SomeSubstitutions:
    if value is None:
        return ''
    if isinstance(value, bool):
        return _word(value)
    return value if is_a_substitution(value) else str(value)


class EqualsSubstitution(Substitution):
    """Whether two texts are the same; as booleans or numbers, where both are."""

    def __init__(self, left: Any, right: Any) -> None:
        self.left = normalize_to_list_of_substitutions(_as_text(left))
        self.right = normalize_to_list_of_substitutions(_as_text(right))

    def describe(self) -> str:
        return f'{type(self).__name__}({described(self.left)} {described(self.right)})'

    def are_equal(self, context: LaunchContext) -> bool:
        """Compare the two."""
        left = perform_substitutions(context, self.left)
        right = perform_substitutions(context, self.right)
        booleans = ('true', 'false', '1', '0')
        if left.lower() in booleans and right.lower() in booleans:
            return (left.lower() in ('true', '1')) == (right.lower() in ('true', '1'))
        try:
            return math.isclose(float(left), float(right))
        except ValueError:
            return left == right

    def perform(self, context: LaunchContext) -> str:
        return _word(self.are_equal(context))


class NotEqualsSubstitution(EqualsSubstitution):
    """Whether two texts differ."""

    def perform(self, context: LaunchContext) -> str:
        return _word(not self.are_equal(context))


class IfElseSubstitution(_Logic):
    """One text or another."""

    def __init__(
        self,
        condition: SomeSubstitutions,
        if_value: SomeSubstitutions = '',
        else_value: SomeSubstitutions = '',
    ) -> None:
        if if_value == else_value == '':
            raise refusal('One of if_value and else_value must be specified')
        super().__init__(condition, if_value, else_value)

    def describe(self) -> str:
        return f'IfElseSubstitution({", ".join(described(each) for each in self.parts)})'

    def perform(self, context: LaunchContext) -> str:
        condition, if_value, else_value = self.parts
        chosen = if_value if self.truth(context, condition) else else_value
        return perform_substitutions(context, chosen)


class PythonExpression(Substitution):
    """The value of an expression of Python, as a text."""

    def __init__(
        self, expression: SomeSubstitutions, python_modules: SomeSubstitutions = ('math',)
    ) -> None:
        self.expression = normalize_to_list_of_substitutions(expression)
        self.python_modules = normalize_to_list_of_substitutions(python_modules)

    def describe(self) -> str:
        modules = ', '.join(each.describe() for each in self.python_modules)
        return f'PythonExpr({described(self.expression)}, [{modules}])'

    def perform(self, context: LaunchContext) -> str:
        text = perform_substitutions(context, self.expression)
        try:
            names: dict[str, Any] = {}
            for module in self.python_modules:
                name = module.perform(context)
                loaded = importlib.import_module(name)
                if name == 'math':  # its names may stand without it
                    names |= vars(loaded)
                names[name] = loaded
            return str(eval(text, {}, names))
        except Exception as error:
            kind = type(error).__name__
            raise self.failure(f"PythonExpression '{text}': {kind}: {error}") from None
