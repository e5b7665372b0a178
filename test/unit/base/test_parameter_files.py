# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Parameter files: what is wrong with one, in one line with its place."""

from pathlib import Path

import pytest

from amr_description.errors import ParameterError
from amr_description.parameter_files import read_parameter_file


def test_nodes_may_stand_below_their_namespaces(tmp_path):
    path = tmp_path / 'good.yaml'
    path.write_text('/left:\n  arm:\n    ros__parameters: {gain: 1.0}\n')
    assert read_parameter_file(path) == {'/left': {'arm': {'ros__parameters': {'gain': 1.0}}}}


@pytest.mark.parametrize(
    ('text', 'said'),
    [
        ('', 'holds no node'),
        ('[1, 2]', 'holds no node'),
        ('/arm: {gain: 1.0}', "below '/arm/gain' stands 1.0, and no ros__parameters"),
        ('/arm:\n  ros__parameters: {gain: [1', r"bad.yaml:2:29: expected ',' or '\]'"),
        ('/arm:\n\tros__parameters:', 'bad.yaml:2:1: found character'),
        ('/arm: \x07', 'character 7 is U.0007, which YAML does not allow'),
        ('/arm: 2026-99-99', 'month must be in 1..12'),
        ('{' * 50_000, 'nested too deeply'),
        ('a: &x\n  b: *x', 'nested too deeply'),
    ],
)
def test_what_is_wrong_is_told_in_one_line(tmp_path, text, said):
    path = tmp_path / 'bad.yaml'
    path.write_text(text)
    with pytest.raises(ParameterError, match=said) as error:
        read_parameter_file(path)
    assert '\n' not in str(error.value)


def test_bytes_that_are_no_text_are_told(tmp_path):
    path = tmp_path / 'bad.yaml'
    path.write_bytes(b'/arm: \xff')
    with pytest.raises(ParameterError, match='not UTF-8 text'):
        read_parameter_file(path)


def test_a_file_that_is_not_there_is_told(tmp_path):
    with pytest.raises(ParameterError, match="nowhere.yaml': No such file"):
        read_parameter_file(tmp_path / 'nowhere.yaml')
    with pytest.raises(ParameterError, match='Is a directory'):
        read_parameter_file(Path(tmp_path))
