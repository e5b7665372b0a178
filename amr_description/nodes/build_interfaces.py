# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``build_interfaces``: a wheel of the messages, services and actions of packages, without colcon.

::

    ros2 run amr_description build_interfaces my_msgs
    python -m pip install my_msgs-0.0.0-*.whl

Their types have the hashes (RIHS01) that any ROS 2 Jazzy gives them.

Exit codes: 0; 1 a package cannot be built, with a line ``path:line:column: ...`` for each fault; 2
wrong arguments; 3 no compiler.
"""

import argparse
from pathlib import Path
import sys

from amr_description.errors import InterfaceBuildError
from amr_description.interface_build.wheel import build_wheel


def parser() -> argparse.ArgumentParser:
    """Return the parser of the command line."""
    options = argparse.ArgumentParser(
        prog='build_interfaces',
        description='Build the messages, services and actions of a package, or of all packages '
        'below a folder, into one wheel.',
        epilog='Exit code: 0; 1 a package cannot be built; 2 wrong arguments; 3 no compiler.',
        allow_abbrev=False,
    )
    add = options.add_argument
    add('folder', metavar='DIR', type=Path, help='a package, or a folder that holds packages')
    add('--output', metavar='DIR', type=Path, default=Path(),
        help='the folder for the wheel (default: this folder)')  # fmt: skip
    add('--name', metavar='NAME', default='',
        help='of the wheel (default: that of the package; of several: that of DIR)')  # fmt: skip
    return options


def main(args: list[str] | None = None) -> int:
    """Run the executable; return its exit code."""
    options = parser().parse_args(sys.argv[1:] if args is None else args)
    if not options.folder.is_dir():
        parser().error(f'{options.folder}: no such folder')
    try:
        wheel = build_wheel(options.folder, options.output, options.name)
    except InterfaceBuildError as error:
        print(error, file=sys.stderr)
        return error.exit_code
    except OSError as error:
        print(f'build_interfaces: {error.filename}: {error.strerror}', file=sys.stderr)
        return 1
    print(f'{wheel}: install it with python -m pip install {wheel}')
    return 0


if __name__ == '__main__':
    sys.exit(main())
