# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A file with ``generate_test_description`` → its runs, each with tests of its own."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
import functools
import importlib.util
import inspect
from pathlib import Path
import sys
from types import ModuleType
from typing import Any
import unittest

from amr_description.launch_api.descriptions import LaunchDescription, LaunchDescriptionEntity
from amr_description.launch_testing.actions import ReadyToTest
from amr_description.launch_testing.markers import (
    KEEP_ALIVE,
    POST_SHUTDOWN,
    runs_of,
    START_TIMEOUT,
)

ENTRY = 'generate_test_description'
"""The function of a test file by which it is known."""
READY_FUNCTION = 'ready_fn'
"""An argument that functions of earlier releases have: what they call in place of ReadyToTest."""
_START_TIMEOUT = 15.0


class LaunchTestError(Exception):
    """A test file is not as it has to be."""


@dataclass
class TestDescription:
    """What a function has returned."""

    launch: LaunchDescription
    context: Mapping[str, Any] = field(default_factory=dict)
    """What its tests may have as arguments."""


class TestRun:
    """One launch, and its tests."""

    __test__ = False

    def __init__(
        self,
        name: str,
        function: Callable[..., Any],
        parameters: Mapping[str, Any],
        module: ModuleType,
    ) -> None:
        """
        Load the tests.

        Args:
            name: Of the file.
            function: Returns the description.
            parameters: The arguments that are bound to it, by name.
            module: The file.
        """
        self.name = name + _in_brackets(parameters)
        self.parameters = parameters
        self.function = function
        self.keeps_alive = bool(getattr(function, KEEP_ALIVE, False))
        self.start_timeout = float(getattr(function, START_TIMEOUT, _START_TIMEOUT))
        """s until ReadyToTest has to come."""
        self.beside = _suite_of(module, parameters, after=False)
        self.after = _suite_of(module, parameters, after=True)

    def describe(self, ready: Callable[[], object]) -> TestDescription:
        """
        Return what is to be run.

        Args:
            ready: Is called when the tests may begin.

        Raises:
            LaunchTestError: it is no description, or has no ReadyToTest.
            unittest.SkipTest: the run is to be skipped.
        """
        takes_function = READY_FUNCTION in inspect.signature(self.function).parameters
        made = self.function(**({READY_FUNCTION: ready} if takes_function else {}))
        launch, context = made if isinstance(made, tuple) else (made, {})
        if not isinstance(launch, LaunchDescription):
            kind = type(launch)
            raise LaunchTestError(
                f'{ENTRY} returned {kind.__module__}.{kind.__qualname__}, which is no '
                'LaunchDescription of amr_description; a workspace that has launch needs '
                'launch_testing, too'
            )
        actions = list(ready_actions(launch))
        if not actions and not takes_function:
            raise LaunchTestError(f'the description that {ENTRY} returned has no ReadyToTest')
        for action in actions:
            action.callbacks.append(ready)
        return TestDescription(launch, context)

    def bind(self, suite: unittest.TestSuite, objects: Mapping[str, Any]) -> None:
        """Give tests what they name as arguments; the rest as attributes, as earlier releases."""
        tests = list(each_test(suite))
        for test in tests:
            for name in (test._testMethodName, 'setUp', 'tearDown'):
                setattr(test, name, _bound(getattr(test, name), objects))
        for kind in dict.fromkeys(map(type, tests)):
            for name in ('setUpClass', 'tearDownClass'):
                setattr(kind, name, _bound(getattr(kind, name), objects))
            for name, value in objects.items():
                if not hasattr(kind, name):
                    setattr(kind, name, value)


def runs(module: ModuleType, name: str) -> list[TestRun]:
    """Return the runs of a test file. Raises LaunchTestError."""
    function = getattr(module, ENTRY, None)
    if not callable(function):
        raise LaunchTestError(f'{name} has no function {ENTRY}')
    known = inspect.signature(function).parameters
    found = []
    for bound, parameters in runs_of(function):
        if unknown := [each for each in parameters if each not in known]:
            raise LaunchTestError(f"{ENTRY} has no argument '{unknown[0]}' to be parametrized")
        given = {*parameters, READY_FUNCTION}
        open_ones = [
            p.name for p in known.values() if p.default is p.empty and p.name not in given
        ]
        if open_ones:
            raise LaunchTestError(f"{ENTRY} has an argument '{open_ones[0]}' that nothing gives")
        found.append(TestRun(name, bound, parameters, module))
    return found


def load(path: Path, name: str) -> ModuleType:
    """Return a test file as a module. Raises LaunchTestError, and what the file raises."""
    spec = importlib.util.spec_from_file_location(name, path)
    if spec is None or spec.loader is None:
        raise LaunchTestError(f'{path} is no Python file')
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return module


def ready_actions(entity: LaunchDescriptionEntity) -> Iterator[ReadyToTest]:
    """Yield every ReadyToTest in a description, also in timers and handlers."""
    if isinstance(entity, ReadyToTest):
        yield entity
    handler = getattr(entity, 'event_handler', None)
    inner = [*entity.sub_entities(), *getattr(handler, 'entities', ())]
    for each in inner:
        if isinstance(each, LaunchDescriptionEntity):
            yield from ready_actions(each)


def each_test(suite: unittest.TestSuite) -> Iterator[unittest.TestCase]:
    """Yield the tests of a suite and of those in it."""
    for each in suite:
        if isinstance(each, unittest.TestSuite):
            yield from each_test(each)
        else:
            yield each


def _suite_of(
    module: ModuleType, parameters: Mapping[str, Any], *, after: bool
) -> unittest.TestSuite:
    suite = unittest.TestSuite()
    # Tests stay in it when they have run: a report has their names.
    suite._removeTestAtIndex = lambda index: None  # type: ignore[attr-defined]
    for kind in vars(module).values():
        if not isinstance(kind, type) or not issubclass(kind, unittest.TestCase):
            continue
        if bool(getattr(kind, POST_SHUTDOWN, False)) is not after or kind is unittest.TestCase:
            continue
        # A class of its own for each run: what a run binds stays in it.
        own = type(kind.__name__, (kind,), {'__module__': kind.__module__})
        for name in unittest.TestLoader().getTestCaseNames(own):
            suite.addTest(_test_of(own, name, parameters))
    return suite


def _test_of(
    kind: type[unittest.TestCase], name: str, parameters: Mapping[str, Any]
) -> unittest.TestCase:
    shown = name + _in_brackets(parameters)
    if shown != name:
        setattr(kind, shown, getattr(kind, name))
    return kind(shown)


def _in_brackets(parameters: Mapping[str, Any]) -> str:
    return f'[{", ".join(map(str, parameters.values()))}]' if parameters else ''


def _bound(function: Callable[..., Any], objects: Mapping[str, Any]) -> Callable[..., Any]:
    known = inspect.signature(function).parameters
    given = {name: value for name, value in objects.items() if name in known}
    return functools.update_wrapper(functools.partial(function, **given), function)
