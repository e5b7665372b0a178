# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""pid_controller: references, measurements, feed-forward and chains; the PID has its own tests."""

import math

import pytest
from support.control_fakes import MS
from support.controller_bench import ControllerBench

from amr_description.control.dof_samples import DofCommandSample, SetBoolRequest
from amr_description.control.interfaces import NO_INTERFACES
from amr_description.errors import ControllerError, ParameterError
from amr_description.log import Severity

PERIOD = 10 * MS
VELOCITIES = {
    'dof_names': ['left', 'right'],
    'command_interface': 'effort',
    'reference_and_state_interfaces': ['velocity'],
    'gains.left.p': 2.0,
    'gains.right.p': 3.0,
}


class Bench(ControllerBench):
    """A controller of which every state is 1.0 at first, activated."""

    def __init__(self, is_chained=False, **values):
        super().__init__('pid_controller/PidController', name='pid', **VELOCITIES | values)
        self.controller.set_chained_mode(is_chained)
        self.activate(value=1.0)

    def refer(self, values, names=(), rates=()):
        self.controller.inputs()[0].put(
            DofCommandSample(tuple(names), tuple(values), tuple(rates))
        )


def test_interfaces_references_and_states_are_those_of_the_original():
    names = {
        'reference_and_state_dof_names': ['a', 'b'],
        'reference_and_state_interfaces': ['position', 'velocity'],
    }
    controller = Bench(**names).controller
    assert controller.command_interfaces().names == ('left/effort', 'right/effort')
    expected = ('a/position', 'b/position', 'a/velocity', 'b/velocity')
    assert controller.state_interfaces().names == expected
    for exported in (controller.references(), controller.exported_states()):
        assert [each.name for each in exported] == [f'pid/{name}' for name in expected]
    external = Bench(use_external_measured_states=True).controller
    assert external.state_interfaces() == NO_INTERFACES
    assert [each.port.name for each in external.inputs()] == ['~/reference', '~/measured_state']
    assert {each.port.qos.reliability for each in external.inputs()} == {'best_effort'}


def test_it_holds_the_present_state_until_the_first_reference():
    bench = Bench()
    assert bench.update() == [0.0, 0.0]
    bench.states[0].value = 4.0
    assert bench.update() == [pytest.approx(2.0 * (1.0 - 4.0)), 0.0]
    bench = Bench(set_current_state_as_first_setpoint=False)
    assert all(map(math.isnan, bench.update()))
    bench.refer([2.0, 5.0])
    assert bench.update() == [2.0, 12.0]


def test_references_are_sorted_by_their_names():
    bench = Bench()
    bench.refer([2.0, 5.0], ['right', 'left'])
    assert bench.update() == [8.0, 3.0]
    bench.refer([math.nan, 1.0], ['right', 'left'])  # NaN: as it was
    assert bench.update() == [0.0, 3.0]
    for values, names in (
        ([1.0], []),
        ([1.0, 2.0], ['left']),
        ([9.0, 9.0], ['left', 'middle']),
    ):
        bench.refer(values, names)
    assert bench.update() == [0.0, 3.0]
    assert bench.log.texts(Severity.WARN) == [
        'Size of input data names (0), values (1) and/or values_dot (0) is not matching the '
        'expected size (2).',
        'Size of input data names (1), values (2) and/or values_dot (0) is not matching the '
        'expected size (2).',
        "DoF name 'middle' not found in the defined list of state DoFs.",
    ]


def test_a_second_interface_is_the_derivative():
    bench = Bench(
        **{
            'reference_and_state_interfaces': ['position', 'velocity'],
            'gains.left.d': 10.0,
            'gains.right.p': 0.0,
        }
    )
    bench.refer([1.5, 1.0], rates=[3.0, math.nan])
    left, right = bench.update()
    assert left == pytest.approx(2.0 * 0.5 + 10.0 * (3.0 - 1.0))
    assert right == 0.0
    state = bench.sent['~/controller_state'][-1].states[0]
    assert (state.reference, state.feedback, state.error) == (1.5, 1.0, 0.5)
    assert (state.feedback_rate, state.error_rate, state.time_step) == (1.0, 2.0, 0.01)
    assert state.output == left


