# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The command ``try_launch_files``: its options, the files one after the other, the table."""

import argparse
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import asdict
import json
import os
from pathlib import Path
import re
import shutil
import signal
import sys
import tempfile
from xml.etree import ElementTree

from amr_description.ament_index import is_installed
from amr_description.cli.launch_files import launch_files_below
from amr_description.errors import AmrError, UsageError
from amr_description.testing.trial.command import given_to
from amr_description.testing.trial.inputs import offer_prefixes, prefixes
from amr_description.testing.trial.launch_trial import (
    LaunchFinding,
    LaunchVerdict,
    try_launch_file,
)

_GOOD = (LaunchVerdict.DRIVES, LaunchVerdict.COMES_UP, LaunchVerdict.NOTHING)
_WIDTH = 16
_PROGRAMS = re.compile(r'^\s*install\s*\(\s*PROGRAMS\s+(.*?)\sDESTINATION\b', re.M | re.S)


def launch_files(paths: Sequence[Path]) -> dict[str, Path]:
    """
    Return the launch files of folders, and those that are named, by their names in the table.

    Raises:
        UsageError: there is none.
    """
    found: dict[str, Path] = {}
    for path in paths:
        if not path.exists():
            raise UsageError(f"'{path}': there is no such file or folder")
        # Several packages have files of the same names.
        root = path if path.is_dir() and len(paths) == 1 else path.parent
        below = sorted(launch_files_below(path)) if path.is_dir() else [path]
        found |= {str(each.relative_to(root)): each for each in below}
    if not found:
        raise UsageError(f'there is no launch file below {", ".join(map(str, paths))}')
    return found


def index_of_sources(paths: Iterable[Path], prefix: Path) -> None:
    """
    Make an install prefix of the source packages of folders, as a build by links would.

    Args:
        paths: folders; of a file, its package.
        prefix: an empty folder. What is installed already is left alone.
    """
    for package in {each for path in paths for each in _packages(path)}:
        name = ElementTree.parse(package / 'package.xml').findtext('name', '').strip()
        marker = prefix / 'share/ament_index/resource_index/packages' / name
        if not name or marker.exists() or is_installed(name):
            continue
        marker.parent.mkdir(parents=True, exist_ok=True)
        marker.touch()
        (prefix / 'share' / name).symlink_to(package.resolve())
        for program in _programs(package):
            copy = prefix / 'lib' / name / program.name
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(program, copy)
            copy.chmod(0o755)  # as install(PROGRAMS …) does, whatever it was


def _programs(package: Path) -> list[Path]:
    """Return the scripts that the rules of CMake of a package install; what is built is none."""
    rules = package / 'CMakeLists.txt'
    text = rules.read_text(encoding='utf-8', errors='replace') if rules.is_file() else ''
    words = [word for found in _PROGRAMS.findall(text) for word in found.split()]
    return [path for word in words if (path := package / word).is_file()]


def _packages(path: Path) -> list[Path]:
    """Return the folders of packages below a folder, or around a file."""
    if path.is_dir():
        return [each.parent for each in path.rglob('package.xml')]
    around = path.resolve().parents
    return [each for each in around if (each / 'package.xml').is_file()][:1]


def table(found: Sequence[LaunchFinding], *, details: bool = True) -> str:
    """Return a row for each launch file, and the sum; ``details``: with what is left out."""
    width = max(len(each.file) for each in found)
    rows = []
    for each in found:
        row = f'{each.file:{width}}  {each.verdict:{_WIDTH}}  {each.seconds:4.0f} s  {each.reason}'
        rows += [row.rstrip(), *(f'    {line}' for line in each.left_out if details)]
    counts = Counter(each.verdict for each in found)
    words = {LaunchVerdict.DRIVES: 'drive', LaunchVerdict.COMES_UP: 'come up'}
    sums = [f'{counts[each]} {words.get(each, each)}' for each in LaunchVerdict if counts[each]]
    return '\n'.join([*rows, f'{len(found)} tried: {"; ".join(sums)}'])


def main(arguments: Sequence[str]) -> int:
    """Try launch files; return 0 if all come up, 1 if one does not, 2 if none can be tried."""
    options = _parser().parse_args(arguments)
    os.environ['ROS_AUTOMATIC_DISCOVERY_RANGE'] = 'LOCALHOST'
    with tempfile.TemporaryDirectory(prefix='amr-try-') as folder:
        try:
            files = launch_files(options.paths)
            offer_prefixes([*prefixes(options.paths), *options.prefix])
            index_of_sources(options.paths, Path(folder))
            offer_prefixes([Path(folder)], last=True)
            found = [
                _try(name, path, options)
                for name, path in files.items()
                if not options.only or any(word in name for word in options.only)
            ]
        except (AmrError, ElementTree.ParseError) as error:
            print(f'try_launch_files: {error}', file=sys.stderr)
            return 2
        except KeyboardInterrupt:
            return 128 + signal.SIGINT
    if found:
        print(table(found, details=not options.brief), flush=True)
    if options.json:
        text = json.dumps([asdict(each) for each in found], indent=2)
        options.json.write_text(f'{text}\n', encoding='utf-8')
    return 0 if all(each.verdict in _GOOD for each in found) else 1


def _try(name: str, path: Path, options: argparse.Namespace) -> LaunchFinding:
    """Try a launch file; say on stderr how it went."""
    words = ' '.join(given_to(name, options.args)).split()
    found = try_launch_file(name, path, words, options.timeout)
    print(f'{name}: {found.verdict} ({found.seconds:.0f} s)', file=sys.stderr, flush=True)
    return found


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog='try_launch_files',
        description='Try launch files as they are: does each come up, and does its robot drive?',
        epilog='Exit code: 0 all come up; 1 one does not; 2 nothing can be tried.',
    )
    add = parser.add_argument
    add('paths', nargs='+', type=Path, metavar='FOLDER|FILE', help='launch files, or their folder')
    add(
        '--args',
        action='append',
        default=[],
        metavar='[FILE=]NAME:=VALUE …',
        help='arguments of all files, or of one; may be given more than once',
    )
    add(
        '--prefix',
        action='append',
        default=[],
        type=Path,
        metavar='FOLDER',
        help='an install prefix whose packages the files name; a FOLDER that is one is taken by '
        'itself, and so are source packages below it',
    )
    add('--only', action='append', default=[], metavar='TEXT', help='files whose name holds it')
    add('--timeout', type=float, default=60.0, metavar='S', help='s until one is ready (60)')
    add('--json', type=Path, metavar='FILE', help='write everything that was found into it')
    add('--brief', action='store_true', help='the table without what is left out')
    return parser


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
