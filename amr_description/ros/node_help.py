# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``--help`` of executables that take nothing but ROS arguments, or also a robot description."""

from collections.abc import Iterator, Sequence
import sys
from textwrap import fill

from amr_description import streams
from amr_description.parameters import Spec, specs
from amr_description.ros_arguments import other_arguments

DESCRIPTION = '[FILE [NAME:=VALUE ...]]'
"""How a robot description is given: :func:`amr_description.ros.arguments.split_arguments`."""
_WIDTH = 80
_INDENT = 6 * ' '
_ROS_ARGUMENTS = '[--ros-args [-p NAME:=VALUE] [-r FROM:=TO] [--params-file FILE] ...]'


def print_help(
    args: Sequence[str] | None,
    program: str,
    purpose: str,
    *tables: type,
    words: str = '',
    notes: str = '',
) -> bool:
    """
    Print how an executable is used if its command line asks for that; return whether it did.

    Args:
        args: the command line without the program's name; None: that of the process.
        program: its name.
        purpose: what it does, in a sentence.
        tables: its parameters, as :mod:`amr_description.parameters` has them.
        words: what may stand before the ROS arguments.
        notes: what else is worth to be known.
    """
    given = other_arguments(sys.argv[1:] if args is None else args)
    if not {'-h', '--help'} & {*given}:
        return False
    try:
        print('\n'.join(_lines(program, purpose, tables, words, notes)), flush=True)
    except BrokenPipeError:  # as of `| head`
        streams.abandon_stdout()
    return True


def _lines(
    program: str, purpose: str, tables: Sequence[type], words: str, notes: str
) -> Iterator[str]:
    yield ' '.join(filter(None, ['usage:', program, '[-h]', words, _ROS_ARGUMENTS]))
    yield ''
    yield fill(purpose, _WIDTH)
    rows = {row.name: row for table in tables for row in specs(table)}
    if rows:
        yield '\nparameters (-p NAME:=VALUE):'
    for row in rows.values():
        yield f'  {row.name}  {_kind(row)}'
        yield fill(row.doc, _WIDTH, initial_indent=_INDENT, subsequent_indent=_INDENT)
    if notes:
        yield f'\n{fill(notes, _WIDTH)}'


def _kind(row: Spec) -> str:
    """Return type, default and unit of a parameter, and what else it may be."""
    match row.default:
        case bool(value):
            default = str(value).lower()
        case () | '':
            default = 'empty'
        case tuple(values):
            default = str(list(values))
        case value:
            default = str(value)
    choices = f': one of {", ".join(row.bounds.choices)}' if row.bounds.choices else ''
    return f'{row.type}, {default}{f" {row.unit}" if row.unit else ""}{choices}'
