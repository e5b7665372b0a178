# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""docs/chain_a_controller.md: its chain drives the shipped robot, and its words are true."""

import re

import pytest
from support.control_fakes import collect, FakeController
from support.doc_pages import install, mocked, Page, Robot, ROOT
import yaml

from amr_description.cli.control import VERBS
from amr_description.clock import NANOSECONDS
from amr_description.control.samples import TwistSample
from amr_description.errors import ControllerError
from amr_description.log import Severity

PAGE = Page('chain_a_controller.md')
CIRCLE, CHAINABLE = PAGE.blocks('python')
TABLE, FALLBACK = PAGE.tables()
SHIPPED = {
    node.removeprefix('/**/'): table
    for node, table in yaml.safe_load((ROOT / 'config/controllers.yaml').read_text()).items()
}
(MOCK,) = Page('write_your_own_controller.md').blocks('xml')
DRIVE = 'diff_drive_controller'


@pytest.fixture
def package(tmp_path, monkeypatch):
    """The reader's package, where Python finds it."""
    install(tmp_path, monkeypatch, circle=CIRCLE, chainable=CHAINABLE)


@pytest.fixture
def robot(package):
    """The shipped controllers, all active, and circle, configured."""
    robot = Robot(mocked(MOCK)).load(SHIPPED)
    robot.switch(f'{DRIVE} joint_state_broadcaster')
    return robot.load(TABLE)


def is_chained(robot):
    return robot.controllers[DRIVE].is_chained


def command(robot, linear):
    """Send a Twist as a teleoperator would."""
    return robot.controllers[DRIVE].inputs()[0].put(TwistSample(robot.time, linear, 0.0))


def test_the_circle_of_the_page_is_driven(robot):
    odometry = collect(robot.controllers[DRIVE].outputs()[0])
    robot.switch('circle')
    robot.run(2.0)
    assert is_chained(robot)
    found, values = odometry[-1], TABLE['circle']['ros__parameters']
    speed, radius = values['speed'], values['radius']
    assert (found.linear, found.angular) == pytest.approx((speed, speed / radius))
    # The wheels of this controller's skid-steered robot are mocked: they do just as told.
    centre_distance = (found.x**2 + (found.y - radius) ** 2) ** 0.5
    assert centre_distance == pytest.approx(radius, abs=1e-3)


def test_the_mode_changes_by_itself_and_topics_count_only_without_the_chain(robot):
    robot.switch('circle')
    command(robot, -1.0)
    robot.run(0.1)
    assert min(robot.wheels) > 0.0
    assert any("'~/cmd_vel': in chained mode" in text for text in robot.log.texts(Severity.WARN))
    robot.switch('', 'circle')
    assert (is_chained(robot), robot.wheels) == (False, [0.0] * 4)
    command(robot, -1.0)
    robot.run(0.02)
    assert max(robot.wheels) < 0.0


def test_no_time_out_is_applied_in_the_chain(robot):
    robot.switch('circle')
    robot.run(3.0)
    assert min(robot.wheels) > 0.0
    assert robot.time == 3 * NANOSECONDS


def test_the_refusals_of_the_page_are_those_of_the_manager(robot):
    quoted = [text for text in PAGE.quoted() if text.startswith('Unable')]
    robot.switch('', DRIVE)
    said = []
    for setup, request in (('', ('circle', '')), (f'{DRIVE} circle', ('', DRIVE))):
        robot.switch(setup)
        with pytest.raises(ControllerError, match='Unable') as refusal:
            robot.switch(*request)
        said.append(str(refusal.value))
    assert said == quoted


def test_a_second_owner_of_a_reference_is_refused(robot):
    robot.load({'rival': TABLE['circle']})
    robot.switch('circle')
    with pytest.raises(ControllerError, match='is currently claimed by another controller'):
        robot.switch('rival')


def fail(*_):
    raise ControllerError('lost the way')


@pytest.mark.parametrize('failing', ['circle', DRIVE])
def test_when_one_of_the_two_fails_both_go_and_the_wheels_stand(robot, failing):
    robot.switch('circle')
    robot.run(0.1)
    robot.controllers[failing].update = fail
    robot.run(0.01)
    assert robot.active == {'joint_state_broadcaster'}
    assert robot.wheels == [0.0] * 4


def test_the_fallback_of_the_page_obeys_topics_again(package):
    robot = Robot(mocked(MOCK)).load(SHIPPED).load(FALLBACK)
    robot.switch(f'{DRIVE} circle')
    robot.run(0.1)
    robot.controllers['circle'].update = fail
    robot.run(0.01)
    assert (robot.active, is_chained(robot)) == ({DRIVE}, False)
    assert command(robot, 0.5)
    robot.run(0.02)
    assert min(robot.wheels) > 0.0


def test_the_chainable_one_of_the_page_can_be_followed(robot):
    values = {'type': 'my_package.chainable/Chainable', 'speed': 0.25}
    robot.load({'middle': {'ros__parameters': values}})
    robot.manager.load(FakeController('head', ['middle/speed'], ['middle/half_speed']), 'a/Fake')
    robot.manager.configure('head', None)
    robot.switch('middle')
    robot.run(0.1)
    linear = robot.controllers[DRIVE].references()[0]
    assert linear.value == 0.25
    robot.switch('head')
    robot.run(0.03)
    assert linear.value == 3.0  # head commands the count of its updates
    assert robot.controllers['middle'].exported_states()[0].value == 1.5


def test_what_the_page_names_is_there():
    assert PAGE.is_sound()
    assert set(re.findall(r'^ros2 control (\w+)', PAGE.text, re.MULTILINE)) <= VERBS.keys()
