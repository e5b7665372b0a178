# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The rooms of the house: which may import which, who owns what library, and what stands where.

Every import statement counts, wherever it stands, those under TYPE_CHECKING too: deferring one
changes when it costs, not what depends on what. So do dotted names of our modules in strings, as
in the tables of plugins.
"""

import ast
from collections import Counter
from collections.abc import Iterator
from functools import cache
import gc
from graphlib import CycleError, TopologicalSorter
from pathlib import Path
import re
import subprocess
import sys
import tokenize

import pytest
from support.paths import PROJECT, ROOT

PACKAGE = ROOT / 'amr_description'
HEADER = ['# Copyright 2026 The amr_description authors', '# SPDX-License-Identifier: Apache-2.0']
MOST_LINES_OF_A_FILE = 600
MOST_LINES_OF_A_FUNCTION = 60
MOST_PUBLIC_NAMES = 12
FEW_LINES = 80
# They only fall: a change may lower one; who raises one writes the reason beside it. The last
# were: simulations without ROS (recordings, services, actions, frames, replays, films, the page);
# robots of others (what is lost is frozen, verdicts by motions, geometry and dialects of plugins,
# joints of no tag, early mecanum drives, controllers to do without, what stands on legs or on
# what is below, meshes that take long); trials, robots to learn in; the page's graph, its two
# threads as types, slow pages; a mux and passthrough in the chain; launch files (commands at
# their time, joysticks, tried one by one, sources not built, functions that spawn controllers,
# beside the original); Python halves of C++ packages; what clients of Nav2 ask; bags of SQLite;
# fixes of satellites; Python packages of ROS, with the many names of the originals:
# nav2_simple_commander, cv_bridge, laser_geometry, rosidl_runtime_py, tf_transformations,
# diagnostic_updater, rosbag2_py (four of its names are also the bag's), launch_testing (14
# modules), urdf_parser_py (15 of its names are also the model's), image_geometry, ros2node.api,
# interactive_markers, turtlebot4_navigation; what RViz draws (markers, poses), forms of services
# and actions, on the page. Of helpers: a host of both, fakes of processes, of a late manager,
# clients of markers, a base with a dock, evo and KISS-ICP, colours of workers, tables of cases
# that mutants went through.
BUDGETS = {
    'modules': 883,
    'code lines': 103_312,
    'small modules of one importer beside them': 38,
    'class names used twice': 53,
    'modules excused from a check of types': 12,
    'modules with many public names': 32,
    'code lines of helpers in test files': 28_290,
}

BASE = {
    'ament_index', 'argument_types', 'clock', 'colors', 'entry', 'errors', 'former_parameters',
    'forking', 'launch_log', 'launch_variables', 'limited_child', 'log', 'ownership',
    'parameter_files', 'parameters', 'plugin_errors', 'registry', 'ros_arguments', 'stand_ins',
    'png', 'streams', 'terminal', 'text', 'trusted_files',
}  # fmt: skip
# room -> rooms it may import; every room may import the base.
ARROWS = {
    'amr_description': {'simulation'},  # what users import from it, when they do
    '__main__': set(),
    'gym': {'simulation', 'model'},
    'base': set(),
    'model': set(),
    'control': {'model'},
    'controllers': {'control', 'model'},
    'hardware': {'control', 'model'},
    'cdr': set(),  # messages as bytes
    'messages': {'cdr', 'control', 'model'},
    'controller_manager': {'controllers', 'hardware', 'control', 'model'},
    'maps': set(),
    'sim': {'control', 'model', 'maps'},  # the map of a world
    'viewer': {'model'},
    'navigation': {'model', 'maps'},
    'ros': {'cdr', 'messages', 'model'},
    'bag': set(),
    'bag/ros': {'bag', 'ros'},
    'tf2_ros': {'ros', 'model', 'sensor_msgs_py'},  # of clouds
    'message_filters': set(),
    'nav2_simple_commander': set(),
    'ros_packages': {'bag', 'ros', 'launch_testing'},
    'sensor_msgs_py': set(),
    'ament_copyright': set(),
    'workspace': set(),
    # A simulation without ROS: it may import nothing that has any, see below.
    'simulation': {
        'controller_manager',
        'controllers',
        'hardware',
        'sim',
        'viewer',  # its page
        'navigation',  # drives to goals
        'maps',
        'bag',
        'cdr',
        'messages',
        'control',
        'model',
    },  # fmt: skip
    'trials': {'simulation', 'sim', 'control', 'model'},
    'control/ros': {
        'ros',
        'cdr',
        'messages',
        'controller_manager',
        'control',
        'controllers',
        'model',
    },  # fmt: skip
    'sim/ros': {
        'bag',  # it records in its own process, without loss
        'bag/ros',
        'control/ros',
        'ros',
        'simulation',
        'sim',
        'control',
        'model',
    },
    'viewer/ros': {
        'bag',  # it shows bags, and records them
        'bag/ros',
        'viewer',
        'ros',
        'cdr',
        'model',
        'doctor',
        'doctor/ros',
    },
    'navigation/ros': {'navigation', 'maps', 'ros', 'tf2_ros', 'model'},
    # Its rules are pure; `host` reads this machine, `ros` the graph around it.
    'doctor': {'model', 'navigation'},
    'doctor/host': {'doctor', 'ros', 'bringup'},
    'doctor/ros': {
        'doctor',
        'ros',
        'navigation/ros',
        'model',
        'navigation',
    },
    'interface_build': set(),  # builds call it by its path
    'bringup': {'model'},
    # Its actions are translated into stacks.
    'launch_api': {'bringup'},
    'launch_testing': {'launch_api', 'bringup'},
    'cli': {
        'bag',
        'bag/ros',
        'bringup',
        'doctor',
        'doctor/host',
        'doctor/ros',
        'launch_api',
        'launch_testing',
        'control/ros',
        'controller_manager',
        'controllers',
        'hardware',
        'ros',
        'sim',
        'model',
    },
    # It starts mujoco_sim and check_urdf.
    'testing': {
        'trials',
        'bringup',
        'cli',
        'control/ros',
        'controller_manager',
        'simulation',
        'nodes',
        'ros',
        'control',
        'model',
    },  # fmt: skip
}
# For nodes and tests of users, under their names in ROS.
FOR_USERS = {
    'message_filters', 'nav2_simple_commander', 'ros_packages', 'sensor_msgs_py',
    'ament_copyright',
}  # fmt: skip
ABOVE_NODES = {
    'bringup', 'launch_api', 'launch_testing', 'cli', 'testing', 'workspace', 'amr_description',
}  # fmt: skip
ARROWS['nodes'] = ARROWS.keys() - ABOVE_NODES - FOR_USERS
ROS = {
    'control/ros', 'sim/ros', 'viewer/ros', 'navigation/ros', 'ros', 'tf2_ros',
    'bag/ros', 'doctor/ros', 'message_filters', 'nav2_simple_commander', 'ros_packages',
    'sensor_msgs_py', 'nodes', 'cli', 'testing',
}  # fmt: skip
PURE_TF2 = {'tf2_ros/time_cache', 'tf2_ros/buffer_core', 'tf2_ros/frame_graph'}
PURE = {
    'base', 'cdr', 'model', 'control', 'controllers', 'controller_manager', 'messages',
    'navigation', 'maps', 'bag', 'doctor',
}  # fmt: skip
# Heavy libraries have one home each.
HOMES = {
    'rclpy': ROS,
    'mujoco': {'sim'},
    'websockets': {'viewer'},
    'serial': {'hardware'},
    'xacro': {'model'},
    'trimesh': {'model'},
    'collada': {'model'},
    'yourdfpy': {'model'},
    'simplejpeg': {'sim', 'viewer', 'ros_packages'},
    'colcon_core': {'workspace'},
    'mcap': {'bag'},
    'zstandard': {'bag'},
}
IMPURE = {
    'asyncio', 'multiprocessing', 'random', 'selectors', 'socket', 'subprocess', 'threading',
    'time',
}  # fmt: skip
# Base modules that are about the process that they run in.
OF_THE_PROCESS = {'entry', 'forking', 'limited_child', 'streams'}
# What the supervisor of a stack must never load, directly or by way of others: it must start at
# once, and no crash of these may take it down. Message packages load DDS.
NOT_FOR_THE_SUPERVISOR = re.compile(r'(rclpy|mujoco|numpy|websockets|\w+_(msgs|interfaces))\b')
OWN_NAME = re.compile(r'\bamr_description(?:\.[a-z_][a-z_0-9]*)+')


def module_of(path: Path) -> str:
    """Return the dotted name of a file of the package."""
    parts = path.relative_to(PACKAGE.parent).with_suffix('').parts
    return '.'.join(parts[:-1] if parts[-1] == '__init__' else parts)


SOURCES = {module_of(path): path for path in sorted(PACKAGE.rglob('*.py'))}


@cache
def room_of(module: str) -> str:
    """Return the room of a dotted name: the longest one that holds it."""
    parts = module.split('.')[1:]
    if not parts:
        return 'amr_description'
    if parts[0] in BASE:
        return 'base'
    return '/'.join(parts[:2]) if parts[1:2] in (['ros'], ['host']) else parts[0]


@cache
def tree_of(path: Path) -> ast.Module:
    return ast.parse(path.read_text())


@pytest.fixture(scope='module', autouse=True)
def trees() -> Iterator[None]:
    """
    Keep the collector from the trees: it would go through millions of nodes, again and again.

    They are gone before another file's tests run in this process.
    """
    gc.disable()
    yield
    tree_of.cache_clear()
    gc.enable()


def imported(
    tree: ast.Module, module: str, *, is_package: bool = False
) -> Iterator[tuple[int, str]]:
    """Yield (line, dotted name) of every import of a module, and of our names in its strings."""
    nodes = [*ast.walk(tree)]
    docstrings = {
        id(node.body[0].value)
        for node in nodes
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef)
        and ast.get_docstring(node, clean=False) is not None
    }
    prose = {id(node.value) for node in nodes if isinstance(node, ast.Expr)} | docstrings
    package = module.split('.') if is_package else module.split('.')[:-1]
    for node in nodes:
        match node:
            case ast.Import():
                yield from ((node.lineno, alias.name) for alias in node.names)
            case ast.ImportFrom():
                base = package[: len(package) - node.level + 1] if node.level else []
                name = '.'.join([*base, *([node.module] if node.module else [])])
                yield from ((node.lineno, f'{name}.{alias.name}') for alias in node.names)
            case ast.Constant(value=str(text)) if id(node) not in prose:
                yield from ((node.lineno, found[0]) for found in OWN_NAME.finditer(text))


def statements(node: ast.AST) -> Iterator[ast.AST]:
    """Yield a node and all statements below it; as ast.walk, but not into their expressions."""
    yield node
    for field in ('body', 'orelse', 'finalbody', 'handlers', 'cases'):
        for below in getattr(node, field, ()):
            yield from statements(below)


def target_of(name: str, sources: object = SOURCES) -> str:
    """Return the module that a dotted name of ours means: it may end in what the module holds."""
    while name not in sources:
        name = name.rpartition('.')[0]
    return name


@cache
def imports() -> list[tuple[str, Path, int, str]]:
    """Return module, file, line and imported name of every import of the package."""
    return [
        (module, path, line, name)
        for module, path in SOURCES.items()
        for line, name in imported(tree_of(path), module, is_package=path.stem == '__init__')
    ]


@cache
def own_imports() -> list[tuple[str, Path, int, str]]:
    """Those of our own modules, and which module is meant."""
    return [
        (module, path, line, target_of(name))
        for module, path, line, name in imports()
        if name.split('.')[0] == 'amr_description'
    ]


def where(path, line=1):
    return f'{path.relative_to(ROOT)}:{line}'


def cycle_of(arrows: dict[str, set[str]]) -> list[str]:
    """Return the modules of a circle of imports; empty: there is none."""
    try:
        TopologicalSorter(arrows).prepare()
    except CycleError as error:
        return error.args[1]
    return []


def test_every_room_has_its_arrows():
    assert {room_of(module) for module in SOURCES} <= ARROWS.keys()


def test_arrows_point_one_way():
    wrong = [
        f'{where(path, line)}: {room} -> {target} ({name})'
        for module, path, line, name in own_imports()
        if (target := room_of(name)) not in {(room := room_of(module)), 'base', 'amr_description'}
        and target not in ARROWS[room]
    ]
    assert wrong == []
    assert cycle_of(ARROWS) == []


def test_no_allowance_is_unused():
    """Each is an invitation. ``nodes`` may take from all; plugins of users bring hardware."""
    used = {(room_of(module), room_of(name)) for module, _, _, name in own_imports()}
    free = {('simulation', 'hardware'), *(('nodes', target) for target in ARROWS)}
    allowed = {(room, target) for room, targets in ARROWS.items() for target in targets}
    assert allowed - free - used == set()


def picture() -> str:
    """
    Return the arrows as a table, the highest floor first, without those that others imply.

    It stands in docs/api/folders.md; ``python -m pytest -k arrows_stand`` prints what it lacks.
    """
    below: dict[str, set[str]] = {}
    for room in TopologicalSorter(ARROWS).static_order():
        below[room] = ARROWS[room].union(*(below[each] for each in ARROWS[room]))
    floors: dict[str, int] = {}
    for room in TopologicalSorter(ARROWS).static_order():
        floors[room] = 1 + max((floors[each] for each in ARROWS[room]), default=-1)
    lines = ['| floor | folder | imports from |', '| --: | --- | --- |']
    for room in sorted(ARROWS.keys() - {'base', 'amr_description', '__main__'}, key=str):
        implied = set().union(*(below[each] for each in ARROWS[room]))
        direct = ', '.join(f'`{each}`' for each in sorted(ARROWS[room] - implied - {'base'}))
        lines.append(f'| {floors[room]} | `{room}` | {direct} |'.replace('|  |', '| |'))
    head, rule, *rows = lines
    return '\n'.join([head, rule, *sorted(rows, key=lambda row: -int(row.split()[1]))])


def test_the_arrows_stand_in_the_docs():
    assert picture() in (ROOT / 'docs' / 'api' / 'folders.md').read_text()


def test_no_modules_import_each_other_in_a_circle():
    arrows = {module: set() for module in SOURCES}
    for module, path, line, name in own_imports():
        # A package's table of its own modules is read on demand: it is no import.
        is_table = path.stem == '__init__' and name.startswith(f'{module}.')
        if name != module and not (is_table and not is_statement(path, line)):
            arrows[module].add(name)
    assert cycle_of(arrows) == []


@cache
def statement_lines(path: Path) -> frozenset[int]:
    found = statements(tree_of(path))
    imports = (node for node in found if isinstance(node, ast.Import | ast.ImportFrom))
    return frozenset(node.lineno for node in imports)


def is_statement(path: Path, line: int) -> bool:
    return line in statement_lines(path)


@pytest.mark.parametrize('library', HOMES)
def test_heavy_library_has_one_home(library):
    wrong = [
        where(path, line)
        for module, path, line, name in imports()
        if name.split('.')[0] == library and room_of(module) not in HOMES[library]
    ]
    assert wrong == []


def test_messages_stay_at_home():
    wrong = [
        f'{where(path, line)}: {name}'
        for module, path, line, name in imports()
        if name.split('.')[0].endswith(('_msgs', '_interfaces')) and room_of(module) not in ROS
    ]
    assert wrong == []


def test_pure_rooms_take_time_and_chance_as_arguments():
    wrong = [
        f'{where(path, line)}: {name}'
        for module, path, line, name in imports()
        if room_of(module) in PURE
        and path.stem not in OF_THE_PROCESS
        and name.split('.')[0] in IMPURE
    ]
    assert wrong == []


def test_the_core_of_tf2_knows_no_ros():
    wrong = [
        f'{where(path, line)}: {name}'
        for module, path, line, name in imports()
        if module.removeprefix('amr_description.').replace('.', '/') in PURE_TF2
        and (
            name.split('.')[0] in {'rclpy', *IMPURE}
            or name.split('.')[0].endswith('_msgs')
            or (name.startswith('amr_description.tf2_ros.') and not is_pure_tf2(name))
        )
    ]
    assert wrong == []


def is_pure_tf2(name: str) -> bool:
    return target_of(name).removeprefix('amr_description.').replace('.', '/') in PURE_TF2


def test_the_supervisor_of_a_stack_loads_nothing_heavy():
    """Neither with its ready-made stacks, nor by deferred imports, nor by packages above these."""
    supervisor = [module for module in SOURCES if room_of(module) == 'bringup']
    assert loads(supervisor, NOT_FOR_THE_SUPERVISOR) == []


def test_only_the_simulator_loads_the_physics():
    """A program that only talks to the simulator would start 0.3 s later."""
    physics = re.compile('mujoco')
    executables = [module for module in SOURCES if module.startswith('amr_description.nodes.')]
    # The second reads worlds, which are MuJoCo's, without any simulator.
    with_physics = ['amr_description.nodes.mujoco_sim', 'amr_description.nodes.map_of_world']
    for name in with_physics:
        executables.remove(name)
        assert loads([name], physics)
    assert loads(executables, physics) == []


@cache
def needed_by_the_simulation() -> set[str]:
    """Return all that it imports, now or later, or names as a plugin, by whatever way."""
    arrows: dict[str, set[str]] = {}
    for module, _, _, name in own_imports():
        arrows.setdefault(module, set()).update(with_parents(name))
    rooms = ('simulation', 'trials', 'gym')
    needed = {module for module in SOURCES if room_of(module) in rooms}
    waiting = list(needed)
    while waiting:
        found = arrows.get(waiting.pop(), set()) - needed
        needed |= found
        waiting += found
    return needed


def test_the_simulation_without_ros_needs_none():
    of_ros = re.compile(r'(rclpy|rpyutils|ament_\w+|rosidl_\w+|\w+_(msgs|interfaces|srvs))\b')
    needed = needed_by_the_simulation()
    assert 'amr_description.hardware.mujoco_system' in needed
    rooms = {room_of(module) for module in needed}
    assert rooms & (ROS | {'bringup', 'launch_api', 'workspace'}) == set()
    wrong = [
        f'{where(path, line)}: {name}'
        for module, path, line, name in imports()
        if module in needed and of_ros.match(name)
    ]
    assert wrong == []


def test_what_the_simulation_without_ros_imports_is_declared():
    """In pyproject.toml, so that pip installs it: for all, or as an extra for what few need."""
    files = {SOURCES[module] for module in needed_by_the_simulation()}
    named = [name for module, _, _, name in imports() if module in needed_by_the_simulation()]
    named += (name for path in files for name in imported_by_name(tree_of(path)))
    found = {name.split('.')[0] for name in named}
    found -= {*sys.stdlib_module_names, 'amr_description'}
    assert {'mujoco', 'yaml', 'PIL', 'matplotlib'} <= found
    extras = {**PROJECT['optional-dependencies']}
    assert extras.pop('ros') and extras.pop('test')
    declared = [*PROJECT['dependencies'], *(each for some in extras.values() for each in some)]
    names = {re.match(r'[\w-]+', each)[0].lower() for each in declared}
    called = {'yaml': 'pyyaml', 'serial': 'pyserial', 'PIL': 'pillow'}
    assert {called.get(name, name) for name in found} == names - {'pycollada'}  # trimesh's


def imported_by_name(tree: ast.Module) -> Iterator[str]:
    """Yield what ``importlib.import_module('name')`` imports."""
    for node in ast.walk(tree):
        match node:
            case ast.Call(ast.Attribute(attr='import_module'), [ast.Constant(str(name))]):
                yield name


def test_the_simulator_loads_what_sensors_measure_with_only_for_them():
    """They are a sixth of its imports; ``loads`` sees deferred ones, too."""
    code = 'import amr_description.nodes.mujoco_sim, sys; print(*sys.modules)'
    loaded = subprocess.run([sys.executable, '-c', code], check=True, stdout=subprocess.PIPE)
    names = loaded.stdout.decode().split()
    heavy = r'amr_description\.(sim\.(lidar|cameras\..*)|simulation\.topics\.equipment)'
    assert 'amr_description.simulation.topics.sensor_manager' in names
    assert [name for name in names if re.fullmatch(heavy, name)] == []


def test_the_doctor_loads_arrays_only_where_there_are_scans():
    """They are half of its start; ``loads`` sees deferred ones, too."""
    code = 'import amr_description.cli.doctor.examination, sys; print(*sys.modules)'
    loaded = subprocess.run([sys.executable, '-c', code], check=True, stdout=subprocess.PIPE)
    names = loaded.stdout.decode().split()
    assert 'amr_description.doctor.rules.sensors' in names
    assert 'numpy' not in names


def loads(modules: list[str], heavy: re.Pattern[str]) -> list[str]:
    """Return the imports of ``heavy`` by these modules, and by what importing them imports."""
    arrows: dict[str, set[str]] = {}
    for module, path, line, name in imports():
        if is_statement(path, line):
            arrows.setdefault(module, set()).add(name)
    waiting = list(modules)
    seen, found = set(waiting), []
    while waiting:
        module = waiting.pop()
        for name in arrows.get(module, ()):
            if heavy.match(name):
                found.append(f'{module} -> {name}')
            loaded = with_parents(target_of(name)) if name.startswith('amr_description') else ()
            waiting += [each for each in loaded if each not in seen]
            seen.update(loaded)
    return found


def with_parents(module: str) -> list[str]:
    """Return a module and the packages that are imported with it."""
    parts = module.split('.')
    return ['.'.join(parts[:count]) for count in range(1, len(parts) + 1)]


def test_reader_sees_deferred_relative_and_named_imports():
    source = (
        '"""Prose may name amr_description.sim.world."""\n'
        'import a.b\n'
        'def f():\n'
        '    from .x import y\n'
        '    from .. import z\n'
        'if TYPE_CHECKING:\n'
        '    from amr_description.nodes import t\n'
        'TABLE = {"a": "amr_description.sim.world:World"}\n'
    )
    assert sorted(imported(ast.parse(source), 'amr_description.control.loop')) == [
        (2, 'a.b'),
        (4, 'amr_description.control.x.y'),
        (5, 'amr_description.z'),
        (7, 'amr_description.nodes.t'),
        (8, 'amr_description.sim.world'),
    ]
    assert list(imported(ast.parse('from .x import y'), 'a.b', is_package=True)) == [
        (1, 'a.b.x.y')
    ]


def test_reader_sees_statements_at_every_depth():
    source = (
        'try:\n    import a\nexcept E:\n    import b\n'
        'else:\n    import c\nfinally:\n    import d\n'
        'match x:\n    case 1:\n        import e\n'
        'class C:\n    def f():\n        with y:\n            import f\n'
        'for x in y:\n    import g\nelse:\n    import h\n'
    )
    names = [n.names[0].name for n in statements(ast.parse(source)) if isinstance(n, ast.Import)]
    assert sorted(names) == [*'abcdefgh']


def test_reader_sees_rooms_and_circles():
    assert room_of('amr_description') == 'amr_description'
    assert room_of('amr_description.errors') == 'base'
    assert room_of('amr_description.control.loop') == 'control'
    assert room_of('amr_description.control.ros') == 'control/ros'
    assert room_of('amr_description.control.ros.client') == 'control/ros'
    assert set(cycle_of({'a': {'b'}, 'b': {'c'}, 'c': {'a'}, 'd': {'a'}})) == {'a', 'b', 'c'}
    assert cycle_of({'a': {'b'}, 'b': {'c'}}) == []


def own_python_files():
    folders = ('amr_description', 'benchmarks', 'interfaces', 'scripts', 'test')
    found = [path for folder in folders for path in (ROOT / folder).rglob('*.py')]
    return sorted(path for path in found if not {'build', '__pycache__'} & set(path.parts))


def test_modules_that_others_import_are_there():
    """Of benchmarks and scripts: no test runs all of them."""
    absent = [
        f'{where(path, node.lineno)}: {node.module}'
        for path in own_python_files()
        if not path.is_relative_to(PACKAGE)
        for node in ast.walk(tree_of(path))
        if isinstance(node, ast.ImportFrom) and not node.level
        if (node.module or '').startswith('amr_description.')
        if node.module not in SOURCES
    ]
    assert not absent


def test_files_begin_with_copyright_and_docstring():
    wrong = [
        where(path)
        for path in own_python_files()
        if path.read_text().splitlines()[:2] != HEADER or not has_docstring(path)
    ]
    assert wrong == []


def has_docstring(path: Path) -> bool:
    """Whether the first statement is a string with words; the others are not looked at."""
    with path.open() as file:
        tokens = tokenize.generate_tokens(file.readline)
        code = (each for each in tokens if each.type not in (tokenize.COMMENT, tokenize.NL))
        first, second = next(code), next(code, None)
        return (
            first.type == tokenize.STRING
            and second.type == tokenize.NEWLINE
            and bool(ast.literal_eval(first.string).strip())
        )


@pytest.mark.parametrize(
    ('text', 'expected'),
    [
        ('# a\n\n"""Words.\n\nMore.\n"""\nimport a\n', True),
        ("r'words'", True),
        ('', False),
        ('# a\nimport a\n"""Words."""\n', False),
        ("'' # nothing\n", False),
        ("'words'.split()\n", False),
    ],
)
def test_a_docstring_comes_first(tmp_path, text, expected):
    (tmp_path / 'a.py').write_text(text)
    assert has_docstring(tmp_path / 'a.py') is expected


def test_files_and_functions_stay_readable():
    too_long = []
    for path in own_python_files():
        if path.is_relative_to(ROOT / 'test'):
            continue
        if path.read_text().count('\n') > MOST_LINES_OF_A_FILE:
            too_long.append(where(path))
        too_long += [
            f'{where(path, node.lineno)}: {node.name}'
            for node in statements(tree_of(path))
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)
            and node.end_lineno - node.lineno >= MOST_LINES_OF_A_FUNCTION
        ]
    assert too_long == []


def test_the_map_for_contributors_has_every_room():
    rooms = {path.parent.name for path in PACKAGE.glob('*/__init__.py')}
    named = (ROOT / 'CONTRIBUTING.md').read_text().partition('## Where things are')[2]
    assert {room for room in rooms if f'`{room}/`' not in named} == set()


PACKAGES = [path.parent for path in SOURCES.values() if path.stem == '__init__']
# Folders whose modules are verbs or executables: their table is the one that the program reads.
WITH_A_TABLE_OF_THEIR_OWN = {'cli', 'nodes', 'stacks'}


def has_module_table(folder: Path) -> bool:
    relative = folder.relative_to(PACKAGE).parts
    modules = [path for path in folder.glob('*.py') if not path.stem.startswith('__')]
    return len(modules) > 2 and not set(relative) & WITH_A_TABLE_OF_THEIR_OWN


@pytest.mark.parametrize(
    'folder', [*filter(has_module_table, PACKAGES)], ids=lambda folder: folder.name
)
def test_each_module_is_named_once_in_the_table_of_its_package(folder):
    table = ast.get_docstring(ast.parse((folder / '__init__.py').read_text())) or ''
    named = re.findall(r'^``([a-z0-9_]+)(?:\.py|/)``', table, re.MULTILINE)
    modules = {path.stem for path in folder.glob('*.py')} - {'__init__', '__main__'}
    packages = {path.parent.name for path in folder.glob('*/__init__.py')}
    assert sorted(named) == sorted(modules | packages)


def test_standard_library_only_at_the_entry():
    """The way into every executable must cost nothing before Ctrl-C is quiet."""
    wrong = [
        f'{where(path, line)}: {name}'
        for module, path, line, name in imports()
        if module == 'amr_description.entry'
        and name.split('.')[0] not in {*sys.stdlib_module_names, 'amr_description'}
    ]
    assert wrong == []


@cache
def code_lines(path: Path) -> int:
    """Return how many lines of a file hold code: no comment, docstring or blank one."""
    docstrings = {
        line
        for node in ast.walk(tree_of(path))
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)
        for line in range(node.lineno, node.end_lineno + 1)
        if isinstance(node.value.value, str)
    }
    lines = {
        number
        for number, line in enumerate(path.read_text().splitlines(), start=1)
        if line.strip() and not line.lstrip().startswith('#')
    }
    return len(lines - docstrings)


def small_modules_of_one_importer() -> list[str]:
    """Return those that are half of their importer, which is in the same folder."""
    importers: dict[str, set[str]] = {}
    for module, _, _, name in own_imports():
        if name != module:
            importers.setdefault(name, set()).add(module)
    return [
        module
        for module, path in SOURCES.items()
        if path.stem != '__init__'
        and len(found := importers.get(module, ())) == 1
        and next(iter(found)).rpartition('.')[0] == module.rpartition('.')[0]
        and code_lines(path) < FEW_LINES
    ]


def class_names_used_twice() -> list[str]:
    names = Counter(
        node.name
        for path in SOURCES.values()
        for node in ast.walk(tree_of(path))
        if isinstance(node, ast.ClassDef)
    )
    return [name for name, count in names.items() if count > 1]


def modules_excused_from_a_check_of_types() -> set[str]:
    """Return those of ours that mypy.ini allows what it allows no others."""
    sections = re.findall(r'^\[mypy-(.*)\]$', (ROOT / 'mypy.ini').read_text(), re.MULTILINE)
    names = {name for section in sections for name in section.split(',')}
    return {name for name in names if name.startswith('amr_description.')}


def public_names(path: Path) -> list[str]:
    """Return the classes and functions of a module that others may use."""
    nodes = tree_of(path).body
    kinds = (ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)
    return [each.name for each in nodes if isinstance(each, kinds) and each.name[0] != '_']


def helper_lines(path: Path) -> int:
    """Return how many lines of code a test file has besides its tests and imports."""
    taken = {
        line
        for node in tree_of(path).body
        if isinstance(node, ast.Import | ast.ImportFrom)
        or getattr(node, 'name', '').startswith(('test_', 'Test'))
        for line in range(node.lineno, node.end_lineno + 1)
    }
    return max(0, code_lines(path) - len(taken))


def test_the_house_grows_no_heavier_than_its_budgets():
    """By the same measures as the plan of the house; -s shows the table."""
    tests = [*(ROOT / 'test').rglob('test_*.py')]
    measured = {
        'modules': len(SOURCES),
        'code lines': sum(map(code_lines, SOURCES.values())),
        'small modules of one importer beside them': len(small_modules_of_one_importer()),
        'class names used twice': len(class_names_used_twice()),
        'modules excused from a check of types': len(modules_excused_from_a_check_of_types()),
        'modules with many public names': sum(
            len(public_names(path)) > MOST_PUBLIC_NAMES for path in SOURCES.values()
        ),
        'code lines of helpers in test files': sum(map(helper_lines, tests)),
    }
    for name, value in measured.items():
        print(f'{name:45} {value:6} of {BUDGETS[name]}')
    over = {name: value for name, value in measured.items() if value > BUDGETS[name]}
    assert over == {}
