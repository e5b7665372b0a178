# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A file with generate_test_description: its runs, what it has to be, who gets which arguments."""

from types import SimpleNamespace
import unittest

import pytest

from amr_description.launch_api.actions import RegisterEventHandler, TimerAction
from amr_description.launch_api.descriptions import LaunchDescription
from amr_description.launch_api.processes import ExecuteProcess
from amr_description.launch_testing import (
    parametrize,
    post_shutdown_test,
    ready_to_test_action_timeout,
    ReadyAggregator,
)
from amr_description.launch_testing.actions import ReadyToTest, StdoutReadyListener
from amr_description.launch_testing.loading import each_test, LaunchTestError, runs
from amr_description.launch_testing.markers import keep_alive


class Beside(unittest.TestCase):
    __test__ = False  # it is no test of this file's
    seen: list[object] = []

    def test_arguments(self, proc_info, size):
        self.seen.append((proc_info, size, self.proc_output))


@post_shutdown_test()
class After(unittest.TestCase):
    __test__ = False

    def test_nothing(self):
        pass


def file(function, **names):
    return SimpleNamespace(generate_test_description=function, Beside=Beside, After=After, **names)


def ready():
    return LaunchDescription([ReadyToTest()])


def names(suite):
    return [test.id().rpartition('.')[2] for test in each_test(suite)]


def test_tests_stand_beside_or_after_the_processes():
    (run,) = runs(file(ready), 'pkg.file')
    assert (run.name, names(run.beside), names(run.after)) == (
        'pkg.file',
        ['test_arguments'],
        ['test_nothing'],
    )
    assert (run.start_timeout, run.keeps_alive) == (15.0, False)


def test_a_parametrized_file_has_a_run_for_each_value():
    @keep_alive
    @ready_to_test_action_timeout(3)
    @parametrize('size, colour', [(1, 'red'), (2, 'blue')])
    def describe(size, colour):
        return ready(), {'colour': colour}

    first, second = runs(file(describe), 'f')
    assert (first.name, names(second.beside)) == ('f[1, red]', ['test_arguments[2, blue]'])
    assert (first.start_timeout, second.keeps_alive) == (3.0, True)
    assert second.describe(lambda: None).context == {'colour': 'blue'}


def test_tests_get_what_they_name_and_attributes():
    first, second = (
        run for run in runs(file(parametrize('size', [1, 2])(lambda size: ready())), 'f')
    )
    for run in (first, second):
        objects = {'size': run.parameters['size'], 'proc_info': 'info', 'proc_output': 'output'}
        run.bind(run.beside, objects)
    result = unittest.TestResult()
    first.beside.run(result)
    second.beside.run(result)
    assert (result.errors, Beside.seen) == ([], [('info', 1, 'output'), ('info', 2, 'output')])
    assert not hasattr(Beside, 'size')


def test_ready_to_test_is_found_in_timers_and_handlers():
    process = ExecuteProcess(cmd=['a'])
    for description in (
        LaunchDescription([TimerAction(period=1.0, actions=[ReadyToTest()])]),
        LaunchDescription(
            [
                RegisterEventHandler(
                    StdoutReadyListener(
                        target_action=process, ready_txt='up', actions=[ReadyToTest()]
                    )
                )
            ]
        ),
    ):
        assert runs(file(lambda made=description: made), 'f')[0].describe(print).launch


def test_a_function_of_earlier_releases_is_given_what_it_calls():
    called = []

    def describe(ready_fn):
        ready_fn()
        return LaunchDescription()

    assert runs(file(describe), 'f')[0].describe(lambda: called.append(1)).context == {}
    assert called == [1]


@pytest.mark.parametrize(
    ('function', 'why'),
    [
        (lambda: LaunchDescription(), 'has no ReadyToTest'),
        (lambda: [ReadyToTest()], 'returned builtins.list, which is no LaunchDescription'),
        (lambda robot: ready(), "has an argument 'robot' that nothing gives"),
        (parametrize('robot', [1])(lambda: ready()), "no argument 'robot' to be parametrized"),
        (None, 'f has no function generate_test_description'),
    ],
)
def test_what_a_file_lacks_is_said(function, why):
    with pytest.raises(LaunchTestError, match=why):
        [run.describe(lambda: None) for run in runs(file(function), 'f')]


def test_post_shutdown_test_marks_classes_only():
    with pytest.raises(TypeError, match='marks classes'):
        post_shutdown_test()(lambda: None)


def test_an_aggregator_calls_once_at_the_last_call():
    called = []
    aggregator = ReadyAggregator(lambda: called.append(1), 3)
    for _ in range(5):
        aggregator.ready_fn()
    assert called == [1]
