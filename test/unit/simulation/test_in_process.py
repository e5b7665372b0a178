# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A simulation without ROS: what only it has, and what it says of what is wrong."""

from dataclasses import dataclass

import pytest
from support.paths import ROOT

import amr_description
from amr_description import Simulation
from amr_description.control.contracts import Controller, Input, Output, Port
from amr_description.control.interfaces import InterfaceRequest
from amr_description.control.samples import CommandsSample, OdometrySample, TwistSample
from amr_description.errors import AmrError, SimulationError, SpawnError
from amr_description.model.frames import Transform
from amr_description.parameters import parameter
from amr_description.plugin_errors import log_error
from amr_description.sim.spawning import checked_namespace
from amr_description.simulation.local_manager import LogLines

URDF = ROOT / 'urdf' / 'amr.urdf'
CMD_VEL = '/diff_drive_controller/cmd_vel'
WHEEL = 'joint_wheel_front_left'


@pytest.fixture(scope='module')
def shared():
    with Simulation(URDF) as sim:
        yield sim


@pytest.fixture
def sim(shared):
    shared.reset()
    return shared


def test_the_package_exports_it_and_nothing_else():
    assert Simulation.__module__ == 'amr_description.simulation.in_process'
    with pytest.raises(AttributeError, match="has no attribute 'Nothing'"):
        _ = amr_description.Nothing


def test_a_reason_is_what_was_logged_without_its_traceback():
    lines = LogLines()
    try:
        raise KeyError('left')
    except KeyError as error:
        reason = log_error(lines.log_of('/arm'), error)
    assert lines.count == 2
    assert lines.errors_since(0, ['/arm']) == [reason]


def test_a_bridge_that_is_none_is_said():
    sim = Simulation(URDF, parameters={'bridge': 'none.yaml'})
    with pytest.raises(SimulationError, match='none.yaml'):
        sim.start()


def test_what_one_raises_at_its_end_keeps_nobody_from_theirs(monkeypatch):
    ended = []

    def shut_down(_time):
        ended.append('manager')
        raise RuntimeError('of a plugin')

    sim = Simulation(URDF)
    sim.start()
    monkeypatch.setattr(sim._loop.managers[0], 'shut_down', shut_down)
    monkeypatch.setattr(sim._instruments, 'close', lambda: ended.append('instruments'))
    with pytest.raises(RuntimeError, match='of a plugin'):
        sim.close()
    assert ended == ['manager', 'instruments']


def test_a_command_is_a_sample_and_acts_from_the_next_step_on(sim):
    sim.step(5)
    sim.send(CMD_VEL, TwistSample(0, 0.5, 0.0))
    assert sim.truth.linear[0] == pytest.approx(0.0, abs=1e-6)
    sim.step(2)
    assert sim.truth.linear[0] > 0.02
    sim.run(0.3)
    assert sim.truth.linear[0] == pytest.approx(0.5, rel=0.02)


def test_a_topic_may_be_written_without_its_slash(sim):
    sim.send(CMD_VEL.removeprefix('/'), TwistSample(0, 0.2, 0.0))
    sim.run(0.3)
    assert sim.truth.linear[0] == pytest.approx(0.2, rel=0.02)


def test_what_a_controller_publishes_is_there_under_its_topic(sim):
    assert sim.robot.sample('/odom') is None
    sim.run(0.1)
    sample = sim.robot.sample('/odom')
    assert isinstance(sample, OdometrySample)
    assert sample.frames.frame_id == 'odom'
    assert sim.robot.sample('/nobody') is None


def test_of_commands_of_two_topics_none_is_sent_when_one_has_no_subscriber(sim):
    with pytest.raises(SimulationError, match="no controller subscribes to '/nobody'; there are"):
        sim.send_all({CMD_VEL: TwistSample(0, 0.5, 0.0), '/nobody': TwistSample(0, 0.5, 0.0)})
    sim.run(0.2)
    assert sim.truth.linear[0] == pytest.approx(0.0, abs=1e-6)


def test_it_logs_what_it_does(sim):
    assert "[INFO] [mujoco_sim]: Spawned 'amr'\n" in sim.log
    sim.send(CMD_VEL, TwistSample(0, 0.1, 0.0))
    sim.run(1.0)
    assert '[WARN] [diff_drive_controller]: Velocity command timed out' in sim.log
    assert sim.is_alive


