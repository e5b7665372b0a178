# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Filters against their formulas, in chains, of states and of wrenches."""

import math

import pytest
from support.control_fakes import collect, FakeLog, MS

from amr_description.control.contracts import ControllerContext
from amr_description.control.interfaces import StateInterface
from amr_description.controllers.broadcasters.force_torque_sensor_broadcaster import (
    ForceTorqueParameters,
    ForceTorqueSensorBroadcaster,
)
from amr_description.controllers.filters import (
    ChainedFilter,
    ChainedFilterParameters,
    FilterChain,
    FilterParameters,
    FilterSettings,
)
from amr_description.errors import ControllerError, ParameterError
from amr_description.parameters import build, specs

TWO = {
    'input_interfaces': ['left/position', 'right/position'],
    'output_interfaces': ['left/smooth', 'right/smooth'],
}
MEAN = {'type': 'filters/MeanFilterDouble', 'params.number_of_observations': 2}


def below(prefix, values):
    return {f'{prefix}.{name}': value for name, value in values.items()}


def run(kind, values, **settings):
    chain = FilterChain({'1': FilterParameters('it', kind, FilterSettings(**settings))})
    return [chain.update(value) for value in values]


def test_filters_are_their_formulas():
    values = [1.0, 5.0, 3.0, 3.0, 9.0]
    mean = run('filters/MeanFilterDouble', values, number_of_observations=2)
    assert mean == [1.0, 3.0, 4.0, 3.0, 6.0]
    median = run('filters/MedianFilterDouble', values, number_of_observations=3)
    assert median == [1.0, 5.0, 3.0, 3.0, 3.0]
    exponential = run('control_filters/ExponentialFilterDouble', values[:3], alpha=0.25)
    assert exponential == [1.0, 2.0, 2.25]
    low_pass = {'sampling_frequency': 1000.0, 'damping_frequency': 20.5, 'damping_intensity': 1.25}
    factor = math.exp(-1.0 / 1000.0 * (2.0 * math.pi * 20.5) / 10.0 ** (1.25 / -10.0))
    second = (1.0 - factor) * 1.0 + factor * 1.0
    third = (1.0 - factor) * 5.0 + factor * second
    assert run('control_filters/LowPassFilterWrench', values[:3], **low_pass) == pytest.approx(
        [1.0, second, third]
    )


@pytest.mark.parametrize(
    ('kind', 'text'),
    [
        ('filters/Nothing', "filter1: there is no filter of type 'filters/Nothing' here; there"),
        (
            'filters/MeanFilterDouble',
            r'filter1 \(filters/MeanFilterDouble\): params.number_of_observations must be greater',
        ),
    ],
)
def test_filters_that_cannot_be_are_refused(kind, text):
    with pytest.raises(ControllerError, match=text):
        run(kind, [])


def make(values):
    controller = ChainedFilter(ControllerContext('smooth', FakeLog()))
    controller.configure(build(ChainedFilterParameters, values))
    return controller


def test_every_state_has_its_chain_and_what_is_not_measured_changes_nothing():
    controller = make(
        TWO
        | below('filter_chain.filter1', MEAN)
        | below('filter_chain.filter2', {'type': 'filters/IncrementFilterDouble'})
    )
    names = controller.state_interfaces().names
    states = [StateInterface(*name.split('/'), 0.0) for name in names]
    controller.activate((), states, 0)
    exported = controller.exported_states()
    assert [each.name for each in exported] == ['smooth/left/smooth', 'smooth/right/smooth']
    for left, right in ((1.0, 10.0), (3.0, math.nan), (5.0, 20.0)):
        states[0].value, states[1].value = left, right
        controller.update(10 * MS, 10 * MS)
    assert [each.value for each in exported] == [5.0, 16.0]
    controller.reset(0)
    controller.update(10 * MS, 10 * MS)
    assert [each.value for each in exported] == [6.0, 21.0]


def test_a_chain_for_each_state():
    own = below('left/position.filter_chain.filter1', MEAN)
    own |= below('right/position.filter_chain.filter1', {'type': 'filters/IncrementFilterDouble'})
    rows = [spec.name for spec in specs(ChainedFilterParameters, '', TWO | own)]
    assert 'left/position.filter_chain.filter1.params.number_of_observations' in rows
    assert not any('filter2' in row for row in rows)
    assert make(TWO | own).exported_states()
    with pytest.raises(ControllerError, match="no filter for 'right/position': give filter_chain"):
        make(TWO | below('left/position.filter_chain.filter1', MEAN))
    with pytest.raises(ControllerError, match=r'output_interfaces \(1\) have to be equally many'):
        make(TWO | own | {'output_interfaces': ['one']})
    with pytest.raises(ParameterError, match="'filter_chain.filter1.type' must not be empty"):
        make(TWO | {'filter_chain.filter1.name': 'it'})


def test_a_wrench_is_published_filtered_too():
    values = {'sensor_name': 'fts', 'frame_id': 'tool', 'offset.force.x': 1.0}
    values |= below('sensor_filter_chain.filter1', MEAN)
    controller = ForceTorqueSensorBroadcaster(ControllerContext('it', FakeLog()))
    controller.configure(build(ForceTorqueParameters, values))
    sent = {each.port.name: collect(each) for each in controller.outputs()}
    names = controller.state_interfaces().names
    states = [StateInterface(*name.split('/'), float(i)) for i, name in enumerate(names)]
    controller.activate((), states, 0)
    controller.update(10 * MS, 10 * MS)
    states[0].value = 4.0
    controller.update(20 * MS, 10 * MS)
    assert [each.force[0] for each in sent['~/wrench']] == [1.0, 5.0]
    assert [each.force[0] for each in sent['~/wrench_filtered']] == [1.0, 3.0]
    assert sent['~/wrench_filtered'][1].torque == (3.0, 4.0, 5.0)
