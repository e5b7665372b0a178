# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What ``scripts/release`` makes of this checkout: two wheels, a lock with hashes, notes.

======================  ===========================================================================
:mod:`.main`            the command line, and the order of things
:mod:`.versions`        which version it is, the same everywhere; its section of the changelog
:mod:`.sources`         what git knows of the checkout, and a copy of it to build in
:mod:`.archives`        wheels, read and written so that the same contents are the same bytes
:mod:`.package_wheel`   this package as two wheels: without ROS, and what makes it one
:mod:`.prefix_files`    what the second brings: commands, executables, hooks
:mod:`.binaries`        which glibc and libstdc++ the compiled interfaces need
:mod:`.locks`           the packages of PyPI, each with the hash of its file
:mod:`.sbom`            the bill of materials, in CycloneDX
======================  ===========================================================================
"""

import sys


class ReleaseError(Exception):
    """Cannot be released as it is; ``str(error)`` says what was found and what would do."""


def say(text: str) -> None:
    """Print one line on standard error."""
    print(f'scripts/release: {text}', file=sys.stderr, flush=True)
