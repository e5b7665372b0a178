# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Parameter files: the text that ``dump`` writes, and what of a file ``load`` gives to a node."""

from collections.abc import Iterator, Mapping
import re
from typing import Any

import yaml

from amr_description.cli.param.values import has_type, Value
from amr_description.errors import ParameterError

_KEY = 'ros__parameters'
_EVERY_NODE = '/**'
# What rcl reads as a number or a truth value, and YAML 1.1 does not.
_READ_OTHERWISE = re.compile(
    r'[-+]?(\d+\.?\d*(e[-+]?\d+)?|\.\d+(e[-+]?\d+)?'
    r'|0x[\da-f]+\.?[\da-f]*(p[-+]?\d+)?|inf(inity)?|nan(\(\w*\))?)|[yn]',
    re.IGNORECASE,
)


class _Dumper(yaml.SafeDumper):
    """Quotes the strings that rcl would not read as such."""

    def represent_text(self, text: str) -> yaml.ScalarNode:
        style = "'" if _READ_OTHERWISE.fullmatch(text) else None
        return self.represent_scalar('tag:yaml.org,2002:str', text, style)


_Dumper.add_representer(str, _Dumper.represent_text)


def file_text(node: str, values: Mapping[str, Value]) -> str:
    """Return the parameters of a node as the YAML that ``--params-file`` reads."""
    content = {node: {_KEY: _nested(values)}}
    return yaml.dump(content, Dumper=_Dumper, default_flow_style=False)


def _nested(values: Mapping[str, Value]) -> dict[str, Any]:
    """Put ``a.b`` as b below a, unless a has a value of its own."""
    tree: dict[str, Any] = {}
    for name, value in sorted(values.items()):
        table, rest = tree, name
        while '.' in rest and isinstance(table.get(rest.partition('.')[0], {}), dict):
            above, _, rest = rest.partition('.')
            table = table.setdefault(above, {})
        table[rest] = value
    return tree


def select(content: Mapping[Any, Any], node: str, *, wildcards: bool = True) -> dict[str, Value]:
    """
    Return what a parameter file says to a node, by dotted names, where it says anything.

    The more a section is the node's own, the later it comes, and so wins: first ``/**``, then
    other patterns, then the node's full name.

    :param content: The file as YAML gives it.
    :param wildcards: Take sections with ``*`` in their names too.
    :raises ParameterError: There is nothing for this node.
    """
    sections = list(_sections(content))
    chosen = [
        (pattern, parameters)
        for pattern, parameters in sections
        if (wildcards or '*' not in pattern) and _matches(pattern, node)
    ]
    if not chosen:
        names = ', '.join(dict.fromkeys(pattern for pattern, _ in sections))
        raise ParameterError(f'no parameters for {node} in it, only for {names}')
    chosen.sort(key=lambda section: (section[0] != _EVERY_NODE, '*' not in section[0]))
    values = {name: value for _, parameters in chosen for name, value in _flat(parameters)}
    return {k: v if has_type(v) else str(v) for k, v in values.items() if v is not None}


def _sections(
    content: Mapping[Any, Any], above: str = ''
) -> Iterator[tuple[str, Mapping[Any, Any]]]:
    """Yield (full name or pattern, parameters); nodes may stand below their namespaces."""
    for key, value in content.items():
        if key == _KEY:
            yield above, _table(value, f'{_KEY} of {above}')
        else:
            name = f'{above}/{str(key).strip("/")}'
            yield from _sections(_table(value, name), name)


def _table(value: Any, what: str) -> Mapping[Any, Any]:
    """Raises ParameterError: it is something else."""
    if not isinstance(value, dict):
        raise ParameterError(f'{what} is expected to be a mapping, found {value!r}')
    return value


def _matches(pattern: str, node: str) -> bool:
    """Tell whether a pattern, with ``*`` for one name and ``**`` for any, is that of a node."""
    names = {'**': '(/[^/]+)*', '*': '/[^/]+'}
    parts = pattern.removeprefix('/').split('/')
    expression = ''.join(names.get(part, f'/{re.escape(part)}') for part in parts)
    return re.fullmatch(expression, node) is not None


def _flat(parameters: Mapping[Any, Any], prefix: str = '') -> Iterator[tuple[str, Any]]:
    """Yield (dotted name, value)."""
    for name, value in parameters.items():
        if isinstance(value, dict):
            yield from _flat(value, f'{prefix}{name}.')
        else:
            yield f'{prefix}{name}', value
