# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Launch files in XML and YAML: their tags as the actions of Python files."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
import shlex
from typing import Any
import xml.parsers.expat

import yaml

from amr_description.errors import BringupError
from amr_description.launch_api import actions, ros_actions
from amr_description.launch_api.conditions import IfCondition, UnlessCondition
from amr_description.launch_api.descriptions import (
    Action,
    DeclareLaunchArgument,
    LaunchDescription,
)
from amr_description.launch_api.including import IncludeLaunchDescription, LaunchDescriptionSource
from amr_description.launch_api.locations import refusal
from amr_description.launch_api.parameters import ParameterFile, ParameterValue
from amr_description.launch_api.processes import ExecuteProcess, Node
from amr_description.launch_api.substitutions import Substitution, TextSubstitution
from amr_description.launch_api.text_syntax import parse_text
from amr_description.text import did_you_mean, truth

_TYPES = {'str': str, 'string': str, 'int': int, 'float': float, 'bool': bool}


@dataclass
class Element:
    """A tag with its attributes and the tags in it."""

    tag: str
    where: str
    attributes: dict[str, Any] = field(default_factory=dict)
    children: list['Element'] = field(default_factory=list)
    taken: set[str] = field(default_factory=set)

    def get(self, name: str, default: Any = None) -> Any:
        """Return an attribute as it stands."""
        self.taken.add(name)
        return self.attributes.get(name, default)

    def need(self, *names: str) -> Any:
        """Return the first of these attributes that is there. Raises BringupError."""
        for name in names:
            if name in self.attributes:
                return self.get(name)
        raise refusal(f'<{self.tag}> lacks the attribute {" or ".join(names)}', self.where)

    def text(self, value: Any) -> list[Substitution]:
        """Return a value as substitutions."""
        word = str(value).lower() if isinstance(value, bool) else str(value)
        return parse_text(word, self.where)

    def optional(self, name: str) -> list[Substitution] | None:
        """Return an attribute as substitutions; None: it is not there."""
        value = self.get(name)
        return None if value is None else self.text(value)

    def needed(self, *names: str) -> list[Substitution]:
        """Return the first of these attributes that is there, as substitutions."""
        return self.text(self.need(*names))

    def flag(self, name: str, default: bool) -> bool:
        """Return an attribute that is true or false. Raises BringupError."""
        value = truth(str(self.get(name, default)))
        if value is None:
            raise refusal(f'<{self.tag} {name}="{self.get(name)}">: true or false', self.where)
        return value

    def below(self, *tags: str) -> list['Element']:
        """Return the tags in it with one of these names."""
        self.taken |= set(tags)
        return [child for child in self.children if child.tag in tags]

    def require_all_taken(self) -> None:
        """Raise BringupError if it has something that is not understood."""
        names = [*self.attributes, *(child.tag for child in self.children)]
        odd = [name for name in names if name not in self.taken]
        if odd:
            raise refusal(
                f"'{odd[0]}' of <{self.tag}> is not understood here"
                f'{did_you_mean(odd[0], sorted(self.taken))}; understood are '
                f'{", ".join(sorted(self.taken))}',
                self.where,
            )


def _words(parts: list[Substitution]) -> list[list[Substitution]]:
    """Split a text with substitutions in it at blanks outside of quotes."""
    words: list[list[Substitution]] = []
    is_open = False
    for part in parts:
        if not isinstance(part, TextSubstitution):
            if is_open:
                words[-1].append(part)
            else:
                words.append([part])
            is_open = True
            continue
        pieces = shlex.split(part.text)
        for index, piece in enumerate(pieces):
            text = TextSubstitution(text=piece)
            if index == 0 and is_open and not part.text[0].isspace():
                words[-1].append(text)
            else:
                words.append([text])
        is_open = bool(part.text) and not part.text[-1].isspace()
    return words


def _process(element: Element) -> dict[str, Any]:
    """Return the arguments that all processes have."""
    for name in ('output', 'emulate_tty', 'sigterm_timeout', 'sigkill_timeout'):
        element.get(name)
    pairs = [(each.needed('name'), each.needed('value')) for each in element.below('env')]
    respawn = element.optional('respawn')
    return {
        'respawn': False if respawn is None else respawn,
        'respawn_delay': element.optional('respawn_delay'),
        'prefix': element.optional('launch-prefix'),
        'cwd': element.optional('cwd'),
        'additional_env': {tuple(name): value for name, value in pairs},
    }


