# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A law: in this process and over DDS a simulation has the same bits.

The truth, odometry, joint states and scans of every kind of robot, after drives that nobody would
think of. A drive begins with a reset, so that one that fails does so by itself.
"""

from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
import warnings

from fixtures.sim.plugin_robot import cart, classic_drive
from hypothesis import given, strategies as st
import pytest
from support.examples import examples
from support.paths import ROOT

from amr_description import Simulation
from amr_description.bag.reader import BagReader
from amr_description.errors import SimulationError
from amr_description.model.frames import Transform
from amr_description.simulation.recorded_run import differences, read_run
from amr_description.testing.simulation import Simulation as SimulationOverDds

FIXTURES = ROOT / 'test' / 'fixtures'


@dataclass(frozen=True)
class Case:
    urdf: Path | str
    controllers: Path | None = None
    world: str = 'empty'
    pose: Transform = Transform()
    positions: str = ''
    """The topic of a controller of two positions, for what does not drive."""


CASES = {
    'shipped': Case(ROOT / 'urdf' / 'amr.urdf', world='ramp'),
    'sensors': Case(ROOT / 'urdf' / 'amr_sensors.urdf.xacro', world='walls'),
    'plugins': Case(cart(classic_drive()), pose=Transform((0.3, -0.2, 0.1))),
    'cart': Case(FIXTURES / 'urdf_good' / 'cart.urdf', FIXTURES / 'urdf_good' / 'cart.yaml'),
    'rover': Case(
        ROOT / 'examples' / 'rover' / 'urdf' / 'rover.urdf.xacro',
        ROOT / 'examples' / 'rover' / 'config' / 'rover.yaml',
        world='kerbs',
    ),
    'arm': Case(FIXTURES / 'urdf' / 'arm.urdf', positions='/forward_position_controller/commands'),
}
ARM = """
controller_manager:
  ros__parameters:
    update_rate: 100
    joint_state_broadcaster: {type: joint_state_broadcaster/JointStateBroadcaster}
    forward_position_controller: {type: forward_command_controller/ForwardCommandController}
joint_state_broadcaster:
  ros__parameters: {update_rate: 50}
forward_position_controller:
  ros__parameters: {joints: [shoulder, left_finger], interface_name: position}
"""

speeds = st.floats(-0.8, 0.8)
drives = st.lists(
    st.tuples(speeds, speeds, st.sampled_from([0.002, 0.1, 0.134, 0.3]), st.booleans()),
    min_size=1,
    max_size=3,
)


@pytest.fixture(scope='module', params=CASES)
def pair(request, tmp_path_factory):
    """The same robot, in this process and over DDS."""
    case = CASES[request.param]
    controllers = case.controllers
    if request.param == 'arm':
        controllers = tmp_path_factory.mktemp('arm') / 'arm.yaml'
        controllers.write_text(ARM)
    options = {'world': case.world, 'pose': case.pose, 'parameters': {'seed': 3}}
    with ExitStack() as stack, warnings.catch_warnings():
        warnings.simplefilter('ignore')
        yield (
            case,
            *(
                stack.enter_context(kind(case.urdf, controllers, **options))
                for kind in (Simulation, SimulationOverDds)
            ),
        )


def read(sim):
    """All that can be read of a robot; of what it has not, why."""
    return [bits_of(reading, sim) for reading in (truth, odometry, joints, scan)]


def bits_of(reading, sim):
    try:
        return reading(sim)
    except SimulationError as error:
        return str(error)


def truth(sim):
    return sim.truth


def odometry(sim):
    return sim.odometry


def joints(sim):
    return repr(sim.joints)


def scan(sim):
    scan = sim.scan
    return scan.time, scan.frame, scan.ranges.tobytes(), scan.angles.tobytes(), scan.range_max


def driven(sim, case, course):
    sim.reset()
    found = [read(sim)]
    for linear, angular, seconds, stop in course:
        if case.positions:
            sim.send(case.positions, {'data': [linear, angular]})
            sim.run(seconds)
        else:
            sim.drive(linear, angular, seconds=seconds, stop=stop)
        found.append(read(sim))
    return sim.time, found


@given(course=drives)
@examples(5, deadline=None)
def test_the_same_calls_give_the_same_bits(pair, course):
    case, here, there = pair
    assert driven(here, case, course) == driven(there, case, course)


def recorded(folder):
    """Topic → (time, bytes) of each of its messages."""
    found = {}
    with BagReader(folder) as reader:
        for each in reader.messages():
            found.setdefault(each.topic, []).append((each.log_time, each.data))
        return {name: (topic.type, found.get(name)) for name, topic in reader.topics.items()}


def test_recordings_are_the_same_byte_for_byte(pair, tmp_path):
    """Sensors, controllers, managers, transforms, truth, world and run: without exception."""
    case, *both = pair
    for sim, name in zip(both, ('here', 'there'), strict=True):
        sim.reset()
        sim.step()  # time goes back from the tick of time 0
        sim.reset()
        sim.record(tmp_path / name)
        driven(sim, case, [(0.5, 0.2, 0.8, False), (0.0, -0.3, 0.134, True)])
        sim.end_recording()
    here, there = (recorded(tmp_path / name) for name in ('here', 'there'))
    assert here.keys() == there.keys()
    assert [name for name in here if here[name] != there[name]] == []


def test_what_one_way_has_recorded_is_driven_again_the_other_way(pair, tmp_path):
    case, here, there = pair
    for one, other in ((here, there), (there, here)):
        folder = tmp_path / type(one).__module__
        folder.mkdir()
        one.reset()
        one.record(folder / 'bag')
        driven(one, case, [(0.5, 0.2, 0.3, False), (0.1, -0.3, 0.134, True)])
        one.end_recording()
        other.reset()
        other.record(folder / 'again')
        other.replay(folder / 'bag')
        other.end_recording()
        first, second = (read_run(folder / name) for name in ('bag', 'again'))
        assert first.commands
        assert differences(first, second) == []


def test_both_have_the_same_robot(pair):
    case, here, there = pair
    assert here.name == there.name
    assert here.robot.command_topic == there.robot.command_topic
    assert here.timestep == there.timestep
    assert bool(here.robot.command_topic) is not bool(case.positions)
