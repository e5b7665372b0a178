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
    host,
    interface_wheel,
    launchers,
    preflight,
    say,
    SetupError,
    stamps,
    virtual_environment,
    workspace,
)
from .checkout import cache_folder, Checkout, one_at_a_time, stamp
from .commands import beside

FAILED, INTERRUPTED = 1, 130
INTERFACES = '--interfaces'
"""The argument by which ``scripts/release`` asks for the wheel of another Python."""


def set_up(checkout: Checkout, environment: Mapping[str, str]) -> bool:
    """Bring the checkout up to date; say whether there was anything to do."""
    steps = (update_environment, update_interfaces, update_workspace)
    return any([step(checkout, environment) for step in steps])


def update_environment(checkout: Checkout, environment: Mapping[str, str]) -> bool:
    """Make ``.venv`` anew, interfaces included, if the lock, the Python or the path is another."""
    key = stamps.digest(
        str(checkout.root),
        os.path.realpath(sys.base_prefix),
        platform.python_version(),
        checkout.requirements.read_bytes(),
    )
    stale = not stamp(checkout.venv, 'environment').holds(key) or not _starts(checkout.venv)
    if stale:
        preflight.check_space(checkout.root)
        preflight.check_home(environment)
        preflight.check_hosts(environment)
        say('this takes 1 to 4 minutes, once; a line every ten seconds says where it is')
        fresh = checkout.venv.with_name('.venv.new')
        _make_environment(checkout, fresh, environment)
        _install_interfaces(checkout, fresh, environment)
        virtual_environment.relocate(fresh, checkout.venv)
        launchers.write(fresh, checkout.venv, checkout)
        stamp(fresh, 'environment').write(key)
        virtual_environment.replace(checkout.venv, fresh)
    launchers.write(checkout.venv, checkout.venv, checkout)
    return stale


def _begin_environment(checkout: Checkout, venv: Path, environment: Mapping[str, str]) -> None:
    """Make an environment with what the interfaces are built with."""
    from . import debian

    lock, cache = checkout.requirements, cache_folder(environment)
    lacks, extras = debian.lacking(), debian.Extras(cache)
    extras.fetch(lacks, environment)
    virtual_environment.create(venv, environment, with_pip='pip' not in lacks)
    if 'pip' in lacks:
        extras.install_pip(venv, environment)
    if 'Python.h' in lacks:
        extras.copy_headers(venv / 'include' / debian.VERSION)
    virtual_environment.begin(venv, lock, environment, interface_wheel.NEEDED_TO_BUILD)


def _make_environment(checkout: Checkout, venv: Path, environment: Mapping[str, str]) -> None:
    """Install all packages, and build the interfaces meanwhile, which takes longer."""
    lock, cache = checkout.requirements, cache_folder(environment)
    _begin_environment(checkout, venv, environment)
    with beside(lambda: interface_wheel.built(checkout, venv, cache, environment)):
        virtual_environment.complete(venv, lock, environment)


def interfaces_of_this_python(checkout: Checkout, environment: Mapping[str, str]) -> Path:
    """Return the wheel of the interfaces, in the cache or built there by a ``.venv`` apart."""
    import tempfile

    cache = cache_folder(environment)
    with tempfile.TemporaryDirectory(prefix='amr-release-') as scratch:
        venv = Path(scratch, '.venv')
        _begin_environment(checkout, venv, environment)
        return interface_wheel.built(checkout, venv, cache, environment)


def update_interfaces(checkout: Checkout, environment: Mapping[str, str]) -> bool:
    """Install the interface packages if their sources, or what they are built with, changed."""
    key = interface_wheel.key(checkout)
    if stamp(checkout.venv, 'interfaces').holds(key):
        return False
    _install_interfaces(checkout, checkout.venv, environment)
    return True


def _install_interfaces(checkout: Checkout, venv: Path, environment: Mapping[str, str]) -> None:
    installed = stamp(venv, 'interfaces')
    installed.remove()
    interface_wheel.install(checkout, venv, cache_folder(environment), environment)
    installed.write(interface_wheel.key(checkout))


def update_workspace(checkout: Checkout, environment: Mapping[str, str]) -> bool:
    """Build the package if what the build looks at changed, or what it made is gone."""
    key = workspace.key(checkout)
    built = stamp(workspace.stamp_folder(checkout), 'workspace')
    finished = built.exists() and workspace.is_complete(checkout)
    if finished and built.holds(key):
        return False
    built.remove()
    workspace.build(checkout, environment, on_top=finished)
    built.write(key)
    return True


def _starts(venv: Path) -> bool:
    """Say whether the interpreter that ``venv`` links to is still there."""
    return virtual_environment.python_of(venv).exists()


def main(arguments: list[str], environment: Mapping[str, str] = os.environ) -> int:
    """Run ``scripts/setup``; return its exit code."""
    if arguments not in ([], [INTERFACES]):
        say(f'takes no arguments, got {" ".join(arguments)}; it makes .venv, install/ and build/')
        return 2
    start = time.monotonic()
    checkout = Checkout(Path(__file__).resolve().parents[2])
    try:
        host.check_host()
        checkout.check()
        preflight.check_writable(checkout)
        variables = host.clean_environment(environment)
        if arguments:
            print(interfaces_of_this_python(checkout, variables))
            return 0
        with one_at_a_time(checkout):
            busy = set_up(checkout, variables)
    except (SetupError, OSError) as error:  # the latter: disk full, not ours to write
        say(f'error: {error}')
        return FAILED
    except KeyboardInterrupt:
        say('interrupted; run it again to go on')
        return INTERRUPTED
    if busy:
        ignored = host.foreign_settings(environment)
        if ignored:
            say(f'ignoring {" and ".join(ignored)} of this shell: it uses the ROS of PyPI alone')
        say(f'done in {time.monotonic() - start:.0f} s; next: source scripts/activate')
    return 0
