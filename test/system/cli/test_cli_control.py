# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``ros2 control list_controllers``: the table, and the service behind it."""

from argparse import ArgumentParser
import signal
from types import SimpleNamespace

from fixtures.cli.commands import ros2, running_node, started
import pytest

from amr_description.cli.control.listing import controller_lines, ListControllersVerb


@pytest.fixture(scope='module')
def manager():
    with running_node('manager_node.py') as node:
        yield node


def list_controllers(*flags, **env):
    result = ros2('control', 'list_controllers', *flags, **env)
    assert result.returncode == 0, result.stderr
    return result.stdout


def test_columns_are_as_wide_as_their_longest_entry(manager):
    assert list_controllers() == (
        'diff_drive_controller   diff_drive_controller/DiffDriveController      active  \n'
        'joint_state_broadcaster joint_state_broadcaster/JointStateBroadcaster  inactive\n'
    )


def test_verbose_tells_everything(manager):
    first = list_controllers('-v').partition('joint_state_broadcaster')[0]
    assert first.splitlines()[1:] == [
        '\tupdate_rate: 100 Hz',
        '\tis_async: False',
        '\tclaimed interfaces:',
        '\t\tjoint_wheel_front_left/velocity',
        '\t\tjoint_wheel_front_right/velocity',
        '\trequired command interfaces:',
        '\t\tjoint_wheel_front_left/velocity',
        '\t\tjoint_wheel_front_right/velocity',
        '\trequired state interfaces:',
        '\t\tjoint_wheel_front_left/position',
        '\tchained to interfaces:',
        '\t\tbelow/effort',
        '\texported reference interfaces:',
        '\t\tlinear/velocity',
        '\t\tangular/velocity',
        '\texported state interfaces:',
    ]


@pytest.mark.parametrize(
    ('flag', 'titles'),
    [
        ('--claimed-interfaces', ['claimed interfaces:']),
        ('--required-command-interfaces', ['required command interfaces:']),
        ('--required-state-interfaces', ['required state interfaces:']),
        ('--chained-interfaces', ['chained to interfaces:']),
        ('--reference-interfaces', ['exported reference interfaces:']),
        (
            '--exported-interfaces',
            ['exported reference interfaces:', 'exported state interfaces:'],
        ),
    ],
)
def test_a_flag_asks_for_its_block(flag, titles):
    parser = ArgumentParser()
    ListControllersVerb.add_arguments(parser)
    names = {name: [] for name in ('claimed', 'required_command', 'required_state')}
    controller = SimpleNamespace(
        name='a',
        type='b/C',
        state='active',
        chain_connections=[],
        reference_interfaces=[],
        exported_state_interfaces=[],
        **{f'{name}_interfaces': value for name, value in names.items()},
    )
    first, *rest = controller_lines([controller], parser.parse_args([flag]))
    assert first == 'a b/C  active'
    assert [line.strip() for line in rest] == titles


def test_states_are_coloured_on_demand(manager):
    first, second = list_controllers(RCUTILS_COLORIZED_OUTPUT='1').splitlines()
    assert first.startswith('\033[92mdiff_drive_controller  \033[0m ')
    assert first.endswith('  \033[92mactive  \033[0m')
    assert second.endswith('  \033[96minactive\033[0m')


def test_a_terminal_shows_colours(manager):
    with started('control', 'list_controllers', terminal=True) as program:
        program.expect('\033\\[92mactive')
        assert program.end() == 0


def test_another_manager_is_asked(manager):
    assert list_controllers('-c', '/empty/manager') == 'No controllers are currently loaded!\n'


def test_a_missing_manager_is_waited_for_until_ctrl_c():
    with started('control', 'list_controllers', '-c', 'nobody', terminal=True) as program:
        program.expect('waiting for service /nobody/list_controllers to become available...')
        program.type('\x03')
        assert program.end() == signal.SIGINT
        assert 'Traceback' not in program.output
