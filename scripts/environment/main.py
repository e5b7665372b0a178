# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The order of things: what is up to date costs a hash, the rest is made anew."""

from collections.abc import Mapping
import os
from pathlib import Path
import platform
import sys
import time

from . import (
    checkout as checkouts,
    host,
    interface_wheel,
    launchers,
    say,
    SetupError,
    stamps,
    virtual_environment,
    workspace,
)

FAILED, INTERRUPTED = 1, 130


def set_up(checkout: checkouts.Checkout, environment: Mapping[str, str]) -> bool:
    """Bring the checkout up to date; say whether there was anything to do."""
    lock, interfaces = checkout.requirements, checkout.interfaces
    cache = checkouts.cache_folder(environment)
    environment_key = stamps.digest(
        str(checkout.root),
        os.path.realpath(sys.base_prefix),
        platform.python_version(),
        lock.read_bytes(),
    )
    interfaces_key = interface_wheel.key(interfaces, lock)
    workspace_key = workspace.key(checkout)
    installed = checkouts.stamp(checkout.venv, 'environment')
    compiled = checkouts.stamp(checkout.venv, 'interfaces')
    built = checkouts.stamp(workspace.stamp_folder(checkout), 'workspace')
    busy = False

    if not installed.holds(environment_key) or not _starts(checkout.venv):
        busy = True
        fresh = checkout.venv.with_name('.venv.new')
        virtual_environment.create(fresh, lock, environment)
        interface_wheel.install(interfaces, lock, fresh, cache, environment)
        virtual_environment.relocate(fresh, checkout.venv)
        launchers.write(fresh, checkout.venv, checkout.build)
        checkouts.stamp(fresh, 'environment').write(environment_key)
        checkouts.stamp(fresh, 'interfaces').write(interfaces_key)
        virtual_environment.replace(checkout.venv, fresh)
    elif not compiled.holds(interfaces_key):
        busy = True
        compiled.remove()
        interface_wheel.install(interfaces, lock, checkout.venv, cache, environment)
        compiled.write(interfaces_key)
    launchers.write(checkout.venv, checkout.venv, checkout.build)
    if not built.holds(workspace_key) or not workspace.is_complete(checkout):
        busy = True
        built.remove()
        workspace.build(checkout, environment)
        built.write(workspace_key)
    return busy


def _starts(venv: Path) -> bool:
    """Say whether the interpreter that ``venv`` links to is still there."""
    return virtual_environment.python_of(venv).exists()


def main(arguments: list[str], environment: Mapping[str, str] = os.environ) -> int:
    """Run ``scripts/setup``; return its exit code."""
    if arguments:
        say(f'takes no arguments, got {" ".join(arguments)}; it makes .venv, install/ and build/')
        return 0 if arguments[0] in ('-h', '--help') else 2
    start = time.monotonic()
    checkout = checkouts.Checkout(Path(__file__).resolve().parents[2])
    try:
        host.check_host()
        checkout.check()
        with checkouts.one_at_a_time(checkout):
            busy = set_up(checkout, host.clean_environment(environment))
    except (SetupError, OSError) as error:  # the latter: disk full, not ours to write
        say(f'error: {error}')
        return FAILED
    except KeyboardInterrupt:
        say('interrupted; run it again to go on')
        return INTERRUPTED
    if busy:
        ignored = host.foreign_settings(environment)
        if ignored:
            say(f'left aside, as it uses the ROS of PyPI: {", ".join(ignored)}')
        say(f'done in {time.monotonic() - start:.0f} s; next: source scripts/activate')
    return 0
