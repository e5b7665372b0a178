# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Which bags can be run again, what of them differs, and that runs again are the same."""

from dataclasses import replace

import pytest
from support.paths import ROOT
from support.small_bags import string

from amr_description import Simulation
from amr_description.bag.mcap_writer import BagWriter
from amr_description.bag.run_description import RunDescription, RunRobot, TOPIC, TYPE
from amr_description.bag.storage import BagMessage, TopicMetadata
from amr_description.errors import BagError, SimulationError
from amr_description.model.frames import Transform
from amr_description.simulation.recorded_run import (
    Delay,
    delays,
    Difference,
    differences,
    digest,
    read_run,
    simulation_of,
)

AMR = ROOT / 'urdf' / 'amr.urdf'
CMD_VEL = '/diff_drive_controller/cmd_vel'
MS = 10**6
ROBOT = RunRobot('amr', '/', (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0), '<robot name="amr"/>')
RUN = RunDescription(robots=(ROBOT,), commands=('/say',)).to_text()
BEGIN = [(0, TOPIC, RUN), (0, '/clock', ''), (10, '/clock', '')]


def bag(folder, *parts):
    """Write a bag of (ms, topic, text), a file for each part; its topics are all of String."""
    with BagWriter(folder) as writer:
        for name in {each[1]: None for part in parts for each in part}:
            writer.add_topic(TopicMetadata(name, TYPE))
        for number, part in enumerate(parts):
            if number:
                writer.split()
            for time, name, text in part:
                writer.write(BagMessage(name, string(text), time * MS, time * MS))
    return folder


def test_the_last_part_is_run_and_stops_where_it_is_commanded(tmp_path):
    part = [*BEGIN, (10, '/say', 'a'), (10, '/say', 'b'), (20, '/clock', ''), (20, '/heard', 'c')]
    run = read_run(bag(tmp_path / 'bag', [(0, '/heard', 'before')], part))
    assert [(each.time, [m.data for _, m in each.commands]) for each in run.instants] == [
        (10 * MS, ['a', 'b']),
        (20 * MS, []),
    ]
    assert (run.seconds, run.commands) == (0.02, 2)
    assert run.messages['/heard'] == [(20 * MS, digest(string('c')))]
    assert TOPIC not in run.messages


