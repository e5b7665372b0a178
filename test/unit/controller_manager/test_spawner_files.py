# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Where parameter files speak of a controller, and what the manager is told of it."""

import pytest
import yaml

from amr_description.controller_manager.spawner_files import (
    controller_entries,
    files_in_arguments,
    manager_parameters,
    not_found,
    parameters_of,
    type_for_the_manager,
)
from amr_description.errors import ParameterError

ENTRY = {'ros__parameters': {'type': 'a/Type', 'gain': 1.0}}


@pytest.fixture
def write(tmp_path):
    def write_it(name, content):
        path = tmp_path / name
        path.write_text(content if isinstance(content, str) else yaml.safe_dump(content))
        return str(path)

    return write_it


@pytest.mark.parametrize(
    ('content', 'namespaces'),
    [
        ({'arm': ENTRY}, {'/'}),
        ({'/arm': ENTRY}, {'/'}),
        ({'/left/arm': ENTRY}, {'/left'}),
        ({'/left': {'arm': ENTRY}}, {'/left'}),
        ({'left': {'arm': ENTRY}}, {'/left'}),
        ({'/**/arm': ENTRY}, {'/', '/left'}),
        ({'/**/left/arm': ENTRY}, {'/left'}),
        ({'/**': {'arm': ENTRY}}, {'/', '/left'}),
        ({'/**': {'/left/arm': ENTRY}}, {'/left'}),
        ({'/**': ENTRY}, {'/', '/left'}),
        ({'leg': ENTRY}, set()),
    ],
)
def test_a_controller_is_found_where_rcl_finds_it(content, namespaces):
    for namespace in ('/', '/left'):
        found = parameters_of('arm', content, namespace)
        assert found == (ENTRY['ros__parameters'] if namespace in namespaces else None)


def test_the_first_place_that_names_it_counts():
    other = {'ros__parameters': {'gain': 2.0}}
    for content in ({'/**': other, 'arm': ENTRY}, {'/**/arm': other, '/arm': ENTRY}):
        assert parameters_of('arm', content, '/') == ENTRY['ros__parameters']


def test_a_name_without_the_namespace_that_it_needs_is_told(write):
    plain = write('plain.yaml', {'arm': ENTRY})
    with pytest.raises(
        ParameterError,
        match='^Missing namespace : /left or wildcard in parameter file for controller : arm$',
    ):
        controller_entries('arm', [plain], '/left')
    right = write('right.yaml', {'/**/arm': ENTRY})
    assert list(controller_entries('arm', [plain, right], '/left')) == [right]


def test_only_files_that_speak_of_it_go_on_and_the_first_type_counts(write):
    files = [
        write('0.yaml', {'leg': ENTRY}),
        write('1.yaml', {'arm': {'ros__parameters': {'gain': 1.0}}}),
        write('2.yaml', {'arm': {'ros__parameters': {'type': 'a/A', 'fallback_controllers': []}}}),
        write('3.yaml', {'arm': {'ros__parameters': {'fallback_controllers': ['x', 'z']}}}),
        write('4.yaml', {'/**': {'ros__parameters': {'type': 'b/B'}}}),
    ]
    entries = controller_entries('arm', [*files, files[1]], '/')
    assert manager_parameters('arm', entries) == {
        'params_file': files[1:],
        'type': 'a/A',
        'fallback_controllers': ['x', 'z'],
    }


def test_a_single_fallback_may_stand_without_a_list(write):
    file = write('a.yaml', {'arm': {'ros__parameters': {'fallback_controllers': 'x'}}})
    parameters = manager_parameters('arm', controller_entries('arm', [file], '/'))
    assert parameters == {'params_file': [file], 'fallback_controllers': ['x']}


def test_nothing_is_set_where_nothing_is_found(write):
    file = write('a.yaml', {'leg': ENTRY})
    entries = controller_entries('arm', [file], '/')
    assert (entries, manager_parameters('arm', entries)) == ({}, {})
    assert not_found('arm', [file]) == (
        f"Controller : arm parameters not found in parameter files : ['{file}']"
    )


def test_a_type_that_only_the_manager_reads_is_said(write):
    """As a file for both has it: spawner reads the section of the controller alone."""
    manager = {'ros__parameters': {'update_rate': 50, 'arm': {'type': 'a/A'}}}
    file = write('a.yaml', {'controller_manager': manager, 'arm': {'ros__parameters': {'x': 1}}})
    said = type_for_the_manager('arm', [file], '/')
    assert said.startswith(f'{file} has a type for it in the section /controller_manager')
    assert said.endswith('write type: a/A below arm: ros__parameters:, too')
    assert type_for_the_manager('leg', [file], '/') == ''


@pytest.mark.parametrize(
    ('entry', 'said'),
    [
        ({'type': 5}, "'type' of controller arm in .*a.yaml is 5, not a name"),
        ({'fallback_controllers': ['x', 1]}, "'fallback_controllers' of .* is 1, not a name"),
    ],
)
def test_what_is_no_name_is_told(write, entry, said):
    file = write('a.yaml', {'arm': {'ros__parameters': entry}})
    with pytest.raises(ParameterError, match=said):
        manager_parameters('arm', controller_entries('arm', [file], '/'))


@pytest.mark.parametrize(
    ('content', 'said'),
    [
        ('arm: {gain: 1.0}', "below 'arm/gain' stands 1.0, and no ros__parameters"),
        ('arm: [', 'a.yaml:1:7: '),
        ('', 'holds no node'),
    ],
)
def test_a_file_that_is_no_parameter_file_is_told(write, content, said):
    file = write('a.yaml', content)
    text = 'is not a valid ROS parameter file for controller node : /left/arm: '
    with pytest.raises(ParameterError, match=f'^YAML file : {file} {text}.*{said}'):
        controller_entries('arm', [file], '/left')


def test_files_for_ros_are_those_between_its_marks(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    words = 'spawner --params-file no --ros-args --params-file a -r x:=y --params-file /b -- arm'
    assert files_in_arguments(words.split()) == [str(tmp_path / 'a'), '/b']
