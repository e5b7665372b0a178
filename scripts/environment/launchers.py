# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What ``.venv`` gets beside its packages: commands, and the hooks every ROS prefix has.

**Commands.** colcon puts executables into ``lib/<package>``, where ``ros2 run`` looks; ``ros2``,
``check_urdf`` and ``bringup`` must be on the PATH. ``bringup`` is that executable. The others are
shell scripts of two lines that start our Python with the wheels' libraries on LD_LIBRARY_PATH, and
say so to ``ros_wheels_bootstrapper``: that would otherwise start Python a second time, for every
command (25 ms of 60, more when cold).

Only the scripts set these two, never the shell: exported, the path would make foreign programs
load our libraries, and the mark would keep another environment's wheels from finding theirs. What
the commands start inherits both; ``ros2 run`` takes them away again from foreign executables.

**Hooks.** ``local_setup.*`` puts the environment in front of PATH and AMENT_PREFIX_PATH. colcon
chains it into each workspace that is built on top, the same as it does with ``/opt/ros/jazzy``.
CMake builds with Ninja, which is here, unless CMAKE_GENERATOR says otherwise: not all have make.
colcon starts it by way of amr_description/workspace/cmake.py (CMAKE_COMMAND): that tells why it
failed.
Such a shell keeps to this host as one of ``scripts/activate`` does: with the range of the subnet,
which is the default of ROS, others would see its nodes, and a publisher that sends once, as
``ros2 topic pub --once``, would not reach a robot that keeps to this host.

**Path file.** ``amr_description.pth`` makes the package importable by ``.venv/bin/python`` in any
shell; it names colcon's build folder, where the package's metadata are too.

**Modules under their names in ROS.** PyPI has no tf2_ros, tf2_geometry_msgs, tf2_sensor_msgs,
message_filters, sensor_msgs_py, nav2_simple_commander, cv_bridge and others. Nodes and tests that
import them get those of this package, under the names of the originals' modules. ``launch`` and
``launch_ros`` are there for programs that are no launch files: tests, by launch_testing.

**Hints.** A program that ends as it does not find a module of ROS says what would do.

**Packages in the index.** What ``ros2 run`` and launch files of ours start in place of packages
that are not installed, genuine ones find too: an entry of the ament index, ``package.xml`` and
``lib/<package>/<executable>``. A workspace's own package of that name comes first.

