# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Bags of tests: what the simulator of a test that fails has published, to look at and to repeat.

``pytest --ros-bag=on-failure`` leaves one for each simulation of a test that fails, ``always`` for
one that passes, too. They are where ``--ros-bag-dir`` says, else beside the JUnit report, else in
``ros_bags``: ``results/report.test_my_robot.test_ramp.mcap``. In a file of settings the options
are ``ros_bag`` and ``ros_bag_dir``.

A recording begins with the test, at time 0. Where the test resets the simulation, each part is a
file of its own: ``….test_ramp_0.mcap``, ``….test_ramp_1.mcap``.
"""

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
import shlex
import shutil
import tempfile
from typing import Protocol

import pytest

from amr_description.errors import SimulationError
from amr_description.testing.failure_logs import beside_junit_report, file_name

CHOICES = ('never', 'on-failure', 'always')
_FOLDER = 'ros_bags'


class Recordable(Protocol):
    """A running simulation."""

    @property
    def is_alive(self) -> bool:
        """Whether it runs, and can be asked to end a recording."""

    def record(self, folder: str | Path) -> None:
        """Record to a new folder."""

    def end_recording(self) -> None:
        """Complete it."""


@dataclass
class _Recordings:
    """Those of a run of pytest."""

    mode: str = CHOICES[0]
    temporary: Path | None = None
    count: int = 0
    going: list[tuple[Recordable, Path]] = field(default_factory=list)
    written: set[Path] = field(default_factory=set)


_recordings = _Recordings()


def add_options(parser: pytest.Parser) -> None:
    """Add the options."""
    group = parser.getgroup('amr_description')
    about = 'leave bags of simulations: never (default), on-failure, always'
    group.addoption('--ros-bag', choices=CHOICES, default=None, help=about)
    group.addoption('--ros-bag-dir', metavar='DIR', default=None, help='folder of these bags')
    parser.addini('ros_bag', about, default=CHOICES[0])
    parser.addini('ros_bag_dir', 'folder of these bags', default='')


def configure(config: pytest.Config) -> None:
    """Begin a run. Raises pytest.UsageError."""
    _recordings.mode = config.getoption('ros_bag', None) or config.getini('ros_bag')
    if _recordings.mode not in CHOICES:
        raise pytest.UsageError(
            f"ros_bag is '{_recordings.mode}'; one of {', '.join(CHOICES)} will do"
        )


def unconfigure() -> None:
    """Remove what no test has ended."""
    if _recordings.temporary is not None:
        shutil.rmtree(_recordings.temporary, ignore_errors=True)
    _recordings.temporary = None
    _recordings.going.clear()
    _recordings.written.clear()
    _recordings.mode = CHOICES[0]


def begin(sim: Recordable) -> None:
    """Record a simulation that begins a test, or is lent to it, if that is wanted."""
    if _recordings.mode == CHOICES[0]:
        return
    _forget(sim)
    if _recordings.temporary is None:
        _recordings.temporary = Path(tempfile.mkdtemp(prefix='amr-bags-'))
    _recordings.count += 1
    folder = _recordings.temporary / f'{_recordings.count}' / 'bag'
    sim.record(folder)
    _recordings.going.append((sim, folder))


def add_bags(item: pytest.Item, report: pytest.TestReport) -> None:
    """End the recordings of a test; keep them if that is wanted, and say where they are."""
    is_over = report.when == 'call' or report.failed
    if not is_over or not _recordings.going:
        return
    going, _recordings.going = _recordings.going, []
    is_kept = report.failed or _recordings.mode == 'always'
    for sim, folder in going:
        if sim.is_alive:
            with suppress(SimulationError):  # it has just ended; what it has written is there
                sim.end_recording()
        if is_kept:
            try:
                lines = [_line(path) for path in _keep(item, report, folder)]
            except OSError as error:  # a disk that is full shall not hide the failure of the test
                lines = [f'no bag: {error}']
            report.sections.append(('ROS bag', '\n'.join(lines)))
        shutil.rmtree(folder.parent, ignore_errors=True)


def _forget(sim: Recordable) -> None:
    """Drop the recording of a simulation that begins another one in the same test."""
    for each in [each for each in _recordings.going if each[0] is sim]:
        _recordings.going.remove(each)
        sim.end_recording()
        shutil.rmtree(each[1].parent, ignore_errors=True)


def _line(path: Path) -> str:
    shown = shlex.quote(str(path))
    return (
        f'{path}\n'
        f'  to look at it:      ros2 run amr_description viewer --bag {shown}\n'
        f'  to drive it again:  ros2 run amr_description replay {shown}'
    )


def _keep(item: pytest.Item, report: pytest.TestReport, folder: Path) -> Iterator[Path]:
    """Move the files of a bag to where they stay; yield their paths."""
    files = sorted(folder.glob('*.mcap'), key=lambda path: int(path.stem.rpartition('_')[2]))
    for number, file in enumerate(files):
        part = f'_{number}' if len(files) > 1 else ''
        path = _path(item.config, report.nodeid, part)
        path.parent.mkdir(parents=True, exist_ok=True)
        shutil.move(file, path)
        yield path


def _path(config: pytest.Config, nodeid: str, part: str) -> Path:
    """Return a path that no other bag of this run has."""
    given = config.getoption('ros_bag_dir', None) or config.getini('ros_bag_dir')
    beside = beside_junit_report(config)
    name = file_name(nodeid)
    if given:
        folder = config.invocation_params.dir / given
    elif beside is not None:
        folder, name = beside.parent, f'{beside.name}.{name}'
    else:
        folder = config.invocation_params.dir / _FOLDER
    path, number = folder / f'{name}{part}.mcap', 2
    while path in _recordings.written:
        path, number = folder / f'{name}-{number}{part}.mcap', number + 1
    _recordings.written.add(path)
    return path
