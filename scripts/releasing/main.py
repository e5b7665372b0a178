# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The command line of ``scripts/release``, and the order of things."""

import argparse
from collections.abc import Mapping
from datetime import datetime, UTC
import os
from pathlib import Path
import shutil
import subprocess
import sys
import tempfile
import zipfile

import environment as setup_parts
from environment import host, interface_wheel, SetupError
from environment.checkout import cache_folder, Checkout
from environment.locks import canonical, Pin
from environment.main import INTERFACES

from releasing import (
    archives,
    binaries,
    locks,
    package_wheel,
    ReleaseError,
    say,
    sbom,
    sources,
    versions,
)
from releasing.versions import Section

FAILED, INTERRUPTED = 1, 130
REQUIREMENTS = 'requirements.txt'
SBOM = 'sbom.cdx.json'
SUMS = 'SHA256SUMS'
NOTES = 'RELEASE_NOTES.md'
_NOTES = """\
# amr_description {version}{draft}

{changes}

## Install

On x86-64 Linux with glibc 2.28 or later and a CPython {pythons}; no compiler. In the folder
with the files of this release:

```
sha256sum -c {sums}
python3 -m venv ros
ros/bin/pip install --no-deps -r {requirements}
source ros/setup.bash
ros2 launch amr_description simulation
```

## How it was made

By `scripts/release` from commit {commit}; all files in the wheels
have the time {epoch} (`SOURCE_DATE_EPOCH`). The compiled interfaces, made by {compilers}, need
{needs}.
"""


def main(arguments: list[str], environment: Mapping[str, str] = os.environ) -> int:
    """Run ``scripts/release``; return its exit code."""
    options = _parsed(arguments)
    setup_parts.program = 'scripts/release'
    checkout = Checkout(Path(__file__).resolve().parents[2])
    try:
        release(checkout, options, host.clean_environment(environment))
    except (ReleaseError, SetupError, OSError) as error:
        say(f'error: {error}')
        return FAILED
    except KeyboardInterrupt:
        say('interrupted; dist/ is as it was')
        return INTERRUPTED
    return 0


def release(
    checkout: Checkout, options: argparse.Namespace, environment: Mapping[str, str]
) -> None:
    """Check the checkout and write the files. Raises ReleaseError, SetupError, OSError."""
    root = checkout.root
    version, section = checked(root, options)
    epoch = sources.time_of(root, environment)
    environment = {**environment, sources.EPOCH: str(epoch)}
    target = options.output.absolute()
    target.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix='.release-', dir=target.parent) as scratch:
        fresh = Path(scratch, 'dist')
        fresh.mkdir()
        say('building the wheels ...')
        own = package_wheel.build(root, checkout.venv, fresh, epoch, environment)
        built = [_built(checkout, environment)]
        built += [_built_by(python, checkout, environment) for python in options.python]
        interfaces = [_interfaces(each, checkout.venv, fresh, epoch) for each in built]
        own += [wheel for wheel, _, _ in interfaces]
        own += _from_sources(checkout, fresh, epoch, environment)
        pins = _pins(checkout, own)
        pythons = ', '.join(sorted(map(_python_of, built)))
        text = locks.requirements_text(version, pins, REQUIREMENTS, pythons)
        (fresh / REQUIREMENTS).write_text(text, encoding='utf-8')
        (fresh / SBOM).write_text(sbom.text(version, pins, epoch), encoding='utf-8')
        _, needs, compilers = interfaces[0]
        notes = _NOTES.format(
            version=version,
            pythons=pythons,
            draft=' (draft)' if options.draft else '',
            changes=section.text,
            sums=SUMS,
            requirements=REQUIREMENTS,
            commit=sources.git(root, 'rev-parse', 'HEAD').strip(),
            epoch=epoch,
            compilers=', '.join(compilers),
            needs=', '.join(f'{kind} {number}' for kind, number in needs.items()),
        )
        (fresh / NOTES).write_text(notes, encoding='utf-8')
        (fresh / SUMS).write_text(sums(fresh), encoding='utf-8')
        _replace(target, fresh)
    _report(target, version, options.draft)


def checked(root: Path, options: argparse.Namespace) -> tuple[str, Section]:
    """Return the version and its section of the changelog. Raises ReleaseError."""
    version = versions.agreed_version(versions.declared_versions(root), options.version)
    changelog = (root / versions.CHANGELOG).read_text(encoding='utf-8')
    section = versions.section_of(version, changelog)
    if not options.draft:
        versions.check_date(section, datetime.now(UTC).date())
        versions.check_readme(version, (root / 'README.md').read_text(encoding='utf-8'))
        sources.check_tag(root, version)
        sources.check_clean(root)
    return version, section


