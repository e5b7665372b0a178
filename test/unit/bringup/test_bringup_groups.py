# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Groups, and stacks in stacks: what a node inherits."""

from fixtures.bringup.running import install_toys
import pytest

from amr_description.bringup import (
    exited_cleanly,
    Group,
    logged,
    Node,
    ready,
    ros_node,
    service,
    Stack,
    started,
    topic,
)
from amr_description.bringup.command_line import process_specs
from amr_description.bringup.placement import Placement
from amr_description.bringup.scheduler import Scheduler
from amr_description.errors import BringupError


def resolve(node, *members):
    return {resolved.node: resolved for resolved in Placement(Stack(members)).nodes}[node]


@pytest.mark.parametrize(
    ('outer', 'inner', 'own', 'namespace'),
    [
        (None, None, None, None),
        (None, None, 'arm', '/arm'),
        ('robot1', None, None, '/robot1'),
        ('robot1', None, 'arm', '/robot1/arm'),
        ('fleet', 'robot1', 'arm/', '/fleet/robot1/arm'),
        ('/fleet', '/robot1', None, '/robot1'),
        ('fleet', 'robot1', '/arm', '/arm'),
        ('fleet', '/', None, '/'),
        ('/', 'robot1', None, '/robot1'),
        ('/', None, 'arm', '/arm'),
    ],
)
def test_namespaces_nest_unless_they_begin_with_a_slash(outer, inner, own, namespace):
    node = Node('n', namespace=own)
    assert resolve(node, Group([Group([node], namespace=inner)], namespace=outer)).namespace == (
        namespace
    )


def test_inner_groups_come_later():
    node = Node(
        'n', environment={'B': 'n', 'C': 'n'}, parameters=['n.yaml'], remappings=[('a', 'n')]
    )
    inner = Group([node], environment={'A': 'i', 'B': 'i'}, parameters=[{'x': 1}])
    outer = Group([inner], environment={'A': 'o'}, parameters=['o.yaml'], remappings=[('a', 'o')])
    resolved = resolve(node, outer)
    assert resolved.environment == {'A': 'i', 'B': 'n', 'C': 'n'}
    assert resolved.parameters == ('o.yaml', {'x': 1}, 'n.yaml')
    assert resolved.remappings == (('a', 'o'), ('a', 'n'))


def test_a_group_does_not_change_its_neighbours():
    node = Node('n')
    resolved = resolve(node, Group([Node('m')], namespace='a', environment={'A': '1'}), node)
    assert (resolved.namespace, resolved.environment) == (None, {})


@pytest.mark.parametrize('condition', [topic, service, ros_node])
@pytest.mark.parametrize(('name', 'full'), [('odom', '/robot1/odom'), ('/odom', '/odom')])
def test_names_in_conditions_are_relative_to_the_group(condition, name, full):
    node = Node('n', namespace='arm', start_when=condition(name))
    assert resolve(node, Group([node], namespace='robot1')).start_when == condition(full)
    assert resolve(node, node).start_when == condition(f'/{name.lstrip("/")}')


def robot(**options):
    """A stack that is ready with its second node."""
    sim, step = Node('sim'), Node('step', start_when=service('list'))
    return Stack([sim, step], ready_when=exited_cleanly(step), **options)


def test_conditions_of_a_stack_in_a_group_are_in_its_namespace():
    first, second = robot(), robot()
    stack = Stack([Group([first], namespace='one'), Group([second], namespace='two')])
    assert [str(resolved.start_when.name) for resolved in Placement(stack).nodes[1::2]] == [
        '/one/list',
        '/two/list',
    ]


def test_ready_resolves_names_in_the_namespace_of_the_stack():
    inner = Stack([Node('sim')], ready_when=topic('odom'))
    after_it = Node('rviz', start_when=ready(inner))
    stack = Stack([Group([inner], namespace='robot1'), Group([after_it], namespace='screens')])
    placement = Placement(stack)
    assert placement.nodes[1].start_when == topic('/robot1/odom')