def _parameter_value(element: Element) -> Any:
    nested = element.below('param')
    if nested:
        return {each.need('name'): _parameter_value(each) for each in nested}
    value = element.need('value')
    separator = element.get('value-sep', element.get('value_sep'))
    if separator is not None:
        return [element.text(each) for each in str(value).split(separator)]
    kind = element.get('type')
    if kind is not None:
        if kind not in _TYPES:
            raise refusal(f'type="{kind}": it is one of {", ".join(_TYPES)}', element.where)
        return ParameterValue(element.text(value), value_type=_TYPES[kind])
    return element.text(value) if isinstance(value, str) else value


def _node(element: Element) -> Node:
    parameters: list[Any] = []  # in their order: of two values the later one counts
    for each in element.below('param'):
        file = each.optional('from')
        if file is not None:
            parameters.append(ParameterFile(file, allow_substs=each.flag('allow_substs', False)))
        else:
            parameters.append({each.need('name'): _parameter_value(each)})
    remaps = element.below('remap')
    element.get('exec_name')
    return Node(
        package=element.needed('pkg', 'package'),
        executable=element.needed('exec', 'executable'),
        name=element.optional('name'),
        namespace=element.optional('namespace'),
        arguments=_words(element.optional('args') or []),
        ros_arguments=_words(element.optional('ros_args') or []),
        parameters=parameters,
        remappings=[(each.needed('from'), each.needed('to')) for each in remaps],
        **_process(element),
    )


def _executable(element: Element) -> ExecuteProcess:
    words = [*_words(element.needed('cmd')), *_words(element.optional('args') or [])]
    element.get('name')
    return ExecuteProcess(cmd=words, shell=element.flag('shell', False), **_process(element))


def _include(element: Element) -> IncludeLaunchDescription:
    given = element.below('arg', 'let')
    return IncludeLaunchDescription(
        LaunchDescriptionSource(element.needed('file')),
        launch_arguments=[(each.needed('name'), each.needed('value')) for each in given],
    )


def _group(element: Element) -> actions.GroupAction:
    kept = {tuple(each.needed('name')): each.needed('value') for each in element.below('keep')}
    return actions.GroupAction(
        _actions(element, skip=('keep',)),
        scoped=element.flag('scoped', True),
        forwarding=element.flag('forwarding', True),
        launch_configurations=kept,
    )


def _arg(element: Element) -> DeclareLaunchArgument:
    choices = [each.need('value') for each in element.below('choice')]
    return DeclareLaunchArgument(
        str(element.need('name')),
        default_value=element.optional('default'),
        description=element.get('description'),
        choices=choices or None,
    )


def _append_env(element: Element) -> actions.AppendEnvironmentVariable:
    separator = element.optional('separator')
    return actions.AppendEnvironmentVariable(
        element.needed('name'),
        element.needed('value'),
        prepend=element.flag('prepend', False),
        **({} if separator is None else {'separator': separator}),
    )


def _of_two(make: Callable[..., Action], one: str, two: str) -> Callable[[Element], Action]:
    return lambda element: make(element.needed(one), element.needed(two))


def _parameter(element: Element) -> ros_actions.SetParameter:
    return ros_actions.SetParameter(element.need('name'), _parameter_value(element))


def _timer(element: Element) -> actions.TimerAction:
    return actions.TimerAction(period=element.needed('period'), actions=_actions(element))


def _log(element: Element) -> actions.Log:
    level = element.get('level', 'INFO')
    return actions.Log(msg=element.needed('message', 'msg'), level=str(level))


def _shutdown(element: Element) -> actions.Shutdown:
    return actions.Shutdown(reason=element.optional('reason') or 'reason not given')


_TAGS: Mapping[str, Callable[[Element], Action]] = {
    'append_env': _append_env,
    'arg': _arg,
    'executable': _executable,
    'group': _group,
    'include': _include,
    'let': _of_two(actions.SetLaunchConfiguration, 'name', 'value'),
    'log': _log,
    'node': _node,
    'push_ros_namespace': lambda e: ros_actions.PushROSNamespace(e.needed('namespace')),
    'set_env': _of_two(actions.SetEnvironmentVariable, 'name', 'value'),
    'set_parameter': _parameter,
    'set_parameters_from_file': lambda e: ros_actions.SetParametersFromFile(e.needed('filename')),
    'set_remap': _of_two(ros_actions.SetRemap, 'from', 'to'),
    'set_use_sim_time': lambda e: ros_actions.SetUseSimTime(e.needed('value')),
    'shutdown': _shutdown,
    'timer': _timer,
    'unset_env': lambda e: actions.UnsetEnvironmentVariable(e.needed('name')),
}