def sums(folder: Path) -> str:
    """Return the SHA-256 of each file, as ``sha256sum -c`` reads it."""
    files = sorted(path for path in folder.iterdir() if path.name != SUMS)
    return ''.join(f'{archives.digest(path)}  {path.name}\n' for path in files)


def _parsed(arguments: list[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser('scripts/release', add_help=False)
    parser.add_argument('version', nargs='?', metavar='VERSION')
    parser.add_argument('--draft', action='store_true')
    parser.add_argument('--python', action='append', default=[], metavar='PYTHON')
    root = Path(__file__).resolve().parents[2]
    parser.add_argument('--output', type=Path, metavar='FOLDER', default=root / 'dist')
    return parser.parse_args(arguments)


def _built(checkout: Checkout, environment: Mapping[str, str]) -> Path:
    """Return the wheel of the interfaces for the Python of ``.venv``."""
    return interface_wheel.built(checkout, checkout.venv, cache_folder(environment), environment)


def _built_by(python: str, checkout: Checkout, environment: Mapping[str, str]) -> Path:
    """Return the wheel of the interfaces for another Python. Raises ReleaseError."""
    command = [python, '-ES', checkout.scripts / 'environment', INTERFACES]
    try:
        done = subprocess.run(command, env=environment, stdout=subprocess.PIPE, text=True)
    except OSError as error:
        raise ReleaseError(f'--python {python}: {error.strerror}') from None
    if done.returncode != 0:
        raise ReleaseError(f'--python {python}: it cannot build the interfaces')
    return Path(done.stdout.strip())


def _python_of(wheel: Path) -> str:
    """Return the version of the Python of a wheel: ``3.12``."""
    tag = wheel.name.split('-')[2]
    return f'3.{tag.removeprefix("cp3")}'


def _interfaces(
    built: Path, venv: Path, folder: Path, epoch: int
) -> tuple[Path, dict[str, str], list[str]]:
    """Write the wheel of the interfaces; return its path, what it needs, and who compiled it."""
    with tempfile.TemporaryDirectory(prefix='amr-release-') as unpacked:
        with zipfile.ZipFile(built) as archive:
            archive.extractall(unpacked)
        provided = {path.name for path in (venv / 'lib').glob('*.so*')}
        try:
            needs = binaries.check(Path(unpacked), provided)
        except ReleaseError as error:
            kept = f'; remove {built.parent} first, where this one is kept'
            raise ReleaseError(f'{error}{kept}') from None
        compilers = binaries.compilers(Path(unpacked).rglob('*.so*'))
    python = built.name.split('-')[2]
    members = archives.retagged(archives.read(built), f'{python}-{python}-{binaries.PLATFORM}')
    return archives.write(members, folder, epoch), needs, compilers


def _from_sources(
    checkout: Checkout, folder: Path, epoch: int, environment: Mapping[str, str]
) -> list[Path]:
    """Write the wheels of what PyPI has only the sources of; return their paths."""
    lock = checkout.requirements.read_text(encoding='utf-8')
    with tempfile.TemporaryDirectory(prefix='amr-release-') as scratch:
        built = locks.wheels_from_sources(lock, checkout.venv, Path(scratch), environment)
        return [archives.write(archives.read(wheel), folder, epoch) for wheel in built]


def _pins(checkout: Checkout, own: list[Path]) -> list[Pin]:
    """Return all that users install, the own wheels first, with the hashes of their files."""
    ours: dict[str, Pin] = {}
    for wheel in own:
        name, number, *_ = wheel.name.split('-')
        others = ours[name].hashes if name in ours else ()
        ours[name] = Pin(name, number, '', (*others, f'sha256:{archives.digest(wheel)}'))
    names = {canonical(name) for name in ours}
    released = locks.released_pins(checkout.requirements.read_text(encoding='utf-8'))
    others = [pin for pin in released if canonical(pin.name) not in names]
    return [*ours.values(), *others]


def _replace(target: Path, fresh: Path) -> None:
    """Put ``fresh`` in the place of ``target``, if that holds an earlier release or nothing."""
    if target.exists():
        if any(target.iterdir()) and not (target / SUMS).is_file():
            raise ReleaseError(f'{target} holds other things than a release; name another folder')
        shutil.rmtree(target)
    fresh.chmod(0o755)
    fresh.rename(target)


def _report(target: Path, version: str, draft: bool) -> None:
    """Say what there is, and what comes next."""
    for path in sorted(target.iterdir()):
        print(f'{path.stat().st_size / 1e6:8.2f} MB  {path.name}')
    if draft:
        say(f'{target} is a draft: nothing was checked but that it can be made')
    else:
        say(f'next: git tag v{version} && git push origin v{version}')
    sys.stdout.flush()
