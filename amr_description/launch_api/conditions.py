# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Whether an action counts: IfCondition, UnlessCondition and comparisons of configurations."""

from collections.abc import Callable

from amr_description.errors import BringupError
from amr_description.launch_api.context import LaunchContext
from amr_description.launch_api.locations import at, Located
from amr_description.launch_api.substitutions import (
    normalize_to_list_of_substitutions,
    perform_substitutions,
    SomeSubstitutions,
)


class InvalidConditionExpressionError(BringupError):
    """The text of a condition is neither true nor false."""


class Condition(Located):
    """A function of the context."""

    def __init__(self, *, predicate: Callable[[LaunchContext], bool]) -> None:
        self._predicate = predicate

    def evaluate(self, context: LaunchContext) -> bool:
        """Return whether it holds."""
        return self._predicate(context)


class IfCondition(Condition):
    """Hold if a text is 'true' or '1'."""

    def __init__(self, predicate_expression: SomeSubstitutions) -> None:
        self._expression = normalize_to_list_of_substitutions(predicate_expression)
        super().__init__(predicate=self._is_true)

    def _is_true(self, context: LaunchContext) -> bool:
        text = perform_substitutions(context, self._expression)
        word = text.strip().lower()
        if word not in ('true', '1', 'false', '0'):
            error = InvalidConditionExpressionError(
                f"invalid condition expression '{text}', expected one of ['true', '1', 'false', "
                "'0']"
            )
            raise at(error, self.where)
        return word in ('true', '1')


class UnlessCondition(IfCondition):
    """Hold if a text is 'false' or '0'."""

    def evaluate(self, context: LaunchContext) -> bool:
        return not super().evaluate(context)


class LaunchConfigurationEquals(Condition):
    """Hold if a configuration has a value; None: if there is no such configuration."""

    def __init__(self, launch_configuration_name: str, expected_value: SomeSubstitutions) -> None:
        self._name = launch_configuration_name
        self._expected = (
            None if expected_value is None else normalize_to_list_of_substitutions(expected_value)
        )
        super().__init__(predicate=self._is_equal)

    def _is_equal(self, context: LaunchContext) -> bool:
        context.read.add(self._name)
        value = context.launch_configurations.get(self._name)
        if self._expected is None or value is None:
            return value is None and self._expected is None
        return bool(value == perform_substitutions(context, self._expected))


class LaunchConfigurationNotEquals(LaunchConfigurationEquals):
    """Hold if a configuration has another value."""

    def evaluate(self, context: LaunchContext) -> bool:
        return not super().evaluate(context)
