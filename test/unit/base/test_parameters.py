# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Tables of parameters: names, types, bounds, and the errors for wrong values."""

from array import array
from collections.abc import Mapping
from dataclasses import dataclass
import json
import math

import pytest
from support.control_fakes import FIXTURES
from support.deferred_annotations import DeferredTable

from amr_description.controllers import CONTROLLERS
from amr_description.controllers.drives.diff_drive_controller import DiffDriveParameters
from amr_description.errors import ParameterError
from amr_description.parameters import build, group, keyed_group, parameter, specs


@dataclass(frozen=True)
class Inner:
    rate: float = parameter(50.0, 'A rate', unit='Hz', above=0.0)
    mode: str = parameter('slow', 'A mode', choices=('slow', 'fast'))


@dataclass(frozen=True)
class Table:
    name: str = parameter('', 'A name', read_only=True)
    wheels: tuple[str, ...] = parameter(('a',), 'Wheels', not_empty=True)
    limit: float = parameter(math.nan, 'A limit', minimum=0.0, maximum=10.0, nan=True)
    factor: float = parameter(1.0, 'A factor', not_zero=True)
    count: int = parameter(3, 'A count', minimum=1)
    flag: bool = parameter(False, 'A flag')
    variances: tuple[float, ...] = parameter((0.0, 0.0), 'Variances', length=2, minimum=0.0)
    inner: Inner = group('in.ner', Inner)


@dataclass(frozen=True)
class Names:
    few: tuple[str, ...] = parameter((), 'Up to two', fewer_than=3)
    each: tuple[str, ...] = parameter((), 'Each once', unique=True)


@pytest.mark.parametrize(
    ('values', 'complaint'),
    [
        ({'few': ['a', 'b', 'c']}, "'few' must have fewer than 3 elements"),
        ({'each': ['a', 'b', 'a']}, "'each' must not hold anything twice"),
    ],
)
def test_arrays_may_be_short_and_without_duplicates(values, complaint):
    assert build(Names, {'few': ['a', 'a'], 'each': ['a', 'b', 'c']}).few == ('a', 'a')
    with pytest.raises(ParameterError, match=complaint):
        build(Names, values)


def test_a_missing_value_keeps_its_default():
    table = build(Table, {})
    assert (table.name, table.wheels, table.factor, table.count) == ('', ('a',), 1.0, 3)
    assert math.isnan(table.limit)
    assert table.inner == Inner(50.0, 'slow')


def test_dotted_names_reach_the_groups_and_unknown_names_are_ignored():
    table = build(Table, {'in.ner.rate': 5.0, 'use_sim_time': True, 'rate': 'not mine'})
    assert table.inner.rate == 5.0


def test_rows_are_flat_in_the_order_of_the_fields():
    rows = list(specs(Table))
    assert [row.name for row in rows] == [
        'name', 'wheels', 'limit', 'factor', 'count', 'flag', 'variances',
        'in.ner.rate', 'in.ner.mode',
    ]  # fmt: skip
    assert [row.type for row in rows] == [
        'string', 'string_array', 'double', 'double', 'integer', 'bool', 'double_array',
        'double', 'string',
    ]  # fmt: skip
    assert rows[0].read_only
    assert (rows[7].unit, rows[7].doc, rows[7].default) == ('Hz', 'A rate', 50.0)


def test_every_default_is_good_but_those_that_must_be_given():
    """A table's own mistake would otherwise show only when the parameter is set."""
    mandatory = {'left_wheel_names', 'right_wheel_names', 'wheel_separation', 'wheel_radius'}
    for row in specs(DiffDriveParameters):
        if row.name in mandatory:
            with pytest.raises(ParameterError, match=row.name):
                row.check(row.default)
        else:
            assert row.check(row.default) == pytest.approx(row.default, nan_ok=True)


