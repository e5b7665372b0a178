# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A run of the simulator in a bag: equal runs have equal files, and it can be run again."""

from geometry_msgs.msg import TwistStamped
from nav_msgs.msg import Odometry
import numpy as np
import pytest
from rclpy.serialization import deserialize_message
from sensor_msgs.msg import JointState
from simulation_interfaces.msg import SimulationState
from simulation_interfaces.srv import SetSimulationState
from support.paths import ROOT
from tf2_msgs.msg import TFMessage

from amr_description.bag.reader import BagReader
from amr_description.errors import SimulationError
from amr_description.model.kinematics import joint_transform
from amr_description.model.urdf import load
from amr_description.simulation.recorded_run import differences, read_run
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
        in_real_time(sim, folder / 'played' / 'drive')
        for name, again in (('first', 'third'), ('played', 'fourth')):
            sim.reset()
            sim.record(folder / again / 'drive')
            sim.replay(folder / name / 'drive')
            sim.end_recording()
    return folder


def in_real_time(sim, bag):
    """Drive while time passes by itself, by commands that come whenever they come."""
    sim.reset()
    sim.record(bag)
    heard = []
    subscription = sim.node.create_subscription(Odometry, '/odom', heard.append, 10)
    command = TwistStamped()
    command.twist.linear.x, command.twist.angular.z = 0.5, 0.7

    def has_driven():
        sim.send('/diff_drive_controller/cmd_vel', command)
        return heard and heard[-1].pose.pose.position.x > 0.1

    sim._running.set_parameter('real_time_factor', 3.0)  # so that a thread writes
    state = SimulationState
    sim.ask(SetSimulationState, state=state(state=state.STATE_PLAYING))
    sim.wait(has_driven, 'the drive')
    sim.ask(SetSimulationState, state=state(state=state.STATE_PAUSED))
    sim.end_recording()
    sim.node.destroy_subscription(subscription)


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
    assert counts['/odom'] == counts['/ground_truth/odom'] == 25
    assert counts['/tf'] == 25 + 10  # those of odometry, and of links
    assert counts['/diff_drive_controller/cmd_vel'] == run.commands == 4
    assert counts['/robot_description'] == counts['/mujoco_sim/world'] == 1
    with BagReader(bags / 'first' / 'drive') as reader:
        assert reader.topics['/robot_description'].type == 'std_msgs/msg/String'
        hashes = [topic.type_description_hash for topic in reader.topics.values()]
    assert all(each.startswith('RIHS01_') for each in hashes)
    assert run.active == ('diff_drive_controller', 'joint_state_broadcaster')


def test_all_links_have_transforms_as_they_truly_are(bags):
    by_topic = {}
    with BagReader(bags / 'first' / 'drive' / 'drive_1.mcap') as reader:
        for each in reader.messages(['/tf', '/tf_static', '/joint_states']):
            by_topic.setdefault(each.topic, []).append((each.log_time, each.data))
    moving = [deserialize_message(data, TFMessage) for _, data in by_topic['/tf']]
    (fixed,) = [deserialize_message(data, TFMessage) for _, data in by_topic['/tf_static']]
    frames = {each.child_frame_id for message in (*moving, fixed) for each in message.transforms}
    robot = load(URDF)
    assert frames == {link.name for link in robot.links}
    joint = robot.joint('joint_wheel_front_left')
    states = dict(by_topic['/joint_states'])
    for (time, _), message in zip(by_topic['/tf'], moving, strict=True):
        for each in message.transforms:
            if each.child_frame_id == joint.child:
                state = deserialize_message(states[time], JointState)
                angle = state.position[state.name.index(joint.name)]
                expected, found = joint_transform(joint, angle), each.transform.rotation
                assert abs(
                    np.dot(expected.rotation, (found.x, found.y, found.z, found.w))
                ) == pytest.approx(1.0, abs=1e-9)


def test_recorded_commands_make_the_recorded_drive_again(bags):
    first, third = (read_run(bags / name / 'drive') for name in ('first', 'third'))
    assert len(first.messages) >= 9
    assert differences(first, third) == []


def test_so_do_those_of_a_run_in_real_time_which_came_at_any_time(bags):
    played, fourth = (read_run(bags / name / 'drive') for name in ('played', 'fourth'))
    assert played.commands >= 2
    assert differences(played, fourth) == []


def test_a_recording_from_the_start_has_a_file_for_each_reset(bags):
    with BagReader(bags / 'whole') as reader:
        files = reader.file_paths
    assert len(files) >= 2
    for path in files:
        with BagReader(path) as reader:
            times = [each.log_time for each in reader.messages()]
            assert times == sorted(times)