**Packages of CMake.** Of those that PyPI has not, ``cmake/`` holds what packages of users ask for.
"""

import ast
import os
from pathlib import Path
import shlex

from . import stamps
from .checkout import Checkout, PACKAGE
from .virtual_environment import site_packages

CMAKE_PACKAGES = Path(__file__).with_name('cmake')
COLCONS_CMAKE = Path('libexec/amr_description/cmake')
EXECUTABLE = ('bin', COLCONS_CMAKE.parent.name)  # the names of their folders
COMMANDS = ('ros2', 'check_urdf', 'launch_test')
HOME = Path('.setup/home')
"""Where the environment is to lie; ``scripts/activate`` sees by it that it was moved."""

COMMAND = """\
#!/bin/sh
_ROS_WHEELS_BOOTSTRAP_COMPLETE=1 \
LD_LIBRARY_PATH={libraries}"${{LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}}" \
exec {python} -P -c {code} {command} "$@"
"""

# What colcon starts instead of CMake. Without site-packages: three times as quick.
CMAKE = """\
#!/bin/sh
exec {python} -I -S -c {code} {build} {cmake} "$@"
"""
CMAKE_CODE = (
    "'import sys; sys.path.insert(0, sys.argv[1]); "
    'from amr_description.workspace.cmake import main; '
    "sys.exit(main(sys.argv[2], sys.argv[3:]))'"
)

BRINGUP = """\
#!/bin/sh
exec {install}/lib/amr_description/bringup "$@"
"""

# A workspace may have a package of the same name, in front on PYTHONPATH.
CODE = 'import sys; sys.path.insert(0, {build!r}); import amr_description.cli.__main__'

# Modules under their names in ROS, and ours that each stands for; none: it is empty.
MODULES = {
    'ament_copyright': None,
    'ament_copyright.main': 'ament_copyright.main',
    'colcon_amr_description': 'workspace.colcon',
    'controller_manager': None,
    'controller_manager.launch_utils': 'launch_api.controller_spawners',
    'cv_bridge': 'ros_packages.cv_bridge',
    'diagnostic_updater': 'ros_packages.diagnostic_updater',
    'image_geometry': 'ros_packages.image_geometry',
    'image_geometry.cameramodels': 'ros_packages.image_geometry',
    'interactive_markers': 'ros_packages.interactive_markers',
    'interactive_markers.interactive_marker_server': 'ros_packages.interactive_markers',
    'interactive_markers.menu_handler': 'ros_packages.interactive_markers',
    'laser_geometry': 'ros_packages.laser_geometry',
    'launch_pytest': 'launch_testing.pytest_plugin',
    'launch_pytest.actions': 'launch_testing.actions',
    'launch_pytest.plugin': 'launch_testing.pytest_plugin',
    'launch_pytest.tools': 'launch_testing.tools',
    'launch_pytest.tools.process': 'launch_testing.tools',
    'launch_testing': 'launch_testing',
    'launch_testing.actions': 'launch_testing.actions',
    'launch_testing.asserts': 'launch_testing.asserts',
    'launch_testing.event_handlers': 'launch_testing.actions',
    'launch_testing.io_handler': 'launch_testing.handlers',
    'launch_testing.launch_test': 'launch_testing.command',
    'launch_testing.markers': 'launch_testing.markers',
    'launch_testing.proc_info_handler': 'launch_testing.handlers',
    'launch_testing.pytest': None,
    'launch_testing.pytest.hooks': 'launch_testing.pytest_items',
    'launch_testing.tools': 'launch_testing.tools',
    'launch_testing.util': 'launch_testing.util',
    'launch_testing_ros': 'ros_packages.launch_testing_ros',
    'launch_testing_ros.tools': 'ros_packages.launch_testing_ros',
    'message_filters': 'message_filters',
    'nav2_simple_commander': None,
    'nav2_simple_commander.costmap_2d': 'nav2_simple_commander.costmap_2d',
    'nav2_simple_commander.footprint_collision_checker': (
        'nav2_simple_commander.footprint_collision_checker'
    ),
    'nav2_simple_commander.line_iterator': 'nav2_simple_commander.line_iterator',
    'nav2_simple_commander.robot_navigator': 'nav2_simple_commander.robot_navigator',
    'ros2action': None,
    'ros2action.api': 'ros_packages.ros2_api',
    'ros2cli': None,
    'ros2cli.node': 'ros_packages.ros2_api',
    'ros2cli.node.direct': 'ros_packages.ros2_api',
    'ros2cli.node.strategy': 'ros_packages.ros2_api',
    'ros2node': None,
    'ros2node.api': 'ros_packages.ros2_api',
    'ros2param': None,
    'ros2param.api': 'ros_packages.ros2_api',
    'ros2pkg': None,
    'ros2pkg.api': 'ros_packages.ros2_api',
    'ros2service': None,
    'ros2service.api': 'ros_packages.ros2_api',
    'ros2topic': None,
    'ros2topic.api': 'ros_packages.ros2_api',
    'rosbag2_py': 'ros_packages.rosbag2_py',
    'rosbag2_py._storage': 'ros_packages.rosbag2_py',
    'rosidl_runtime_py': 'ros_packages.rosidl_runtime_py',
    'rosidl_runtime_py.convert': 'ros_packages.rosidl_runtime_py',
    'rosidl_runtime_py.get_interfaces': 'ros_packages.rosidl_runtime_py',
    'rosidl_runtime_py.import_message': 'ros_packages.rosidl_runtime_py',
    'rosidl_runtime_py.set_message': 'ros_packages.rosidl_runtime_py',
    'rosidl_runtime_py.utilities': 'ros_packages.rosidl_runtime_py',
    'sensor_msgs_py': None,
    'sensor_msgs_py.numpy_compat': 'sensor_msgs_py.numpy_compat',
    'sensor_msgs_py.point_cloud2': 'sensor_msgs_py.point_cloud2',
    'tf2_geometry_msgs': 'tf2_ros.geometry',
    'tf2_geometry_msgs.tf2_geometry_msgs': 'tf2_ros.geometry',
    'tf2_py': 'tf2_ros.core',
    'tf2_ros': 'tf2_ros',
    'tf2_ros.buffer': 'tf2_ros.buffer',
    'tf2_ros.buffer_client': 'tf2_ros.buffer_client',
    'tf2_ros.buffer_interface': 'tf2_ros.buffer_interface',
    'tf2_ros.buffer_server': 'tf2_ros.buffer_server',
    'tf2_ros.static_transform_broadcaster': 'tf2_ros.broadcaster',
    'tf2_ros.transform_broadcaster': 'tf2_ros.broadcaster',
    'tf2_ros.transform_listener': 'tf2_ros.listener',
    'tf2_sensor_msgs': 'tf2_ros.clouds',
    'tf2_sensor_msgs.tf2_sensor_msgs': 'tf2_ros.clouds',
    'tf_transformations': 'ros_packages.tf_transformations',
    'turtlebot4_navigation': None,
    'turtlebot4_navigation.turtlebot4_navigator': 'nav2_simple_commander.turtlebot4_navigator',
    'urdf_parser_py': None,
    'urdf_parser_py.urdf': 'ros_packages.urdf_parser_py',
}
MODULE = """\
# Written by scripts/setup: the module of this name is that of amr_description here.
import amr_description as _package

