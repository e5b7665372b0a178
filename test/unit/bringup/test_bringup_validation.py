# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A value of the wrong type in a stack is reported with the field it was given for."""

import math
import re

from fixtures.bringup.running import install_toys
import pytest

from amr_description.bringup import (
    after,
    all_of,
    any_of,
    exited_cleanly,
    Group,
    logged,
    Node,
    path_exists,
    ready,
    Respawn,
    Shutdown,
    Stack,
    started,
    topic,
)
from amr_description.bringup.command_line import process_specs
from amr_description.errors import BringupError

NODE = Node('talker')


@pytest.mark.parametrize(
    ('fields', 'kind'),
    [
        ({'package': 5}, 'a name without a path'),
        ({'name': 'my-talker'}, 'a name of letters, digits and _'),
        ({'name': 5}, 'a name of letters, digits and _'),
        ({'namespace': 'a b'}, 'a namespace of letters'),
        ({'namespace': 'robot-1'}, 'a namespace of letters'),
        ({'parameters': {'a': 1}}, 'a list of tables and files'),
        ({'parameters': 'arm.yaml'}, 'a list of tables and files'),
        ({'parameters': [5]}, 'a list of tables and files'),
        ({'parameters': None}, 'a list of tables and files'),
        ({'remappings': {'a': 'b'}}, 'a list of pairs'),
        ({'remappings': ['a:=b']}, 'a list of pairs'),
        ({'remappings': [('a', 'b', 'c')]}, 'a list of pairs'),
        ({'arguments': '--help'}, 'a list of words'),
        ({'arguments': [None]}, 'a list of words'),
        ({'arguments': ['a\0b']}, 'a list of words'),
        ({'arguments': (word for word in 'ab')}, 'a list of words'),
        ({'environment': ['A=1']}, 'a table of texts'),
        ({'environment': {'A': 1}}, 'a table of texts'),
        ({'environment': {'A=B': '1'}}, 'a table of texts'),
        ({'prefix': ['gdb']}, 'a text'),
        ({'start_when': NODE}, 'a condition, as exited_cleanly(node)'),
        ({'start_when': exited_cleanly}, 'a condition, as exited_cleanly(node)'),
        ({'timeout': '5'}, 'a number'),
        ({'required': 'no'}, "True, False or 'at start'"),
        ({'required': 1}, "True, False or 'at start'"),
        ({'terminal': 1}, 'True or False'),
        ({'respawn': True}, 'Respawn(…)'),
        ({'on_exit': 'shutdwon'}, "'continue', 'shutdown' or a function"),
        ({'on_exit': Shutdown('x')}, "'continue', 'shutdown' or a function"),
    ],
)
def test_fields_of_a_node(fields, kind):
    (name,) = fields
    with pytest.raises(BringupError, match=rf"Node\('arm', {name}=.*: it takes {re.escape(kind)}"):
        Node('arm', **fields)


@pytest.mark.parametrize('executable', [None, '', '/bin/ls'])
def test_an_executable_has_a_name(executable):
    with pytest.raises(BringupError, match=rf'Node\({executable!r}\): it takes a name'):
        Node(executable)


@pytest.mark.parametrize(
    ('make', 'text'),
    [
        (lambda: Group(NODE), "Group(Node('talker')): it takes a list of nodes, groups"),
        (lambda: Group([NODE], namespace=3), 'Group(…, namespace=3): it takes a namespace'),
        (lambda: Group([NODE], start_when=NODE), 'Group(…, start_when='),
        (lambda: Stack(NODE), "Stack(Node('talker')): it takes a list of nodes, groups"),
        (lambda: Stack(node for node in [NODE]), 'it takes a list of nodes, groups'),
        (lambda: Stack([[NODE]]), "[Node('talker')] stands in a stack; there can be Node"),
        (lambda: Stack([NODE], ready_when=NODE), "Stack(…, ready_when=Node('talker')): it takes"),
        (lambda: Stack([NODE], timeout=None), 'Stack(…, timeout=None): it takes a number'),
        (lambda: Stack([NODE], timeout=math.nan), 'timeout=nan: it takes more than 0 s'),
        (lambda: Stack([NODE], on_shutdown='x'), 'it takes a function'),
        (lambda: Stack([NODE], next_steps=5), 'it takes a text'),
        (lambda: Stack([NODE], notes=['hello']), "pairs, as [('INFO', 'a text')]"),
        (lambda: Respawn(delay='1'), "Respawn(…, delay='1'): it takes a number"),
        (lambda: Respawn(limit='1'), "Respawn(…, limit='1'): it takes a number"),
        (lambda: Shutdown('x', exit_code='3'), 'it takes a whole number from 0 to 255'),
        (lambda: Shutdown(3), 'Shutdown(3): it takes a text'),
        (lambda: after('5'), "after('5'): it takes a number"),
        (lambda: after(5, NODE), "after(…, Node('talker')): it takes a condition"),
        (lambda: all_of([started(NODE)]), 'it takes a condition'),
        (lambda: any_of(), 'any_of(): it takes one condition or more'),
        (lambda: ready(NODE), "ready(Node('talker')): it takes a Stack"),
        (lambda: logged('x', NODE), "logged(…, Node('talker')): it takes a text"),
        (lambda: topic(None), 'None: it takes a text'),
        (lambda: topic('a', 'std_msgs/String'), 'it takes a type as std_msgs/msg/String'),
        (lambda: path_exists(None), 'path_exists(None): it takes a path'),
        (
            lambda: Stack([NODE, Node('arm', start_when=started('talker'))]),
            "a condition waits for 'talker', which is not in the list",
        ),
    ],
)
def test_fields_of_everything_else(make, text):
    with pytest.raises(BringupError, match=re.escape(text)):
        make()


@pytest.mark.parametrize('table', [{'a': None}, {5: 1}, {'a': [[1]]}])
def test_a_wrong_parameter_is_reported_with_its_node(tmp_path, monkeypatch, table):
    install_toys(tmp_path)
    monkeypatch.setenv('AMENT_PREFIX_PATH', str(tmp_path))
    with pytest.raises(BringupError, match=r'^step-1: .*parameter'):
        process_specs(Stack([Node('step', package='toys', parameters=[table])]), tmp_path)


def test_all_valid_kinds_of_values_are_accepted(tmp_path):
    Node(
        'arm',
        namespace='/robot1/arm/',
        parameters=({'a': 1}, 'b.yaml', tmp_path),
        arguments=('-x', 1, 0.5, tmp_path),
        remappings=[['a', 'b']],
        on_exit=lambda _: None,
        respawn=Respawn(limit=None),
        timeout=math.inf,
    )
    all_of()
