# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The actions of launch_testing: when the tests may begin, and tests that are programs."""

from collections.abc import Callable
import sys
from typing import Any

from amr_description.launch_api.context import LaunchContext
from amr_description.launch_api.descriptions import Occurrence
from amr_description.launch_api.events import OnLine, SomeActions
from amr_description.launch_api.processes import ExecuteProcess
from amr_description.launch_api.substitutions import SomeSubstitutions


class ReadyToTest(Occurrence):
    """The tests may begin: what stands before it is started."""

    def __init__(self) -> None:
        super().__init__()
        self.callbacks: list[Callable[[], object]] = []

    def occur(self, context: LaunchContext) -> None:
        for callback in self.callbacks:
            callback()


class StdoutReadyListener(OnLine):
    """Does actions once a process has written a text."""

    def __init__(
        self, *, target_action: object = None, ready_txt: str, actions: SomeActions
    ) -> None:
        super().__init__(target_action=target_action, text=ready_txt, actions=actions)


class Test(ExecuteProcess):
    """A test that is a program; ``timeout`` is taken, and pytest's or CTest's own ends it."""

    __test__ = False

    def __init__(self, *, timeout: Any = None, kill_timeout: Any = 5.0, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.timeout = timeout


class GTest(Test):
    """A program with tests of GoogleTest."""

    def __init__(self, *, path: SomeSubstitutions, **kwargs: Any) -> None:
        super().__init__(cmd=[path], **kwargs)
        self.path = path


class PyTest(Test):
    """A file with tests of pytest."""

    def __init__(self, *, path: SomeSubstitutions, **kwargs: Any) -> None:
        super().__init__(cmd=[sys.executable, '-m', 'pytest', path], **kwargs)
        self.path = path


__all__ = ['GTest', 'PyTest', 'ReadyToTest', 'StdoutReadyListener']
