# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Parameters and names of topics that follow from ROS arguments: as rcl has them, without it."""

import pytest
from rclpy.node import Node
from support.manager_host import ros_in_this_process

from amr_description.controller_manager.plain_parameters import given_parameters
from amr_description.ros.rclpy_internals import parameter_overrides
from amr_description.ros_arguments import NodeNames

FILE = """
/**:
  ros__parameters: {a: 1, of_all: true, deep: {er: 0.5, names: [x, z]}}
/left/arm:
  ros__parameters: {a: 2, gains.p: 1.5, deep.er: 0.75}
arm:
  ros__parameters: {a: 3, only_root: 1}
/**/arm:
  ros__parameters: {b: 'text', empty: ''}
/*/arm:
  ros__parameters: {c: [1.0, 2.0]}
left:
  arm:
    ros__parameters: {d: [1, 2], gpio: [{e: [1]}]}
/left/other:
  ros__parameters: {a: 4}
"""
LATER = """
/**/arm:
  ros__parameters: {a: 5, b: 'later'}
"""


@pytest.fixture(scope='module')
def files(tmp_path_factory):
    folder = tmp_path_factory.mktemp('parameters')
    for name, text in (('one', FILE), ('two', LATER)):
        (folder / f'{name}.yaml').write_text(text)
    with ros_in_this_process():
        yield [str(folder / 'one.yaml'), str(folder / 'two.yaml')]


def node_of(name, namespace, arguments):
    return Node(
        name,
        namespace=namespace,
        cli_args=['--ros-args', *arguments],
        use_global_arguments=False,
        start_parameter_services=False,
    )


@pytest.mark.parametrize('namespace', ['/', '/left', '/left/inner'])
@pytest.mark.parametrize(
    'words',
    [
        '--params-file {0}',
        '--params-file {0} --params-file {1}',
        '--params-file {1} --params-file {0}',
        '-p a:=7 --params-file {0}',
        '--params-file {0} -p a:=7 -p deep.er:=0.25 -p b:=text',
        '--params-file {0} -p arm:a:=8 -p other:b:=9 --param c:=[1.5]',
        '-p flag:=true -p number:=3 -p text:="7" -p list:=[a,b] -p word:=no',
    ],
)
def test_parameters_are_those_of_rcl(files, namespace, words):
    arguments = words.format(*files).split()
    node = node_of('arm', namespace, arguments)
    try:
        expected = {name: each.value for name, each in parameter_overrides(node).items()}
    finally:
        node.destroy_node()
    found = given_parameters(f'{namespace.rstrip("/")}/arm', arguments)
    assert {name: as_list(value) for name, value in expected.items()} == found


def as_list(value):
    return list(value) if hasattr(value, '__iter__') and not isinstance(value, str) else value


WORDS = (
    '1 -1 +1 0 010 08 0x1F 1.0 1. .5 1e5 1e-5 -1E+5 1.5e3 inf -inf .inf -.inf nan .nan infinity '
    '1_000 1:30 12e y Y n yes No on OFF true TRUE truE null2 2026-01-01 a-b 0x1p3 0b1 1,5 - + . e5'
)


@pytest.mark.parametrize('word', WORDS.split())
@pytest.mark.parametrize('quote', ['', "'"])
def test_a_word_is_what_rcl_takes_it_for(files, tmp_path, word, quote):
    """As a value in a file; on a command line rcl reads it likewise."""
    file = tmp_path / 'word.yaml'
    file.write_text(f'/**: {{ros__parameters: {{word: {quote}{word}{quote}}}}}')
    for arguments in (['--params-file', str(file)], ['-p', f'word:={quote}{word}{quote}']):
        try:
            node = node_of('arm', '/', arguments)
        except Exception as error:
            expected = type(error)
        else:
            expected = repr(parameter_overrides(node)['word'].value)
            node.destroy_node()
        try:
            found = repr(given_parameters('/arm', arguments)['word'])
        except Exception as error:
            found = type(error)
        assert isinstance(expected, type) or found == expected


@pytest.mark.parametrize('namespace', ['/', '/left'])
@pytest.mark.parametrize('topic', ['odom', '~/odom', '/odom', '~/cmd_vel', 'deep/er', '/tf'])
@pytest.mark.parametrize(
    'words',
    [
        '',
        '-r ~/odom:=odom',
        '-r ~/odom:=/odom -r odom:=other',
        '-r odom:=~/mine -r /left/odom:=/second',
        '-r arm:~/odom:=here -r other:~/cmd_vel:=there',
        '--remap /tf:=tf',
        '-r rostopic://~/odom:=x -r rosservice://odom:=y',
        '-r rosservice://odom:=x -r odom:=y',
    ],
)
def test_names_of_topics_and_services_are_those_of_rcl(files, namespace, topic, words):
    node = node_of('arm', namespace, words.split())
    try:
        expected = node.resolve_topic_name(topic), node.resolve_service_name(topic)
    finally:
        node.destroy_node()
    names = NodeNames(f'{namespace.rstrip("/")}/arm', words.split())
    assert (names.resolve(topic), names.resolve_service(topic)) == expected
