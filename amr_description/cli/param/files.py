# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What ``load`` takes from a parameter file for one node."""

from collections.abc import Mapping
from typing import Any

from amr_description.cli.param.values import has_type, Value
from amr_description.errors import ParameterError
from amr_description.parameter_files import dotted, EVERY_NODE, flatten, KEY, Section, sections


def select(content: Mapping[Any, Any], node: str, *, wildcards: bool = True) -> dict[str, Value]:
    """
    Return the parameters of a node in a parameter file, by dotted names.

    The most particular section wins: ``/**`` comes first, then other patterns, then the node's
    full name. Values that have no type in ROS become strings.

    Args:
        content: the file as YAML gives it.
        node: the full name of the node.
        wildcards: whether sections with ``*`` in their names count.

    Raises:
        ParameterError: there is nothing for this node, or it is not a mapping.
    """
    found = list(sections(content))
    chosen = [s for s in found if (wildcards or '*' not in s.pattern) and s.is_of(node)]
    if not chosen:
        names = ', '.join(dict.fromkeys(section.pattern for section in found))
        raise ParameterError(f'no parameters for {node} in it, only for {names}')
    chosen.sort(key=lambda section: (section.pattern != EVERY_NODE, '*' not in section.pattern))
    values = {dotted(keys): v for section in chosen for keys, v in flatten(_table(section))}
    return {k: v if has_type(v) else str(v) for k, v in values.items() if v is not None}


def _table(section: Section) -> Mapping[Any, Any]:
    if not isinstance(section.parameters, dict):
        raise ParameterError(
            f'{KEY} of {section.pattern} is expected to be a mapping, found {section.parameters!r}'
        )
    return section.parameters
