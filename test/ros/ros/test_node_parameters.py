# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Tables as parameters of a node: groups by lists and numbers, and what was given otherwise."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import pytest
import rclpy
from rclpy.node import Node
from rclpy.parameter import Parameter

from amr_description.former_parameters import FormerParameter, replaced
from amr_description.parameters import keyed_group, numbered_group, parameter
from amr_description.ros.parameters import (
    add_validation_callback,
    adopt_overrides,
    declare,
    declare_added,
    values,
)


@dataclass(frozen=True)
class Gains:
    p: float = parameter(1.0, 'Gain', minimum=0.0)


@dataclass(frozen=True)
class Table:
    former: ClassVar[tuple[FormerParameter, ...]] = (replaced('wheels', 'Foxy', 'dofs'),)
    dofs: tuple[str, ...] = parameter((), 'Degrees of freedom')
    rate: float = parameter(1.0, 'Rate')
    gains: Mapping[str, Gains] = keyed_group('gains', 'dofs', Gains)
    filters: Mapping[str, Gains] = numbered_group('filter', Gains)


@pytest.fixture
def make():
    rclpy.init(args=[])
    nodes = []

    def make(**given):
        overrides = [Parameter(name, value=value) for name, value in given.items()]
        nodes.append(Node('it', parameter_overrides=overrides))
        return nodes[-1]

    yield make
    for node in nodes:
        node.destroy_node()
    rclpy.try_shutdown()


def test_groups_of_lists_and_numbers_are_declared_as_they_are_given(make):
    node = make(**{'dofs': ['a', 'b'], 'gains.b.p': 3.0, 'filter1.p': 4.0, 'filter3.p': 5.0})
    table = declare(node, Table)
    assert table.gains == {'a': Gains(1.0), 'b': Gains(3.0)}
    assert table.filters == {'1': Gains(4.0)}
    assert node.get_parameter('gains.a.p').value == 1.0
    assert not node.has_parameter('filter3.p')


def test_an_element_that_is_set_later_has_its_group_from_then_on(make):
    node = make(**{'dofs': ['a'], 'gains.c.p': 3.0})
    declare(node, Table)
    add_validation_callback(node, Table)
    (result,) = node.set_parameters([Parameter('dofs', value=['a', 'c'])])
    assert result.successful
    declare_added(node, Table)
    assert values(node, Table).gains == {'a': Gains(1.0), 'c': Gains(3.0)}
    (result,) = node.set_parameters([Parameter('gains.c.p', value=-1.0)])
    assert result.reason == "parameter 'gains.c.p' must be at least 0, found -1.0"


def test_what_was_given_otherwise_is_declared_as_it_is_meant(make):
    node = make(**{'wheels': ['a'], 'gains.a.p': 2, 'rate': 5})
    lines = adopt_overrides(node, Table)
    assert declare(node, Table) == Table(('a',), 5.0, {'a': Gains(2.0)})
    assert [line.partition(' is ')[0] for line in lines] == [
        "parameter 'wheels'",
        "parameter 'rate'",
        "parameter 'gains.a.p'",
    ]
    assert not node.has_parameter('wheels')
