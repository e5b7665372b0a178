# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``ros2 pkg create``: what it prints, what it writes, and what it refuses."""

import ast
from xml.etree import ElementTree

from catkin_pkg.package import parse_package
import pytest

from amr_description.cli.main import main
from amr_description.cli.pkg.licenses import LICENSES
from amr_description.cli.pkg.templates import python

WHO = ('--maintainer-name', 'Ada', '--maintainer-email', 'ada@todo.todo')
SUMMARY = """\
going to create a new package
package name: {name}
destination directory: {folder}
package format: 3
version: 0.0.0
description: TODO: Package description
maintainer: ['Ada <ada@todo.todo>']
licenses: ['{license}']
build type: {build_type}
dependencies: {dependencies}
"""
PYTHON = """\
creating folder ./py_pubsub
creating ./py_pubsub/package.xml
creating source folder
creating folder ./py_pubsub/py_pubsub
creating ./py_pubsub/setup.py
creating ./py_pubsub/setup.cfg
creating folder ./py_pubsub/resource
creating ./py_pubsub/resource/py_pubsub
creating ./py_pubsub/py_pubsub/__init__.py
creating folder ./py_pubsub/test
creating ./py_pubsub/test/test_copyright.py
creating ./py_pubsub/test/test_flake8.py
creating ./py_pubsub/test/test_pep257.py
"""
CMAKE = """\
node_name: my_node
library_name: my_library
creating folder ./bot
creating ./bot/package.xml
creating source and include folder
creating folder ./bot/src
creating folder ./bot/include/bot
creating ./bot/CMakeLists.txt
creating ./bot/src/my_node.cpp
creating ./bot/include/bot/my_library.hpp
creating ./bot/src/my_library.cpp
creating ./bot/include/bot/visibility_control.h
"""
NO_LICENSE = """
[WARNING]: Unknown license 'TODO: License declaration'.  This has been set in the package.xml, \
but no LICENSE file has been created.
It is recommended to use one of the ament license identifiers:
Apache-2.0
BSL-1.0
BSD-2.0
BSD-2-Clause
BSD-3-Clause
GPL-3.0-only
LGPL-3.0-only
MIT
MIT-0
"""


