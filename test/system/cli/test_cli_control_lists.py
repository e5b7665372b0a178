# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The verbs of ``ros2 control`` that look, against outputs of the genuine one."""

import json

from controller_manager_msgs.msg import ControllerState, HardwareComponentState, HardwareInterface
from controller_manager_msgs.srv import ListHardwareInterfaces
from fixtures.cli.commands import HERE, ros2
from lifecycle_msgs.msg import State
import pytest
from support.manager_host import ros_in_this_process, running_host

from amr_description.cli.control.listing import component_lines, dot, interface_lines, tree

RECORDED = json.loads((HERE / 'control_outputs.json').read_text())
"""verb -> the lines that the original prints, with the tutorial's robot over mock hardware."""
MOCK = 'mock_components/GenericSystem'
FORWARD = 'forward_command_controller/ForwardCommandController'
AHEAD = """
ahead:
  ros__parameters:
    joints: [diff_drive_controller/linear, diff_drive_controller/angular]
    interface_name: velocity
"""
FRONT, BACK = 'joint_wheel_front_left', 'joint_wheel_back_left'

pytestmark = pytest.mark.in_order('one manager: as it was recorded, then with a chain')


@pytest.fixture(scope='module')
def host(tmp_path_factory):
    with ros_in_this_process(), running_host(tmp_path_factory.mktemp('host')) as host:
        host.activate('joint_state_broadcaster', 'diff_drive_controller')
        yield host


@pytest.fixture
def no_colors(monkeypatch):
    monkeypatch.setenv('RCUTILS_COLORIZED_OUTPUT', '0')


@pytest.fixture
def colors(monkeypatch):
    monkeypatch.setenv('RCUTILS_COLORIZED_OUTPUT', '1')


def interface(name, available=True, claimed=False):
    return HardwareInterface(
        name=name, data_type='double', is_available=available, is_claimed=claimed
    )


INTERFACES = ListHardwareInterfaces.Response(
    command_interfaces=[
        interface(f'{FRONT}/velocity', claimed=True),
        interface(f'{BACK}/velocity', claimed=True),
        interface('diff_drive_controller/linear/velocity'),
        interface('z/effort', available=False),
    ],
    state_interfaces=[interface(f'{FRONT}/position'), interface(f'{BACK}/position')],
)
COMPONENT = HardwareComponentState(
    name='AmrSystem',
    type='system',
    plugin_name='mock_components/GenericSystem',
    state=State(id=3, label='active'),
    rw_rate=100,
    command_interfaces=[
        interface(f'{BACK}/velocity', claimed=True),
        interface(f'{FRONT}/velocity', available=False),
    ],
    state_interfaces=[interface(f'{BACK}/position')],
)


def test_interfaces_stand_in_order(no_colors):
    assert list(interface_lines(INTERFACES, verbose=False)) == [
        'command interfaces',
        '\tdiff_drive_controller/linear/velocity [available] [unclaimed]',
        '\tjoint_wheel_back_left/velocity [available] [claimed]',
        '\tjoint_wheel_front_left/velocity [available] [claimed]',
        '\tz/effort [unavailable] [unclaimed]',
        'state interfaces',
        '\tjoint_wheel_back_left/position',
        '\tjoint_wheel_front_left/position',
    ]
    verbose = list(interface_lines(INTERFACES, verbose=True))
    assert verbose[2] == '\tjoint_wheel_back_left/velocity [double] [available] [claimed]'
    assert verbose[-1] == '\tjoint_wheel_front_left/position [double]'


def test_interfaces_are_coloured_by_what_may_be_done_with_them(colors):
    lines = list(interface_lines(INTERFACES, verbose=False))
    starts = [line.partition('m')[0] for line in lines if line.startswith('\t\033')]
    assert starts == ['\t\033[96', '\t\033[94', '\t\033[94', '\t\033[93']


def test_a_component_is_told_as_the_genuine_one_does(no_colors):
    short = [
        'Hardware Component 1',
        '\tname: AmrSystem',
        '\ttype: system',
        '\tplugin name: mock_components/GenericSystem',
        '\tstate: id=3 label=active',
        '\tread/write rate: 100 Hz',
        '\tis_async: False',
        '\tcommand interfaces',
        '\t\tjoint_wheel_back_left/velocity [available] [claimed]',
        '\t\tjoint_wheel_front_left/velocity [unavailable] [unclaimed]',
    ]
    assert list(component_lines(1, COMPONENT, verbose=False)) == short
    verbose = list(component_lines(1, COMPONENT, verbose=True))
    assert verbose[8] == '\t\tjoint_wheel_back_left/velocity [double] [available] [claimed]'
    assert verbose[-2:] == [
        '\tstate interfaces',
        '\t\tjoint_wheel_back_left/position [double] [available]',
    ]