@pytest.mark.parametrize(
    ('arguments', 'words'),
    [
        ({'urdf': 'no.urdf'}, 'no.urdf'),
        ({'urdf': '<robot'}, 'line 1'),
        ({'controllers': 'no.yaml'}, 'no.yaml'),
        ({'world': 'mars'}, "world 'mars': neither a file nor a shipped world"),
        ({'activate': ['nobody']}, 'nobody'),
        ({'parameters': {'on_fault': 'cry'}}, 'on_fault'),
        ({'parameters': {'seed': -1}}, "'seed' must be at least 0"),
        ({'rtf': -1.0}, 'rtf is -1.0'),
        ({'name': 'a', 'robots': {'b': Transform()}}, "name is 'a', and robots have the names"),
        ({'pose': Transform((float('nan'), 0.0, 0.0))}, 'finite numbers'),
        ({'robots': {'7up': Transform()}}, "namespace is '7up', which ROS does not allow"),
    ],
)
def test_what_cannot_be_started_says_so_in_a_line(arguments, words):
    with (
        pytest.raises(AmrError, match=words) as refusal,
        Simulation(**{'urdf': URDF, **arguments}),
    ):
        pass
    assert '\n' not in str(refusal.value)


def test_a_fault_pauses_if_asked_and_time_goes_on_when_it_is_let(tmp_path):
    world = tmp_path / 'table.xml'
    world.write_text(
        '<mujoco><worldbody><geom name="table" type="box" size="1 1 .1" pos="0 0 -.1"/>'
        '</worldbody></mujoco>'
    )
    beside = Transform((5.0, 0.0, 0.0))
    with Simulation(URDF, world=world, pose=beside, parameters={'on_fault': 'pause'}) as sim:
        with pytest.raises(SimulationError, match='of 500 steps were not made'):
            sim.step(500)
        fallen = sim.time
        assert 'paused, as on_fault says; run() and step() let time go on' in sim.log
        sim.run(0.1)
        assert sim.time == pytest.approx(fallen + 0.1)


@pytest.mark.parametrize('namespace', ['7up', 'a b', 'a//b', 'é', 'a' * 250])
def test_a_namespace_that_ros_does_not_allow_is_refused(namespace):
    with pytest.raises(SpawnError, match='which ROS does not allow: its parts are letters'):
        checked_namespace(namespace)


def test_outside_of_its_block_it_does_nothing():
    sim = Simulation(URDF)
    with sim:
        sim.run(0.1)
    for read in (lambda: sim.truth, lambda: sim.joints, lambda: sim.time, sim.reset, sim.step):
        with pytest.raises(SimulationError, match='runs inside its block'):
            read()
    sim.start()
    with pytest.raises(SimulationError, match='has been started already'):
        sim.start()
    assert sim.time == 0.0
    sim.close()
    assert not sim.is_alive


def test_robots_come_and_go_in_namespaces_of_their_own():
    poses = {'robot1': Transform(), 'robot2': Transform((0.0, 2.0, 0.0))}
    with Simulation(URDF, robots=poses) as sim:
        sim.drive_all({'robot1': (0.5, 0.0), 'robot2': (-0.5, 0.0)}, seconds=0.5)
        assert sim.robots['robot1'].odometry.x == pytest.approx(0.25, abs=0.01)
        assert sim.robots['robot2'].truth.x == pytest.approx(-0.25, abs=0.01)
        assert sim.robots['robot2'].command_topic == '/robot2/diff_drive_controller/cmd_vel'
        sim.remove('robot1')
        before = sim.time
        sim.spawn('robot3', Transform((0.0, -2.0, 0.0)))
        assert (list(sim.robots), sim.time) == (['robot2', 'robot3'], before)
        sim.run(0.1)
        assert sim.robots['robot3'].truth.y == pytest.approx(-2.0, abs=1e-3)
        with pytest.raises(SimulationError, match=r"no robot 'robot1'; did you mean robot\d or "):
            sim.remove('robot1')
        with pytest.raises(SimulationError, match='another name will do'):
            sim.spawn('robot2')


def test_a_robot_that_cannot_be_spawned_leaves_nothing():
    with Simulation(URDF, robots={'one': Transform()}) as sim:
        with pytest.raises(SimulationError, match='finite numbers'):
            sim.spawn('two', Transform((float('inf'), 0.0, 0.0)))
        assert list(sim.robots) == ['one']
        sim.spawn('two', Transform((0.0, 2.0, 0.0)))
        sim.run(0.1)


@dataclass(frozen=True)
class SpinnerParameters:
    joint: str = parameter('', 'The joint to turn', not_empty=True)
    gain: float = parameter(1.0, 'Speed for a command of 1', unit='rad/s', above=0.0)