def test_a_stack_is_ready_once_those_in_it_are():
    inner, last = robot(), Node('last')
    scheduler = Scheduler(Stack([inner, Group([last])]))
    for node in (inner.nodes[0], last, inner.nodes[1]):
        scheduler.on_start(node)
    assert not scheduler.ready
    scheduler.on_exit(inner.nodes[1], 0)
    assert scheduler.ready


def test_an_optional_node_that_never_starts_does_not_keep_a_stack_from_being_ready():
    fails = Node('fails', required=False)
    waits = Node('waits', required=False, start_when=exited_cleanly(fails))
    scheduler = Scheduler(Stack([fails, waits, Node('worker')]))
    for node in scheduler.startable():
        scheduler.on_start(node)
    assert not scheduler.ready
    scheduler.on_exit(fails, 1)
    assert scheduler.ready


def test_all_members_wait_for_the_condition_of_their_group():
    first = Node('first')
    second, third = Node('second'), Node('third', start_when=logged(first, 'up'))
    scheduler = Scheduler(Stack([first, Group([second, third], start_when=exited_cleanly(first))]))
    scheduler.on_start(first)
    scheduler.on_line(first, 'up')
    assert scheduler.startable() == []
    scheduler.on_exit(first, 0)
    assert scheduler.startable() == [second, third]


def test_the_timeout_is_that_of_the_stack_around_a_node():
    inner = Stack([Node('a'), Node('b', timeout=3.0)], timeout=5.0)
    nodes = Placement(Stack([Node('c'), Group([inner])], timeout=9.0)).nodes
    assert {each.node.executable: each.timeout for each in nodes} == {'a': 5.0, 'b': 3.0, 'c': 9.0}


def test_numbers_and_command_lines(tmp_path, monkeypatch):
    install_toys(tmp_path)
    monkeypatch.setenv('AMENT_PREFIX_PATH', str(tmp_path))
    one = Node('worker', package='toys', name='w', prefix="nice -n '10'")
    two = Node('step', package='toys')
    group = Group([one], namespace='robot1', parameters=[{'a': 1}], remappings=[('/tf', 'tf')])
    first, second, third = process_specs(
        Stack([Stack([two]), group, Node('step', package='toys')]), tmp_path
    )
    assert [spec.name for spec in (first, second, third)] == ['step-1', 'worker-2', 'step-3']
    assert second.command == [
        'nice', '-n', '10', f'{tmp_path}/lib/toys/worker', '--ros-args',
        '-r', '__node:=w', '-r', '__ns:=/robot1',
        '--params-file', f'{tmp_path}/worker-2-parameters-1.yaml', '-r', '/tf:=tf',
    ]  # fmt: skip
    second.write_parameter_files()
    assert '/robot1/w:\n' in (tmp_path / 'worker-2-parameters-1.yaml').read_text()


def test_an_invalid_stack_is_refused():
    node, inner = Node('a'), robot()
    with pytest.raises(BringupError, match='at least one node'):
        Stack([Group([])])
    with pytest.raises(BringupError, match=r"Node\('sim'\) stands twice"):
        Stack([inner, Group([inner])])
    with pytest.raises(BringupError, match=r"waits for Node\('a'\), which is not in"):
        Stack([Group([Node('b')], start_when=started(node))])
    with pytest.raises(BringupError, match=r"waits for Node\('step'\), which is not in"):
        Stack([node], ready_when=ready(inner))
    with pytest.raises(BringupError, match="'talker' stands in a stack; there can be"):
        Stack([Group(['talker'])])
    for timeout in (0, -1, float('nan')):
        for kind in (Node, lambda _, **options: Stack([node], **options)):
            with pytest.raises(BringupError, match='takes more than 0 s'):
                kind('a', timeout=timeout)
