# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A run of the simulator in a bag: equal runs have equal files, and it can be run again."""

import pytest
from support.paths import ROOT

from amr_description.bag.reader import BagReader
from amr_description.errors import SimulationError
from amr_description.testing.recorded_run import differences, read_run
from amr_description.testing.simulation import Simulation

URDF = ROOT / 'urdf' / 'amr.urdf'


def course(sim, *steps):
    """Drive, reset, and drive again; ``steps``: in which the last part is made."""
    sim.drive(0.5, 0.7, seconds=0.3)
    sim.reset()
    sim.drive(0.4, -0.5, seconds=0.4, stop=False)
    for count in steps:
        sim.step(count)


@pytest.fixture(scope='module')
def bags(tmp_path_factory):
    """The bags of one simulation; ``whole`` is recorded from its start."""
    folder = tmp_path_factory.mktemp('recorded')
    with Simulation(URDF, parameters={'record': str(folder / 'whole')}) as sim:
        sim.end_recording()
        for name, steps in (('first', (50,)), ('second', (20, 20, 10))):
            sim.reset()
            sim.record(folder / name / 'drive')
            course(sim, *steps)
            sim.end_recording()
        with pytest.raises(SimulationError, match='is there already; another name will do'):
            sim.record(folder / 'first')
        sim.reset()
        sim.record(folder / 'third' / 'drive')
        sim.replay(folder / 'first' / 'drive')
    return folder


def test_equal_runs_have_equal_files_however_they_are_stepped(bags):
    first, second = (sorted((bags / name / 'drive').iterdir()) for name in ('first', 'second'))
    assert [path.name for path in first] == ['drive_0.mcap', 'drive_1.mcap', 'metadata.yaml']
    assert [path.name for path in second] == [path.name for path in first]
    for one, other in zip(first, second, strict=True):
        assert one.read_bytes() == other.read_bytes()


def test_every_message_of_a_run_is_there(bags):
    run = read_run(bags / 'first' / 'drive')
    assert [time for time, _ in run.messages['/clock']] == [10**7 * n for n in range(50)]
    counts = {topic: len(messages) for topic, messages in run.messages.items()}
    assert counts['/joint_states'] == 50
    assert counts['/odom'] == counts['/tf'] == counts['/ground_truth/odom'] == 25
    assert counts['/diff_drive_controller/cmd_vel'] == run.commands == 4
    assert counts['/robot_description'] == counts['/mujoco_sim/world'] == 1
    with BagReader(bags / 'first' / 'drive') as reader:
        assert reader.topics['/robot_description'].type == 'std_msgs/msg/String'
        hashes = [topic.type_description_hash for topic in reader.topics.values()]
    assert all(each.startswith('RIHS01_') for each in hashes)
    assert run.active == ('diff_drive_controller', 'joint_state_broadcaster')


def test_recorded_commands_make_the_recorded_drive_again(bags):
    first, third = (read_run(bags / name / 'drive') for name in ('first', 'third'))
    assert len(first.messages) >= 9
    assert differences(first, third) == []


def test_a_recording_from_the_start_has_a_file_for_each_reset(bags):
    with BagReader(bags / 'whole') as reader:
        files = reader.file_paths
    assert len(files) >= 2
    for path in files:
        with BagReader(path) as reader:
            times = [each.log_time for each in reader.messages()]
            assert times == sorted(times)