@pytest.mark.parametrize(
    ('values', 'message'),
    [
        ({'count': 2.0}, r"'count' must be of type integer, found 2\.0, a double; write 2$"),
        ({'count': True}, r"'count' must be of type integer, found True, a bool$"),
        ({'factor': 2}, r"'factor' must be of type double, found 2, an integer; write 2\.0$"),
        ({'factor': 'x'}, r"'factor' must be of type double, found 'x', a string$"),
        ({'factor': '0.1'}, r"found '0.1', a string; write 0.1, without quotes$"),
        ({'factor': '0,10'}, r"found '0,10', a string; write 0.1, with a point$"),
        ({'factor': '-12,5'}, r"found '-12,5', a string; write -12.5, with a point$"),
        ({'factor': '1,000'}, r"found '1,000', a string$"),
        ({'factor': None}, r"'factor' must be of type double, found None, no value$"),
        ({'factor': {'a': 1}}, r"'factor' must be of type double, found .*, a table$"),
        ({'flag': 1}, r"'flag' must be of type bool, found 1, an integer$"),
        ({'flag': 'True'}, r"found 'True', a string; write true, without quotes$"),
        ({'name': 7}, r"'name' must be of type string, found 7, an integer; write '7', in quotes"),
        ({'wheels': 'left'}, r"type string_array, found 'left', a string; write \[left\]$"),
        ({'wheels': ['a', 1]}, r"string_array, found \['a', 1\], a list of various types$"),
        (
            {'variances': [0, 0]},
            r'double_array, found \[0, 0\], a list of integers; write \[0.0, 0.0\]$',
        ),
        ({'wheels': []}, r"'wheels' must not be empty, found \[\]"),
        ({'variances': [1.0]}, r"'variances' must have 2 elements, found \[1\.0\]"),
        ({'variances': [1.0, math.nan]}, r"'variances' must be a finite number"),
        ({'variances': [1.0, -1.0]}, r"'variances' must be at least 0, found \[1\.0, -1\.0\]"),
        ({'count': 0}, r"'count' must be at least 1, found 0"),
        ({'limit': -0.5}, r"'limit' must be at least 0, found -0\.5"),
        ({'limit': 11.0}, r"'limit' must be at most 10, found 11\.0"),
        ({'limit': math.inf}, r"'limit' must be at most 10, found inf"),
        ({'factor': 0.0}, r"'factor' must not be zero, found 0\.0"),
        ({'factor': math.nan}, r"'factor' must be a finite number, found nan"),
        ({'factor': -math.inf}, r"'factor' must be a finite number, found -inf"),
        ({'in.ner.rate': 0.0}, r"'in\.ner\.rate' must be greater than 0, found 0\.0 Hz"),
        ({'in.ner.mode': 'medium'}, r"'in\.ner\.mode' must be one of slow, fast, found medium"),
    ],
)
def test_a_wrong_value_is_reported_with_its_name_and_a_fix(values, message):
    with pytest.raises(ParameterError, match=message):
        build(Table, values)


RECORDED = json.loads((FIXTURES / 'parameters.json').read_text())
_OF_LIMITS = ('has_velocity_limits', 'has_acceleration_limits', 'has_jerk_limits')
# What ours have beyond the originals: off by default, or of earlier releases of them.
BEYOND = {
    'diff_drive_controller/DiffDriveController': {
        'enable_cmd_vel_unstamped', 'preserve_curvature',
    },
    'joint_trajectory_controller/JointTrajectoryController': {'gains.__map_joints.antiwindup'},
    'mecanum_drive_controller/MecanumDriveController': {
        'tf_odometry_topic',
        *(
            f'{axis}.{name}'
            for axis in ('linear.x', 'linear.y', 'angular.z')
            for name in (*_OF_LIMITS, 'min_acceleration')
        ),
    },
    **{
        f'{kind}_steering_controller/{kind.capitalize()}SteeringController': {'tf_odometry_topic'}
        for kind in ('ackermann', 'bicycle', 'tricycle')
    },
}  # fmt: skip


def plain(default):
    """A default as the recording has it."""
    if isinstance(default, tuple):
        return list(default)
    return default if isinstance(default, str | bool) or math.isfinite(default) else str(default)


def is_none(default):
    """Whether a default stands for none."""
    return not default or default != default  # noqa: PLR0124  # NaN


@pytest.mark.parametrize('controller', RECORDED)
def test_the_tables_are_those_of_ros2_controllers(controller):
    """Where the original has no default, ours stands for none."""
    recorded = RECORDED[controller]
    lists = {part for name in recorded for part in name.split('.') if part.startswith('__map_')}
    # An element of each list of names, called as in the recording.
    given = {each.removeprefix('__map_'): [each] for each in lists}
    table = CONTROLLERS.find(controller).parameters_type
    ours = {row.name: row for row in specs(table, '', given)}
    assert set(ours) == set(recorded) | BEYOND.get(controller, set())
    for name, (kind, default, read_only) in recorded.items():
        row = ours[name]
        assert (row.type, row.read_only) == (kind, read_only), name
        assert plain(row.default) == default or (default is None and is_none(row.default)), name