def test_feedforward_counts_while_it_is_enabled():
    gain = {'gains.left.feedforward_gain': 0.5}
    bench = Bench(**gain)
    assert 'has no effect: enable_feedforward is false' in bench.log.texts(Severity.WARN)[0]
    bench.refer([3.0, 1.0])
    assert bench.update()[0] == 4.0
    (service,) = bench.controller.services()
    assert service.answer(SetBoolRequest(True)).success
    assert bench.update()[0] == 4.0 + 1.5
    service.answer(SetBoolRequest(False))
    assert bench.update()[0] == 4.0
    bench = Bench(enable_feedforward=True, **gain)
    bench.refer([3.0, 1.0])
    assert bench.update()[0] == 5.5
    assert bench.log.texts(Severity.WARN) == [
        'Reference massage does not have DoF names defined. Assuming that value have order as '
        'defined state DoFs'
    ]


def test_angles_take_the_short_way_round():
    bench = Bench(**{'gains.left.angle_wraparound': True})
    bench.states[0].value = 3.0
    bench.refer([-3.0, 1.0])
    assert bench.update()[0] == pytest.approx(2.0 * (2.0 * math.pi - 6.0))
    assert bench.sent['~/controller_state'][-1].states[0].error == pytest.approx(0.2831853)
    bench.states[0].value = math.pi  # half a turn: either way is as short, and one is taken
    bench.refer([0.0, 1.0])
    assert bench.update()[0] == pytest.approx(2.0 * math.pi)


def test_what_is_measured_by_a_topic_counts_once_it_has_come():
    bench = Bench(use_external_measured_states=True)
    bench.refer([2.0, 5.0])
    assert all(map(math.isnan, bench.update()))
    measured = bench.controller.inputs()[1]
    measured.put(DofCommandSample(('left', 'right'), (1.0, 1.0), ()))
    measured.put(DofCommandSample((), (7.0, 7.0), ()))
    assert bench.update() == [2.0, 12.0]


def test_in_a_chain_the_preceding_controller_refers():
    bench = Bench(is_chained=True)
    bench.refer([9.0, 9.0])
    bench.controller.references()[0].value = 2.0
    assert bench.update() == [2.0, 0.0]
    assert bench.log.texts(Severity.WARN)[0].startswith("Ignoring references on '~/reference'")
    assert [each.value for each in bench.controller.exported_states()] == [1.0, 1.0]


@pytest.mark.parametrize(('keeps', 'expected'), [(True, 1.0), (False, 0.0)])
def test_deactivation_stops_and_may_keep_the_integral(keeps, expected):
    bench = Bench(
        **{
            'gains.left.p': 0.0,
            'gains.left.i': 100.0,
            'gains.left.save_i_term': keeps,
            'gains.left.activate_state_publisher': True,
        }
    )
    bench.refer([2.0, 1.0])
    assert bench.update()[0] == pytest.approx(1.0)
    assert bench.sent['~/left/pid_state'][-1].i_term == pytest.approx(1.0)
    bench.controller.deactivate(20 * MS)
    assert [command.value for command in bench.commands] == [0.0, 0.0]
    bench.activate()
    assert bench.update()[0] == pytest.approx(expected)


def test_a_position_stays_commanded():
    bench = Bench(command_interface='position')
    bench.refer([2.0, 5.0])
    assert bench.update() == [2.0, 12.0]
    bench.controller.deactivate(20 * MS)
    assert [command.value for command in bench.commands] == [2.0, 12.0]


@pytest.mark.parametrize(
    ('values', 'error', 'text'),
    [
        ({'dof_names': []}, ParameterError, "'dof_names' must not be empty"),
        ({'dof_names': ['a', 'a']}, ParameterError, 'must not hold anything twice'),
        ({'gains.left.antiwindup_strategy': 'clamp'}, ParameterError, 'must be one of back_calc'),
        ({'reference_and_state_dof_names': ['a']}, ControllerError, r"'dof_names' \(2\) and"),
        ({'gains.left.u_clamp_min': math.inf}, ControllerError, 'must be less than u_max'),
        (
            {'reference_and_state_interfaces': ['a', 'b', 'c']},
            ControllerError,
            'may be one interface, and its derivative; found a, b, c',
        ),
    ],
)
def test_parameters_that_mean_nothing_are_refused(values, error, text):
    with pytest.raises(error, match=text):
        Bench(**values)
