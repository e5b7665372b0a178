# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Films and plots of what happens in a simulation while a block runs.

What they are made with need not be installed: Pillow for .webp and .gif, the program ffmpeg for
.mp4, matplotlib for a plot. What is missing is said when the block begins.
"""

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
import importlib
import math
from pathlib import Path
import shutil
import subprocess
import tempfile
import zlib

import numpy as np
import numpy.typing as npt

from amr_description.clock import NANOSECONDS
from amr_description.errors import SimulationError
from amr_description.simulation.readings import Image

Observers = list[Callable[[int], None]]
"""Called at the end of each cycle with its time, ns."""
Pixels = npt.NDArray[np.uint8]
MOST_FRAMES = 100
"""A second: the world has a cycle each 10 ms."""
SUFFIXES = ('.webp', '.gif', '.mp4')


class Film:
    """Pictures of instants, kept in little memory until they are written."""

    def __init__(self, path: Path, rate: float) -> None:
        """
        Check that it can be written.

        Args:
            path: Of the file; its suffix says what it is.
            rate: Pictures per s of simulated time.

        Raises:
            SimulationError: It cannot, with what would do.
        """
        if not (math.isfinite(rate) and 0.0 < rate <= MOST_FRAMES):
            raise SimulationError(f'a film of {rate} pictures a second; at most {MOST_FRAMES}')
        self.path, self.rate = require_folder(path), rate
        self._shape = (0, 0, 0)
        self._frames: list[bytes] = []
        if path.suffix not in SUFFIXES:
            raise SimulationError(f"a film '{path.name}'; {', '.join(SUFFIXES)} will do")
        if path.suffix != '.mp4':
            require_package('PIL', 'Pillow', f'a film as {path.suffix}')
        elif not shutil.which('ffmpeg'):
            raise SimulationError(
                'a film as .mp4 needs the program ffmpeg, which is not on the PATH; install it, '
                'or take .webp'
            )

    def add(self, picture: Image) -> None:
        """Add a picture, of the same size as the others."""
        self._shape = picture.pixels.shape
        self._frames.append(zlib.compress(picture.pixels.tobytes(), 1))

    def write(self) -> None:
        """Write the file. Raises SimulationError."""
        if not self._frames:
            raise SimulationError(f'{self.path}: no time has passed in the film')
        try:
            if self.path.suffix == '.mp4':
                self._write_by_ffmpeg()
            else:
                self._write_by_pillow()
        except (OSError, subprocess.CalledProcessError) as error:
            said = getattr(error, 'stderr', b'') or str(error).encode()
            reason = said.decode(errors='replace').strip().splitlines()[-1:]
            raise SimulationError(f'{self.path} is not written: {"".join(reason)}') from error

    def _pixels(self) -> Iterator[Pixels]:
        for frame in self._frames:
            yield np.frombuffer(zlib.decompress(frame), np.uint8).reshape(self._shape)

    def _write_by_pillow(self) -> None:
        images = map(importlib.import_module('PIL.Image').fromarray, self._pixels())
        duration = round(1000.0 / self.rate)
        options = {'save_all': True, 'append_images': images, 'duration': duration, 'loop': 0}
        next(images).save(self.path, **options)

    def _write_by_ffmpeg(self) -> None:
        height, width, _ = self._shape
        source = ['-f', 'rawvideo', '-pix_fmt', 'rgb24', '-s', f'{width}x{height}']
        even = ['-vf', 'pad=ceil(iw/2)*2:ceil(ih/2)*2', '-pix_fmt', 'yuv420p']  # as players want
        with tempfile.TemporaryFile() as frames:
            for pixels in self._pixels():
                frames.write(pixels.tobytes())
            frames.seek(0)
            subprocess.run(
                ['ffmpeg', '-y', '-loglevel', 'error', *source, '-r', f'{self.rate}', '-i', '-']
                + [*even, str(self.path.absolute())],
                stdin=frames,
                capture_output=True,
                check=True,
            )


class Plot:
    """Where robots drive: by the truth, and by their odometry, as lines in the plane."""

    def __init__(self, path: Path) -> None:
        """Check that it can be drawn. Raises SimulationError."""
        require_package('matplotlib', 'matplotlib', 'a plot')
        self.path = require_folder(path)
        self._lines: dict[str, list[tuple[float, float]]] = {}

    def add(self, places: Mapping[str, tuple[float, float]]) -> None:
        """Add a point to each line; x and y, m."""
        for name, place in places.items():
            self._lines.setdefault(name, []).append(place)

    def write(self) -> None:
        """Draw it. Raises SimulationError."""
        figure = importlib.import_module('matplotlib.figure').Figure()
        axes = figure.add_subplot(aspect='equal', xlabel='x in m', ylabel='y in m')
        for name, places in self._lines.items():
            axes.plot(*zip(*places, strict=True), label=name)
        axes.legend()
        axes.grid()
        try:
            figure.savefig(self.path)
        except (OSError, ValueError) as error:
            raise SimulationError(f'{self.path} is not written: {error}') from error


@contextmanager
def observed(observers: Observers, rate: float, observe: Callable[[], None]) -> Iterator[None]:
    """Call ``observe`` ``rate`` times a second of simulated time, at ends of cycles."""
    begin, count, latest = -1, 0, -1

    def look(time: int) -> None:
        nonlocal begin, count, latest
        if begin < 0 or time < latest:  # a reset
            begin, count = time, 0
        latest = time
        if time >= begin + count * NANOSECONDS / rate:
            count += 1
            observe()

    observers.append(look)
    try:
        yield
    finally:
        observers.remove(look)


def require_folder(path: Path) -> Path:
    """Return the path. Raises SimulationError: its folder is not there."""
    if not path.absolute().parent.is_dir():
        raise SimulationError(f'{path} cannot be written: there is no folder {path.parent}')
    return path


def require_package(module: str, package: str, what: str) -> None:
    """Raise SimulationError if a package is not installed."""
    try:
        importlib.import_module(module)
    except ImportError as error:
        raise SimulationError(
            f'{what} needs the Python package {package}, which is not installed; '
            f'pip install {package.lower()}'
        ) from error
