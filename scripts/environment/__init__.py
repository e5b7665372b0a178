# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The pip underlay: make the environment that this checkout runs in, and keep it up to date.

The standard library only: nothing is installed yet when this runs. ``scripts/setup``
finds the Python and starts :mod:`.main`, which goes through the parts in this order:

============================  =====================================================================
:mod:`.host`                  can the wheels run here; which foreign ROS or conda is in the way
:mod:`.preflight`             what would keep a set-up from its end: rights, disk, home, network
:mod:`.checkout`              where everything is; the lock that keeps two set-ups apart
:mod:`.stamps`                what was made of what: content hashes, written last
:mod:`.locks`                 which version of each package, for each Python, and its hashes
:mod:`.debian`                what a bare Debian or Ubuntu lacks, fetched by apt without root
:mod:`.virtual_environment`   ``.venv`` with exactly the versions of ``requirements.lock``
:mod:`.interface_wheel`       ``interfaces/`` as a wheel, cached for the user by content
:mod:`.commands`              the programs that do the work, how far they are, why they failed
:mod:`.launchers`             what ``.venv`` gets beside packages: ros2, hooks, ``import tf2_ros``
:mod:`.workspace`             ``colcon build --symlink-install``
============================  =====================================================================

Each part can be interrupted: it removes its stamp, works (under another name where others may be
using the result), and writes the stamp last.
"""

import sys
import time

_START = time.monotonic()
program = 'scripts/setup'
"""Who speaks. A script that uses these modules for something else puts its own name here."""


class SetupError(Exception):
    """The environment cannot be made; ``str(error)`` says what was found and what would do."""


def say(text: str) -> None:
    """Tell the person in front of it, on standard error, one line."""
    print(f'{program}: {text}', file=sys.stderr, flush=True)


def progress(text: str) -> None:
    """Tell what is being done, with the seconds since the start."""
    say(f'[{time.monotonic() - _START:3.0f} s] {text}')
