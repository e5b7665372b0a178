# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Which files a request may name: a program reads them as its own user, whoever asks.

Every user of a host reaches the services of a program, and a xacro file is a program. So a request
is not to have another user's file run, or wait for a pipe, or tell what only the program's user
may read: regular files only, and of these the ones in packages of the ament index, and those that
nobody but the program's user or root can change, and are for all to read by their mode.
"""

import os
from pathlib import Path
import re
from stat import S_ISREG
import sys

from amr_description.ament_index import own_share, prefixes
from amr_description.errors import ResourceError
from amr_description.ownership import changed_by_others, hidden_from_others
from amr_description.text import one_line, shorten

_PLAIN = re.compile(r'[\w .,:/+=@~%-]*')
"""An argument that calls nothing, though xacro takes it for an expression inside of ``${…}``."""


def distrust(path: Path) -> str:
    """Return why a request may not name a file, and what would do; '': it may, or is not there."""
    try:
        if not S_ISREG(path.stat().st_mode):
            return 'is no regular file'
    except (OSError, ValueError):  # who reads it says why
        return ''
    if _is_in_package(path):
        return ''
    real = Path(os.path.realpath(path))
    hidden = hidden_from_others(real)  # its own mode: Ubuntu's homes, of 0750, have robots in them
    for reason in (hidden, *map(changed_by_others, (real, *real.parents))):
        if reason:
            return (
                f'is not taken from a request: {reason}; what would do: a file of a package, as '
                'package://PACKAGE/FILE, or, of a robot, the text, as '
                "'ros2 run amr_description create -file' sends it"
            )
    return ''


def distrust_argument(name: str, value: str) -> str:
    """Return why a request may not give xacro an argument, and what would do; '': it may."""
    if _PLAIN.fullmatch(value):
        return ''
    return (
        f"the argument {one_line(shorten(name))} is not taken from a request: it is '"
        f"{one_line(shorten(value))}', which could be an expression that xacro evaluates; what "
        'would do: letters, digits, blanks and _ . , : / + = @ ~ % -, or the text of the '
        "description, as 'ros2 run amr_description create -file' sends it"
    )


def distrust_folder(folder: Path) -> str:
    """Return why a request may not have a folder listed, and what would do; '': it may."""
    if _is_in_package(folder):
        return ''
    if reason := hidden_from_others(Path(os.path.realpath(folder))):
        return f'is not listed for a request: {reason}; a folder of a package will do'
    return ''


def distrust_new(path: Path, place: Path) -> str:
    """
    Return why a request may not have a folder made, and what would do; '': it may.

    Below a place only, and where nobody else can have it lead elsewhere in the meantime.

    Args:
        path: That of the folder.
        place: Absolute, without links.
    """
    try:
        real = (place / path).resolve()
        for each in real.parents:  # from Python 3.13 on resolve() lets links in a circle pass
            if os.path.lexists(each):
                each.stat()
    except (OSError, ValueError, RuntimeError):  # no such name can be, or links in a circle
        return f'is no name that a folder can have; what would do: a name below {place}'
    if real == place or not real.is_relative_to(place):
        return f'is not below {place}, as a request has to be; what would do: a name below it'
    for each in real.parents:
        if os.path.lexists(each) and (reason := changed_by_others(each)):
            return f'is not made for a request: {reason}; what would do: another one below {place}'
        if each == place:
            break
    return ''


def guard_reads() -> None:
    """
    Have this process open no file that a request may not name, but those of Python itself.

    A xacro file that may be run opens what its arguments name, and those come of the request. For
    a process that does nothing else: it cannot be undone.
    """
    own = [Path(each).resolve() for each in (sys.prefix, sys.base_prefix, *sys.path) if each]

    def look(event: str, arguments: tuple[object, ...]) -> None:
        if event != 'open' or not isinstance(arguments[0], str | bytes):
            return
        path = Path(os.fsdecode(arguments[0]))
        if not _is_below(_absolute(path), own) and (reason := distrust(path)):
            raise PermissionError(f'{path} {reason}')

    sys.addaudithook(look)


def _is_in_package(path: Path) -> bool:
    try:
        own = [own_share()]
    except ResourceError:
        own = []
    return _is_below(_absolute(path), [*prefixes(), *own])


def _absolute(path: Path) -> Path:
    """Return a path without ``..``, which may have links, as packages of a workspace have."""
    return Path(os.path.normpath(path.absolute()))


def _is_below(path: Path, folders: list[Path]) -> bool:
    return any(path.is_relative_to(folder.absolute()) for folder in folders)
