# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Recordings of a simulation without ROS: what is in the bag, and what cannot be."""

from dataclasses import dataclass
import sys

import pytest
from support.paths import ROOT

from amr_description import Simulation
from amr_description.bag import run_description
from amr_description.bag.reader import BagReader
from amr_description.control.contracts import Controller, Output, Port
from amr_description.control.samples import TwistSample
from amr_description.errors import AmrError, SimulationError
from amr_description.messages.commands import plain_message
from amr_description.model.frames import Transform
from amr_description.parameters import parameter

URDF = ROOT / 'urdf' / 'amr.urdf'
SENSORS = ROOT / 'urdf' / 'amr_sensors.urdf.xacro'
CMD_VEL = '/diff_drive_controller/cmd_vel'


@dataclass(frozen=True)
class NoParameters:
    """Of a controller."""

    rate: int = parameter(0, 'None')


class Speaker(Controller):
    """Publishes messages of a package that is not here."""

    parameters_type = NoParameters

    def configure(self, parameters):
        self._said = Output(Port('~/said', 'my_msgs/msg/It', convert=f'{__name__}:write'))

    def outputs(self):
        return (self._said,)

    def activate(self, commands, states, time):
        """Nothing is taken."""

    def deactivate(self, time):
        """Nothing is let go."""

    def update(self, time, period):
        self._said.send(time)


def write(sample, message):
    message.data = sample


def read(path):
    """Topic → (time in s, message) of each."""
    found = {}
    with BagReader(path) as reader:
        types = {name: topic.type for name, topic in reader.topics.items()}
        for each in reader.messages():
            message = plain_message(types[each.topic], each.data)
            found.setdefault(each.topic, []).append((each.log_time / 1e9, message))
    return found


def raw(path):
    with BagReader(path) as reader:
        return [(each.topic, each.log_time, each.data) for each in reader.messages()]


def bytes_of(folder):
    return [path.read_bytes() for path in sorted(folder.glob('*.mcap'))]


def test_what_is_published_is_in_the_bag(tmp_path):
    with Simulation(SENSORS, world='walls', record=tmp_path / 'bag') as sim:
        sim.drive(0.5, 0.0, seconds=1, stop=False)
        odometry, truth = sim.odometry, sim.truth
        sim.step()  # the tick of this instant
        ranges = sim.scan.ranges
    found = read(tmp_path / 'bag')
    time, last = found['/odom'][-1]
    assert last.pose.pose.position.x == pytest.approx(odometry.x, abs=0.02)
    time, last = found['/ground_truth/odom'][-1]
    assert (time, last.pose.pose.position.x) == (1.0, truth.x)
    assert [time for time, _ in found['/scan']] == pytest.approx([k / 10 for k in range(11)])
    assert len(found['/scan'][-1][1].ranges) == len(ranges)
    assert [time for time, _ in found['/clock']] == pytest.approx([k / 100 for k in range(101)])
    assert [message.twist.linear.x for _, message in found[CMD_VEL]] == [0.5] * 10
    assert len(found['/camera/image'][0][1].data) == 320 * 240 * 3
    links = {each.child_frame_id for each in found['/tf_static'][0][1].transforms}
    assert 'lidar_link' in links
    (_, text), *_ = found['/mujoco_sim/run']
    run = run_description.from_text(text.data)
    assert run.parameters == {'camera_renderer': 'rays', 'world': 'walls'}
    assert CMD_VEL in run.commands
    assert found['/robot_description'][0][1].data == run.robots[0].description
    (_, activity), *_ = found['/controller_manager/activity']
    assert {each.name: each.state.label for each in activity.controllers} == {
        'joint_state_broadcaster': 'active',
        'imu': 'active',
        'diff_drive_controller': 'active',
    }


def test_equal_runs_have_equal_files(tmp_path):
    """Each step ends with a message on /clock, as over ROS; the rest is as it would be anyway."""
    with Simulation(URDF) as sim:
        for name, steps in (
            ('one', [100] * 5),
            ('same', [100] * 5),
            ('other', [1, 249, 250]),
        ):
            sim.reset()
            (tmp_path / name).mkdir()
            sim.record(tmp_path / name / 'bag')
            sim.send(CMD_VEL, TwistSample(0, 0.5, 0.1))
            for count in steps:
                sim.step(count)
            sim.end_recording()
    assert bytes_of(tmp_path / 'one' / 'bag') == bytes_of(tmp_path / 'same' / 'bag')
    one, other = (raw(tmp_path / name / 'bag') for name in ('one', 'other'))
    assert [each for each in one if each[0] != '/clock'] == [
        each for each in other if each[0] != '/clock'
    ]
    assert len(other) == len(one) + 1


