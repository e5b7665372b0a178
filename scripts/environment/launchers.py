# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What ``.venv`` gets beside its packages: commands, and the hooks every ROS prefix has.

**Commands.** colcon puts executables into ``lib/<package>``, where ``ros2 run`` looks; ``ros2``
and ``check_urdf`` must be on the PATH. Each is a shell script of two lines that starts our Python
with the wheels' libraries on LD_LIBRARY_PATH, and says so to ``ros_wheels_bootstrapper``: that
would otherwise start Python a second time, for every command (25 ms of 60, more when cold).

Only the scripts set these two, never the shell: exported, the path would make foreign programs
load our libraries, and the mark would keep another environment's wheels from finding theirs. What
the commands start inherits both; ``ros2 run`` takes them away again from foreign executables.

**Hooks.** ``local_setup.*`` puts the environment in front of PATH and AMENT_PREFIX_PATH. colcon
chains it into each workspace that is built on top, the same as it does with ``/opt/ros/jazzy``.
Such a shell keeps to this host as one of ``scripts/activate`` does: with the range of the subnet,
which is the default of ROS, others would see its nodes, and a publisher that sends once, as
``ros2 topic pub --once``, would not reach a robot that keeps to this host.

**Path file.** ``amr_description.pth`` makes the package importable by ``.venv/bin/python`` in any
shell; it names colcon's build folder, where the package's metadata are too.

**tf2_ros.** PyPI has none. Nodes that import it get that of this package, under the names of the
original's modules.
"""

import os
from pathlib import Path
import shlex

from . import stamps
from .checkout import PACKAGE

COMMANDS = ('ros2', 'check_urdf')

COMMAND = """\
#!/bin/sh
_ROS_WHEELS_BOOTSTRAP_COMPLETE=1 \
LD_LIBRARY_PATH={libraries}"${{LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}}" \
exec {python} -P -c {code} {command} "$@"
"""

# A workspace may have a package of the same name, in front on PYTHONPATH.
CODE = 'import sys; sys.path.insert(0, {build!r}); import amr_description.cli.__main__'

TF2_ROS = """\
# Written by scripts/setup: tf2_ros is that of amr_description here.
import amr_description

# A workspace may have a package of that name, in front on PYTHONPATH: this is found behind it.
if {modules!r} not in amr_description.__path__:
    amr_description.__path__.append({modules!r})
from amr_description.tf2_ros import *  # noqa: E402, F403
from amr_description.tf2_ros import __all__  # noqa: E402, F401
"""
# Where nodes find a class that they do not import from tf2_ros itself.
TF2_ROS_MODULES = {
    'buffer': ('Buffer',),
    'static_transform_broadcaster': ('StaticTransformBroadcaster',),
    'transform_broadcaster': ('TransformBroadcaster',),
    'transform_listener': ('TransformListener',),
}

LOCAL_SETUP = """\
# Written by scripts/setup: this virtual environment as a ROS prefix (the underlay of workspaces).
case ":${{PATH-}}:" in *:{bin}:*) ;; *) export PATH={bin}"${{PATH:+:$PATH}}" ;; esac
case ":${{AMENT_PREFIX_PATH-}}:" in
  *:{venv}:*) ;;
  *) export AMENT_PREFIX_PATH={venv}"${{AMENT_PREFIX_PATH:+:$AMENT_PREFIX_PATH}}" ;;
esac
export ROS_DISTRO=jazzy ROS_VERSION=2 ROS_PYTHON_VERSION=3
export ROS_AUTOMATIC_DISCOVERY_RANGE="${{ROS_AUTOMATIC_DISCOVERY_RANGE:-LOCALHOST}}"
"""


def library_path(venv: Path, home: Path) -> str:
    """Return the LD_LIBRARY_PATH of the ROS wheels in ``venv``, once it has moved to ``home``."""
    bundled = sorted(venv.glob('lib/python3.12/site-packages/ros_*.libs'))
    return os.pathsep.join(
        str(home / folder.relative_to(venv)) for folder in (venv / 'lib', *bundled)
    )


def tf2_ros(build: Path) -> dict[str, str]:
    """Return the text of each module of the package ``tf2_ros``, by its name."""
    modules = {
        f'{name}.py': f'from tf2_ros import {", ".join(classes)}\n\n__all__ = {list(classes)!r}\n'
        for name, classes in TF2_ROS_MODULES.items()
    }
    return {'__init__.py': TF2_ROS.format(modules=str(build / PACKAGE)), **modules}


def files(venv: Path, home: Path, build: Path) -> dict[Path, str]:
    """Return the text of each file, by its path in ``venv``, as it has to be at ``home``."""
    python = shlex.quote(str(home / 'bin' / 'python'))
    libraries = shlex.quote(library_path(venv, home))
    code = shlex.quote(CODE.format(build=str(build)))
    local_setup = LOCAL_SETUP.format(
        venv=shlex.quote(str(home)), bin=shlex.quote(str(home / 'bin'))
    )
    packages = venv / 'lib/python3.12/site-packages'
    return {
        **{
            venv / 'bin' / command: COMMAND.format(
                command=command, libraries=libraries, python=python, code=code
            )
            for command in COMMANDS
        },
        **{venv / f'local_setup.{shell}': local_setup for shell in ('sh', 'bash', 'zsh')},
        packages / f'{PACKAGE}.pth': f'{build}\n',
        **{packages / 'tf2_ros' / name: text for name, text in tf2_ros(build).items()},
    }


def write(venv: Path, home: Path, build: Path) -> None:
    """Write the files that are not there already, commands with the execute bit."""
    for file, text in files(venv, home, build).items():
        if not file.is_file() or file.read_text() != text:
            stamps.replace_file(file, text, 0o755 if file.parent.name == 'bin' else 0o644)