class Spinner(Controller):
    """As docs/write_your_own_controller.md has it, but for its converters."""

    parameters_type = SpinnerParameters

    def configure(self, parameters):
        self._parameters = parameters
        self._input = Input(Port('~/command', 'std_msgs/msg/Float64', sample=CommandsSample))
        self._output = Output(Port('~/angle', 'std_msgs/msg/Float64', 'no_such.module:fill'))

    def command_interfaces(self):
        return InterfaceRequest.individual([f'{self._parameters.joint}/velocity'])

    def state_interfaces(self):
        return InterfaceRequest.individual([f'{self._parameters.joint}/position'])

    def inputs(self):
        return (self._input,)

    def outputs(self):
        return (self._output,)

    def activate(self, commands, states, time):
        (self._speed,), (self._angle,) = commands, states
        self._speed.value = 0.0

    def update(self, time, period):
        for command in self._input.drain():
            self._speed.value = self._parameters.gain * command.values[0]
        self._output.send(self._angle.value)


def spinner_file(tmp_path, **parameters):
    file = tmp_path / 'controllers.yaml'
    rows = ''.join(f'\n    {name}: {value}' for name, value in parameters.items())
    file.write_text(
        'controller_manager:\n  ros__parameters: {update_rate: 50}\n'
        f'spinner:\n  ros__parameters:\n    type: {__name__}/Spinner{rows}\n'
    )
    return file


def test_a_controller_of_the_user_needs_nothing_else(tmp_path):
    file = spinner_file(tmp_path, joint=WHEEL, gain=2.0)
    with Simulation(URDF, file, activate=['spinner']) as sim:
        sim.send('/spinner/command', CommandsSample((1.5,)))
        sim.run(1.0)
        assert sim.robot.sample('/spinner/angle') == pytest.approx(3.0, rel=0.05)
        assert sim.robot.command_topic == ''
        with pytest.raises(SimulationError, match='no controller that drives'):
            sim.drive(0.1, 0.0, seconds=1.0)


def test_a_drive_behind_a_mux_is_driven_by_the_topic_of_the_highest_priority(tmp_path):
    file = tmp_path / 'mux.yaml'
    file.write_text("""
/**/controller_manager:
  ros__parameters:
    mux: {type: twist_mux_controller/TwistMuxController}
/**/mux:
  ros__parameters:
    cmd_vel_inputs: {manual: {priority: 2}, autonomous: {priority: 1}}
    command_interface_linear_x: diff_drive_controller/linear/velocity
    command_interface_angular_z: diff_drive_controller/angular/velocity
""")
    with Simulation(URDF, [ROOT / 'config' / 'controllers.yaml', file]) as sim:
        assert sim.robot.command_topic == '/manual/cmd_vel'
        sim.drive(0.2, 0.0, seconds=1.0)
        assert sim.truth.x == pytest.approx(0.2, rel=0.1)
        assert sim.robot.sample('/mux/source') == 'manual'
        assert sim.odometry.x == pytest.approx(sim.truth.x, abs=0.01)


@pytest.mark.parametrize(
    ('parameters', 'words'),
    [
        ({}, "parameter 'joint' must not be empty"),
        ({'joint': WHEEL, 'gain': -1.0}, "parameter 'gain' must be greater than 0, found -1.0"),
        ({'joint': WHEEL, 'gain': 'fast'}, "parameter 'gain' must be of type double"),
        ({'joint': 'nowhere'}, "'nowhere/velocity'"),
    ],
)
def test_a_parameter_that_is_no_good_is_named(tmp_path, parameters, words):
    file = spinner_file(tmp_path, **parameters)
    with (
        pytest.raises(AmrError, match=words) as refusal,
        Simulation(URDF, file, activate=['spinner']),
    ):
        pass
    assert '\n' not in str(refusal.value)
    with pytest.warns(UserWarning, match=words), Simulation(URDF, file) as sim:
        sim.run(0.1)  # all others go on


def test_ctrl_c_in_the_middle_of_a_drive_leaves_it_usable(sim, monkeypatch):
    calls = []

    def interrupt(count):
        calls.append(count)
        raise KeyboardInterrupt

    with monkeypatch.context() as patch:
        patch.setattr(sim.world.engine, 'step', interrupt)
        with pytest.raises(KeyboardInterrupt):
            sim.run(1.0)
    sim.run(0.1)
    assert (len(calls), sim.time) == (1, 0.1)


def test_a_joint_that_has_no_state_is_told_those_that_have(sim):
    sim.step()
    assert sim.joints[WHEEL].position == pytest.approx(0.0, abs=0.01)
    with pytest.raises(
        SimulationError, match=r"no joint 'joint_wheel_front_lef' has a state; did"
    ):
        _ = sim.joints['joint_wheel_front_lef']
    with pytest.raises(SimulationError, match=r'<ros2_control> gives a joint one, by <state_i'):
        _ = sim.joints['a_mimic_that_is_in_the_urdf_alone']
    with pytest.raises(SimulationError, match=r"no robot 'amz'; did you mean amr\?; there a"):
        _ = sim.robots['amz']
    assert 'nothing' not in sim.joints
    assert sim.joints.get('nothing') is None
