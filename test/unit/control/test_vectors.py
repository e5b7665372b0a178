# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Every recorded vector is used by a test."""

import ast
import functools
from pathlib import Path

import pytest
from support.control_fakes import VECTORS
from support.paths import TESTS

REMARKS = {'_note'}


def names_in(nodes):
    return {n.id for node in nodes for n in ast.walk(node) if isinstance(n, ast.Name)}


def strings_in(nodes):
    return {n.value for node in nodes for n in ast.walk(node) if isinstance(n, ast.Constant)}


def is_vector(node):
    return (
        isinstance(node, ast.Subscript)
        and isinstance(node.value, ast.Name)
        and node.value.id == 'VECTORS'
    )


def readers(module):
    """
    Key → the test functions of the module that use it, if only by a name given to it at the top.
    """
    tests = [n for n in module.body if isinstance(n, ast.FunctionDef) and n.name[:5] == 'test_']
    found = {}
    for statement in module.body:
        keys = {n.slice.value for n in ast.walk(statement) if is_vector(n)}
        if isinstance(statement, ast.Assign):
            given = names_in(statement.targets)
            using = [t.name for t in tests if given & names_in([t])]
        else:
            using = [statement.name] if statement in tests else []
        for key in keys:
            found.setdefault(key, []).extend(using)
    return found


@functools.cache
def users():
    """Key → (file, test function) of every use in a test."""
    found = {}
    for path in sorted(TESTS.rglob('test_*.py')):
        text = path.read_text()
        if path.name != Path(__file__).name and 'VECTORS' in text:
            for key, functions in readers(ast.parse(text)).items():
                found.setdefault(key, []).extend((path, function) for function in functions)
    return found


@pytest.mark.parametrize('key', sorted(VECTORS.keys() - REMARKS))
def test_a_vector_is_run_by_a_test(key):
    assert users().get(key), f'no test uses VECTORS[{key!r}]'


@pytest.mark.parametrize('key', sorted(VECTORS.keys() - REMARKS))
def test_every_list_of_rows_in_it_is_read(key):
    """By its name, or all of them by a loop over the whole vector."""
    lists = {name for name, value in VECTORS[key].items() if isinstance(value, list)}
    modules = [ast.parse(path.read_text()) for path in {path for path, _ in users()[key]}]
    if 'items' in {n.attr for m in modules for n in ast.walk(m) if isinstance(n, ast.Attribute)}:
        return
    assert lists - {'arg_order'} <= strings_in(modules)


def test_the_reader_itself_finds_what_is_used_and_only_that():
    module = ast.parse(
        "A = VECTORS['a']['rows']\n"
        "B = VECTORS['b']\n"
        "C = [row for row in VECTORS['c']]\n"
        'def test_one(): assert A\n'
        "@parametrize('row', C)\ndef test_two(row): assert VECTORS['d']\n"
        'def helper(): return B\n'
    )
    assert readers(module) == {'a': ['test_one'], 'b': [], 'c': ['test_two'], 'd': ['test_two']}
