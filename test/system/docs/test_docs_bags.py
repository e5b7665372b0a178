# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""docs/bags.md, typed as it stands."""

from contextlib import chdir, ExitStack
import re
import signal

from fixtures.cli.commands import started
import pytest
from support.doc_pages import Page
from support.page_lines import command, typed
from support.paths import ROOT
from support.running_programs import Program
from support.small_bags import LATCHED, read_bag, topic, write_bag

from amr_description.testing.simulation import Simulation

PAGE = Page('bags.md')
CLOCK = 'rosgraph_msgs/msg/Clock'


@pytest.fixture(scope='module')
def folder(tmp_path_factory):
    """A folder with my_bag."""
    made = tmp_path_factory.mktemp('bags')
    topics = [topic('/scan'), topic('/robot_description', LATCHED)]
    texts = [(0, '/robot_description', 'robot'), *((n * 100, '/scan', 'x') for n in range(15))]
    write_bag(made / 'my_bag', topics, texts)
    return made


def test_bags_are_cut_joined_and_converted(folder):
    typed(PAGE, 'ros2 bag trim my_bag', folder)
    typed(PAGE, 'ros2 bag filter my_bag', folder)
    typed(PAGE, 'ros2 bag merge part', folder)
    options = re.search(r'```yaml\n(# (smaller.yaml)\n.*?)```', PAGE.text, re.DOTALL)
    (folder / options[2]).write_text(options[1])
    typed(PAGE, 'ros2 bag convert -i my_bag', folder)
    assert typed(PAGE, 'ros2 bag list storage', folder) == 'mcap\nsqlite3\n'
    assert len(read_bag(folder / 'smaller_bag')) == 16
    assert [text for _, _, text in read_bag(folder / 'part')] == ['robot', *'xxxxxx']
    assert [text for _, _, text in read_bag(folder / 'together')] == ['robot', 'robot', *'xxxxxx']


@pytest.mark.parametrize(
    'beginning',
    [
        'ros2 bag play my_bag',
        'ros2 bag play my_bag --rate 4',
        'ros2 bag play my_bag --topics /scan',
        'ros2 bag burst my_bag',
    ],
)
def test_a_bag_is_played(folder, beginning):
    typed(PAGE, beginning, folder)


def test_recordings_begin_and_end(folder):
    lines = (
        'ros2 bag record --topics /scan',
        'ros2 bag record --all',
        'ros2 bag record --regex',
    )
    with ExitStack() as stack:
        # A simulation, for --use-sim-time.
        stack.enter_context(
            started('topic', 'pub', '-r', '20', '/clock', CLOCK, 'clock: {sec: 7}')
        )
        programs = [
            stack.enter_context(Program(*command(PAGE, line), cwd=folder)) for line in lines
        ]
        for program in programs:
            program.expect('Recording...')
        for program in programs:
            program.signal(signal.SIGINT)
        assert [program.end() for program in programs] == [0, 0, 0]
    assert (folder / 'drive' / 'metadata.yaml').exists()


def test_a_simulation_is_recorded_and_driven_again(tmp_path):
    # In the folder of the simulator, as that of a launch is that of the shell.
    with chdir(tmp_path), Simulation(ROOT / 'urdf' / 'amr.urdf') as sim:
        typed(PAGE, 'ros2 param set /mujoco_sim record drive', tmp_path)
        sim.drive(0.5, 0.3, seconds=0.2)
        assert typed(PAGE, "ros2 param set /mujoco_sim record ''", tmp_path)
    said = typed(PAGE, 'ros2 run amr_description replay', tmp_path).splitlines()
    assert re.fullmatch(r'drive: 0\.\d+ s, \d+ commands', said[0])
    assert re.fullmatch(r'equal, byte for byte: \d{3} messages', said[1])
    shown = re.search(r'```text\n(drive: .*?)```', PAGE.text, re.DOTALL)[1].splitlines()
    assert [re.sub(r'[\d.]+', 'N', line) for line in said] == [
        re.sub(r'[\d.]+', 'N', line) for line in shown
    ]


@pytest.mark.parametrize(
    'line',
    [
        'ros2 run amr_description viewer --bag my_bag',
        'ros2 run amr_description viewer --ros-args -p bag_folder',
    ],
)
def test_the_page_shows_a_bag_and_records_one(folder, line):
    with Program(*command(PAGE, line), cwd=folder) as program:
        program.expect('The page is at http://')
        assert program.end(signal.SIGINT) == 0


def test_a_bag_is_looked_at(folder):
    assert 'Messages:          16\n' in typed(PAGE, 'ros2 bag info my_bag', folder)
    assert 'Size Contribution' in typed(PAGE, 'ros2 bag info my_bag --verbose', folder)
    assert typed(PAGE, 'ros2 bag reindex my_bag', folder) == ''
