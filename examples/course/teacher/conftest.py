"""
The grader, for pytest: points, one line of help for what is wrong, and a file of results.

``python -m pytest teacher --work FOLDER --results results.json``: the exit code is 0 only where
all points are reached. The form of the file is Gradescope's.
"""

from collections import defaultdict
from collections.abc import Callable, Iterator
import importlib.util
import json
from pathlib import Path
import signal
import sys
from types import ModuleType
from typing import Any

import pytest

collect_ignore = ['reference']
LONGEST = 30
"""s that the code of a student may take in one test."""


class Grades:
    """What each test is worth, and what came of it."""

    def __init__(self, work: Path) -> None:
        self.work = work
        self.tests: list[dict[str, Any]] = []

    def note(self, item: pytest.Item, call: pytest.CallInfo[None]) -> None:
        """Take the end of a test, or of what it needs before it begins."""
        error = call.excinfo
        if error is None and call.when != 'call':
            return
        worth = item.get_closest_marker('points').args[0]
        self.tests.append(
            {
                'name': f'{item.path.stem.removeprefix("test_")}: {described(item)}',
                'score': 0 if error else worth,
                'max_score': worth,
                'status': 'failed' if error else 'passed',
                'output': self.help_of(error) if error else '',
            }
        )

    def help_of(self, error: pytest.ExceptionInfo[BaseException]) -> str:
        """Return what has gone wrong, in one line; with its place in the student's own code."""
        if isinstance(error.value, pytest.fail.Exception | pytest.skip.Exception):
            return str(error.value)
        own = [each for each in error.traceback if Path(each.path).is_relative_to(self.work)]
        at = f'{Path(own[-1].path).name}:{own[-1].lineno + 1}: ' if own else ''
        if isinstance(error.value, SyntaxError):
            at = f'{Path(error.value.filename or "").name}:{error.value.lineno}: '
        return ' '.join(f'{at}{error.typename}: {error.value}'.split())

    @property
    def score(self) -> int:
        """Points reached."""
        return sum(test['score'] for test in self.tests)

    @property
    def most(self) -> int:
        """Points that can be reached."""
        return sum(test['max_score'] for test in self.tests)

    def lines(self) -> Iterator[str]:
        """For the terminal."""
        by_exercise = defaultdict(list)
        for test in self.tests:
            by_exercise[test['name'].partition(':')[0]].append(test)
        for exercise, tests in by_exercise.items():
            reached, most = (sum(t[key] for t in tests) for key in ('score', 'max_score'))
            yield f'{exercise:20} {reached:3} of {most:3}'
            yield from dict.fromkeys(f'    {test["output"]}' for test in tests if test['output'])
        yield f'{"all":20} {self.score:3} of {self.most:3}'


GRADES = pytest.StashKey[Grades]()


def described(item: pytest.Item) -> str:
    """Return the first line of what a test says of itself."""
    return item.function.__doc__.strip().partition('\n')[0].rstrip('.')


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the options of the grader."""
    parser.addoption('--work', default='.', help='the folder of the student')
    parser.addoption('--results', help='a file of JSON to write, as Gradescope reads it')


def pytest_configure(config: pytest.Config) -> None:
    """Begin."""
    config.addinivalue_line('markers', 'points(n): what a test is worth')
    config.option.tbstyle, config.option.reportchars = 'no', ''  # the points say it better
    config.stash[GRADES] = Grades(Path(config.option.work).resolve())


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item: pytest.Item, call: pytest.CallInfo[None]) -> Any:
    """Keep what came of a test."""
    item.config.stash[GRADES].note(item, call)
    return (yield)


def pytest_terminal_summary(terminalreporter: Any, config: pytest.Config) -> None:
    """Print what was reached, and what helps."""
    terminalreporter.section('points')
    for line in config.stash[GRADES].lines():
        terminalreporter.write_line(line)


def pytest_sessionfinish(session: pytest.Session) -> None:
    """Write the results."""
    grades = session.config.stash[GRADES]
    if file := session.config.option.results:
        results = {'score': grades.score, 'tests': grades.tests}
        Path(file).write_text(json.dumps(results, indent=2) + '\n')


@pytest.fixture(autouse=True)
def bounded() -> Iterator[None]:
    """Have a loop without an end fail, in place of the whole grading."""
    if not hasattr(signal, 'SIGALRM'):  # Windows
        yield
        return

    def stop(*_: object) -> None:
        pytest.fail(f'your code had not come to an end after {LONGEST} s', pytrace=False)

    former = signal.signal(signal.SIGALRM, stop)
    signal.alarm(LONGEST)
    yield
    signal.alarm(0)
    signal.signal(signal.SIGALRM, former)


@pytest.fixture
def work(request: pytest.FixtureRequest) -> Path:
    """The folder of the student."""
    return request.config.stash[GRADES].work


@pytest.fixture
def submitted(work: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[[str], ModuleType]:
    """Import a file of the student's by its name; the code of no other folder is in its way."""
    monkeypatch.syspath_prepend(str(work))

    def load(name: str) -> ModuleType:
        path = work / f'{name}.py'
        if not path.is_file():
            pytest.fail(f'{path.name} is not there', pytrace=False)
        spec = importlib.util.spec_from_file_location(name, path)
        module = importlib.util.module_from_spec(spec)
        monkeypatch.setitem(sys.modules, name, module)
        try:
            spec.loader.exec_module(module)
        except SystemExit as error:
            pytest.fail(f'{path.name} ends Python as it is imported: {error}', pytrace=False)
        return module

    return load


def expect(holds: object, said: str) -> None:
    """Fail with one line of help, unless it holds."""
    if not holds:
        pytest.fail(said, pytrace=False)
