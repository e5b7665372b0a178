# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The build of interface packages: what it finds, in which order, and what it says of faults."""

import io
from pathlib import Path
import subprocess
import sys
import sysconfig
from unittest import mock

import em
from environment import interface_wheel
from environment.locks import pins_of
from hypothesis import given, strategies as st
import pytest
from support import public_interfaces
from support.paths import ROOT

from amr_description.errors import CompilerError, InterfaceBuildError
from amr_description.interface_build import generators, libraries, packages, toolchain


@pytest.fixture
def folder(tmp_path):
    """Return a function that writes a package; each depends on the ones named."""

    def write(name, *depends, files=('msg/A.msg',), called=None):
        for file in files:
            (tmp_path / name / file).parent.mkdir(parents=True, exist_ok=True)
            (tmp_path / name / file).write_text('int8 a\n')
        tags = ''.join(f'<depend>{other}</depend>' for other in depends)
        (tmp_path / name).mkdir(exist_ok=True)
        (tmp_path / name / 'package.xml').write_text(
            f'<package format="3"><name>{called or name}</name>{tags}</package>'
        )
        return tmp_path

    return write


def test_every_folder_with_a_manifest_is_found_dependencies_first(folder):
    folder('a_msgs', 'b_msgs', 'std_msgs')
    folder('b_msgs', 'c_msgs')
    root = folder('c_msgs')
    (root / 'interface_build').mkdir()
    assert [found.name for found in packages.find_packages(root)] == ['c_msgs', 'b_msgs', 'a_msgs']


def test_interfaces_of_each_kind_are_found(folder):
    root = folder('a_msgs', files=('msg/B.msg', 'msg/A.msg', 'srv/S.srv', 'action/T.action'))
    (root / 'a_msgs/msg/README').touch()
    (found,) = packages.find_packages(root)
    assert [str(path) for path in found.interfaces] == [
        'msg/A.msg', 'msg/B.msg', 'srv/S.srv', 'action/T.action',
    ]  # fmt: skip


@pytest.mark.parametrize(
    ('files', 'needed'),
    [
        (('msg/A.msg',), set()),
        (('srv/A.srv',), {'service_msgs', 'builtin_interfaces'}),
        (
            ('action/A.action',),
            {'service_msgs', 'builtin_interfaces', 'action_msgs', 'unique_identifier_msgs'},
        ),
    ],
)
def test_services_and_actions_imply_dependencies(folder, files, needed):
    (found,) = packages.find_packages(folder('a_msgs', files=files))
    assert found.needed == needed


def test_dependencies_are_followed_here_and_in_the_prefix(folder, tmp_path):
    root = folder('a_msgs', 'b_msgs', 'ament_cmake')
    folder('b_msgs', 'c_msgs')
    prefix = tmp_path / 'prefix'
    for name, depends in (('c_msgs', '<depend>d_msgs</depend>'), ('d_msgs', '')):
        (prefix / 'share' / name / 'msg').mkdir(parents=True)
        (prefix / 'share' / name / 'package.xml').write_text(f'<package>{depends}</package>')
        (prefix / 'lib').mkdir(exist_ok=True)
        (prefix / 'lib' / f'lib{name}__rosidl_generator_c.so').touch()
    found = packages.find_packages(root)
    reached = packages.interface_dependencies(found[-1], found, packages.find_underlay(prefix))
    assert reached == ['b_msgs', 'c_msgs', 'd_msgs']


def test_packages_that_need_each_other_are_refused(folder):
    folder('a_msgs', 'b_msgs')
    with pytest.raises(
        InterfaceBuildError, match='need each other: [ab]_msgs -> [ab]_msgs -> [ab]_msgs'
    ):
        packages.find_packages(folder('b_msgs', 'a_msgs'))


def test_folder_and_package_have_the_same_name(folder):
    with pytest.raises(InterfaceBuildError, match="called 'b_msgs', its folder 'a_msgs'"):
        packages.find_packages(folder('a_msgs', called='b_msgs'))


def test_a_package_without_interfaces_is_refused(folder):
    with pytest.raises(InterfaceBuildError, match='a_msgs: no interface found'):
        packages.find_packages(folder('a_msgs', files=()))


def test_a_broken_manifest_is_named(folder):
    root = folder('a_msgs')
    (root / 'a_msgs/package.xml').write_text('<package>')
    with pytest.raises(InterfaceBuildError, match='a_msgs/package.xml: not well-formed XML'):
        packages.find_packages(root)


def test_an_empty_folder_is_refused(tmp_path):
    with pytest.raises(InterfaceBuildError, match='no folder with a package.xml'):
        packages.find_packages(tmp_path)


def compiler(folder, name, text):
    path = folder / name
    path.write_text(f'#!/bin/sh\n{text}\n')
    path.chmod(0o755)
    return str(path)


