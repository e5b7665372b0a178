# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``python -m interface_build``: build the packages into a tree, or only check the compiler."""

import argparse
from pathlib import Path
import sys
import tempfile

from interface_build import build, BuildError, toolchain


def main() -> int:
    """Run the command line; return the exit code."""
    parser = argparse.ArgumentParser(prog='interface_build', description=__doc__)
    parser.add_argument('--check', action='store_true', help='check the compiler, build nothing')
    parser.add_argument(
        '--source', type=Path, default=Path(__file__).parents[1], help='the folder of the packages'
    )
    parser.add_argument('--stage', type=Path, help='where the built tree goes')
    arguments = parser.parse_args()
    try:
        if arguments.check:
            toolchain.python_headers()
            toolchain.find_toolchain()
        elif arguments.stage is None:
            parser.error('--stage is needed')
        else:
            with tempfile.TemporaryDirectory(prefix='interface_build-') as work:
                build.build(arguments.source.resolve(), arguments.stage.resolve(), Path(work))
    except BuildError as error:
        print(f'error: {error}', file=sys.stderr)
        return error.exit_code
    return 0


if __name__ == '__main__':
    sys.exit(main())
