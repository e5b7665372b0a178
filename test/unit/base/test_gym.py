# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Robots as environments of Gymnasium, and docs/learning.md.

Gymnasium is there where the simulation is tested without ROS: test/tooling/test_engine.py runs
this file there.
"""

from importlib.util import find_spec
import subprocess
import sys
import warnings

import numpy as np
import pytest
from support.doc_pages import Page
from support.paths import ROOT

from amr_description.errors import AmrError, SimulationError, UsageError

HAS_GYMNASIUM = find_spec('gymnasium') is not None
needs_gymnasium = pytest.mark.skipif(
    not HAS_GYMNASIUM, reason='with gymnasium, by test/tooling/test_engine.py'
)
PAGE = Page('learning.md')
DRIVE = {'linear': (-0.5, 0.5), 'angular': (-1.0, 1.0)}
ARM = """<robot name="arm">
  <link name="base"><inertial><mass value="5"/>
    <inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="lever"><inertial><mass value="0.5"/>
    <inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="hinge" type="revolute"><parent link="base"/><child link="lever"/>
    <axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="10" velocity="2"/></joint>
  <ros2_control name="arm" type="system">
    <hardware><plugin>gz_ros2_control/GazeboSimSystem</plugin></hardware>
    <joint name="hinge"><command_interface name="position"/>
      <state_interface name="position"/><state_interface name="velocity"/></joint>
  </ros2_control>
</robot>"""
CONTROLLERS = """
controller_manager:
  ros__parameters:
    update_rate: 100
    joint_state_broadcaster: {type: joint_state_broadcaster/JointStateBroadcaster}
    arm: {type: forward_command_controller/ForwardCommandController}
arm:
  ros__parameters: {joints: [hinge], interface_name: position}