def test_a_reset_begins_a_file_and_what_is_not_recorded_costs_nothing(tmp_path):
    with Simulation(URDF) as sim:
        sim.run(0.5)
        assert sim._published.publisher.outbox == []
        sim.record(tmp_path / 'bag')
        sim.run(0.1)
        sim.reset()
        sim.run(0.2)
        sim.end_recording()
        sim.end_recording()
        sim.run(0.1)
    with BagReader(tmp_path / 'bag') as reader:
        files = reader.file_paths
    first, second = (read(path) for path in files)
    assert [time for time, _ in first['/clock']][0] == pytest.approx(0.5)
    assert [time for time, _ in second['/clock']] == pytest.approx([k / 100 for k in range(20)])
    assert second['/mujoco_sim/world'][0][0] == 0.0


def test_sensors_measure_at_time_0_of_each_run(tmp_path):
    with Simulation(SENSORS, world='walls', record=tmp_path / 'bag') as sim:
        for _ in range(3):
            sim.step()
            sim.reset()
        sim.step(51)
    with BagReader(tmp_path / 'bag') as reader:
        files = reader.file_paths
    times = [[time for time, _ in read(file)['/scan']] for file in files]
    assert times == [[0.0], [0.0], [0.0], [0.0, 0.1]]


def test_robots_that_come_and_go_and_controllers_that_change_are_told(tmp_path):
    poses = {'a': Transform(), 'b': Transform((0.0, 2.0, 0.0))}
    with Simulation(URDF, robots=poses, record=tmp_path / 'bag') as sim:
        sim.run(0.1)
        sim.robots['a'].manager.switch(deactivate=['diff_drive_controller'])
        sim.remove('b')
        sim.spawn('c', Transform((0.0, -2.0, 0.0)))
        sim.run(0.1)
    found = read(tmp_path / 'bag')
    runs = [run_description.from_text(message.data) for _, message in found['/mujoco_sim/run']]
    assert [each.name for each in runs[-1].robots] == ['a', 'c']
    assert '/b/diff_drive_controller/cmd_vel' in runs[0].commands
    events = [message for _, message in found['/a/diff_drive_controller/transition_event']]
    assert [each.transition.label for each in events] == ['deactivate', 'transition_success']
    _, activity = found['/a/controller_manager/activity'][-1]
    states = {each.name: each.state.label for each in activity.controllers}
    assert states['diff_drive_controller'] == 'inactive'
    assert found['/b/joint_states'][-1][0] < 0.1
    assert found['/c/joint_states'][0][0] == pytest.approx(0.1)


def test_a_message_without_a_definition_is_left_out_and_said(tmp_path):
    controllers = tmp_path / 'controllers.yaml'
    controllers.write_text(
        'controller_manager: {ros__parameters: {update_rate: 100, '
        f"speaker: {{type: '{__name__}/Speaker'}}}}}}"
    )
    with Simulation(URDF, controllers, record=tmp_path / 'bag') as sim:
        sim.run(0.1)
        assert sim.robot.sample('/speaker/said') is not None
        assert "'/speaker/said' is not recorded" in sim.log
    assert '/speaker/said' not in read(tmp_path / 'bag')


def test_a_folder_that_is_there_is_refused_and_the_recording_goes_on(tmp_path):
    with Simulation(URDF, record=tmp_path / 'bag') as sim:
        sim.run(0.1)
        with pytest.raises(SimulationError, match='bag is there already; another name will do'):
            sim.record(tmp_path / 'bag')
        sim.run(0.1)
    assert len(read(tmp_path / 'bag')['/clock']) == 20


def test_what_is_missing_to_record_is_said(tmp_path, monkeypatch):
    for name in [*sys.modules]:
        if name.split('.')[0] == 'mcap' or name.startswith('amr_description.bag.mcap'):
            monkeypatch.delitem(sys.modules, name)
    monkeypatch.delitem(sys.modules, 'amr_description.simulation.run_recorder', raising=False)
    monkeypatch.setitem(sys.modules, 'mcap', None)
    monkeypatch.setitem(sys.modules, 'mcap.writer', None)
    with Simulation(URDF) as sim, pytest.raises(SimulationError, match='pip install mcap'):
        sim.record(tmp_path / 'bag')
    assert not (tmp_path / 'bag').exists()


def test_a_sample_that_cannot_be_recorded_is_refused(tmp_path):
    class Own(TwistSample):
        pass

    with Simulation(URDF, record=tmp_path / 'bag') as sim:
        with pytest.raises(AmrError, match='nothing writes a Own'):
            sim.send(CMD_VEL, Own(0, 0.1, 0.0))
        sim.end_recording()
        sim.send(CMD_VEL, Own(0, 0.1, 0.0))