def _actions(element: Element, skip: tuple[str, ...] = ()) -> list[Action]:
    element.taken |= {child.tag for child in element.children}
    return [_action(child) for child in element.children if child.tag not in skip]


def _action(element: Element) -> Action:
    tag = element.tag.replace('-', '_')
    if tag not in _TAGS:
        raise refusal(
            f'<{element.tag}> is not understood here{did_you_mean(tag, list(_TAGS))}; understood '
            f'are {", ".join(_TAGS)}',
            element.where,
        )
    holds, fails = element.optional('if'), element.optional('unless')
    made = _TAGS[tag](element)
    made.where = element.where
    if holds is not None and fails is not None:
        raise refusal(f'<{element.tag}> has both if and unless: it takes one', element.where)
    if holds is not None:
        made.condition = IfCondition(holds)
    elif fails is not None:
        made.condition = UnlessCondition(fails)
    element.require_all_taken()
    for child in element.children:
        if child.tag not in _TAGS:
            child.require_all_taken()
    return made


def _description(root: Element, path: Path) -> LaunchDescription:
    if root.tag != 'launch':
        raise BringupError(f"'{path}': its first tag is {root.tag}, not launch")
    return LaunchDescription(_actions(root))


def _from_xml(path: Path) -> LaunchDescription:
    parser = xml.parsers.expat.ParserCreate()
    root = Element('', path.name)
    open_tags = [root]

    def start(tag: str, attributes: dict[str, str]) -> None:
        where = f'{path.name}:{parser.CurrentLineNumber}'
        element = Element(tag, where, dict(attributes))
        open_tags[-1].children.append(element)
        open_tags.append(element)

    parser.StartElementHandler = start
    parser.EndElementHandler = lambda _tag: open_tags.pop()
    try:
        parser.Parse(path.read_bytes(), True)
    except xml.parsers.expat.ExpatError as error:
        raise refusal(f'is not XML: {error}', f'{path.name}:{error.lineno}') from None
    return _description(root.children[0], path)


def _from_yaml(path: Path) -> LaunchDescription:
    try:
        node = yaml.compose(path.read_text('utf-8'), Loader=yaml.SafeLoader)
    except yaml.MarkedYAMLError as error:
        line = error.problem_mark.line + 1 if error.problem_mark else 1
        raise refusal(f'is not YAML: {error.problem}', f'{path.name}:{line}') from None
    if not isinstance(node, yaml.MappingNode) or len(node.value) != 1:
        raise BringupError(f"'{path}': it takes one key, launch")
    key, value = node.value[0]
    root = Element(str(key.value), f'{path.name}:1')
    root.children += _elements(value, path.name)
    return _description(root, path)


def _elements(node: yaml.Node, file: str) -> Iterator[Element]:
    """Yield the tags of a list of ``- tag: {…}``."""
    if not isinstance(node, yaml.SequenceNode):
        raise refusal('it takes a list', f'{file}:{node.start_mark.line + 1}')
    for each in node.value:
        if not isinstance(each, yaml.MappingNode):
            raise refusal('it takes `tag:` with its values', f'{file}:{each.start_mark.line + 1}')
        for key, value in each.value:
            yield _element(str(key.value), value, file, key.start_mark.line + 1)


def _element(tag: str, node: yaml.Node, file: str, line: int) -> Element:
    element = Element(tag, f'{file}:{line}')
    if isinstance(node, yaml.SequenceNode):
        element.children += _elements(node, file)
    elif isinstance(node, yaml.MappingNode):
        for key, value in node.value:
            name, at = str(key.value), key.start_mark.line + 1
            if _is_list_of_tables(value) and name == 'children':
                element.children += _elements(value, file)
            elif _is_list_of_tables(value):
                element.children += (_element(name, each, file, at) for each in value.value)
            else:
                element.attributes[name] = yaml.SafeLoader('').construct_object(value, deep=True)
    return element


def _is_list_of_tables(node: yaml.Node) -> bool:
    return isinstance(node, yaml.SequenceNode) and all(
        isinstance(each, yaml.MappingNode) for each in node.value
    )


LOADERS: Mapping[str, Callable[[Path], LaunchDescription]] = {
    '.launch': _from_xml,
    '.xml': _from_xml,
    '.yaml': _from_yaml,
    '.yml': _from_yaml,
}
