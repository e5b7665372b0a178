# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Where the time of a piece of code goes."""

import json
import math
import sys

import pytest

from benchmarks.call_tree import CallRecorder, CallTree, cost_of_watching

OUTER = (lambda: None).__code__.replace(co_qualname='outer', co_filename='/a/rclpy/one.py')
INNER = OUTER.replace(co_qualname='inner')


def tree_of(*events):
    tree = CallTree('all', total=100.0)
    tree.add(events)
    return tree


def outer_and_inner():
    return tree_of(
        (100, OUTER),
        (110, INNER),
        (-130, INNER),
        (135, INNER),
        (-140, INNER),
        (-160, OUTER),
    )


def test_time_is_that_of_the_calls_below_one():
    (outer,) = outer_and_inner().children.values()
    (inner,) = outer.children.values()
    assert (outer.name, outer.module, outer.calls) == ('outer', 'rclpy/one', 1)
    assert (inner.name, inner.calls) == ('inner', 2)
    assert (outer.total, inner.total, outer.own) == (60, 25, 35)


def test_an_end_without_a_beginning_and_a_call_without_an_end_do_no_harm():
    tree = tree_of(
        (-1, INNER),
        (1, OUTER),
        (-2, math.sqrt),
        (3, INNER),
        (-9, OUTER),
        (9, OUTER),
    )
    (outer,) = tree.children.values()
    (inner,) = outer.children.values()
    assert (outer.calls, outer.total, inner.total) == (1, 8, 6)


def test_what_watching_costs_is_shared_by_caller_and_called():
    tree = outer_and_inner().without_overhead(2.0, 100.0 - 3 * 2.0)
    (outer,) = tree.children.values()
    (inner,) = outer.children.values()
    assert inner.own == 25 - 2  # the inner halves of two calls
    assert outer.own == 35 - 1 - 2  # its own, and the outer halves of two
    assert tree.own == 40 - 1
    assert tree.total == 94


def test_the_rest_is_scaled_and_nothing_is_negative():
    assert outer_and_inner().without_overhead(2.0, 50.0).total == pytest.approx(50.0)
    tree = outer_and_inner().without_overhead(1e6, 50.0)
    assert all(each.own >= 0.0 for each in tree.walk())


def test_what_is_known_exactly_is_not_scaled():
    tree = outer_and_inner().without_overhead(0.0, 60.0, {'inner': 15.0, 'another': 7.0})
    found = {each.name: each for each in tree.walk()}
    assert found['inner'].own == pytest.approx(15.0)
    assert tree.total == pytest.approx(60.0)
    assert found['outer'].own == pytest.approx(35.0 * 45.0 / 75.0)


def test_what_would_be_more_than_all_is_not_believed():
    tree = outer_and_inner().without_overhead(0.0, 10.0, {'inner': 15.0})
    assert tree.total == pytest.approx(10.0)
    assert min(each.own for each in tree.walk()) > 0.0


def test_mean_and_modules():
    tree = outer_and_inner().per(2, 10.0)
    assert tree.total == 5.0
    assert tree.by_module() == {'rclpy/one': 3.0}
    (outer,) = tree.children.values()
    assert (outer.calls, outer.total) == (0.5, 3.0)


def test_table_leaves_out_what_is_small():
    lines = list(outer_and_inner().lines(least=30.0))
    assert [line.split()[:2] for line in lines] == [['100.0', '40.0'], ['60.0', '35.0']]
    assert len(list(outer_and_inner().lines(least=20.0))) == 3


def test_json_and_back():
    tree = outer_and_inner()
    assert CallTree.from_json(json.loads(json.dumps(tree.as_json()))) == tree


def test_recorder_hears_functions_of_python_and_of_c():
    clock = iter(range(1, 100))
    recorder = CallRecorder(lambda: next(clock))

    def inner():
        return len('abc')

    before = sys.getprofile()
    sys.setprofile(recorder)
    inner()
    sys.setprofile(before)
    tree = CallTree('all')
    tree.add(recorder.events)
    found = {each.name: each.calls for each in tree.walk()}
    name = inner.__qualname__
    assert (found[name], found['len']) == (1, 1)


def test_watching_costs_something():
    assert 0.0 < cost_of_watching(200) < 1e6
