# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The text of a message type with all that it contains, for those who read a bag.

It is what MCAP calls ``ros2msg``: the ``.msg`` file as it is, then that of each type in it, behind
a line of ``=`` and one with the name.
"""

from collections.abc import Callable, Iterator
from functools import cache
import re

from amr_description.ament_index import package_share
from amr_description.errors import ResourceError

ENCODING = 'ros2msg'
_BETWEEN = '=' * 80 + '\nMSG: '
_PRIMITIVES = {
    'bool', 'byte', 'char', 'float32', 'float64', 'int8', 'uint8', 'int16', 'uint16', 'int32',
    'uint32', 'int64', 'uint64', 'string', 'wstring',
}  # fmt: skip
# The type of a field, without what makes an array or a bounded string of it.
_FIELD_TYPE = re.compile(r'\s*([A-Za-z][\w/]*)')
_TYPE_NAME = re.compile(
    r'(?P<package>[a-zA-Z]\w*)/((?P<kind>msg|srv|action)/)?(?P<name>[a-zA-Z]\w*)', re.ASCII
)
_EVENT_TEXT = """\
service_msgs/ServiceEventInfo info
{name}_Request[<=1] request
{name}_Response[<=1] response
"""


@cache
def schema_text(type_name: str) -> str:
    """
    Return the text of ``package/msg/Name`` and of the types in it; empty: it is not installed.

    So it is for the types behind services and actions, of which there are no files of their own:
    ``package/srv/Name_Event``, ``package/action/Name_FeedbackMessage`` and so on.
    """
    found = _TYPE_NAME.fullmatch(type_name)  # which a bag may have from anybody
    if not found:
        return ''
    return compose(f'{found["package"]}/{found["kind"] or "msg"}/{found["name"]}', _installed_text)


def compose(type_name: str, text_of: Callable[[str], str | None]) -> str:
    """
    Return the text of a type and of those in it.

    Args:
        type_name: ``package/kind/Name``.
        text_of: returns that of a type alone; None: there is none, and what is composed is empty.
    """
    text = text_of(type_name)
    if text is None:
        return ''
    parts, seen, waiting = [text], {type_name}, [*contained_types(type_name, text)]
    while waiting:
        name = waiting.pop(0)
        if name in seen:
            continue
        seen.add(name)
        text = text_of(name)
        if text is None:
            return ''
        package, _, last = name.split('/')
        parts.append(f'{_BETWEEN}{package}/{last}\n{text}')
        waiting[:0] = contained_types(name, text)
    return '\n'.join(part.rstrip('\n') for part in parts) + '\n'


def contained_types(type_name: str, text: str) -> Iterator[str]:
    """Yield ``package/kind/Name`` of the type of each field that is a message."""
    package, kind, _ = type_name.split('/')
    for line in text.splitlines():
        found = _FIELD_TYPE.match(line.partition('#')[0])
        if not found or found[1] in _PRIMITIVES:
            continue
        *before, name = found[1].split('/')
        if before:
            yield f'{before[0]}/msg/{name}'
        elif name == 'Header' and kind == 'msg':
            yield 'std_msgs/msg/Header'
        else:
            # Parts of services and actions are beside them, messages of a package in msg/.
            beside = kind != 'msg' and '_' in name
            yield f'{package}/{kind if beside else "msg"}/{name}'


def _installed_text(type_name: str) -> str | None:
    package, kind, name = type_name.split('/')
    if kind == 'msg':
        return _file_text(package, f'msg/{name}.msg')
    whole, _, part = name.rpartition('_')
    if kind == 'srv':
        return _service_text(_file_text(package, f'srv/{whole}.srv'), whole, part)
    return _action_text(package, name)


def _service_text(text: str | None, whole: str, part: str) -> str | None:
    if text is None:
        return None
    sections = [each.strip('\n') for each in re.split(r'(?m)^---[ \t]*$', text)]
    texts = {'Event': _EVENT_TEXT.format(name=whole)}
    texts.update(zip(('Request', 'Response'), sections, strict=False))
    return texts.get(part)


def _action_text(package: str, name: str) -> str | None:
    """Return the text of a part of an action, which is made of its goal, result and feedback."""
    found = re.fullmatch(
        r'(\w+?)_(Goal|Result|Feedback|FeedbackMessage|SendGoal_\w+|GetResult_\w+)', name
    )
    whole, part = found.groups() if found else ('', '')
    text = _file_text(package, f'action/{whole}.action') if whole else None
    if text is None:
        return None
    sections = [each.strip('\n') for each in re.split(r'(?m)^---[ \t]*$', text)]
    goal_id = 'unique_identifier_msgs/UUID goal_id\n'
    texts = {
        'FeedbackMessage': f'{goal_id}{whole}_Feedback feedback\n',
        'SendGoal_Request': f'{goal_id}{whole}_Goal goal\n',
        'SendGoal_Response': 'bool accepted\nbuiltin_interfaces/Time stamp\n',
        'GetResult_Request': goal_id,
        'GetResult_Response': f'int8 status\n{whole}_Result result\n',
        'SendGoal_Event': _EVENT_TEXT.format(name=f'{whole}_SendGoal'),
        'GetResult_Event': _EVENT_TEXT.format(name=f'{whole}_GetResult'),
    }
    texts.update(zip(('Goal', 'Result', 'Feedback'), sections, strict=False))
    return texts.get(part)


def _file_text(package: str, below: str) -> str | None:
    try:
        return (package_share(package) / below).read_text(encoding='utf-8')
    except (OSError, ResourceError, UnicodeDecodeError):
        return None