def test_it_stops_where_a_step_has_ended_between_two_cycles(tmp_path):
    times = [0, 4, 8, 12, 13, 16, 20, 24]
    part = [BEGIN[0], *((time, '/clock', '') for time in times)]
    run = read_run(bag(tmp_path / 'bag', part))
    assert [each.time // MS for each in run.instants] == [13, 24]


@pytest.mark.parametrize(
    ('part', 'why'),
    [
        (BEGIN[1:], '/mujoco_sim/run is not in it; record by the parameter'),
        (BEGIN[:1], 'no time has passed in it'),
        ([BEGIN[0], BEGIN[2]], r'begins at 0\.01 s .* reset the simulation while it records'),
        ([*BEGIN, (20, TOPIC, RUN)], r'at 0\.02 s robots were spawned or controllers switched'),
        ([(0, TOPIC, RunDescription().to_text()), *BEGIN[1:]], 'there is no robot in it'),
    ],
)
def test_what_cannot_be_run_again_is_refused_with_the_reason(tmp_path, part, why):
    with pytest.raises(BagError, match=why):
        read_run(bag(tmp_path / 'bag', part))


@pytest.mark.parametrize('name', [TOPIC, '/say', '/amr/controller_manager/activity'])
def test_a_broken_message_is_refused_with_its_place(tmp_path, name):
    types = dict.fromkeys((TOPIC, '/clock', '/say'), TYPE)
    types['/amr/controller_manager/activity'] = (
        'controller_manager_msgs/msg/ControllerManagerActivity'
    )
    with BagWriter(tmp_path / 'bag') as writer:
        for each, kind in types.items():
            writer.add_topic(TopicMetadata(each, kind))
        for _, each, text in BEGIN:
            writer.write(BagMessage(each, string(text), 0, 0))
        writer.write(BagMessage(name, b'\0\1\0\0\xff\xff\0\0', 0, 0))
    with pytest.raises(BagError, match=f'bag_0.mcap: the message of {name} at 0 s cannot be read'):
        read_run(tmp_path / 'bag')


def test_the_first_difference_of_each_topic_is_found(tmp_path):
    run = read_run(bag(tmp_path / 'bag', [*BEGIN, (10, '/heard', 'a'), (20, '/heard', 'b')]))
    assert differences(run, run) == []
    heard = [(10 * MS, digest(string('a'))), (20 * MS, digest(string('c')))]
    other = replace(run, messages={'/heard': heard, '/clock': []})
    assert differences(run, other) == [
        Difference('/clock', 0, 2, 2),
        Difference('/heard', 20 * MS, 1, 2),
    ]
    assert delays(run, other) == []


def test_pictures_that_were_only_late_or_left_out_in_real_time_are_no_difference(tmp_path):
    heard = [(12, '/heard', 'a'), (30, '/heard', 'c'), (40, '/heard', 'd')]
    run = read_run(bag(tmp_path / 'bag', [*BEGIN, *heard]))
    waited = [
        (time * MS, digest(string(text)))
        for time, text in ((10, 'a'), (20, 'b'), (30, 'c'), (40, 'd'))
    ]
    again = replace(run, messages={**run.messages, '/heard': waited})
    # What no thread measures has no reason to be late.
    assert run.delayed == frozenset()
    assert differences(run, again) == [Difference('/heard', 10 * MS, 4, 4)]
    assert delays(run, again) == []
    run, again = (replace(each, delayed=frozenset({'/heard', '/none'})) for each in (run, again))
    assert differences(run, again) == []
    assert delays(run, again) == [Delay('/heard', late=1, left_out=1)]
    # The other way round it is one: time has waited, and there is less.
    assert differences(again, run) == [Difference('/heard', 10 * MS, 4, 4)]
    assert delays(again, run) == []


def test_topics_of_cameras_and_lidars_may_be_delayed(tmp_path):
    with BagWriter(tmp_path / 'bag') as writer:
        for name, kind in (('/image', 'Image'), ('/scan', 'LaserScan'), ('/imu', 'Imu')):
            writer.add_topic(TopicMetadata(name, f'sensor_msgs/msg/{kind}'))
        for time, name, text in BEGIN:
            writer.add_topic(TopicMetadata(name, TYPE))
            writer.write(BagMessage(name, string(text), time * MS, time * MS))
        writer.write(BagMessage('/image', b'x' * 10**6, 0, 0))
    run = read_run(tmp_path / 'bag')
    assert run.delayed == {'/image', '/scan'}
    ((_, kept),) = run.messages['/image']
    assert len(kept) == 16, 'a bag of pictures may be larger than memory'


def again(folder, run, **options):
    """The run, driven again in this process and recorded."""
    with simulation_of(Simulation, run, folder, record=folder / 'again', **options) as sim:
        sim.replay(run)
    return read_run(folder / 'again')


def test_a_recorded_drive_is_driven_again_byte_for_byte(tmp_path):
    with Simulation(AMR, world='ramp', parameters={'seed': 7}, record=tmp_path / 'bag') as sim:
        sim.drive(0.5, 0.2, seconds=0.7)
        sim.reset()
        sim.send(CMD_VEL, {'twist': {'linear': {'x': 0.4, 'y': 0.1}, 'angular': {'x': 0.3}}})
        sim.step(13)
        sim.drive(0.3, -0.4, seconds=0.4, stop=False)
    run = read_run(tmp_path / 'bag')
    assert run.commands >= 5
    assert differences(run, again(tmp_path, run)) == []
    with Simulation(AMR, world='ramp', parameters={'seed': 7}) as sim:
        sim.replay(tmp_path / 'bag')
        assert sim.time == pytest.approx(run.seconds, abs=0.01)
        assert sim.odometry.linear[0] > 0.1


def test_a_fleet_is_driven_again(tmp_path):
    poses = {'a': Transform(), 'b': Transform((0.0, 2.0, 0.0))}
    with Simulation(AMR, robots=poses, record=tmp_path / 'bag') as sim:
        sim.drive_all({'a': (0.4, 0.1), 'b': (-0.4, 0.3)}, seconds=0.5)
    run = read_run(tmp_path / 'bag')
    assert differences(run, again(tmp_path, run)) == []


def test_all_parameter_files_are_in_the_bag(tmp_path):
    more = tmp_path / 'more.yaml'
    more.write_text('diff_drive_controller:\n  ros__parameters:\n    wheel_radius: 0.09\n')
    given = [ROOT / 'config' / 'controllers.yaml', more]
    with Simulation(AMR, given, record=tmp_path / 'bag') as sim:
        sim.drive(0.5, 0.2, seconds=0.5)
    run = read_run(tmp_path / 'bag')
    more.unlink()
    assert len(run.description.controllers) == 2
    assert differences(run, again(tmp_path, run)) == []


def test_what_was_changed_differs(tmp_path):
    with Simulation(AMR, record=tmp_path / 'bag') as sim:
        sim.drive(0.5, 0.2, seconds=0.5)
    run = read_run(tmp_path / 'bag')
    other = replace(run, instants=tuple(each._replace(commands=()) for each in run.instants))
    assert {'/odom', CMD_VEL} <= {each.topic for each in differences(run, again(tmp_path, other))}


def test_a_robot_that_has_not_what_was_commanded_says_so(tmp_path):
    with Simulation(AMR, record=tmp_path / 'bag') as sim:
        sim.drive(0.5, 0.2, seconds=0.3)
    with Simulation(AMR, activate=['joint_state_broadcaster']) as sim:
        with pytest.raises(SimulationError, match=f"no controller subscribes to '{CMD_VEL}'"):
            sim.replay(tmp_path / 'bag')
        with pytest.raises(BagError, match='nowhere'):
            sim.replay(tmp_path / 'nowhere')
