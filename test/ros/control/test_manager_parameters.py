# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What a manager reads out of the parameters of its node."""

import pytest
from rclpy.node import Node
from rclpy.parameter import Parameter
from support.manager_host import ros_in_this_process

from amr_description.control.ros.node_parameters import NodeParameters
from amr_description.control.switching import Strictness
from amr_description.controller_manager.parameters import ManagerParameters
from amr_description.errors import ControllerError, ParameterError
from amr_description.log import null_log


@pytest.fixture
def made(tmp_path):
    """A function: YAML of the parameters → node and what is read of it."""
    nodes = []

    def make(yaml='{}', *arguments):
        path = tmp_path / 'manager.yaml'
        path.write_text(f'/**: {{ros__parameters: {yaml}}}')
        arguments = ['--params-file', str(path), *arguments]
        node = Node(
            'controller_manager',
            cli_args=['--ros-args', *arguments],
            use_global_arguments=False,
            allow_undeclared_parameters=True,
        )
        nodes.append(node)
        return node, ManagerParameters(NodeParameters(node), arguments, null_log)

    with ros_in_this_process():
        yield make
        for node in nodes:
            node.destroy_node()


def test_what_the_file_gives_is_read_and_keeps_its_rights(made):
    node, parameters = made(
        '{update_rate: 50, enforce_command_limits: true, defaults: {switch_controller: '
        '{strictness: strict}}, hardware_components_initial_state: {inactive: [a], '
        'unconfigured: []}}'
    )
    assert parameters.update_rate == 50
    assert parameters.start.enforce_command_limits
    assert parameters.start.hardware_components_initial_state.inactive == ('a',)
    assert parameters.start.hardware_components_initial_state.unconfigured == ()
    assert parameters.defaults().strictness is Strictness.STRICT
    assert node.describe_parameter('enforce_command_limits').read_only
    assert not node.describe_parameter('update_rate').read_only


@pytest.mark.parametrize('sim_time', [False, True])
def test_overruns_are_warned_of_by_default_unless_time_is_simulated(made, sim_time):
    _, parameters = made(f'{{use_sim_time: {sim_time}}}'.lower())
    assert parameters.start.overruns.print_warnings is not sim_time


def test_the_default_strictness_may_be_set_at_run_time_to_what_there_is(made):
    node, parameters = made()
    name = 'defaults.switch_controller.strictness'
    (refused,) = node.set_parameters([Parameter(name, value='fierce')])
    assert not refused.successful
    assert 'must be one of best_effort, strict' in refused.reason
    assert parameters.defaults().strictness is Strictness.BEST_EFFORT
    assert node.set_parameters([Parameter(name, value='strict')])[0].successful
    assert parameters.defaults().strictness is Strictness.STRICT


def test_an_entry_is_declared_whole_once_it_is_asked_for(made):
    node, parameters = made('{arm: {type: a/B, fallback_controllers: [], params_file: one.yaml}}')
    node.set_parameters([Parameter('arm.node_options_args', value=['-r', 'a:=b'])])
    entry = parameters.entry_of('arm')
    assert (entry.type, entry.params_file) == ('a/B', ('one.yaml',))
    assert (entry.fallback_controllers, entry.node_options_args) == ((), ('-r', 'a:=b'))
    kinds = {
        name: node.describe_parameter(f'arm.{name}').type
        for name in ('type', 'params_file', 'fallback_controllers', 'node_options_args')
    }
    string, strings = Parameter.Type.STRING.value, Parameter.Type.STRING_ARRAY.value
    assert kinds == {
        'type': string,
        'params_file': string,
        'fallback_controllers': strings,
        'node_options_args': strings,
    }


def test_an_entry_that_is_no_good_is_refused(made):
    _, parameters = made('{arm: {type: 5}, leg: {type: a/B, fallback_controllers: [1]}}')
    with pytest.raises(ControllerError, match="not defined for 'tail'.* arm, leg$"):
        parameters.entry_of('tail')
    with pytest.raises(ParameterError, match=r"'arm.type' must be of type string, found 5"):
        parameters.entry_of('arm')
    with pytest.raises(ParameterError, match=r"'leg.fallback_controllers' must be of type string"):
        parameters.entry_of('leg')


def test_controllers_inherit_arguments_and_simulated_time_but_no_name(made, tmp_path):
    _, parameters = made(
        '{use_sim_time: true, arm: {type: a/B, node_options_args: ["-r", "a:=b"]}}',
        '-r',
        '__ns:=/amr',
        '--log-level',
        'debug',
    )
    path = str(tmp_path / 'manager.yaml')
    assert parameters.arguments_of(parameters.entry_of('arm')) == [
        '--params-file',
        path,
        '--log-level',
        'debug',
        '-p',
        'use_sim_time:=true',
        '-r',
        'a:=b',
    ]