def test_lists_of_any_kind_become_tuples():
    """rclpy hands double arrays over as array.array."""
    table = build(Table, {'variances': array('d', [1.0, 2.0]), 'wheels': ['a', 'b']})
    assert table.variances == (1.0, 2.0)
    assert table.wheels == ('a', 'b')


def test_nan_and_zero_do_where_they_mean_something():
    table = build(Table, {'limit': math.nan, 'factor': -1.0})
    assert math.isnan(table.limit)
    assert table.factor == -1.0


def test_a_table_in_a_module_that_defers_its_annotations():
    assert build(DeferredTable, {'speed': 2.0}).speed == 2.0
    assert [row.type for row in specs(DeferredTable)] == ['double']


def test_a_field_of_a_type_that_ros_lacks_is_named():
    @dataclass(frozen=True)
    class Wrong:
        shape: complex = parameter(1j, 'Not a parameter')

    with pytest.raises(ParameterError, match=r"'shape' of Wrong is annotated as .*complex"):
        build(Wrong, {})


@dataclass(frozen=True)
class Gains:
    p: float = parameter(0.0, 'Proportional')
    inner: Inner = group('in', Inner)


@dataclass(frozen=True)
class Keyed:
    dofs: tuple[str, ...] = parameter((), 'Degrees of freedom', unique=True)
    gains: Mapping[str, Gains] = keyed_group('gains', 'dofs', Gains)
    bare: Mapping[str, Inner] = keyed_group('', 'dofs', Inner)
    inputs: Mapping[str, Inner] = keyed_group('inputs', '', Inner)


def test_a_keyed_group_has_a_table_for_each_element_of_its_list():
    given = {'dofs': ['left', 'a/b'], 'gains.left.p': 2.0, 'gains.a/b.in.rate': 5.0}
    assert [row.name for row in specs(Keyed, '', given)] == [
        'dofs',
        'gains.left.p', 'gains.left.in.rate', 'gains.left.in.mode',
        'gains.a/b.p', 'gains.a/b.in.rate', 'gains.a/b.in.mode',
        'left.rate', 'left.mode', 'a/b.rate', 'a/b.mode',
    ]  # fmt: skip
    table = build(Keyed, given | {'left.mode': 'fast', 'gains.other.p': 'not mine'})
    assert table.gains == {'left': Gains(2.0), 'a/b': Gains(0.0, Inner(5.0))}
    assert table.bare == {'left': Inner(mode='fast'), 'a/b': Inner()}
    assert table.inputs == {}
    assert build(Keyed, {}).gains == {}
    with pytest.raises(ParameterError, match=r"'gains\.left\.in\.rate' must be greater than 0"):
        build(Keyed, given | {'gains.left.in.rate': 0.0})
    with pytest.raises(ParameterError, match="'dofs' must not hold anything twice"):
        build(Keyed, {'dofs': ['left', 'left']})


def test_a_keyed_group_without_a_list_has_a_table_for_each_name_that_is_given():
    given = {'inputs.b.rate': 2.0, 'inputs.a.mode': 'fast', 'inputs.b.mode': 'slow', 'inputs': 1}
    assert build(Keyed, given).inputs == {'b': Inner(2.0, 'slow'), 'a': Inner(mode='fast')}
    assert 'inputs.a.rate' in [row.name for row in specs(Keyed, '', given)]


@pytest.mark.parametrize(
    ('name', 'value', 'adopted'),
    [
        ('factor', 2, 2.0),
        ('count', 2.0, 2),
        ('variances', [0, 1], [0.0, 1.0]),
        ('count', 2.5, 2.5),
        ('factor', True, True),
        ('factor', '2', '2'),
        ('variances', [0, 1.0], [0, 1.0]),
        ('wheels', 'a', 'a'),
    ],
)
def test_numbers_of_the_other_type_are_adopted_and_nothing_else(name, value, adopted):
    row = next(row for row in specs(Table) if row.name == name)
    assert row.adopt(value) == adopted
    assert type(row.adopt(value)) is type(adopted)