def test_compilers_of_the_environment_come_first(monkeypatch):
    monkeypatch.setenv('PATH', '')
    found = next(toolchain.candidates({'CC': 'ccache cc', 'CXX': 'c++'}))
    assert found == toolchain.Toolchain(('ccache', 'cc'), ('c++',))


def test_a_compiler_that_does_not_work_is_passed_over(tmp_path, monkeypatch):
    monkeypatch.setenv('PATH', str(tmp_path))
    for name in ('gcc', 'g++'):
        compiler(tmp_path, name, 'echo "fatal error: string: No such file" >&2; exit 1')
    for name in ('clang', 'clang++'):
        compiler(tmp_path, name, 'exit 0')
    assert toolchain.find_toolchain({}) == toolchain.Toolchain(('clang',), ('clang++',))


def test_no_compiler_gives_the_reasons_and_the_way(tmp_path, monkeypatch):
    monkeypatch.setenv('PATH', str(tmp_path))
    monkeypatch.setattr('importlib.util.find_spec', lambda _name: None)
    with pytest.raises(CompilerError, match='neither gcc nor clang on PATH.*pip install ziglang'):
        toolchain.find_toolchain({})
    for name in ('gcc', 'g++'):
        compiler(tmp_path, name, 'echo "fatal error: string: No such file" >&2; exit 1')
    with pytest.raises(CompilerError, match='gcc .*: fatal error: string: No such file'):
        toolchain.find_toolchain({})


def test_zig_is_the_last_resort(tmp_path, monkeypatch):
    monkeypatch.setenv('PATH', str(tmp_path))
    monkeypatch.setattr('importlib.util.find_spec', lambda name: name == 'ziglang')
    (found,) = toolchain.candidates({})
    assert found.c == (sys.executable, '-m', 'ziglang', 'cc')
    assert found.cpp == (sys.executable, '-m', 'ziglang', 'c++')


def test_headers_of_the_environment_are_used_where_the_system_has_none(tmp_path, monkeypatch):
    monkeypatch.setattr(sysconfig, 'get_path', lambda _name: f'{tmp_path}/usr/python3.99')
    monkeypatch.setattr(sys, 'prefix', str(tmp_path))
    with pytest.raises(
        InterfaceBuildError, match=r'python3.99/Python.h not found.* python3\.1[1-4]-dev;'
    ):
        toolchain.python_headers()
    header = tmp_path / 'include/python3.99/Python.h'
    header.parent.mkdir(parents=True)
    header.touch()
    assert toolchain.python_headers() == header.parent


def test_language_follows_the_suffix():
    compilers = toolchain.Toolchain(('gcc',), ('g++',))
    assert compilers.compiler_for(Path('a.c')) == ('gcc', '-std=gnu11')
    assert compilers.compiler_for(Path('a.cpp')) == ('g++', '-std=c++17')


def test_descriptions_are_compiled_apart_all_else_together():
    names = [f'm{number}__functions.c' for number in range(libraries.SOURCES_PER_UNIT + 1)]
    sources = [Path(name) for name in (*names, 'a__description.c', 'b__description.c')]
    units = libraries.translation_units(sources)
    assert [len(unit) for unit in units] == [libraries.SOURCES_PER_UNIT, 1, 1, 1]
    assert sorted(path for unit in units for path in unit) == sorted(sources)


def test_a_library_is_found_in_the_first_folder_that_has_it(tmp_path):
    ours, wheels = tmp_path / 'ours', tmp_path / 'wheels'
    for folder in (ours, wheels):
        folder.mkdir()
        (folder / 'libboth.so').touch()
    (wheels / 'librmw.so').touch()
    assert libraries.find_library('both', (ours, wheels)) == ours / 'libboth.so'
    assert libraries.find_library('rmw', (ours, wheels)) == wheels / 'librmw.so'
    with pytest.raises(InterfaceBuildError, match=f'libnone.so is not in {ours} nor in {wheels}'):
        libraries.find_library('none', (ours, wheels))


def test_what_is_called_is_linked_before_its_caller(folder, tmp_path):
    (found,) = packages.find_packages(folder('a_msgs'))
    package = generators.GeneratedPackage(found, tmp_path / 'build', tmp_path / 'prefix')
    made = []
    for job in libraries.link_jobs(package, ['std_msgs'], tmp_path / 'stage'):
        assert {name for name in job.calls if name.startswith('a_msgs')} <= set(made)
        made.append(job.output.name.removeprefix('lib').removesuffix('.so'))
    assert len(made) == len(libraries.LIBRARIES) + len(libraries.EXTENSIONS)


_PIECES = (
    'text\n', '@@', '@# said\n', '@(a)', '@( a + 1)', '@a', '@name.upper()', '@{b = a}\n', '@(b)',
    '@[if a]', '@[elif name]', '@[else]', '@[end if]', '@[for x in range(3)]@(x)', '@[end for]',
    '@{\ndef f():\n    return 3\n}', '@(f())', '@(', '@{', '@[', '@', '"@(\')\')"', '@!', '\r\n',
)  # fmt: skip


