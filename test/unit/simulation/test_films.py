# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Films and plots of a simulation.

Pillow and matplotlib are there where the engine is tested without ROS (``scripts/test engine``),
and need not be elsewhere: then it has to be said.
"""

from contextlib import ExitStack
from importlib.util import find_spec
import sys

import pytest
from support.paths import ROOT

from amr_description import Simulation
from amr_description.errors import SimulationError

URDF = ROOT / 'urdf' / 'amr.urdf'
FFMPEG = """#!{python}
import sys
with open(sys.argv[-1], 'w') as file:
    print(*sys.argv[1:-1], file=file)
    print(len(sys.stdin.buffer.read()), file=file)
"""
FAILS = '#!/bin/sh\necho "no codec" >&2; exit 1\n'


@pytest.fixture
def sim():
    with Simulation(URDF) as sim:
        yield sim


def block_of(package, words, stack):
    """The block that needs a package; where that is not installed, it says what to do."""
    if not find_spec(package):
        stack.enter_context(pytest.raises(SimulationError, match=words))


@pytest.mark.parametrize('suffix', ['.gif', '.webp'])
def test_a_film_has_a_picture_of_each_tenth_of_a_second(sim, tmp_path, suffix):
    path = tmp_path / f'drive{suffix}'
    with ExitStack() as stack:
        block_of('PIL', f'a film as {suffix} needs .* Pillow, .*; pip install pillow', stack)
        stack.enter_context(sim.film(path, (2.0, 2.0, 2.0), (0.5, 0.0, 0.0), width=64, height=48))
        sim.drive(0.5, 0.0, seconds=0.9)
    if path.exists():
        from PIL import Image

        film, duration, seen = Image.open(path), 0, set()
        for number in range(film.n_frames):
            film.seek(number)
            seen.add(film.convert('RGB').tobytes())
            duration += film.info['duration']
        assert film.size == (64, 48)
        assert duration == 100 * (round(sim.time * 10) + 1)
        assert len(seen) >= 8, 'the robot moves'


def test_a_plot_has_truth_and_odometry(sim, tmp_path):
    path = tmp_path / 'drive.svg'
    with ExitStack() as stack:
        block_of('matplotlib', 'a plot needs .* matplotlib, .*; pip install matplotlib', stack)
        stack.enter_context(sim.plot(path))
        sim.drive(0.5, 0.3, seconds=1)
    if path.exists():
        text = path.read_text()
        assert f'{sim.name}, truth' in text
        assert f'{sim.name}, odometry' in text


@pytest.fixture
def programs(tmp_path, monkeypatch):
    """A folder that is the PATH."""
    folder = tmp_path / 'bin'
    folder.mkdir()
    monkeypatch.setenv('PATH', str(folder))
    return folder


def install(folder, text):
    program = folder / 'ffmpeg'
    program.write_text(text)
    program.chmod(0o755)


@pytest.mark.skipif(sys.platform == 'win32', reason='the program is a script')
def test_ffmpeg_is_given_each_picture(sim, tmp_path, programs):
    path = tmp_path / 'drive.mp4'
    with (
        pytest.raises(SimulationError, match='needs the program ffmpeg, which is not on the PATH'),
        sim.film(path),
    ):
        pytest.fail('it has begun')
    install(programs, FFMPEG.format(python=sys.executable))
    with sim.film(path, width=32, height=24, rate=20):
        sim.step(5)
        sim.reset()
        sim.run(0.5)
    words, size = path.read_text().splitlines()
    assert '-s 32x24 -r 20' in words
    assert int(size) == (1 + 11) * 32 * 24 * 3  # begin and end of the half second, too
    install(programs, FAILS)
    with (
        pytest.raises(SimulationError, match='drive.mp4 is not written: no codec'),
        sim.film(path, width=32, height=24),
    ):
        sim.run(0.1)


@pytest.mark.parametrize(
    ('name', 'options', 'words'),
    [
        ('drive.avi', {}, r"a film 'drive.avi'; .webp, .gif, .mp4 will do"),
        ('drive.gif', {'rate': 0.0}, 'a film of 0.0 pictures a second; at most 100'),
        ('nowhere/drive.gif', {}, 'cannot be written: there is no folder .*nowhere'),
    ],
)
def test_what_cannot_be_filmed_is_said_before_it_begins(sim, tmp_path, name, options, words):
    with (
        pytest.raises(SimulationError, match=words),
        sim.film(tmp_path / name, **options),
    ):
        pytest.fail('it has begun')


def test_filming_changes_nothing(sim, tmp_path, programs):
    def drive():
        sim.reset()
        sim.drive(0.5, 0.3, seconds=0.5)
        return sim.truth, sim.odometry

    before = drive()
    install(programs, FFMPEG.format(python=sys.executable))
    with sim.film(tmp_path / 'drive.mp4', width=32, height=24):
        assert drive() == before
    assert sim._published.publisher.observers == []
