# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``changed_tests.py``: the test folders and files of what has changed since ``main``, one a line.

By the mirror of the folders: ``amr_description/sim/…`` is tested in ``test/*/sim``. A change that
every test depends on prints ``test``.
"""

from collections.abc import Iterable, Iterator
from pathlib import Path, PurePosixPath
import subprocess
import sys

LEVELS = ('unit', 'ros', 'system')
# The beginning of a path -> what tests it, besides the mirror.
BESIDE = {
    'web': ('viewer',),
    'docs': ('docs',),
    'README.md': ('docs',),
    'CONTRIBUTING.md': ('docs',),
    'examples': ('docs',),
    'benchmarks': ('benchmarks',),
    'urdf': ('model', 'sim'),
    'config': ('controllers', 'control'),
}
TOOLING = (
    'scripts',
    'interfaces',
    '.ci',
    '.github',
    'pyproject.toml',
    'setup.py',
    'setup.cfg',
    'package.xml',
    'web',
)


def affected_tests(changed: Iterable[str], root: Path) -> list[str]:
    """Return the existing folders and files of ``test/`` for changed paths, sorted."""
    found = {test for path in changed for test in _tests_of(PurePosixPath(path))}
    found = {test for test in found if (root / test).exists()}
    if 'test' in found:
        return ['test']
    return sorted(
        test for test in found if not any(str(p) in found for p in PurePosixPath(test).parents)
    )


def _tests_of(path: PurePosixPath) -> Iterator[str]:
    first, *rest = path.parts
    if first == 'test':
        yield str(path) if path.name.startswith('test_') else 'test'
        return
    if first == 'amr_description':
        yield 'test/tooling/test_architecture.py'
        rooms = (rest[0] if len(rest) > 1 else 'base',)
    else:
        rooms = BESIDE.get(first, ())
    if first in TOOLING:
        yield 'test/tooling'
    yield from (f'test/{level}/{room}' for level in LEVELS for room in rooms)


def changed_paths(root: Path) -> list[str]:
    """Return the paths that differ from where this branch left ``main``, new ones too."""

    def git(*words: str) -> list[str]:
        done = subprocess.run(
            ['git', '-C', root, *words], check=True, capture_output=True, text=True
        )
        return done.stdout.splitlines()

    names = git('for-each-ref', '--format=%(refname)', 'refs/remotes/origin/main')
    (base,) = git('merge-base', 'HEAD', (names or ['main'])[0])
    return git('diff', '--name-only', base) + git('ls-files', '--others', '--exclude-standard')


if __name__ == '__main__':
    root = Path(__file__).resolve().parents[2]
    try:
        changed = changed_paths(root)
    except FileNotFoundError:
        sys.exit(
            'scripts/test --changed: there is no git here, which knows what has changed; '
            'name the tests instead, as in scripts/test unit'
        )
    except (OSError, subprocess.CalledProcessError) as error:
        said = (getattr(error, 'stderr', None) or str(error)).strip().splitlines()[-1]
        sys.exit(
            f'scripts/test --changed: git does not know what has changed here: {said}; '
            'name the tests instead, as in scripts/test unit'
        )
    print(*affected_tests(changed, root), sep='\n')
    sys.exit(0)
