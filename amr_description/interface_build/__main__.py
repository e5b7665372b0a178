# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What builds call: with ``--check``, look for a compiler; else build what CMake asks for.

It is started by its path, as no other Python has to find this package; a workspace may have one of
the same name.
"""

from pathlib import Path
import sys

sys.path.insert(0, str(Path(__file__).absolute().parents[2]))


def main(args: list[str]) -> int:
    """Run the program; return the exit code."""
    if args == ['--check']:
        return check()
    from amr_description.interface_build import cmake_target

    return cmake_target.main(args)


def check() -> int:
    """Say whether there is a compiler that works; return the exit code."""
    from amr_description.errors import InterfaceBuildError
    from amr_description.interface_build import toolchain

    try:
        toolchain.python_headers()
        toolchain.find_toolchain()
    except InterfaceBuildError as error:
        print(f'error: {error}', file=sys.stderr)
        return error.exit_code
    return 0


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
