# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""docs/write_your_own_controller.md: its class works, its test passes, its words are true."""

import inspect
import math
import re

import pytest
from support.doc_pages import install, mocked, Page, Robot

from amr_description.control.contracts import Controller
from amr_description.errors import ParameterError

PAGE = Page('write_your_own_controller.md')
CLASS, _ACTION, TEST = PAGE.blocks('python')
(TABLE,) = PAGE.tables()
(MOCK,) = PAGE.blocks('xml')


@pytest.fixture
def package(tmp_path, monkeypatch):
    """The reader's package, where Python finds it."""
    install(tmp_path, monkeypatch, my_module=CLASS)


@pytest.fixture
def robot(package):
    return Robot(mocked(MOCK)).load(TABLE)


def test_the_test_of_the_page_passes(package, capsys):
    PAGE.run(TEST)['test_it_turns_as_commanded'](mocked(MOCK))


def test_the_yaml_of_the_page_loads_the_class(robot):
    robot.switch('spinner')
    spinner = robot.controllers['spinner']
    spinner.inputs()[0].put(0.5)
    robot.run(0.1)
    assert sorted(robot.wheels, key=math.isnan)[0] == 1.0
    spinner.inputs()[0].put(math.nan)
    robot.run(0.1)
    assert 1.0 in robot.wheels
    robot.switch('', 'spinner')
    assert 0.0 in robot.wheels


def test_parameters_are_checked_as_the_page_says(package):
    bad = {'spinner': {'ros__parameters': TABLE['spinner']['ros__parameters'] | {'gain': -1.0}}}
    with pytest.raises(ParameterError, match="'gain' must be greater than 0, found -1.0 rad/s"):
        Robot(mocked(MOCK)).load(bad)


def test_the_class_is_short():
    body = CLASS.partition('class MyClass')[2].partition('\n\n\n')[0]
    assert sum(1 for line in body.splitlines() if line.strip()) <= 30


def test_every_method_of_the_table_is_one_of_the_contract():
    named = re.findall(r'^\| `(\w+)` \|', PAGE.text, re.MULTILINE)
    assert len(named) == 13
    assert all(inspect.isfunction(getattr(Controller, name)) for name in named)


def test_what_the_page_names_is_there():
    assert PAGE.is_sound()
