# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The references that are made of the code: rules by their docstrings, parameters, arguments.

``python docs/references.py`` writes them into ``docs/api/``, to be read without a site, too;
``test/unit/docs/test_docs_references.py`` holds that they are what the code says.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
import inspect
from pathlib import Path
import re
from typing import Any

from amr_description.bringup.arguments import declared
from amr_description.bringup.stacks import STACKS
from amr_description.controllers import CONTROLLERS
from amr_description.doctor import table
from amr_description.launch_api.modules import UNDERSTOOD
from amr_description.model import checks
from amr_description.navigation.contract.rules import RULES as DEMANDS
from amr_description.parameters import Spec, specs
from amr_description.registry import resolve

FOLDER = Path(__file__).resolve().parent / 'api'
_MADE = '<!-- Made by docs/references.py. -->\n\n'
_PART_OF = {'qos': 'graph', 'topic_names': 'graph'}


def _paragraphs(rule: Callable[..., Any]) -> list[str]:
    """Return the docstring of a rule as paragraphs of Markdown."""
    text = inspect.getdoc(rule) or ''
    text = re.sub(r':\w+:`~?(?:[\w.]+\.)?(\w+)`', r'`\1`', text).replace('``', '`')
    text = re.sub(r'docs/(\w+\.md(#[\w-]+)?)', r'[more](../\1)', text)
    return [' '.join(each.split()) for each in text.split('\n\n')]


def _doctor() -> str:
    lines = ['# Rules of the doctor', '', 'What [`ros2 doctor`](../doctor.md) looks for:', '']
    family = ''
    for rule in table.RULES:
        name = table.family(rule.__name__)
        if (part := _PART_OF.get(name, name)) != family:
            family = part
            lines += [f'## {family.capitalize()}', '']
        lines += [f'### {rule.__name__}', '']
        for each in _paragraphs(rule):
            lines += [each, '']
    return '\n'.join(lines)


def _check_urdf() -> str:
    def rows(rules: Iterable[Callable[..., Any]]) -> list[str]:
        return [f'| `{each.__name__}` | {" ".join(_paragraphs(each))} |' for each in rules]

    head = ['| rule | what has to be so |', '| --- | --- |']
    return '\n'.join(
        [
            '# Rules of check_urdf',
            '',
            '[check_urdf](../check_urdf.md) asks of each part of a robot:',
            '',
            *head,
            *rows(checks.RULES),
            '',
            'And of the whole, if the parts have no errors, no missing shapes, no wrong units:',
            '',
            *head,
            *rows(checks.RULES_OF_THE_WHOLE),
            '',
        ]
    )


def _rows_of(parameters: type) -> list[Spec]:
    """Return the rows of a table; those of each of ``dof_names`` begin with ``<dof>``."""
    names = {
        row.name: [f'<{row.name.removesuffix("s").removesuffix("_name")}>']
        for row in specs(parameters)
        if row.type in ('string', 'string_array')
    }
    return [*specs(parameters, values=names)]


def _default(row: Spec) -> str:
    match row.default:
        case bool(value):
            return str(value).lower()
        case () | '':
            return ''
        case tuple(values):
            return f'[{", ".join(map(str, values))}]'
        case value:
            return str(value)


def _parameters() -> str:
    kinds: dict[type, list[str]] = {}
    for name in CONTROLLERS.names:
        if name.startswith('amr_description/'):  # made of a plugin of Gazebo, with its settings
            continue
        kinds.setdefault(CONTROLLERS.find(name).parameters_type, []).append(name)
    lines = [
        '# Parameters of the controllers',
        '',
        'What the [controllers](../controllers.md) take;',
    ]
    lines += ['`ros2 run amr_description NAME --help` prints those of a node.', '']
    for parameters, names in kinds.items():
        lines += [f'## {", ".join(name.rpartition("/")[2] for name in names)}', '']
        lines += [', '.join(f'`{name}`' for name in names), '']
        lines += [
            '| parameter | type | default | unit | meaning |',
            '| --- | --- | --- | --- | --- |',
        ]
        for row in _rows_of(parameters):
            doc = ' '.join(row.doc.split()).replace('|', '\\|')
            choices = f'; one of {", ".join(row.bounds.choices)}' if row.bounds.choices else ''
            lines.append(
                f'| `{row.name}` | {row.type} | {_default(row)} | {row.unit} | {doc}{choices} |'
            )
        lines.append('')
    return '\n'.join(lines)


def _check_navigation() -> str:
    lines = ['# Demands of check_navigation', '']
    lines += ['What Nav2 and slam_toolbox ask of a robot, by [check_navigation](../nav2.md):', '']
    lines += ['| demand | what is asked | by |', '| --- | --- | --- |']
    return '\n'.join(
        [*lines, *(f'| `{each.name}` | {each.asked} | {each.source} |' for each in DEMANDS), '']
    )


def _stacks() -> str:
    lines = [
        '# Arguments of the stacks',
        '',
        '`ros2 launch amr_description STACK NAME:=VALUE …`:',
        '',
    ]
    common = declared(resolve(STACKS['simulation']))
    for name in sorted(STACKS, key=lambda each: (each != 'simulation', each)):
        stack = resolve(STACKS[name])
        taken = declared(stack)
        others = [each for each in taken if each not in common] if name != 'simulation' else taken
        lines += [f'## {name}', '', _paragraphs(stack)[0], '']
        if len(others) < len(taken):
            same = ', '.join(f'`{each.name}`' for each in taken if each in common)
            has_all = len(taken) - len(others) == len(common)
            lines += [f'As `simulation`: {"all of its arguments" if has_all else same}.', '']
        if others:
            lines += ['| argument | default | meaning |', '| --- | --- | --- |']
        for each in others:
            shown = each.default if each.default is not None else 'has to be given'
            choices = f'; one of {", ".join(each.choices)}' if each.choices else ''
            lines.append(f'| `{each.name}:=` | {shown} | {each.help}{choices} |')
        lines.append('')
    return '\n'.join(lines)


def _launch() -> str:
    rows = (
        f'| `{module}` | {", ".join(f"`{name}`" for name in sorted(names))} |'
        for module, names in UNDERSTOOD.items()
        if names
    )
    lines = ['# Names of launch files', '', 'What [launch files](../launch_files.md) may use:', '']
    return '\n'.join([*lines, '| module | names |', '| --- | --- |', *rows, ''])


def pages() -> dict[str, str]:
    """Return the text of each page by the name of its file."""
    made = {
        'doctor': _doctor,
        'check_navigation': _check_navigation,
        'check_urdf': _check_urdf,
        'launch': _launch,
        'parameters': _parameters,
        'stacks': _stacks,
    }
    return {
        f'{name}.md': _MADE + re.sub('\n{3,}', '\n\n', make()).rstrip() + '\n'
        for name, make in made.items()
    }


if __name__ == '__main__':
    for name, text in pages().items():
        (FOLDER / name).write_text(text, encoding='utf-8')