"""


@pytest.mark.skipif(HAS_GYMNASIUM, reason='gymnasium is there')
def test_without_gymnasium_one_line_says_what_to_install():
    with pytest.raises(ModuleNotFoundError, match=r"pip install 'amr-description\[gym\]'"):
        import amr_description.gym  # noqa: F401


@pytest.fixture
def env_of():
    from amr_description.gym import RobotEnv

    made = []

    def make(kind=RobotEnv, *given, **options):
        made.append(kind(*given, **options))
        return made[-1]

    yield make
    for each in made:
        each.close()


def episode(env, seed, count=15):
    found = [env.reset(seed=seed)[0]]
    env.action_space.seed(seed)
    found += [env.step(env.action_space.sample())[0] for _ in range(count)]
    return np.concatenate([value.ravel() for each in found for _, value in sorted(each.items())])


@needs_gymnasium
def test_gymnasium_finds_nothing_wrong(env_of):
    import gymnasium
    from gymnasium.utils.env_checker import check_env

    import amr_description.gym  # noqa: F401

    with warnings.catch_warnings(record=True) as said:
        env = gymnasium.make('amr_description/DriveToGoal-v0', render_mode='rgb_array')
        check_env(env.unwrapped)
        env.reset(seed=1)
        assert env.render().shape == (480, 640, 3)
        env.close()
    # Advice of what learns best, which wrappers of Gymnasium follow.
    assert all('recommend' in str(w.message) or 'infinity' in str(w.message) for w in said)


@needs_gymnasium
def test_the_same_seed_gives_the_same_bits(env_of):
    from amr_description.gym import DriveToGoal

    first, second = env_of(DriveToGoal), env_of(DriveToGoal)
    episode(second, 3)
    assert (episode(first, 5) == episode(second, 5)).all()
    assert (episode(first, 6) != episode(second, 5)).any()


@needs_gymnasium
def test_the_goal_is_rewarded_and_ends_the_episode(env_of):
    from amr_description.gym import DriveToGoal

    env = env_of(DriveToGoal)
    observed, _ = env.reset(seed=1)
    total, is_there, is_over = 0.0, False, False
    while not (is_there or is_over):
        ahead, left = observed['goal']
        observed, reward, is_there, is_over, _ = env.step(np.array([ahead, 2.0 * left]))
        total += reward
    assert is_there
    assert total == pytest.approx(1 + np.hypot(*env.goal) - env._distance)


@needs_gymnasium
def test_time_truncates_and_what_is_seen_has_its_names(env_of):
    given = {'actions': DRIVE, 'observations': ['odometry', 'joints', 'truth'], 'seconds': 1.0}
    env = env_of(**given)
    assert {name: space.shape for name, space in env.observation_space.items()} == {
        'odometry': (5,), 'joints': (8,), 'truth': (5,)
    }  # fmt: skip
    env.reset(seed=1)
    steps = [env.step(np.array([0.5, 0.0])) for _ in range(9)]
    assert [step[3] for step in steps] == [False] * 8 + [True]
    assert steps[-1][0]['truth'][0] == pytest.approx(0.43, abs=0.02)
    assert steps[-1][4] == {'time': pytest.approx(1.0)}


@needs_gymnasium
def test_a_topic_of_a_controller_is_an_action(env_of, tmp_path):
    file = tmp_path / 'arm.yaml'
    file.write_text(CONTROLLERS)
    actions = {'/arm/commands': [(-1.0, 1.0)]}
    env = env_of(_robot_env(), ARM, str(file), actions=actions, observations=['joints'])
    env.reset(seed=1)
    for _ in range(20):
        observed, *_ = env.step(np.array([0.5]))
    assert observed['joints'][0] == pytest.approx(0.5, abs=0.05)


def _robot_env():
    from amr_description.gym import RobotEnv

    return RobotEnv


@needs_gymnasium
@pytest.mark.parametrize(
    ('options', 'words'),
    [
        ({'actions': {'speed': (0, 1)}}, '\'speed\' is no action; "linear"'),
        ({'actions': {'linear': (1, 0)}}, "bounds of 'linear' are (1, 0); (lower, upper) will do"),
        ({'actions': {'linear': 'much'}}, "bounds of 'linear' are 'much'; (lower, upper)"),
        ({'actions': {'/x/commands': [(0, np.nan)]}}, '[(lower, upper), …] will do'),
        ({'actions': {'/x/commands': [(0, 1)]}}, "no controller subscribes to '/x/commands'"),
        ({'observations': ['speed']}, '\'speed\' cannot be observed by name; "odometry"'),
        ({'observations': ['scan']}, 'has a topic of sensor_msgs/msg/LaserScan'),
        ({'period': 0.0015}, 'a period of 0.0015 s; a multiple of the time step of 0.002 s'),
        ({'render_mode': 'human'}, "render_mode is 'human'; 'rgb_array' or None will do"),
    ],
)
def test_what_cannot_be_is_one_line(env_of, options, words):
    with pytest.raises((UsageError, SimulationError)) as caught:
        env_of(**{'actions': DRIVE, 'observations': ['odometry'], **options})
    assert words in str(caught.value)
    assert '\n' not in str(caught.value)


@needs_gymnasium
@pytest.mark.parametrize('action', [np.array([0.1]), np.array([0.1, np.nan])])
def test_an_action_that_is_none_is_one_line(env_of, action):
    env = env_of(actions=DRIVE, observations=['truth'])
    env.reset(seed=1)
    with pytest.raises(AmrError, match='2 finite numbers will do: "linear", "angular"'):
        env.step(action)


@needs_gymnasium
@pytest.mark.parametrize('block', PAGE.blocks('python'))
def test_a_block_of_the_page_holds(block, capsys):
    PAGE.run(block)
    assert capsys.readouterr().out


@needs_gymnasium
def test_the_example_learns(tmp_path):
    program = [sys.executable, ROOT / 'examples' / 'learn_to_drive.py']
    options = ['--generations', '2', '--population', '4', '--goals', '2']
    done = subprocess.run(
        [*program, *options], cwd=tmp_path, text=True, capture_output=True, timeout=600
    )
    assert done.returncode == 0, done.stderr
    first, second, last = done.stdout.splitlines()
    assert first.startswith('generation 0: ') and second.startswith('generation 1: ')
    assert last.endswith(' of 2 goals reached')
    assert np.load(tmp_path / 'policy.npy').shape == (2, 4)
