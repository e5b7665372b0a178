# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What the pages say of simulations, robots, controllers and hardware holds without ROS, too.

Only the import of the class is another one. That docs/simulation.md runs where no ROS is, is in
test/tooling/test_engine.py.
"""

import re

import pytest
from support.doc_pages import install, Page, ROOT

from amr_description import Simulation

TESTING = Page('test_your_robot.md')
OVER_ROS = 'from amr_description.testing.simulation import Simulation'
BLOCKS = [block for block in TESTING.blocks('python') if OVER_ROS in block]
FRONT, _ = Page('../README.md').blocks('python')  # the other: test_docs_trials.py
CONTROLLER = Page('write_your_own_controller.md')
PAGE = Page('simulation.md')
WORLD = """
<mujoco>
  <worldbody>
    <geom type="plane" size="0 0 1"/>
    <geom type="box" pos="1.5 0 0.25" size="0.05 2 0.25"/>
  </worldbody>
</mujoco>
"""


def without_ros(block):
    assert OVER_ROS in block
    return block.replace(OVER_ROS, 'from amr_description import Simulation')


@pytest.mark.parametrize('block', BLOCKS, ids=range(len(BLOCKS)))
def test_a_block_of_the_page_about_tests_holds(block):
    TESTING.run(without_ros(block))


def test_the_block_of_the_front_page_holds(monkeypatch):
    monkeypatch.chdir(ROOT / 'examples' / 'rover')
    PAGE.run(without_ros(FRONT))


def test_my_own_controller_turns_a_wheel_of_my_own_robot_in_my_own_world(tmp_path, monkeypatch):
    """With the converters that the page has, which know nothing of where a message is from."""
    install(tmp_path, monkeypatch, my_module=CONTROLLER.blocks('python')[0])
    (spinner,) = [block for block in CONTROLLER.blocks('yaml') if 'my_module/MyClass' in block]
    file, world = tmp_path / 'controllers.yaml', tmp_path / 'wall.xml'
    file.write_text(
        'controller_manager:\n  ros__parameters:\n    joint_state_broadcaster:\n'
        f'      type: joint_state_broadcaster/JointStateBroadcaster\n{spinner}'
    )
    world.write_text(WORLD)
    urdf = ROOT / 'urdf' / 'amr_sensors.urdf.xacro'
    with Simulation(
        urdf, file, world=world, activate=['joint_state_broadcaster', 'spinner']
    ) as sim:
        sim.send('/spinner/command', {'data': 1.5})
        sim.run(1.0)
        joint = sim.joints['joint_wheel_front_left']
        assert joint.velocity == pytest.approx(3.0, rel=0.05)
        assert sim.robot.sample('/spinner/angle') == pytest.approx(joint.position, abs=0.05)
        # The wall is 1.45 m before the base, the lidar of the robot in its middle.
        assert sim.scan.ranges[180] == pytest.approx(1.45 - sim.truth.x, abs=0.2)


def test_what_the_page_names_is_there():
    named = set(re.findall(r'\bsim\.(\w+)', PAGE.text)) - {'node', 'wait', 'ask'}
    with Simulation(ROOT / 'urdf' / 'amr.urdf', activate=[]) as sim:
        assert [each for each in sorted(named) if not hasattr(type(sim), each)] == ['world']
        assert sim.world.engine.model.nu > 0
        assert sim.robot.manager.states() == {}
        assert sim.robot.manager.load('joint_state_broadcaster')
        assert sim.robot.manager.configure('joint_state_broadcaster')
        assert sim.robot.manager.switch(activate=['joint_state_broadcaster']) is None
        assert sim.robot.manager.states() == {'joint_state_broadcaster': 'active'}