def expanded(template, functions, methods):
    """Return what EmPy makes of a template, with these functions of its own; or its error."""
    with (
        mock.patch.multiple(em, create=True, **functions),
        mock.patch.multiple(em.Interpreter, **methods),
        mock.patch.object(em.Interpreter, 'installProxy'),  # standard output stays pytest's
    ):
        output = io.StringIO()
        options = {em.RAW_OPT: True, em.OVERRIDE_OPT: False}
        interpreter = em.Interpreter(output=output, options=options)
        try:
            interpreter.string(template, 'some.em', {'a': 1, 'name': 'n'})
            interpreter.flush()
            return output.getvalue()
        except Exception as error:
            return type(error)
        finally:
            interpreter.shutdown()


@pytest.fixture(scope='module')
def as_written_by_empy_and_as_ours():
    before = {'_exec': em._exec, 'eval': eval}, {'string': em.Interpreter.string}
    try:
        generators.read_templates_once()
        ours = {'_exec': em._exec, 'eval': em.eval}, {'string': em.Interpreter.string}
    finally:
        em._exec, em.Interpreter.string = before[0]['_exec'], before[1]['string']
        del em.eval
    return before, ours


@given(st.lists(st.sampled_from(_PIECES), max_size=12).map(''.join))
def test_a_template_that_is_read_once_expands_as_ever(as_written_by_empy_and_as_ours, template):
    before, ours = as_written_by_empy_and_as_ours
    assert expanded(template, *ours) == expanded(template, *before)
    assert expanded(template, *ours) == expanded(template, *before)  # of what was read before


def test_another_module_than_these_needs_no_new_wheel():
    folder = f'{libraries.__name__.rpartition(".")[0]}.'
    code = f"""
import sys
import {folder}build
print(*(name.removeprefix('{folder}') for name in sys.modules if name.startswith('{folder}')))
"""
    loaded = subprocess.run([sys.executable, '-c', code], check=True, stdout=subprocess.PIPE)
    assert sorted(loaded.stdout.decode().split()) == sorted(interface_wheel.BUILDER)


def test_what_a_library_of_a_workspace_calls_is_found_before_the_underlay(folder, tmp_path):
    (found,) = packages.find_packages(folder('a_msgs'))
    package = generators.GeneratedPackage(found, tmp_path / 'build', tmp_path / 'prefix')
    jobs = libraries.link_jobs(package, [], tmp_path / 'stage', ['../../b_msgs/lib'])
    assert all(job.comes_first for job in jobs)
    assert {job.run_path for job in jobs} == {
        '$ORIGIN:$ORIGIN/../../b_msgs/lib',
        '$ORIGIN/../../..:$ORIGIN/../../../../../b_msgs/lib',
    }
    # Opened by its bare name, it is that of the workspace if that is loaded already.
    assert [job.loads for job in jobs if job.loads] == [('a_msgs__rosidl_typesupport_fastrtps_c',)]
    assert not any(job.comes_first for job in libraries.link_jobs(package, [], tmp_path / 'stage'))


def test_public_messages_have_their_public_hashes(tmp_path, monkeypatch):
    monkeypatch.setattr(sys, 'path', [*sys.path])
    generators.find_parser()
    public_interfaces.write_public_packages(tmp_path / 'src')
    underlay = packages.find_underlay(Path(sys.prefix))
    found = {}
    for source in packages.find_packages(tmp_path / 'src'):
        package = generators.GeneratedPackage(source, tmp_path / source.name, Path(sys.prefix))
        generators.write_idl(package)
        generators.write_type_descriptions(package, [], underlay)
        described = package.generated(generators.TYPE_DESCRIPTION)
        found |= {
            name: public_interfaces.hash_of(described.parent / f'{name}.json', name)
            for name in public_interfaces.HASHES
            if name.startswith(f'{source.name}/')
        }
    assert found == public_interfaces.HASHES


def test_a_parser_that_is_missing_is_one_line_with_the_way_to_get_it(tmp_path, monkeypatch):
    """As after an installation by pip alone: nodes start faster without it."""
    monkeypatch.setattr(sys, 'prefix', str(tmp_path))
    monkeypatch.setattr(sys, 'path', [])
    monkeypatch.setattr('importlib.util.find_spec', lambda _name: None)
    with pytest.raises(InterfaceBuildError) as caught:
        generators.find_parser()
    wanted = f'-m pip install --target {tmp_path}/lib/interface_build lark-parser==0.12.0'
    assert str(caught.value).endswith(wanted)
    assert '\n' not in str(caught.value)


def test_set_up_installs_the_parser_where_builds_look_for_it():
    pin = pins_of((ROOT / 'scripts/tools.lock').read_text())[interface_wheel.PARSER]
    assert f'{pin.name}=={pin.version}' == generators.PARSER
    assert (Path(sys.prefix) / interface_wheel.PARSER_FOLDER / 'lark').is_dir()