# A workspace may have a package of that name, in front on PYTHONPATH: this is found behind it.
if {modules!r} not in _package.__path__:
    _package.__path__.append({modules!r})
from amr_description.{ours} import *  # noqa: E402, F403
"""
# What launch files import, for programs that are none: tests of launch files, launch_testing.
LAUNCH_MODULES = ('launch', 'launch_ros', 'launch_xml', 'launch_yaml', 'nav2_common')
LAUNCH_MODULE = """\
# Written by scripts/setup: launch files find the modules of amr_description under this name.
import amr_description as _package

if {modules!r} not in _package.__path__:
    _package.__path__.append({modules!r})
from amr_description.launch_api.modules import provide  # noqa: E402

provide(__name__)
"""
# pytest loads this before it knows the paths of a user's package, which may be called as ours is:
# nothing of ours is imported here.
MARKER = {
    'ament_copyright/pytest_marker.py': """\
# Written by scripts/setup: the marker of test/test_copyright.py.
def pytest_configure(config):
    config.addinivalue_line('markers', 'copyright: marks tests checking for copyright notices')
""",
    'ament_copyright-0.dist-info/METADATA': """\
Metadata-Version: 2.1
Name: ament-copyright
Version: 0
Summary: Written by scripts/setup: that of amr_description
""",
    'ament_copyright-0.dist-info/entry_points.txt': """\
[pytest11]
ament_copyright = ament_copyright.pytest_marker
launch_pytest = _amr_launch_pytest
launch_testing = _amr_launch_testing
""",
    '_amr_hints.py': """\
# Written by scripts/setup: where a program ends as it does not find a module of ROS, what would do
# is said below the traceback. Who catches the error sees it as it is.
import sys


def _install():
    before = sys.excepthook

    def hook(kind, error, traceback):
        name = getattr(error, 'name', None)
        if isinstance(error, ModuleNotFoundError) and name:
            try:
                from amr_description.stand_ins import hint_of_module

                hint = hint_of_module(name)
            except Exception:
                hint = ''
            if hint:
                error.add_note(f"amr_description: no module '{name}': {hint}")
        before(kind, error, traceback)

    sys.excepthook = hook


_install()
""",
    '_amr_hints.pth': 'import _amr_hints\n',
    '_amr_launch_testing.py': """\
# Written by scripts/setup: the plugin of launch_testing, loaded at the first file that needs it.
# Where a workspace has the genuine one, pytest takes that in place of this.
def pytest_addoption(parser):
    parser.addoption('--launch-args', action='append', nargs='*', default=[],
                     help='One or more Launch test arguments')


