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

A simulation has one recording. Where a test records by itself, that of the option ends before it,
and the report names both.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
import shlex
import shutil
import tempfile

import pytest

from amr_description.errors import SimulationError
from amr_description.testing.failure_logs import beside_junit_report, file_name

CHOICES = ('never', 'on-failure', 'always')
_FOLDER = 'ros_bags'


class Recording:
    """The one recording of a simulation: that of its test, or that of the option."""

    def __init__(
        self,
        record: Callable[[str], None],
        is_alive: Callable[[], bool],
        own: str | Path | None = None,
    ) -> None:
        """
        Record nothing more yet.

        Args:
            record: Ends the recording, and begins one to a folder; empty: none. Raises
                SimulationError.
            is_alive: Whether the simulation runs, and can be asked.
            own: The folder to which the simulation records from its start.
        """
        self._record, self._is_alive = record, is_alive
        self.own = Path(own) if own else None
        """The folder to which the test itself records."""

    def begin_own(self, folder: Path) -> None:
        """Record as the test says. Raises SimulationError."""
        self._record(str(folder.absolute()))
        self.own = folder

    def end_own(self) -> None:
        """End what the test has begun. Raises SimulationError: the bag is not complete."""
        if self.own is not None or not _is_going(self):
            self.own = None
            self._record('')

    def begin(self, folder: Path) -> None:
        """Record as the option says. Raises SimulationError."""
        self._record(str(folder))

    def end(self) -> str:
        """End that; return why its bag is not complete."""
        if self.own is not None or not self._is_alive():
            return ''
        try:
            self._record('')
        except SimulationError as error:
            return str(error) if self._is_alive() else ''
        return ''


@dataclass
class _Recordings:
    """Those of a run of pytest."""

    mode: str = CHOICES[0]
    temporary: Path | None = None
    count: int = 0
    going: list[tuple[Recording, Path | None]] = field(default_factory=list)
    """With the folder; None: the test records by itself."""
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


def begin(recording: Recording) -> None:
    """Record a simulation that begins a test, or is lent to it, if that is wanted."""
    if _recordings.mode == CHOICES[0]:
        return
    _forget(recording)
    if recording.own is not None:
        _recordings.going.append((recording, None))
        return
    if _recordings.temporary is None:
        _recordings.temporary = Path(tempfile.mkdtemp(prefix='amr-bags-'))
    _recordings.count += 1
    folder = _recordings.temporary / f'{_recordings.count}' / 'bag'
    recording.begin(folder)
    _recordings.going.append((recording, folder))


def add_bags(item: pytest.Item, report: pytest.TestReport) -> None:
    """End the recordings of a test; keep them if that is wanted, and say where they are."""
    is_over = report.when in ('call', 'teardown') or report.failed or report.skipped
    if not is_over or not _recordings.going:
        return
    going, _recordings.going = _recordings.going, []
    is_kept = report.failed or _recordings.mode == 'always'
    for recording, folder in going:
        reason = recording.end()
        if is_kept:
            lines = _lines(item, report, folder)
            if reason:
                lines.append(f'not complete: {reason}')
            if recording.own is not None:
                lines.append(f'the test itself records to {recording.own}')
            report.sections.append(('ROS bag', '\n'.join(lines)))
        _remove(folder)


def _is_going(recording: Recording) -> bool:
    """Whether the option records a simulation."""
    return any(each is recording for each, _ in _recordings.going)


def _forget(recording: Recording) -> None:
    """Drop the recording of a simulation that begins another one in the same test."""
    for each in [each for each in _recordings.going if each[0] is recording]:
        _recordings.going.remove(each)
        recording.end()
        _remove(each[1])


def _remove(folder: Path | None) -> None:
    if folder is not None:
        shutil.rmtree(folder.parent, ignore_errors=True)


def _lines(item: pytest.Item, report: pytest.TestReport, folder: Path | None) -> list[str]:
    """Keep a bag, and return where it is."""
    try:
        return [] if folder is None else [_line(path) for path in _keep(item, report, folder)]
    except OSError as error:  # a disk that is full shall not hide the failure of the test
        return [f'no bag: {error}']


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
