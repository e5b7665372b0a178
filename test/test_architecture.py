# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The arrows of the house: which part of the package may import which, and who owns what library.

Every import statement counts, wherever it stands: deferring one changes when it costs, not what
depends on what. So do module names given as text to ``import_module``.
"""

import ast
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PACKAGE = ROOT / 'amr_description'
HEADER = ['# Copyright 2026 The amr_description authors', '# SPDX-License-Identifier: Apache-2.0']
MOST_LINES_OF_A_FILE = 600
MOST_LINES_OF_A_FUNCTION = 60

# part -> parts it may import; arrows point one way.
BASE = {'errors', 'registry', 'parameters'}
PURE = BASE | {'model', 'control', 'controllers'}
LEAVES = {'sim', 'viewer', 'controllers', 'hardware'}
ARROWS = {
    '__init__': set(),
    'errors': set(),
    'entry': set(),  # it imports by name what setup.py names
    'registry': {'errors'},
    'parameters': {'errors', 'registry'},
    'model': BASE,
    'control': BASE | {'model'},
    'controllers': BASE | {'model', 'control'},
    'hardware': BASE | {'model', 'control'},
    'sim': BASE | {'model', 'control'},
    'viewer': BASE | {'model', 'control'},
    'nodes': BASE | {'model', 'control'} | LEAVES,
    'bringup': BASE | {'model', 'control'} | LEAVES | {'nodes'},
    'cli': BASE | {'model', 'control'} | LEAVES | {'nodes', 'bringup', 'entry'},
    'testing': BASE | {'model', 'control'} | LEAVES | {'nodes', 'bringup'},
}
# Heavy libraries have one home each.
HOMES = {
    'rclpy': {'nodes', 'cli', 'testing'},
    'mujoco': {'sim'},
    'websockets': {'viewer'},
    'serial': {'hardware'},
    'xacro': {'model'},
}
MESSAGE_HOMES = {'nodes', 'cli', 'testing'}
IMPURE = {
    'asyncio', 'multiprocessing', 'random', 'selectors', 'signal', 'socket', 'subprocess',
    'threading', 'time',
}  # fmt: skip


def part_of(path):
    return path.relative_to(PACKAGE).parts[0].removesuffix('.py')


def imported(path):
    """Yield (line, dotted name) of every import in a file."""
    tree = ast.parse(path.read_text())
    package = ['amr_description', *path.relative_to(PACKAGE).parts[:-1]]
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from ((node.lineno, alias.name) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            base = package[: len(package) - node.level + 1] if node.level else []
            module = '.'.join([*base, *([node.module] if node.module else [])])
            yield from ((node.lineno, f'{module}.{alias.name}') for alias in node.names)
        elif (
            isinstance(node, ast.Call)
            and getattr(node.func, 'attr', getattr(node.func, 'id', '')) == 'import_module'
            and node.args
            and isinstance(node.args[0], ast.Constant)
        ):
            yield node.lineno, node.args[0].value


SOURCES = sorted(PACKAGE.rglob('*.py'))
IMPORTS = [(path, line, name) for path in SOURCES for line, name in imported(path)]


def where(path, line=1):
    return f'{path.relative_to(ROOT)}:{line}'


def test_every_part_has_its_arrows():
    assert {part_of(path) for path in SOURCES} <= ARROWS.keys()


def test_arrows_point_one_way():
    wrong = [
        f'{where(path, line)}: {part_of(path)} -> {target}'
        for path, line, name in IMPORTS
        if name.startswith('amr_description.')
        and (target := name.split('.')[1]) != part_of(path)
        and target in ARROWS
        and target not in ARROWS[part_of(path)]
    ]
    assert wrong == []


def test_arrows_have_no_cycle():
    from graphlib import TopologicalSorter

    assert set(TopologicalSorter(ARROWS).static_order()) >= ARROWS.keys()


@pytest.mark.parametrize('library', HOMES)
def test_heavy_library_has_one_home(library):
    wrong = [
        where(path, line)
        for path, line, name in IMPORTS
        if name.split('.')[0] == library and part_of(path) not in HOMES[library]
    ]
    assert wrong == []


def test_messages_stay_at_home():
    wrong = [
        f'{where(path, line)}: {name}'
        for path, line, name in IMPORTS
        if name.split('.')[0].endswith(('_msgs', '_interfaces'))
        and part_of(path) not in MESSAGE_HOMES
    ]
    assert wrong == []


def test_pure_parts_take_time_and_chance_as_arguments():
    wrong = [
        f'{where(path, line)}: {name}'
        for path, line, name in IMPORTS
        if part_of(path) in PURE and name.split('.')[0] in IMPURE
    ]
    assert wrong == []


def test_bringup_is_standard_library_only():
    import sys

    wrong = [
        f'{where(path, line)}: {name}'
        for path, line, name in IMPORTS
        if part_of(path) == 'bringup'
        and (top := name.split('.')[0]) != 'amr_description'
        and top not in sys.stdlib_module_names
    ]
    assert wrong == []


def test_reader_sees_deferred_and_relative_and_named_imports(tmp_path, monkeypatch):
    monkeypatch.setattr('test_architecture.PACKAGE', tmp_path)
    folder = tmp_path / 'control'
    folder.mkdir()
    source = folder / 'loop.py'
    source.write_text(
        'import a.b\n'
        'def f():\n'
        '    from .x import y\n'
        '    from .. import z\n'
        '    importlib.import_module("amr_description.nodes")\n'
    )
    assert list(imported(source)) == [
        (1, 'a.b'),
        (3, 'amr_description.control.x.y'),
        (4, 'amr_description.z'),
        (5, 'amr_description.nodes'),
    ]


def own_python_files():
    folders = ('amr_description', 'interfaces', 'scripts', 'test')
    found = [path for folder in folders for path in (ROOT / folder).rglob('*.py')]
    return sorted(path for path in found if not {'build', '__pycache__'} & set(path.parts))


def test_files_begin_with_copyright_and_docstring():
    wrong = [
        where(path)
        for path in own_python_files()
        if path.read_text().splitlines()[:2] != HEADER
        or not ast.get_docstring(ast.parse(path.read_text()))
    ]
    assert wrong == []


def test_files_and_functions_stay_readable():
    too_long = []
    for path in own_python_files():
        if path.is_relative_to(ROOT / 'test'):
            continue
        text = path.read_text()
        if text.count('\n') > MOST_LINES_OF_A_FILE:
            too_long.append(where(path))
        too_long += [
            f'{where(path, node.lineno)}: {node.name}'
            for node in ast.walk(ast.parse(text))
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)
            and node.end_lineno - node.lineno >= MOST_LINES_OF_A_FUNCTION
        ]
    assert too_long == []
