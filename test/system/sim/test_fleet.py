# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Ten robots in one simulation, each in its namespace, over real DDS; one goes and comes again."""

from contextlib import contextmanager
from dataclasses import dataclass
from itertools import pairwise
import math

from geometry_msgs.msg import TwistStamped
from nav_msgs.msg import Odometry
import pytest
from simulation_interfaces.srv import GetEntitiesStates
from support.ros_processes import ROOT
from tf2_msgs.msg import TFMessage
import yaml

from amr_description.model.frames import Transform
from amr_description.testing.readings import motion_of_entity
from amr_description.testing.simulation import Simulation

NAMES = [f'robot{number}' for number in range(1, 11)]
STARTS = {
    name: Transform((6.0 * (number % 5), 12.0 * (number // 5), 0.0))
    for number, name in enumerate(NAMES)
}
"""No circle meets another."""
CIRCLES = {
    name: (0.30 + 0.02 * number, (-1) ** number * (0.30 + 0.02 * number) / (0.9 + 0.15 * number))
    for number, name in enumerate(NAMES)
}
"""m/s and rad/s: all different, of radii from 0.9 to 2.25 m, by turns to the left and right."""
GONE = 'robot4'
LENGTHS = [pytest.param(12, id='short'), pytest.param(60, id='minute', marks=pytest.mark.long)]
"""s; GONE is away in the second third."""
LOOK = 2.0
"""s between two looks at all robots, who turn by less than half a turn meanwhile."""


@pytest.fixture(scope='module')
def parameters(tmp_path_factory):
    """The shipped parameters, but for commands that hold until the next; a file."""
    shipped = yaml.safe_load((ROOT / 'config/controllers.yaml').read_text())
    shipped['/**/diff_drive_controller']['ros__parameters']['cmd_vel_timeout'] = 0.0
    path = tmp_path_factory.mktemp('fleet') / 'controllers.yaml'
    path.write_text(yaml.safe_dump(shipped))
    return path


@contextmanager
def simulation(parameters, starts):
    urdf, drive = ROOT / 'urdf/amr.urdf', ['diff_drive_controller']
    with Simulation(urdf, parameters, robots=starts, activate=drive) as sim:
        yield sim


@pytest.fixture(scope='module')
def sim(parameters):
    with simulation(parameters, STARTS) as sim:
        yield sim


def command(sim, *names):
    """Send each to its circle."""
    messages = {}
    for name in names:
        message = TwistStamped()
        message.twist.linear.x, message.twist.angular.z = CIRCLES[name]
        messages[f'/{name}/diff_drive_controller/cmd_vel'] = message
    sim.send_all(messages)


def test_each_speaks_with_its_own_names(sim):
    """One tree of frames a robot: every frame has one parent, of the same robot."""
    odometry, parents = {}, {}

    def listen(name):
        def hear(message):
            found = odometry.setdefault(name, set())
            found.add((message.header.frame_id, message.child_frame_id))

        return sim.node.create_subscription(Odometry, f'/{name}/odom', hear, 10)

    def hear_transforms(message):
        for each in message.transforms:
            parents.setdefault(each.child_frame_id, set()).add(each.header.frame_id)

    listening = [listen(name) for name in NAMES]
    listening.append(sim.node.create_subscription(TFMessage, '/tf', hear_transforms, 100))

    command(sim, *NAMES)

    def all_are_heard():
        sim.run(0.1)
        return len(odometry) == len(parents) == len(NAMES)

    sim.wait(all_are_heard, 'the odometry and the transforms of all')
    for subscription in listening:
        sim.node.destroy_subscription(subscription)
    assert odometry == {name: {(f'{name}/odom', f'{name}/base_footprint')} for name in NAMES}
    assert parents == {f'{name}/base_footprint': {f'{name}/odom'} for name in NAMES}


def names_below(node, namespace):
    """Topics, services and nodes in a namespace."""
    full = (f'{ns.rstrip("/")}/{name}' for name, ns in node.get_node_names_and_namespaces())
    topics, services = node.get_topic_names_and_types(), node.get_service_names_and_types()
    everything = [*full, *(name for name, _ in topics), *(name for name, _ in services)]
    return [name for name in everything if name.startswith(namespace)]


@dataclass(frozen=True)
class Drive:
    """What was seen of all robots in a drive."""

    seconds: int
    comes: float
    """s; when GONE is back."""
    tracks: dict[str, list]
    """Name → truth and odometry after every LOOK, of GONE since it came again."""


@pytest.fixture(scope='module', params=LENGTHS)
def drive(sim, request):
    """All on their circles, from time 0 on."""
    seconds = request.param
    leaves, comes = (LOOK * round(part * seconds / LOOK) for part in (1 / 3, 2 / 3))
    sim.reset()
    command(sim, *NAMES)
    found = {name: [] for name in NAMES}
    for number in range(round(seconds / LOOK)):
        if number == round(leaves / LOOK):
            sim.remove(GONE)
            found[GONE].clear()
            sim.wait(lambda: not names_below(sim.node, f'/{GONE}/'), 'its names to be free')
        if number == round(comes / LOOK):
            sim.spawn(GONE, STARTS[GONE])
            command(sim, GONE)
        sim.run(LOOK)
        sim.wait(lambda: tells_of_now(sim), 'odometry of this time, which is on its way')
        states = sim.ask(GetEntitiesStates)
        for name, state in zip(states.entities, states.states, strict=True):
            found[name].append((motion_of_entity(state), sim.robots[name].odometry))
    return Drive(seconds, comes, found)


def tells_of_now(sim):
    """Whether the last odometry of all robots is of this time, but for a few periods of it."""
    return all(robot.odometry.time > sim.time - 0.1 for robot in sim.robots.values())


def place(motion):
    return motion.x, motion.y


def turned(motions):
    """rad in all."""
    steps = (after.yaw - before.yaw for before, after in pairwise(motions))
    return math.fsum(math.remainder(step, math.tau) for step in steps)


@pytest.mark.parametrize('name', NAMES)
def test_each_drives_its_own_circle_and_knows_it(drive, name):
    truth, odometry = zip(*drive.tracks[name], strict=True)
    speed, rate = CIRCLES[name]
    seconds = LOOK * (len(truth) - 1)
    assert seconds >= drive.seconds - drive.comes - LOOK
    x, y, _ = STARTS[name].translation
    centre = (x, y + speed / rate)
    radii = [math.dist(place(motion), centre) for motion in truth]
    # The limits are those of test_sim_physics; measured: 0.966 to 1.014 of the radius, 1.015 of
    # the turn, and odometry that is 1.2 % of the way from the truth after a minute.
    assert max(radii) < 1.05 * speed / abs(rate)
    assert min(radii) > 0.95 * speed / abs(rate)
    assert turned(truth) == pytest.approx(rate * seconds, rel=0.03)
    told_of = odometry[-1].time - odometry[0].time  # each may be a few periods old
    assert turned(odometry) == pytest.approx(rate * told_of, rel=0.01)
    for true, told in drive.tracks[name]:
        way = speed * (told.time - (drive.comes if name == GONE else 0))
        assert math.dist(place(told), (true.x - x, true.y - y)) < 0.05 * way + 0.02


def test_who_comes_again_begins_at_its_start(drive):
    truth, odometry = drive.tracks[GONE][0]
    x, y, _ = STARTS[GONE].translation
    assert math.dist(place(truth), (x, y)) < LOOK * CIRCLES[GONE][0] + 0.01
    assert math.hypot(*place(odometry)) < LOOK * CIRCLES[GONE][0] + 0.01


@pytest.mark.long
def test_twenty_robots_drive_as_one_does(parameters):
    """Side by side for two minutes; the first of them as the last, to the micrometre."""
    starts = {f'robot{n}': Transform((0.0, 6.0 * n, 0.0)) for n in range(1, 21)}
    speed, rate = 0.4, 0.4
    with simulation(parameters, starts) as sim:
        for _ in range(10):
            sim.drive_all(dict.fromkeys(starts, (speed, rate)), seconds=12, stop=False)
            states = sim.ask(GetEntitiesStates)
            assert sorted(states.entities) == sorted(starts)
            for name, state in zip(states.entities, states.states, strict=True):
                truth, told = motion_of_entity(state), sim.robots[name].odometry
                x, y, _ = starts[name].translation
                assert math.dist(place(truth), (x, y + speed / rate)) < 1.05 * speed / rate
                assert place(told) == pytest.approx(place(sim.robots['robot1'].odometry), abs=1e-6)
                assert sim.time == truth.time