@pytest.fixture
def create(tmp_path, monkeypatch, capsys):
    """Run ``ros2 pkg create`` in an empty folder; return exit code, stdout, stderr."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr('amr_description.streams.open_missing', lambda: None)
    monkeypatch.setattr('amr_description.streams.make_line_buffered', lambda: None)

    def run(*words, who=WHO):
        try:
            code = main('ros2', ['pkg', 'create', *words, *who])
        except SystemExit as end:
            code = end.code
        return code, *capsys.readouterr()

    return run


def files_in(folder):
    return {str(path.relative_to(folder)) for path in folder.rglob('*') if path.is_file()}


def test_a_package_of_python(create, tmp_path):
    words = ('--build-type', 'ament_python', 'py_pubsub', '--dependencies', 'rclpy', 'std_msgs')
    summary = SUMMARY.format(
        name='py_pubsub',
        folder=tmp_path,
        license='TODO: License declaration',
        build_type='ament_python',
        dependencies=['rclpy', 'std_msgs'],
    )
    assert create(*words) == (0, summary + PYTHON + NO_LICENSE, '')
    package = parse_package(tmp_path / 'py_pubsub')  # by the rules that colcon has
    assert [str(each) for each in package.build_depends] == ['rclpy', 'std_msgs']
    assert [str(each) for each in package.test_depends][-1] == 'python3-pytest'
    assert package.get_build_type() == 'ament_python'
    assert (tmp_path / 'py_pubsub/resource/py_pubsub').read_text() == ''
    assert "'console_scripts': [\n        ]," in (tmp_path / 'py_pubsub/setup.py').read_text()


def test_node_library_and_license_of_a_package_of_python(create, tmp_path):
    words = ('p', '--build-type', 'ament_python', '--license', 'MIT')
    code, said, _ = create(*words, '--node-name', 'n', '--library-name', 'l')
    assert (code, 'WARNING' in said) == (0, False)
    assert 'node_name: n\nlibrary_name: l\ncreating folder ./p\n' in said
    assert said.endswith('./p/p/n.py\ncreating folder ./p/p/l\ncreating ./p/p/l/__init__.py\n')
    assert "'n = p.n:main'" in (tmp_path / 'p/setup.py').read_text()
    assert "print('Hi from p.')" in (tmp_path / 'p/p/n.py').read_text()
    assert 'Ada\n' in (tmp_path / 'p/LICENSE').read_text()


def test_a_package_of_ament_cmake(create, tmp_path):
    words = ('bot', '--node-name', 'my_node', '--library-name', 'my_library')
    words += ('--license', 'Apache-2.0', '--dependencies', 'rcutils')
    summary = SUMMARY.format(
        name='bot',
        folder=tmp_path,
        license='Apache-2.0',
        build_type='ament_cmake',
        dependencies=['rcutils'],
    )
    assert create(*words) == (0, summary + CMAKE, '')
    package = parse_package(tmp_path / 'bot')
    assert [str(each) for each in package.buildtool_depends] == ['ament_cmake_ros']
    rules = (tmp_path / 'bot/CMakeLists.txt').read_text()
    for rule in (
        'find_package(ament_cmake REQUIRED)\nfind_package(ament_cmake_ros REQUIRED)\n'
        'find_package(rcutils REQUIRED)\n',
        'add_library(my_library src/my_library.cpp)',
        'ament_target_dependencies(\n  my_library\n  "rcutils"\n)',
        'target_link_libraries(my_node my_library)',
        'install(TARGETS my_node\n  DESTINATION lib/${PROJECT_NAME})',
        'PRIVATE "BOT_BUILDING_LIBRARY"',
    ):
        assert rule in rules
    assert 'class MyLibrary' in (tmp_path / 'bot/include/bot/my_library.hpp').read_text()


def test_a_package_that_only_has_files(create, tmp_path):
    assert create('my_robot_description', '--license', 'BSD-3-Clause')[0] == 0
    assert files_in(tmp_path / 'my_robot_description') == {
        'CMakeLists.txt', 'LICENSE', 'package.xml',
    }  # fmt: skip


def test_a_package_of_plain_cmake(create, tmp_path):
    assert create('lib', '--build-type', 'cmake', '--library-name', 'my', '--license', 'x')[0] == 0
    assert files_in(tmp_path / 'lib') == {
        'CMakeLists.txt', 'include/lib/my.hpp', 'include/lib/visibility_control.h',
        'libConfig.cmake.in', 'libConfigVersion.cmake.in', 'package.xml', 'src/my.cpp',
    }  # fmt: skip
    assert parse_package(tmp_path / 'lib').buildtool_depends == []


def test_what_was_typed_cannot_break_the_files(create, tmp_path):
    text = 'it\'s <b> & "c" \\ ü'
    words = ('--description', text, '--license', '<\'&">', '--package-format', '2')
    assert create('p', '--build-type', 'ament_python', *words)[0] == 0
    manifest = ElementTree.parse(tmp_path / 'p/package.xml').getroot()
    assert (manifest.get('format'), manifest.findtext('description')) == ('2', text)
    call = ast.parse((tmp_path / 'p/setup.py').read_text()).body[-1].value
    values = {each.arg: each.value for each in call.keywords}
    assert ast.literal_eval(values['description']) == text
    assert ast.literal_eval(values['license']) == '<\'&">'


def test_licenses(create, tmp_path):
    assert create('p', '--license', '?') == (
        0,
        'Supported licenses:\n' + '\n'.join(LICENSES) + '\n',
        '',
    )
    assert not (tmp_path / 'p').exists()
    for number, name in enumerate(LICENSES):
        assert create(f'p{number}', '--license', name)[0] == 0
        text = (tmp_path / f'p{number}/LICENSE').read_text()
        assert len(text) > 700 and '{' not in text
        assert ('Ada' in text) == name.startswith(('BSD', 'MIT'))


def test_a_node_that_is_called_as_the_library(create, tmp_path):
    code, said, warned = create('p', '--node-name', 'n', '--library-name', 'n')
    assert (code, 'node_name: n_node\n' in said) == (0, True)
    assert warned.splitlines() == [
        '[WARNING] node name can not be equal to the library name',
        '[WARNING] renaming node to n_node',
    ]
    assert (tmp_path / 'p/src/n_node.cpp').is_file()


@pytest.mark.parametrize(
    ('git', 'user', 'address'),
    [
        ('me@host.example', 'Ada', 'me@host.example'),
        ('me@localhost', 'Ada', 'Ada@todo.todo'),  # colcon would refuse it
        ('', 'Ada Lovelace', 'Ada.Lovelace@todo.todo'),
        (None, 'ä', 'user@todo.todo'),
    ],
)
def test_the_address_of_the_maintainer(create, tmp_path, monkeypatch, git, user, address):
    programs = tmp_path / 'bin'
    programs.mkdir()
    if git is not None:
        (programs / 'git').write_text(f'#!/bin/sh\necho {git}\n')
        (programs / 'git').chmod(0o755)
    monkeypatch.setenv('PATH', str(programs))
    monkeypatch.setenv('LOGNAME', user)
    assert create('p', who=())[0] == 0
    maintainer = ElementTree.parse(tmp_path / 'p/package.xml').find('maintainer')
    assert (maintainer.text, maintainer.get('email')) == (user, address)


def test_nothing_is_overwritten(create, tmp_path):
    (tmp_path / 'there/p').mkdir(parents=True)
    code, said, error = create('p', '--destination-directory', 'there')
    assert (code, said) == (1, '')
    assert error == (
        '\nAborted!\nThe directory already exists: there/p\nEither remove the directory or choose'
        ' a different destination directory or package name\n'
    )


@pytest.mark.parametrize(
    ('words', 'code', 'said'),
    [
        (('test', '--build-type', 'ament_python'), 1, "can't be named 'test'"),
        (('a-b', '--build-type', 'ament_python'), 1, "'a_b' may do"),
        (('class', '--build-type', 'ament_python'), 1, "cannot import: 'my_class' may do"),
        (('4wd', '--build-type', 'ament_python'), 1, "'my_4wd' may do"),
        (('a-b', '--library-name', 'l'), 1, "which is no namespace: 'a_b' may do"),
        (('a b',), 1, "a package cannot be called 'a b'"),
        (('../p',), 1, 'a package cannot be called'),
        (('p', '--node-name', 'my-node'), 1, 'as in my_node'),
        (('p', '--maintainer-email', 'me'), 1, 'NAME@HOST.DOMAIN'),
        (('p', '--destination-directory', 'file/deep'), 1, 'unable to create file/deep'),
        (('p', '--build-type', 'ament_rust'), 2, "invalid choice: 'ament_rust'"),
        ((), 2, 'required: package_name'),
    ],
)
def test_what_cannot_be_is_refused_in_a_line(create, tmp_path, words, code, said):
    (tmp_path / 'file').touch()
    found, _, error = create(*words, who=())
    assert (found, said in error) == (code, True), error
    assert code == 2 or error.count('\n') == 1
    assert files_in(tmp_path) == {'file'}


def test_the_tests_of_the_template_are_right_python():
    for text in (*python.TESTS.values(), python.NODE.format(name='x')):
        ast.parse(text)
