# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``launch_pytest``, and its plugin: fixtures that are launched, and tests marked ``launch``.

It is loaded at the first file that needs it (``scripts/environment/launchers.py``). Tests run on
the main thread; a test that is a coroutine runs in the loop of the fixture ``event_loop``.
"""

import asyncio
from collections.abc import AsyncGenerator, Callable, Generator, Iterator, Sequence
from dataclasses import dataclass
import functools
import inspect
import threading
from typing import Any

import pytest

from amr_description.launch_api.context import LaunchContext
from amr_description.launch_api.descriptions import LaunchDescription
from amr_description.launch_api.service import LaunchService
from amr_description.launch_testing import actions as actions, tools as tools
from amr_description.launch_testing.actions import ReadyToTest
from amr_description.launch_testing.loading import ready_actions

OPTIONS = 'launch_pytest_options'
"""An attribute of such fixtures, and of their functions."""
_SCOPES = ('function', 'class', 'module', 'package', 'session')


@dataclass(frozen=True)
class Options:
    """How a fixture is to be run."""

    name: str
    scope: str
    shutdown_when_idle: bool
    auto_shutdown: bool


def finalize(service: LaunchService, *, auto_shutdown: bool = True) -> None:
    """Wait until a service is over, which is ended unless it ends by itself."""
    if auto_shutdown:
        service.shutdown()
    code = service.wait()
    assert code == 0, f'the launch service ended with the code {code}'


def support_fixtures(scope: Any = 'function') -> dict[str, Any]:
    """Return the fixtures that a launch fixture of this scope needs, by name."""

    @pytest.fixture(scope=scope)
    def event_loop() -> Iterator[asyncio.AbstractEventLoop]:
        """Runs the tests that are coroutines."""
        loop = asyncio.new_event_loop()
        yield loop
        loop.run_until_complete(loop.shutdown_default_executor())
        loop.close()

    @pytest.fixture(scope=scope)
    def launch_service() -> Iterator[LaunchService]:
        """Runs the description of the launch fixture."""
        service = LaunchService()
        yield service
        finalize(service)

    @pytest.fixture(scope=scope)
    def launch_context(launch_service: LaunchService) -> LaunchContext:
        """Return what the tools of launch_pytest take."""
        return launch_service.context

    return {
        'event_loop': event_loop,
        'launch_context': launch_context,
        'launch_service': launch_service,
    }


def fixture(
    decorated: Callable[..., Any] | None = None,
    *args: Any,
    shutdown_when_idle: bool = True,
    auto_shutdown: bool = True,
    **kwargs: Any,
) -> Any:
    """
    As pytest.fixture, of a function that returns a description, or several things, that first.

    Args:
        decorated: The function.
        args: As of pytest.fixture.
        shutdown_when_idle: Whether the launch is over when all processes have ended.
        auto_shutdown: Whether it is ended after the tests beside it.
        kwargs: As of pytest.fixture.
    """
    scope = kwargs.get('scope', 'function')
    if scope != 'function':  # its service lives as long
        frame = inspect.currentframe()
        assert frame is not None and frame.f_back is not None, 'a file has called this'
        for name, made in support_fixtures(scope).items():
            _override(frame.f_back.f_globals, name, made, scope)

    def decorate(function: Callable[..., Any]) -> Any:
        name = kwargs.get('name') or function.__name__
        options = Options(name, scope, shutdown_when_idle, auto_shutdown)
        setattr(function, OPTIONS, options)
        made = pytest.fixture(*args, **kwargs)(function)
        setattr(made, OPTIONS, options)
        return made

    return decorate if decorated is None else decorate(decorated)


def _override(module: dict[str, Any], name: str, made: Any, scope: str) -> None:
    """Give a file a fixture of a wider scope, unless it has one of its own."""
    key = f'{name} of launch_pytest'
    before = module.get(key)
    if name in module and before is None:
        return
    if before is None or _SCOPES.index(scope) > _SCOPES.index(before):
        module[name], module[key] = made, scope


globals().update(support_fixtures())  # of function scope, for all files


@pytest.hookimpl(wrapper=True)
def pytest_fixture_setup(fixturedef: Any, request: Any) -> Generator[None, Any, Any]:
    """Run what a launch fixture returns, until it is ready."""
    options: Options | None = getattr(fixturedef.func, OPTIONS, None)
    if options is None:
        return (yield)
    service: LaunchService = request.getfixturevalue('launch_service')
    value = yield
    first = value[0] if isinstance(value, Sequence) and value else value
    if not isinstance(first, LaunchDescription):
        raise TypeError(
            f'the launch fixture {options.name} returned {type(first).__name__}, which is no '
            'LaunchDescription of amr_description, nor a sequence that begins with one'
        )
    ready = next(ready_actions(first), None)
    if ready is None:
        first.add_action(ready := ReadyToTest())
    is_awake = threading.Event()
    ready.callbacks.append(is_awake.set)
    service.on_end = is_awake.set
    service.include_launch_description(first)
    fixturedef.addfinalizer(
        functools.partial(finalize, service, auto_shutdown=options.auto_shutdown)
    )
    service.start(shutdown_when_idle=options.shutdown_when_idle)
    is_awake.wait()
    return value


def _options_of(item: pytest.Item) -> Options | None:
    mark = item.get_closest_marker('launch')
    given = None if mark is None else mark.kwargs.get('fixture')
    return getattr(given, OPTIONS, None)


@pytest.hookimpl(tryfirst=True)
def pytest_pycollect_makeitem(collector: Any, name: str, obj: Any) -> list[pytest.Item] | None:
    """Collect functions that are marked: also generators, which pytest does not know."""
    if not inspect.isfunction(obj) or not collector.funcnamefilter(name):
        return None
    marks = [*getattr(obj, 'pytestmark', ()), *collector.iter_markers('launch')]
    mark = next((each for each in marks if each.name == 'launch'), None)
    if mark is None:
        return None
    options: Options | None = getattr(mark.kwargs.get('fixture'), OPTIONS, None)
    if options is None:
        text = 'pytest.mark.launch takes fixture=, which is one of launch_pytest'
        pytest.mark.skip(text)(obj)
        return list(collector._genfunctions(name, obj))
    pytest.mark.usefixtures(options.name, 'launch_service', 'event_loop')(obj)
    items = list(collector._genfunctions(name, obj))
    is_after = bool(mark.kwargs.get('shutdown', False))
    for item in items:
        item._launch_step = _Step(is_after)
    if _is_generator(obj) and options.scope != 'function':
        rest = list(collector._genfunctions(name, obj))
        for first, second in zip(items, rest, strict=True):
            second.name = f'{second.name}[shutdown_test]'
            second._launch_step = _Step(True, first._launch_step)
        items += rest
    return items


class _Step:
    """What an item does: the whole of a function, or a part of a generator."""

    def __init__(self, is_after: bool, first: '_Step | None' = None) -> None:
        self.is_after = is_after
        """Whether it comes when the launch is over."""
        self.first = first
        """The part before it."""
        self.generator: Any = None


def _is_generator(function: object) -> bool:
    return inspect.isgeneratorfunction(function) or inspect.isasyncgenfunction(function)


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Have what comes after a launch stand behind all that runs beside it."""
    last: dict[object, int] = {}
    for index, item in enumerate(items):
        if (key := _launch_of(item)) is not None and not _step_of(item).is_after:
            last[key] = index

    def place(entry: tuple[int, pytest.Item]) -> tuple[int, int]:
        index, item = entry
        key = _launch_of(item)
        if key is None or not _step_of(item).is_after:
            return index, -1
        return max(last.get(key, index), index), index

    items[:] = [item for _, item in sorted(enumerate(items), key=place)]


