# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``$(var name)`` and the like, in launch files of XML and YAML, and in parameter files."""

from collections.abc import Callable, Sequence
import re
from typing import TypeAlias

from amr_description.launch_api import logic, substitutions
from amr_description.launch_api.locations import refusal
from amr_description.launch_api.substitutions import Substitution, TextSubstitution
from amr_description.text import did_you_mean

Argument: TypeAlias = list[Substitution]


def _env(name: Argument, default: Argument | None = None) -> Substitution:
    return substitutions.EnvironmentVariable(name, default_value=default)


def _var(name: Argument, default: Argument | None = None) -> Substitution:
    return substitutions.LaunchConfiguration(name, default=default)


def _command(command: Argument, on_stderr: Argument | None = None) -> Substitution:
    return substitutions.Command(command, on_stderr=on_stderr or 'fail')


def _eval(expression: Argument, modules: Argument | None = None) -> Substitution:
    if modules is None:
        return logic.PythonExpression(expression)
    text = ''.join(each.text for each in modules if isinstance(each, TextSubstitution))
    return logic.PythonExpression(expression, [name.strip() for name in text.split(',')])


_MAKERS: dict[str, Callable[..., Substitution]] = {
    'all': logic.AllSubstitution,
    'and': logic.AndSubstitution,
    'anon': substitutions.AnonName,
    'any': logic.AnySubstitution,
    'command': _command,
    'dirname': substitutions.ThisLaunchFileDir,
    'env': _env,
    'equals': logic.EqualsSubstitution,
    'eval': _eval,
    'exec-in-pkg': substitutions.ExecutableInPackage,
    'file-content': substitutions.FileContent,
    'filename': substitutions.ThisLaunchFile,
    'find-exec': lambda name: substitutions.FindExecutable(name=name),
    'find-pkg-prefix': substitutions.FindPackagePrefix,
    'find-pkg-share': substitutions.FindPackageShare,
    'if': logic.IfElseSubstitution,
    'launch_log_dir': substitutions.LaunchLogDir,
    'log_dir': substitutions.LaunchLogDir,
    'not': logic.NotSubstitution,
    'not-equals': logic.NotEqualsSubstitution,
    'or': logic.OrSubstitution,
    'var': _var,
}
_NAME = re.compile(r'\s*([\w-]+)\s*')


def parse_text(text: str, where: str = '') -> list[Substitution]:
    """
    Return a text with ``$(…)`` in it as substitutions.

    Args:
        text: the text.
        where: its place, for messages.

    Raises:
        BringupError: a substitution is unknown or not closed.
    """
    found, end = _parts(text, 0, where, inner=False)
    assert end == len(text)
    return found or [TextSubstitution(text='')]


def _parts(text: str, at: int, where: str, *, inner: bool) -> tuple[list[Substitution], int]:
    """Return the parts from ``at`` to the end or, within ``$(…)``, to the end of the argument."""
    found: list[Substitution] = []
    plain, quote = '', ''
    while at < len(text):
        char = text[at]
        if text.startswith('$(', at):
            if plain:
                found.append(TextSubstitution(text=plain))
            one, at = _substitution(text, at + 2, where)
            found.append(one)
            plain = ''
            continue
        if text.startswith('\\$', at) or (char == '\\' and inner and at + 1 < len(text)):
            plain += text[at + 1]
            at += 2
            continue
        if inner and char in '\'"' and (not quote or char == quote):
            quote = '' if quote else char
        elif inner and not quote and (char.isspace() or char == ')'):
            break
        else:
            plain += char
        at += 1
    if plain:
        found.append(TextSubstitution(text=plain))
    return found, at


def _substitution(text: str, at: int, where: str) -> tuple[Substitution, int]:
    match = _NAME.match(text, at)
    name = match[1] if match else ''
    if name not in _MAKERS:
        raise refusal(
            f'$({name or "…"}) is not understood here{did_you_mean(name, list(_MAKERS))}; '
            f'understood are {", ".join(_MAKERS)}',
            where,
        )
    at = match.end() if match else at
    is_quoted = text[at : at + 1] in ('"', "'")
    arguments: list[Argument] = []
    while at < len(text) and text[at] != ')':
        if text[at].isspace():
            at += 1
            continue
        argument, at = _parts(text, at, where, inner=True)
        arguments.append(argument)
    if at >= len(text):
        raise refusal(f"'{text}': $({name} is not closed", where)
    if name in ('eval', 'command') and not (is_quoted or _is_on_stderr(name, arguments[1:])):
        arguments = _as_one(arguments)
    return _made(name, arguments, where), at + 1


def _as_one(words: Sequence[Argument]) -> list[Argument]:
    """Return the words of an expression or a command, which were not quoted, as one argument."""
    blank = TextSubstitution(text=' ')
    return [[part for word in words for part in (*word, blank)][:-1]] if words else []


def _made(name: str, given: Sequence[Argument], where: str) -> Substitution:
    try:
        made = _MAKERS[name](*given)
    except TypeError:
        raise refusal(f'$({name} …): it does not take {len(given)} arguments', where) from None
    made.where = where or made.where
    return made


def _is_on_stderr(name: str, more: Sequence[Argument]) -> bool:
    """Return whether what follows a command is its second argument, and no word of it."""
    if name != 'command' or len(more) != 1 or len(more[0]) != 1:
        return False
    (part,) = more[0]
    return isinstance(part, TextSubstitution) and part.text in substitutions.ON_STDERR