def pytest_configure(config):
    for name in ('launch_test', 'rostest'):
        config.addinivalue_line('markers', name + ': marks generate_test_description of a test')


def pytest_pycollect_makemodule(module_path, parent):
    if module_path.name == '__init__.py':
        return None
    if b'generate_test_description' not in module_path.read_bytes():
        return None
    from launch_testing.pytest.hooks import makemodule

    return makemodule(module_path, parent)
""",
    '_amr_launch_pytest.py': """\
# Written by scripts/setup: that of launch_pytest, likewise.
def pytest_configure(config):
    config.addinivalue_line('markers', 'launch(fixture): runs beside what the fixture launches')


def pytest_pycollect_makemodule(module_path, parent):
    plugins = parent.config.pluginmanager
    if plugins.has_plugin('amr_launch_pytest') or b'launch_pytest' not in module_path.read_bytes():
        return None
    import launch_pytest.plugin

    plugins.register(launch_pytest.plugin, 'amr_launch_pytest')
""",
    'colcon_amr_description-0.dist-info/METADATA': """\
Metadata-Version: 2.1
Name: colcon-amr-description
Version: 0
Summary: Written by scripts/setup: that of amr_description
""",
    'colcon_amr_description-0.dist-info/entry_points.txt': """\
[colcon_core.package_selection]
amr_description = colcon_amr_description:ContinueOnError
""",
}

STAND_INS = Path(PACKAGE, 'stand_ins.py')
STANDS_IN = 'of amr_description'  # as ament_index.py has it
PACKAGE_XML = """\
<?xml version="1.0"?>
<package format="3">
  <name>{package}</name>
  <version>0.0.0</version>
  <description>Written by scripts/setup: what amr_description has in place of it</description>
  <maintainer email="nobody@localhost">amr_description</maintainer>
  <license>Apache-2.0</license>
</package>
"""
STAND_IN = """\
#!/bin/sh
exec {executable} "$@"
"""
_OF_USERS = {'py_pubsub'}  # which the tutorial has them make
_OF_MESSAGES = {'robot_localization'}  # which are in interfaces/, with what makes it a package
_OF_TOOLS = {'ament_copyright', 'colcon_amr_description'}

LOCAL_SETUP = """\
# Written by scripts/setup: this virtual environment as a ROS prefix (the underlay of workspaces).
case ":${{PATH-}}:" in *:{bin}:*) ;; *) export PATH={bin}"${{PATH:+:$PATH}}" ;; esac
case ":${{AMENT_PREFIX_PATH-}}:" in
  *:{venv}:*) ;;
  *) export AMENT_PREFIX_PATH={venv}"${{AMENT_PREFIX_PATH:+:$AMENT_PREFIX_PATH}}" ;;
