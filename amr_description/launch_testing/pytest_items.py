# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Files with ``generate_test_description``, as pytest collects and runs them."""

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import pytest

from amr_description.bringup.arguments import parse
from amr_description.launch_testing.loading import ENTRY, runs
from amr_description.launch_testing.runner import run_tests, RunResult

_MARKS = ('launch_test', 'rostest')


class LaunchTestFailure(Exception):  # noqa: N818 - as in the original
    """Tests of a run have failed."""

    def __init__(self, results: Sequence[RunResult]) -> None:
        super().__init__('some test cases have failed')
        self.results = results


class LaunchTestItem(pytest.Item):
    """All runs of a file."""

    def __init__(self, *, module: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._module = module

    def runtest(self) -> None:
        words = [word for words in self.config.getoption('--launch-args') for word in words]
        results = []
        for run in runs(self._module, self.name):
            results.append(run_tests(run, parse(words)))
            if results[-1].failure:
                break
        if not all(each.is_successful for each in results):
            raise LaunchTestFailure(results)
        if all(each.skipped for each in results):
            pytest.skip(results[0].skipped)

    def repr_failure(self, excinfo: Any, style: Any = None) -> Any:
        if isinstance(excinfo.value, LaunchTestFailure):
            found = (each for result in excinfo.value.results for each in result.failures)
            return '\n\n'.join(f'FAIL: {name}\n{text}' for name, text in found)
        return super().repr_failure(excinfo, style)

    def reportinfo(self) -> tuple[Path, int, str]:
        return self.path, 0, f'launch tests: {self.name}'


class LaunchTestModule(pytest.Module):
    """A file that may be a launch test: where the function is marked as one."""

    def collect(self) -> Iterable[Any]:
        marks = getattr(getattr(self.obj, ENTRY, None), 'pytestmark', ())
        if not any(mark.name in _MARKS for mark in marks):
            return super().collect()
        for mark in marks:
            self.add_marker(getattr(pytest.mark, mark.name).with_args(*mark.args, **mark.kwargs))
        name = self.obj.__name__
        return [LaunchTestItem.from_parent(self, name=name, module=self.obj)]


def makemodule(module_path: Path, parent: pytest.Collector) -> LaunchTestModule:
    """Return what collects a file that names such a function."""
    made: LaunchTestModule = LaunchTestModule.from_parent(parent, path=module_path)
    return made