@pytest.mark.parametrize(
    ('label', 'number'),
    [('active', 92), ('inactive', 95), ('unconfigured', 93), ('finalized', 91)],
)
def test_the_colour_of_a_component_is_its_state(colors, label, number):
    component = HardwareComponentState(name='arm', state=State(label=label))
    text = '\n'.join(component_lines(1, component, verbose=False))
    assert f'name: \033[{number}marm\033[0m\n' in text
    assert f'label=\033[{number}m{label}\033[0m\n' in text
    assert 'plugin name: \033[93mplugin name missing!\033[0m\n' in text


CHAIN = [
    ControllerState(
        name='drive',
        type='a/Drive',
        state='active',
        required_command_interfaces=['left/velocity', 'right/velocity', 'arm/effort'],
    ),
    ControllerState(
        name='left',
        type='b/"Pid"',
        state='inactive',
        reference_interfaces=['velocity'],
        required_command_interfaces=['wheel/effort'],
        required_state_interfaces=['wheel/velocity'],
    ),
    ControllerState(name='alone', type='c/Alone', state='active'),
]


def test_chains_lead_down_to_the_hardware():
    assert list(tree(CHAIN)) == [
        'drive [active]',
        '    -> left [inactive]: left/velocity',
        '        -> hardware: wheel/effort',
        '    -> hardware: right/velocity, arm/effort',
        'alone [active]',
    ]


def test_a_chain_that_leads_back_ends():
    ring = [
        ControllerState(
            name=name,
            state='active',
            reference_interfaces=['x'],
            required_command_interfaces=[f'{other}/x'],
        )
        for name, other in (('a', 'b'), ('b', 'c'), ('c', 'b'))
    ]
    assert list(tree(ring)) == [
        'a [active]',
        '    -> b [active]: b/x',
        '        -> c [active]: c/x',
        '            -> b [active]: b/x',
    ]


def test_the_graph_has_every_controller_and_edge_once():
    lines = list(dot(CHAIN))
    assert (lines[0], lines[-1]) == ('digraph controllers {', '}')
    assert r'    "left" [label="left\nb/\"Pid\"\ninactive", style=dashed];' in lines
    assert [line for line in lines if '->' in line] == [
        '    "drive" -> "left" [label="left/velocity"];',
        r'    "drive" -> "hardware" [label="right/velocity\narm/effort"];',
        '    "left" -> "hardware" [label="wheel/effort"];',
        '    "hardware" -> "left" [label="wheel/velocity"];',
    ]


def printed(verb):
    result = ros2('control', *verb.split())
    assert result.returncode == 0, result.stderr
    return result.stdout.splitlines()


def blocks(lines):
    """Order counts in a title, and not below it: there the original has that of a hash table."""
    found = {}
    for line in lines:
        if not line.startswith('\t\t'):
            title = (line.strip(), len(found))
            found[title] = []
        else:
            found[title].append(line)
    return {title: sorted(items) for title, items in found.items()}


def test_a_running_manager_is_told_of_as_the_genuine_one(host):
    assert printed('list_controllers') == RECORDED['list_controllers']
    assert printed('list_hardware_interfaces') == RECORDED['list_hardware_interfaces']
    for verb in ('list_controllers -v', 'list_hardware_components -v'):
        here = [
            line.replace('name: hardware', 'name: AmrSystem').replace('a/Fake', MOCK)
            for line in printed(verb)
        ]
        assert blocks(here) == blocks(RECORDED[verb])
    assert set(printed('list_controller_types')) >= set(RECORDED['list_controller_types'])


def test_a_chain_of_a_running_manager_is_shown(host, tmp_path):
    file = tmp_path / 'ahead.yaml'
    file.write_text(AHEAD)
    host.client.set_parameters('ahead', {'type': FORWARD, 'params_file': [str(file)]})
    host.activate('ahead')
    names = ['linear/velocity', 'angular/velocity']
    links = [f'diff_drive_controller/{name}' for name in names]
    listed = printed('list_controllers --chained-interfaces --claimed-interfaces')
    assert listed[0].split() == ['ahead', FORWARD, 'active']
    claimed, chained = ([f'\t\t{name}' for name in each] for each in (links, names))
    assert listed[1:7] == ['\tclaimed interfaces:', *claimed, '\tchained to interfaces:', *chained]
    commands = printed('list_hardware_interfaces')[1:3]
    assert commands == [f'\t{link} [available] [claimed]' for link in sorted(links)]
    tree = printed('view_controller_chains')
    start = tree.index('ahead [active]')
    chain = tree[start + 1 : start + 3]
    assert chain[0] == f'    -> diff_drive_controller [active]: {", ".join(links)}'
    assert chain[1].startswith('        -> hardware: joint_wheel_front_left/velocity, ')
    assert set(tree) - {tree[start], *chain} == {'joint_state_broadcaster [active]'}
    assert printed('view_controller_chains --dot')[0] == 'digraph controllers {'