esac
export ROS_DISTRO=jazzy ROS_VERSION=2 ROS_PYTHON_VERSION=3
export CMAKE_GENERATOR="${{CMAKE_GENERATOR:-Ninja}}"
export CMAKE_COMMAND={venv}/libexec/amr_description/cmake
export ROS_AUTOMATIC_DISCOVERY_RANGE="${{ROS_AUTOMATIC_DISCOVERY_RANGE:-LOCALHOST}}"
"""


def library_path(venv: Path, home: Path) -> str:
    """Return the LD_LIBRARY_PATH of the ROS wheels in ``venv``, once it has moved to ``home``."""
    bundled = sorted(site_packages(venv).glob('ros_*.libs'))
    return os.pathsep.join(
        str(home / folder.relative_to(venv)) for folder in (venv / 'lib', *bundled)
    )


def module_path(name: str) -> str:
    """Return where a module of :data:`MODULES` or :data:`LAUNCH_MODULES` lies in site-packages."""
    is_package = '.' not in name or any(each.startswith(f'{name}.') for each in MODULES)
    return f'{name.replace(".", "/")}{"/__init__" if is_package else ""}.py'


def modules(build: Path) -> dict[str, str]:
    """Return the text of what lies in site-packages, by its path there."""
    found = dict(MARKER)
    for name, ours in MODULES.items():
        found[module_path(name)] = (
            MODULE.format(modules=str(build / PACKAGE), ours=ours) if ours else ''
        )
    for name in LAUNCH_MODULES:
        found[module_path(name)] = LAUNCH_MODULE.format(modules=str(build / PACKAGE))
    return found


def cmake_packages(venv: Path) -> dict[Path, str]:
    """Return the text of each file of the packages of ``cmake/``, by its path in ``venv``."""
    share = venv / 'share'
    found = {}
    for source in sorted(CMAKE_PACKAGES.glob('*/*.cmake')):
        package = source.parent.name
        found[share / package / 'cmake' / source.name] = source.read_text()
        found[share / 'ament_index/resource_index/packages' / package] = ''
    return found


def stand_ins(table: str, executable: str) -> dict[Path, str]:
    """
    Return the text of what programs of others find in place of packages, by its path in a prefix.

    Args:
        table: The text of ``stand_ins.py``.
        executable: The path of an executable of ours, for a shell, with ``{name}`` in it.
    """
    (value,) = (
        each.value
        for each in ast.parse(table).body
        if isinstance(each, ast.Assign) and ast.unparse(each.targets[0]) == 'STAND_INS'
    )
    pairs = {
        pair: ours for pair, ours in ast.literal_eval(value).items() if pair[0] not in _OF_USERS
    }
    found = {}
    imported = {name.partition('.')[0] for name in (*MODULES, *LAUNCH_MODULES)} - _OF_TOOLS
    for package in sorted((imported | {package for package, _ in pairs}) - _OF_MESSAGES):
        found[Path('share/ament_index/resource_index/packages', package)] = STANDS_IN
        found[Path('share', package, 'package.xml')] = PACKAGE_XML.format(package=package)
    for (package, name), ours in pairs.items():
        text = STAND_IN.format(executable=executable.format(name=ours))
        found[Path('lib', package, name)] = text
    return found


def files(venv: Path, home: Path, checkout: Checkout) -> dict[Path, str]:
    """Return the text of each file, by its path in ``venv``, as it has to be at ``home``."""
    build = checkout.build
    python = shlex.quote(str(home / 'bin' / 'python'))
    libraries = shlex.quote(library_path(venv, home))
    code = shlex.quote(CODE.format(build=str(build)))
    local_setup = LOCAL_SETUP.format(
        venv=shlex.quote(str(home)), bin=shlex.quote(str(home / 'bin'))
    )
    packages = site_packages(venv)
    cmake = shlex.quote(str(site_packages(home) / 'cmake/data/bin/cmake'))
    colcons_cmake = CMAKE.format(
        python=python, code=CMAKE_CODE, build=shlex.quote(str(build)), cmake=cmake
    )
    return {
        venv / HOME: f'{home}\n',
        venv / COLCONS_CMAKE: colcons_cmake,
        **{
            venv / 'bin' / command: COMMAND.format(
                command=command, libraries=libraries, python=python, code=code
            )
            for command in COMMANDS
        },
        venv / 'bin' / 'bringup': BRINGUP.format(install=shlex.quote(str(checkout.install))),
        **{venv / f'local_setup.{shell}': local_setup for shell in ('sh', 'bash', 'zsh')},
        **{
            venv / path: text
            for path, text in stand_ins(
                Path(__file__).parents[2].joinpath(STAND_INS).read_text(),
                shlex.quote(str(checkout.install / 'lib' / PACKAGE)) + '/{name}',
            ).items()
        },
        **cmake_packages(venv),
        packages / f'{PACKAGE}.pth': f'{build}\n',
        **{packages / path: text for path, text in modules(build).items()},
    }


def write(venv: Path, home: Path, checkout: Checkout) -> None:
    """Write the files that are not there already, commands with the execute bit."""
    for file, text in files(venv, home, checkout).items():
        if not file.is_file() or file.read_text() != text:
            is_program = file.parent.name in EXECUTABLE or file.parents[1] == venv / 'lib'
            stamps.replace_file(file, text, 0o755 if is_program else 0o644)