def _launch_of(item: pytest.Item) -> object:
    """Return by what the launch of an item is known; None: it has none, or one of its own."""
    options = _options_of(item)
    if options is None or options.scope == 'function' or not hasattr(item, '_launch_step'):
        return None
    parameters = getattr(getattr(item, 'callspec', None), 'params', {})
    holder = item.parent if options.scope == 'class' else item.getparent(pytest.Module)
    return holder, options.name, repr(parameters.get(options.name))


def _step_of(item: pytest.Item) -> _Step:
    step: _Step = item._launch_step  # type: ignore[attr-defined]
    return step


@pytest.hookimpl(wrapper=True, tryfirst=True)
def pytest_pyfunc_call(pyfuncitem: Any) -> Generator[None, Any, Any]:
    """Call a function that is marked."""
    options = _options_of(pyfuncitem)
    if options is None or not hasattr(pyfuncitem, '_launch_step'):
        return (yield)
    step, function = _step_of(pyfuncitem), pyfuncitem.obj
    loop: asyncio.AbstractEventLoop = pyfuncitem.funcargs['event_loop']
    end = functools.partial(
        finalize, pyfuncitem.funcargs['launch_service'], auto_shutdown=options.auto_shutdown
    )
    if _is_generator(function) and step.is_after and step.first is None:
        pytest.fail('a generator is no test with shutdown=True: it has a part before and after')
    if step.is_after:
        end()
    if step.first is not None:
        pyfuncitem.obj = _without_arguments(pyfuncitem, _rest_of(step.first.generator, loop))
    elif _is_generator(function):
        both = options.scope == 'function'
        pyfuncitem.obj = _begun(function, loop, step, end if both else None)
    elif inspect.iscoroutinefunction(function):
        pyfuncitem.obj = _in_loop(function, loop)
    try:
        return (yield)
    finally:
        pyfuncitem.obj = function


def _in_loop(function: Any, loop: asyncio.AbstractEventLoop) -> Callable[..., None]:
    @functools.wraps(function)
    def call(**kwargs: Any) -> None:
        loop.run_until_complete(function(**kwargs))

    return call


def _without_arguments(item: Any, function: Callable[[], None]) -> Callable[..., None]:
    """Return a function that pytest may give what the first part has taken already."""

    @functools.wraps(item.obj)
    def call(**_kwargs: Any) -> None:
        function()

    return call


def _begun(
    function: Any, loop: asyncio.AbstractEventLoop, step: _Step, end: Callable[[], None] | None
) -> Callable[..., None]:
    """Return what runs a generator to its yield; with ``end``, then that, and then the rest."""

    @functools.wraps(function)
    def call(**kwargs: Any) -> None:
        step.generator = function(**kwargs)
        if not _advance(step.generator, loop):
            pytest.fail('the test has no yield: nothing is left for when the launch is over')
        if end is not None:
            end()
            _rest_of(step.generator, loop)()

    return call


def _rest_of(generator: Any, loop: asyncio.AbstractEventLoop) -> Callable[[], None]:
    def finish() -> None:
        if generator is None:
            pytest.skip('its first part did not run')
        if _advance(generator, loop):
            pytest.fail('the test has yielded twice')

    return finish


def _advance(
    generator: Generator[Any, Any, Any] | AsyncGenerator[Any, Any], loop: asyncio.AbstractEventLoop
) -> bool:
    """Run a generator to its next yield; return whether there is one."""
    try:
        if inspect.isasyncgen(generator):
            loop.run_until_complete(anext(generator))
        else:
            next(generator)  # type: ignore[arg-type]
    except (StopIteration, StopAsyncIteration):
        return False
    return True
