# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Launch files in XML and YAML: the same stack as in Python."""

from pathlib import Path

from fixtures.launch_files.packages import (
    commands,
    first_in_the_index,
    install_package,
    parameters,
    stack_of,
)
import pytest

from amr_description.bringup.command_line import process_specs
from amr_description.errors import BringupError
from amr_description.launch_api.launch_file import LaunchFile

XML = """<?xml version="1.0"?>
<launch>
  <arg name="who" default="you" description="Whom to greet.">
    <choice value="you"/><choice value="all"/>
  </arg>
  <let name="n" value="3"/>
  <log message="hello $(var who)"/>
  <group>
    <push_ros_namespace namespace="left"/>
    <set_env name="COLOR" value="red"/>
    <set_parameter name="use_sim_time" value="true"/>
    <node pkg="toys" exec="a" name="x" args="-n $(var n) 'two words' --to=$(var who)"
        output="screen" if="$(equals $(var who) you)" launch-prefix="nice -n 5" respawn="true">
      <param name="rate" value="$(var n)"/>
      <param name="deep"><param name="name" value="5" type="str"/></param>
      <param from="$(dirname)/p.yaml" allow_substs="true"/>
      <remap from="in" to="$(var who)/out"/>
      <env name="MORE" value="1"/>
    </node>
  </group>
  <node pkg="toys" exec="b" unless="$(equals $(var who) you)"/>
  <executable cmd="echo $(var who)" shell="true"/>
  <timer period="2.0"><node pkg="toys" exec="b"/></timer>
  <include file="$(dirname)/inner.launch.yaml"><arg name="of" value="$(var who)"/></include>
</launch>
"""
YAML = """\
launch:
- arg:
    name: of
- group:
  - push_ros_namespace:
      namespace: right
  - node:
      pkg: toys
      exec: b
      args: $(var of)
      param:
      - name: rate
        value: 2.5
      - name: names
        value: [a, b]
      remap:
      - from: in
        to: out
"""


@pytest.fixture
def folder(tmp_path):
    """A folder with two files, and the package ``toys``."""
    install_package(tmp_path, 'toys', *'ab')
    (tmp_path / 'my.launch.xml').write_text(XML)
    (tmp_path / 'inner.launch.yaml').write_text(YAML)
    (tmp_path / 'p.yaml').write_text('/**: {ros__parameters: {who: $(var who)}}\n')
    with first_in_the_index(tmp_path):
        yield tmp_path


@pytest.mark.parametrize('file_first', [True, False])
def test_of_two_values_of_a_parameter_the_later_one_counts(folder, file_first):
    ways = ['<param from="$(dirname)/plain.yaml"/>', '<param name="rate" value="1"/>']
    (folder / 'plain.yaml').write_text('/**: {ros__parameters: {rate: 2}}\n')
    file = folder / 'order.launch.xml'
    inner = ''.join(ways if file_first else reversed(ways))
    file.write_text(f'<launch><node pkg="toys" exec="a">{inner}</node></launch>')
    (spec,) = process_specs(stack_of(file), folder)
    names = [Path(word).name for word in spec.command if word.endswith('.yaml')]
    assert names.index('plain.yaml') == (0 if file_first else 1)


def test_what_is_started(folder):
    stack = stack_of(folder / 'my.launch.xml')
    assert commands(stack) == [
        (
            'a-1',
            'at once, started again',
            "nice -n 5 a -n 3 'two words' --to=you --ros-args -r __node:=x -r __ns:=/left "
            '-r in:=you/out',
        ),
        ('echo-2', 'at once', "sh -c 'echo you'"),
        ('b-3', 'when 2 s have passed of the stack', 'b'),
        ('b-4', 'at once', 'b you --ros-args -r __ns:=/right -r in:=out'),
    ]
    written = parameters(stack, 'a-1')
    for line in ('who: you', 'rate: 3', "deep:\n      name: '5'", 'use_sim_time: true'):
        assert line in written
    assert 'rate: 2.5' in parameters(stack, 'b-4')
    assert '- a' in parameters(stack, 'b-4')
    assert process_specs(stack, folder)[0].environment == {'COLOR': 'red', 'MORE': '1'}
    assert stack.notes == [('INFO', 'hello you')]


def test_arguments(folder):
    others = stack_of(folder / 'my.launch.xml', who='all')
    assert [line for *_, line in commands(others)][0] == 'b'
    shown = LaunchFile(folder / 'my.launch.xml').show_arguments()
    assert (
        "        Whom to greet. Valid choices are: ['you', 'all']\n        (default: 'you')"
        in shown
    )
    with pytest.raises(BringupError, match="missing required argument 'of'"):
        stack_of(folder / 'inner.launch.yaml')


@pytest.mark.parametrize(
    ('name', 'text', 'said'),
    [
        ('a.launch.xml', '<launch>\n<nod/></launch>', 'a.launch.xml:2: <nod> is not under'),
        ('a.launch.xml', '<launch><node pkg="x"/></launch>', ':1: <node> lacks the attribute '),
        ('a.launch.xml', '<launch>\n<arg/>\n<let/></launch>', ':2: <arg> lacks the attribute '),
        (
            'a.launch.xml',
            '<launch>\n\n<log message="a" massage="b"/></launch>',
            "a.launch.xml:3: 'massage' of <log> is not understood here; did you mean message",
        ),
        ('a.launch.xml', '<launch>\n<a', 'a.launch.xml:2: is not XML: unclosed token'),
        ('a.launch.xml', '<launch><log message="a" if="1" unless="0"/></launch>', 'both if an'),
        ('a.launch.xml', '<robot/>', 'its first tag is robot, not launch'),
        ('a.launch.xml', '<launch><log message="$(x)"/></launch>', r'\$\(x\) is not understood'),
        ('a.launch.yaml', 'launch:\n- nod: {}\n', 'a.launch.yaml:2: <nod> is not understood here'),
        ('a.launch.yaml', 'launch: [\n', 'a.launch.yaml:2: is not YAML'),
        ('a.launch.yaml', '[]', 'it takes one key, launch'),
        ('a.launch.yaml', 'launch:\n  node: {}\n', 'a.launch.yaml:2: it takes a list'),
    ],
)  # fmt: skip
def test_what_is_wrong_is_told_with_its_place(folder, name, text, said):
    (folder / name).write_text(text)
    with pytest.raises(BringupError, match=said) as told:
        stack_of(folder / name)
    assert '\n' not in str(told.value)
