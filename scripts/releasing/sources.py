# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The checkout as git knows it."""

from collections.abc import Mapping
from pathlib import Path
import shutil
import subprocess

from releasing import ReleaseError

EPOCH = 'SOURCE_DATE_EPOCH'
SHOWN_CHANGES = 3


def git(root: Path, *words: str) -> str:
    """Return what a command of git prints. Raises ReleaseError with the last line it complains."""
    try:
        done = subprocess.run(['git', '-C', root, *words], capture_output=True, text=True)
    except FileNotFoundError:
        raise ReleaseError('there is no git here, which says what belongs to a release') from None
    if done.returncode != 0:
        last = (done.stderr.strip() or 'no message').splitlines()[-1]
        raise ReleaseError(f'git {words[0]}: {last}')
    return done.stdout


def check_clean(root: Path) -> None:
    """Raise ReleaseError when something is not committed."""
    changed = git(root, 'status', '--porcelain').splitlines()
    if changed:
        names = ', '.join(line[3:] for line in changed[:SHOWN_CHANGES])
        more = f' and {len(changed) - SHOWN_CHANGES} more' if len(changed) > SHOWN_CHANGES else ''
        raise ReleaseError(f'not committed: {names}{more}; commit or stash, or try with --draft')


def check_tag(root: Path, version: str) -> None:
    """Raise ReleaseError when the tag of the version is on another commit: it was released."""
    tag = f'v{version}'
    if not git(root, 'tag', '--list', tag).strip():
        return
    head, tagged = (git(root, 'rev-parse', f'{name}^{{commit}}').strip() for name in ('HEAD', tag))
    if head != tagged:
        raise ReleaseError(
            f'{tag} is the tag of {tagged[:10]}, this is {head[:10]}; raise the version'
        )


def time_of(root: Path, environment: Mapping[str, str]) -> int:
    """Return the time that all files in the wheels get, in seconds since 1970."""
    given = environment.get(EPOCH)
    if given is None:
        return int(git(root, 'log', '-1', '--format=%ct'))
    if not given.isdecimal():
        raise ReleaseError(f'{EPOCH}={given}: want seconds since 1970')
    return int(given)


def files(root: Path) -> list[str]:
    """Return the paths of all files that belong to the checkout, uncommitted ones too, sorted."""
    listed = git(root, 'ls-files', '-z', '--cached', '--others', '--exclude-standard')
    return sorted({name for name in listed.split('\0') if name and (root / name).is_file()})


def copy(root: Path, target: Path) -> None:
    """Copy these files, so that nothing that was built earlier gets into a wheel."""
    for name in files(root):
        (target / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(root / name, target / name)
