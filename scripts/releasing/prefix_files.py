# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What a virtual environment needs beside the modules of this package, so that it is a ROS prefix.

``scripts/setup`` writes such files for a checkout (``scripts/environment/launchers.py``, which has
the why). There they name the folders of the checkout; a wheel does not know where it will be
installed, so these find it from their own path.

**Commands** (``bin/``): ``ros2``, ``check_urdf`` and ``bringup`` set up their environment by
themselves, so they need no ``source``.

**Executables** (``lib/amr_description/``): where ``ros2 run`` looks. Installers correct the first
line of scripts in ``bin/`` only, so these start the Python of their prefix by way of the shell.

**Hooks** (``setup.bash`` and its like): those of every ROS prefix, to be sourced by people, and by
the ``setup.bash`` of each workspace that is built on top.

**Tools** (``libexec/``): what colcon starts in place of CMake.

**Modules under their names in ROS, packages of CMake**: those of ``launchers``.
"""

from collections.abc import Iterable
from pathlib import Path

from environment import launchers

PACKAGE = launchers.PACKAGE
LIBRARY = 'lib/python3.*/site-packages'
"""As the shell finds it: a virtual environment has one."""

_BEGIN = """\
#!/bin/sh
# Of the wheel of amr_description: sets up its environment by itself.
_amr_file=$0
[ ! -h "$0" ] || _amr_file=$(readlink -f -- "$0")
_amr_root=$(CDPATH='' cd -- "$(dirname -- "$_amr_file")/.." && pwd -P) || exit
_amr_prefix=$_amr_root
. "$_amr_prefix/local_setup.sh"
_amr_libraries=$_amr_root/lib
for _amr_file in "$_amr_root"/{library}/ros_*.libs; do
    _amr_libraries=$_amr_libraries:$_amr_file
done
export _ROS_WHEELS_BOOTSTRAP_COMPLETE=1
export LD_LIBRARY_PATH="$_amr_libraries${{LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}}"
"""
_ROOT_OF_TOOL = """\
_amr_root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd -P) || exit
for _amr_library in "$_amr_root"/{library}; do :; done
"""
_COMMAND = """\
exec "$_amr_root/bin/python" -P -c '{imports}
import amr_description.cli.__main__' {command} "$@"
"""
_BRINGUP = """\
exec "$_amr_root/bin/python" "$_amr_root/lib/amr_description/bringup" "$@"
"""

# The shell reads the second line and is replaced by Python, to which it is part of a string;
# amr_description/bringup/environment.py knows that line.
_EXECUTABLE = """\
#!/bin/sh
'''exec' "${{0%/*}}/../../bin/python" "$0" "$@"
'''
{imports}
from {module} import {name}

sys.exit({name}{attributes}())
"""
# A workspace may have a package of the same name, in front on PYTHONPATH. The folder does not stay
# in front: modules of the standard library would be looked for among all packages first.
_IMPORTS = """\
import sys

sys.path.insert(0, "%s/lib/python%d.%d/site-packages" % (sys.prefix, *sys.version_info[:2]))
import amr_description

del sys.path[0]"""

_LOCAL_SETUP_SH = """\
# Of the wheel of amr_description: this virtual environment as a ROS prefix. bash and zsh know
# where it is; another shell is told by the setup.sh of a workspace.
_amr_prefix=${{_amr_prefix:-${{COLCON_CURRENT_PREFIX-}}}}
if [ -z "$_amr_prefix" ]; then
    echo 'setup.sh cannot tell its own folder in this shell; in bash: source setup.bash' >&2
    return 1
fi
{exports}unset _amr_prefix
"""
_LOCAL_SETUP = """\
# Of the wheel of amr_description.
_amr_prefix=$(CDPATH='' cd -- "$(dirname -- "{file}")" >/dev/null && pwd -P)
. "$_amr_prefix/local_setup.sh"
"""
_SETUP = """\
# Of the wheel of amr_description: source this as you would that of /opt/ros/jazzy.
_amr_root=$(CDPATH='' cd -- "$(dirname -- "{file}")" >/dev/null && pwd -P)
. "$_amr_root/local_setup.{shell}"
case $- in
    *i*) # Tab completes the words of ros2, in a shell that somebody types into.
{complete}        ;;
esac
unset _amr_root
"""
_FILE = {'bash': '${BASH_SOURCE[0]}', 'zsh': '${(%):-%x}'}
# bash asks argcomplete at the first Tab, not in each shell that is opened; 124: look again how.
_COMPLETE = {
    'bash': """\
        printf -v _amr_python %q "$_amr_root/bin/python"
        eval "_python_argcomplete_at_first_tab() {
            local text
            text=\\$(_ROS_WHEELS_BOOTSTRAP_COMPLETE=1 $_amr_python -P \\
                -m argcomplete.scripts.register_python_argcomplete ros2) &&
                eval \\"\\$text\\" && return 124
        }"
        complete -o nospace -o default -o bashdefault -F _python_argcomplete_at_first_tab ros2
        unset _amr_python
