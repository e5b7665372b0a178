# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``$(var name)`` in parameter files: what a launch file would replace, before a node reads it.

launch_ros does so for ``ParameterFile(…, allow_substs=True)``. Without that launch file, a
variable in the names of joints, links and sensors is what makes them names of the robot, if there
is only one such text.
"""

from collections.abc import Collection, Iterator, Mapping
import re
from typing import Any

_VARIABLE = re.compile(r'\$\(var\s+([^)\s]+)\s*\)')


def variables_as(
    given: Mapping[str, Any], joints: Collection[str], others: Collection[str] = ()
) -> dict[str, str]:
    """
    Return the text of each variable with which the texts that hold it are names of the robot.

    Args:
        given: parameters, by dotted name.
        joints: the names of the robot's joints.
        others: those of its links, sensors and GPIOs, for texts that are names of no joints.

    Returns:
        The text by variable, of a prefix perhaps empty; variables for which there is none, or more
        than one, are left out.
    """
    templates: dict[str, list[str]] = {}
    for text in _texts(given):
        for variable in dict.fromkeys(_VARIABLE.findall(text)):
            templates.setdefault(variable, []).append(text)
    found = {}
    for variable, texts in templates.items():
        fits = [_fits(text, joints) or _fits(text, others) for text in texts]
        common = set.intersection(*(filter(None, fits))) if any(fits) else set()
        if len(common) == 1 or '' in common:
            found[variable] = min(common)
    return found


def replaced(value: Any, variables: Mapping[str, str]) -> Any:
    """Return a parameter with these variables replaced, as often as they are in it."""
    if isinstance(value, str):
        return _VARIABLE.sub(lambda match: variables.get(match[1], match[0]), value)
    if isinstance(value, list | tuple):
        return type(value)(replaced(each, variables) for each in value)
    return value


def has_variables(value: Any) -> bool:
    """Return whether a parameter holds a variable."""
    return any(_VARIABLE.search(text) for text in _texts({'': value}))


def _texts(given: Mapping[str, Any]) -> Iterator[str]:
    for value in given.values():
        for each in value if isinstance(value, list | tuple) else (value,):
            if isinstance(each, str) and '$(var' in each:
                yield each


def _fits(template: str, names: Collection[str]) -> set[str]:
    """Return the texts that make a template with one variable, perhaps repeated, a known name."""
    parts = _VARIABLE.split(template)[::2]
    pattern = f'{re.escape(parts[0])}(.*?){re.escape(parts[1])}'
    pattern += ''.join(rf'\1{re.escape(part)}' for part in parts[2:])
    return {match[1] for name in names if (match := re.fullmatch(pattern, name))}
