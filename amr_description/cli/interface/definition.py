# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The text of an interface definition, with the definition of each field's type below it."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
import re

from amr_description.errors import AmrError

_COMMENT = '#'
# A message's name begins with a capital, a primitive type's does not (rosidl_adapter).
_FIELD_OF_MESSAGE = re.compile(
    r'(?:(?P<package>\w+)/)?(?P<message>[A-Z]\w*)(?:\[[^]]*\])?[ \t]+[a-z]'
)

KINDS = {'msg': 'message', 'srv': 'service', 'action': 'action'}
"""The second part of an interface's name -> its kind in words."""


def kind_of(name: str) -> str:
    """Return the kind of ``msg/Name``."""
    return name.partition('/')[0]


@dataclass(frozen=True)
class InterfaceText:
    """The text of a .msg, .srv, .action or .idl file."""

    text: str
    idl: bool = False


@dataclass(frozen=True)
class Comments:
    """Which comments and blank lines are kept."""

    at_top: bool = True
    below: bool = False


def expand(
    name: str,
    read: Callable[[str], InterfaceText],
    comments: Comments = Comments(),  # noqa: B008
) -> Iterator[str]:
    """
    Yield the lines of an interface, each field of a message type followed by its definition.

    The definition is indented by one tab more than the field. IDL is printed as it is.

    Args:
        name: ``package/msg/Name``, or srv or action.
        read: returns the definition of such a name.
        comments: which comments are kept.

    Raises:
        AmrError: a message contains itself.
    """
    yield from _expand((name,), read, comments.at_top, comments.below)


def _expand(
    names: tuple[str, ...], read: Callable[[str], InterfaceText], comments: bool, below: bool
) -> Iterator[str]:
    """``names``: the interface and those that contain it, outermost first."""
    package = names[-1].partition('/')[0]
    indent = '\t' * (len(names) - 1)
    definition = read(names[-1])
    for line in definition.text.splitlines():
        shown = line.rstrip() if comments or definition.idl else _without_comment(line)
        if shown or comments:
            yield indent + shown if shown else ''
        message = None if definition.idl else message_type_of(line, package)
        if message is None:
            continue
        if message in names:
            raise AmrError(f'The definition of {message} contains itself')
        yield from _expand((*names, message), read, below, below)


def message_type_of(line: str, package: str) -> str | None:
    """
    Return the message type of the field that a line declares: ``package/msg/Name``.

    None: it declares something else, or nothing. ``package`` is the default of the type's package.
    """
    field = _FIELD_OF_MESSAGE.match(line)
    return f'{field["package"] or package}/msg/{field["message"]}' if field else None


def _without_comment(line: str) -> str:
    """Return the part before the comment; in rosidl a ``#`` cannot be quoted."""
    before, mark, _ = line.partition(_COMMENT)
    return before.strip() if mark else line.rstrip()