""",
    'zsh': """\
        command -v compdef >/dev/null || { autoload -Uz compinit && compinit -i -D; }
        eval "$(_ROS_WHEELS_BOOTSTRAP_COMPLETE=1 "$_amr_root/bin/python" -P \\
            -m argcomplete.scripts.register_python_argcomplete ros2)"
""",
}

_MODULE = """\
# Of the wheel of amr_description: the module of this name is that of amr_description here.
import os

import amr_description as _package

# A workspace may have a package of that name, in front on PYTHONPATH: this is found behind it.
_modules = os.path.join(os.path.abspath(__file__ + {up!r}), 'amr_description')
if _modules not in _package.__path__:
    _package.__path__.append(_modules)
from amr_description.{ours} import *  # noqa: E402, F403
"""

_LAUNCH_MODULE = _MODULE.replace(
    'from amr_description.{ours} import *  # noqa: E402, F403\n',
    'from amr_description.launch_api.modules import provide  # noqa: E402\n\nprovide(__name__)\n',
)


def commands() -> dict[str, str]:
    """Return the text of each command, by its name in ``bin/``."""
    begin = _BEGIN.format(library=LIBRARY)
    found = {
        name: begin + _COMMAND.format(imports=_IMPORTS, command=name)
        for name in launchers.COMMANDS
    }
    return {**found, 'bringup': begin + _BRINGUP}


def tools() -> dict[str, str]:
    """Return the text of what other programs start, by its path in the prefix."""
    cmake = launchers.CMAKE.format(
        python='"$_amr_root/bin/python"',
        code=launchers.CMAKE_CODE,
        build='"$_amr_library"',
        cmake='"$_amr_library/cmake/data/bin/cmake"',
    )
    first, _, rest = cmake.partition('\n')
    root = _ROOT_OF_TOOL.format(library=LIBRARY)
    return {str(launchers.COLCONS_CMAKE): f'{first}\n{root}{rest}'}


def executables(entry_points: Iterable[str]) -> dict[str, str]:
    """
    Return the text of each executable, by its name in ``lib/amr_description/``.

    Args:
        entry_points: ``talker = amr_description.entry:nodes.talker.main``.
    """
    found = {}
    for line in entry_points:
        script, _, entry_point = (part.strip() for part in line.partition('='))
        module, _, path = entry_point.partition(':')
        name, dot, attributes = path.partition('.')
        found[script] = _EXECUTABLE.format(
            imports=_IMPORTS,
            module=module,
            name=name,
            attributes=dot + attributes,
        )
    return found


def hooks() -> dict[str, str]:
    """Return the text of each hook, by its name in the prefix."""
    _, _, exports = launchers.LOCAL_SETUP.partition('\n')
    exports = exports.format(venv='"$_amr_prefix"', bin='"$_amr_prefix/bin"')
    text = _LOCAL_SETUP_SH.format(exports=exports)
    found = dict.fromkeys(('setup.sh', 'local_setup.sh'), text)
    for shell, file in _FILE.items():
        complete = _COMPLETE[shell]
        found[f'setup.{shell}'] = _SETUP.format(file=file, shell=shell, complete=complete)
        found[f'local_setup.{shell}'] = _LOCAL_SETUP.format(file=file)
    return found


def cmake_packages() -> dict[str, str]:
    """Return the text of each file of a package of CMake, by its path in the prefix."""
    files = launchers.cmake_packages(Path('prefix'))
    return {str(path.relative_to('prefix')): text for path, text in files.items()}


def stand_ins(table: str, *, programs: bool) -> dict[str, str]:
    """
    Return the text of what stands in for packages, by its path in the prefix.

    Args:
        table: The text of ``stand_ins.py``.
        programs: Whether to return executables, or else what is none.
    """
    ours = f'"$(dirname -- "$0")"/../{PACKAGE}/{{name}}'
    files = launchers.stand_ins(table, ours)
    return {
        str(path): text for path, text in files.items() if (path.parts[0] == 'lib') == programs
    }


def modules() -> dict[str, str]:
    """Return the text of each module under its name in ROS, by its path in site-packages."""
    found = {path: text for path, text in launchers.MARKER.items() if '.dist-info/' not in path}
    for name, ours in launchers.MODULES.items():
        path = launchers.module_path(name)
        up = '/..' * (path.count('/') + 1)
        found[path] = _MODULE.format(up=up, ours=ours) if ours else ''
    for name in launchers.LAUNCH_MODULES:
        found[launchers.module_path(name)] = _LAUNCH_MODULE.format(up='/../..')
    return found


def plugins() -> str:
    """Return the entry points that those modules have, for the metadata of the wheel."""
    return '\n'.join(
        text for path, text in launchers.MARKER.items() if path.endswith('/entry_points.txt')
    )
