# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The arguments of a stack, ``name:=value``, declared by the signature of its function.

::

    def stack(
        urdf: str,                                               # required
        rtf: Annotated[float, 'real-time factor'] = 1.0,         # with a help text
        world: Literal['empty', 'maze'] = 'empty',               # with choices
    ) -> Stack: ...
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
import inspect
from typing import Annotated, Any, get_args, get_origin, get_type_hints, Literal, TypeVar

from amr_description.errors import BringupError, UsageError
from amr_description.text import suggestion, truth

F = TypeVar('F', bound=Callable[..., object])


@dataclass(frozen=True)
class Argument:
    """One parameter of a stack's function."""

    name: str
    type: type
    """str, float, int or bool."""
    default: str | None = None
    """As a user would type it; None: required."""
    choices: tuple[str, ...] = ()
    help: str = ''

    def convert(self, text: str) -> Any:
        """Return the value of a text. Raises BringupError or UsageError."""
        if self.choices and text not in self.choices:
            raise BringupError(
                f'Argument "{self.name}" provided value "{text}" is not valid. '
                f'Valid options are: {list(self.choices)}'
            )
        try:
            value = truth(text) if self.type is bool else self.type(text)
        except ValueError:
            value = None
        if value is None:
            wanted = {bool: 'true or false', int: 'an integer', float: 'a number'}[self.type]
            raise UsageError(f"{self.name}:={text}: '{text}' is not {wanted}")
        return value


def declared(function: Callable[..., object]) -> list[Argument]:
    """Return the arguments that a stack's function declares. Raises BringupError."""
    try:
        hints = get_type_hints(function, include_extras=True)
    except NameError as error:
        raise BringupError(f"the annotations of '{function.__name__}': {error}") from None
    return [
        _argument(parameter, hints.get(name, str))
        for name, parameter in inspect.signature(function).parameters.items()
    ]


def with_arguments_of(other: Callable[..., object]) -> Callable[[F], F]:
    """
    Return a decorator: the ``**others`` of a stack's function are the arguments of another stack.

    ::

        @with_arguments_of(simulation)
        def patrol(rounds: int = 3, **others: Any) -> Stack:
            robot = simulation(**others)
    """

    def decorate(function: F) -> F:
        own = inspect.signature(function)
        given = inspect.signature(other).parameters | own.parameters
        parameters = [
            parameter.replace(kind=parameter.KEYWORD_ONLY)
            for parameter in given.values()
            if parameter.kind is not parameter.VAR_KEYWORD
        ]
        vars(function)['__signature__'] = own.replace(parameters=parameters)
        function.__annotations__ = {**other.__annotations__, **function.__annotations__}
        return function

    return decorate


def _argument(parameter: inspect.Parameter, hint: Any) -> Argument:
    if parameter.kind not in (parameter.POSITIONAL_OR_KEYWORD, parameter.KEYWORD_ONLY):
        raise BringupError(f"argument '{parameter}' of the stack can not be given by its name")
    help_text = ''
    if get_origin(hint) is Annotated:
        hint, *notes = get_args(hint)
        help_text = ' '.join(note for note in notes if isinstance(note, str))
    choices = get_args(hint) if get_origin(hint) is Literal else ()
    kind = str if choices else hint
    if kind not in (str, float, int, bool) or not all(isinstance(c, str) for c in choices):
        raise BringupError(
            f"argument '{parameter.name}' of the stack is annotated {hint!r}; "
            'it can be str, float, int, bool or a Literal of strings'
        )
    return Argument(parameter.name, kind, _typed_default(parameter, kind), choices, help_text)


def _typed_default(parameter: inspect.Parameter, kind: type) -> str | None:
    default = parameter.default
    if default is parameter.empty:
        return None
    if not isinstance(default, (int, float) if kind is float else kind):
        raise BringupError(
            f"argument '{parameter.name}' of the stack is {default!r} by default, "
            f'which is no {kind.__name__}'
        )
    return as_typed(default)


def as_typed(value: object) -> str:
    """Return a value as a user would type it."""
    return str(value).lower() if isinstance(value, bool) else str(value)


def parse(words: Sequence[str]) -> dict[str, str]:
    """
    Split words ``name:=value``; the last one of a name wins.

    Raises:
        BringupError: one is none of these; the exit code is 1, as that of the original.
    """
    given = {}
    for word in words:
        name, separator, value = word.partition(':=')
        if not separator or not name:
            raise BringupError(
                f"malformed launch argument '{word}', expected format '<name>:=<value>'"
            )
        given[name] = value
    return given


def resolve(arguments: Sequence[Argument], given: Mapping[str, str]) -> dict[str, Any]:
    """
    Return the values to call a stack's function with.

    Args:
        arguments: those that it declares.
        given: texts by name, as a user typed them.

    Raises:
        UsageError: a name is unknown, or a value has the wrong type.
        BringupError: a required argument is missing, or a value is not among the choices.
    """
    known = [argument.name for argument in arguments]
    for name in given:
        if name not in known:
            raise UsageError(f"unknown argument '{name}'{suggestion(name, known)}")
    return {argument.name: _value(argument, given) for argument in arguments}


def _value(argument: Argument, given: Mapping[str, str]) -> Any:
    text = given.get(argument.name, argument.default)
    if text is None:
        raise BringupError(
            f"missing required argument '{argument.name}' (description: "
            f"'{argument.help or 'no description given'}'), given: {list(given)}"
        )
    return argument.convert(text)


def show(arguments: Sequence[Argument]) -> str:
    """Return what ``--show-args`` prints, in launch's format."""
    paragraphs = ["Arguments (pass arguments as '<name>:=<value>'):\n"]
    for argument in arguments:
        about = argument.help or 'no description given'
        if argument.choices:
            about += f'. Valid choices are: {list(argument.choices)}'
        default = '' if argument.default is None else f"\n        (default: '{argument.default}')"
        paragraphs.append(f"    '{argument.name}':\n        {about}{default}\n")
    return '\n'.join(paragraphs if arguments else [*paragraphs, '  No arguments.\n'])
