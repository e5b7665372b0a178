# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A robot that lives through pauses and resets, and one that leaves others behind: over real DDS.

The simulator begins paused, and everything is brought up before time begins.
"""

from collections import defaultdict
from concurrent.futures import ThreadPoolExecutor
from itertools import count, pairwise
import math
import signal
import subprocess

from geometry_msgs.msg import TwistStamped
from nav_msgs.msg import Odometry
import pytest
from rclpy.clock import Clock
from rclpy.parameter import Parameter
from rclpy.time import ClockType
from sensor_msgs.msg import JointState
from simulation_interfaces.msg import SimulationState
from simulation_interfaces.srv import (
    DeleteEntity,
    GetEntityState,
    ResetSimulation,
    SetSimulationState,
    SpawnEntity,
    StepSimulation,
)
from support.preloaded import Popen
from support.ros_processes import command, environment, PATIENCE, run
from support.simulator import simulator, URDF
from tf2_msgs.msg import TFMessage

from amr_description.clock import NANOSECONDS
from amr_description.control.ros.client import ManagerClient
from amr_description.ros.messages import nanoseconds

MS = 1_000_000
CONTROLLERS = ('joint_state_broadcaster', 'diff_drive_controller')
KEEPING = ResetSimulation.Request.SCOPE_TIME | ResetSimulation.Request.SCOPE_STATE
YAML = """
/**/controller_manager:
  ros__parameters:
    update_rate: 100
    joint_state_broadcaster: {type: joint_state_broadcaster/JointStateBroadcaster}
    diff_drive_controller: {type: diff_drive_controller/DiffDriveController}
/**/diff_drive_controller:
  ros__parameters:
    left_wheel_names: [joint_wheel_front_left, joint_wheel_back_left]
    right_wheel_names: [joint_wheel_front_right, joint_wheel_back_right]
    wheel_separation: 0.3
    wheel_radius: 0.1
    base_frame_id: base_footprint
"""
ODOMETRY = ('odom', 'odom_tf')
OF_THE_SIMULATOR = ('joint_states', *ODOMETRY)
OF_THE_PUBLISHER = 'wheel_tf'
HEARD = (*OF_THE_SIMULATOR, OF_THE_PUBLISHER)
LONGEST_DELAY = 160 * MS
"""
ns by which the wheels' transforms, sent each 50 ms by a process of its own, may be behind.

Joint states of before a reset that come late are taken as new up to 100 ms after the clock: the
next ones are sent 50 ms later, at the tick after that.
"""
LONGEST_SILENCE = 500 * MS
"""
ns between two messages that a writer sends one after the other, beginning at the reset. They come
every 10 to 50 ms. A writer keeps one sample: on a busy machine some are lost, as numbers tell.
"""
FASTEST = 0.55
"""m/s; the commanded speed, and a little."""

pytestmark = pytest.mark.in_order('one simulator: it is paused, plays, and is stopped at the end')


@pytest.fixture(scope='module')
def sim(tmp_path_factory):
    path = tmp_path_factory.mktemp('reset') / 'controllers.yaml'
    path.write_text(YAML)
    with simulator('paused:=true', f'controllers:={path}') as asked:
        asked.node.set_parameters([Parameter('use_sim_time', value=True)])
        yield asked


@pytest.fixture(scope='module')
def publisher(tmp_path_factory, sim):
    """A robot_state_publisher of the robot in the root namespace."""
    path = tmp_path_factory.mktemp('robot') / 'amr.urdf'
    path.write_text(URDF)
    line = command('robot_state_publisher', str(path), '--ros-args', '-p', 'use_sim_time:=true')
    process = Popen(line, stderr=subprocess.DEVNULL, env=environment(), start_new_session=True)
    yield process
    process.send_signal(signal.SIGINT)
    assert process.wait(PATIENCE) == 0


class Driver:
    """Commands one robot 20 times a second, and receives its messages."""

    def __init__(self, sim, namespace='', *, linear=0.5, angular=0.0):
        self.node = node = sim.node
        self.heard = defaultdict(list)
        """The stamps of the received messages by topic, ns."""
        self.sent = defaultdict(list)
        """The stamp of each, and its number among all that its writer has sent."""
        self.odometry = []
        drive = f'{namespace}/diff_drive_controller'
        self._command = TwistStamped()
        self._command.twist.linear.x, self._command.twist.angular.z = linear, angular
        self._publisher = node.create_publisher(TwistStamped, f'{drive}/cmd_vel', 10)
        self._timer = node.create_timer(
            0.05, self._drive, clock=Clock(clock_type=ClockType.STEADY_TIME)
        )
        self._subscriptions = [
            node.create_subscription(Odometry, f'{drive}/odom', self._hear_odometry, 2000),
            node.create_subscription(
                JointState, f'{namespace}/joint_states', self._hear_joints, 100
            ),
            node.create_subscription(TFMessage, '/tf', self._hear_transforms, 100),
        ]

    @property
    def hears_all(self):
        """
        Whether what one robot publishes from now on is heard: there is a writer for each topic.

        The writers know these readers when the robot's node has answered a client made later.
        """
        return all(subscription.get_publisher_count() for subscription in self._subscriptions)

    def _drive(self):
        self._command.header.stamp = self.node.get_clock().now().to_msg()
        self._publisher.publish(self._command)

    def _hear_odometry(self, message, info):
        self._note('odom', message, info)
        self.odometry.append(message)

    def _hear_joints(self, message, info):
        self._note('joint_states', message, info)

    def _hear_transforms(self, message, info):
        for each in message.transforms:
            if each.header.frame_id == 'odom':
                self._note('odom_tf', each, info)
            elif each.child_frame_id == 'wheel_front_left':
                self._note('wheel_tf', each, info)

    def _note(self, name, message, info):
        stamp = nanoseconds(message.header.stamp)
        self.heard[name].append(stamp)
        self.sent[name].append((stamp, info['publication_sequence_number']))

    @property
    def travelled(self):
        """m from where odometry began."""
        if not self.odometry:
            return 0.0
        place = self.odometry[-1].pose.pose.position
        return (place.x**2 + place.y**2) ** 0.5

    def forget(self):
        """Forget the received messages, but when the last ones were sent."""
        self.heard.clear()
        self.sent = defaultdict(list, {name: each[-1:] for name, each in self.sent.items()})
        self.odometry.clear()

    def close(self):
        self.node.destroy_timer(self._timer)
        self.node.destroy_publisher(self._publisher)
        for subscription in self._subscriptions:
            self.node.destroy_subscription(subscription)


@pytest.fixture
def driver(sim):
    found = Driver(sim)
    yield found
    found.close()


def compare_with_truth(sim, driver):
    """Odometry and truth at one instant: the robot itself was put back too."""
    state = sim.do(GetEntityState, entity='amr').state
    asked = nanoseconds(state.header.stamp)
    sim.wait(lambda: driver.heard['odom'][-1] >= asked)
    stamps = since_reset(driver.heard['odom'])  # an older one may bear the same time
    heard = zip(stamps, driver.odometry[-len(stamps) :], strict=True)
    stamp, odometry = min(heard, key=lambda pair: abs(pair[0] - asked))
    meanwhile = FASTEST * abs(stamp - asked) / NANOSECONDS
    truth = state.pose.position.x
    assert odometry.pose.pose.position.x == pytest.approx(truth, abs=0.01 + meanwhile)


def turn(sim, state):
    sim.do(SetSimulationState, state=SimulationState(state=state))


def namespaces(sim):
    return {namespace for _, namespace in sim.node.get_node_names_and_namespaces()}


def insert(sim, name, namespace='', y=0.0):
    """A robot without controllers."""
    request = SpawnEntity.Request()
    request.initial_pose.pose.position.y = y
    sim.do(
        SpawnEntity,
        name=name,
        resource_string=URDF,
        entity_namespace=namespace,
        initial_pose=request.initial_pose,
    )


def spawn(sim, name, namespace='', y=0.0):
    """A robot with both controllers active."""
    insert(sim, name, namespace, y)
    spawn_controllers(f'{namespace}/controller_manager')


def spawn_controllers(manager='controller_manager', names=CONTROLLERS):
    ended = run('spawner', *names, '-c', manager)
    assert ended.returncode == 0, ended.stderr
    return ended.stderr


def test_everything_is_brought_up_while_paused_and_drives_from_the_first_step(
    sim, publisher, driver
):
    sim.wait(lambda: sim.clock)
    assert run('create', '-string', URDF, '-name', 'amr').returncode == 0
    spawn_controllers()
    assert sim.time == 0
    states = ManagerClient(sim.node, 'controller_manager', timeout=PATIENCE).states()
    assert states == dict.fromkeys(CONTROLLERS, 'active')
    assert driver.odometry == []
    sim.wait(lambda: driver.hears_all)
    sim.do(StepSimulation, steps=5)
    sim.wait(lambda: driver.odometry)
    assert driver.heard['odom'] == [0]
    turn(sim, SimulationState.STATE_PLAYING)
    sim.wait(lambda: driver.travelled > 0.1)
    turn(sim, SimulationState.STATE_PAUSED)


CYCLE, CYCLE_STEPS = 10 * MS, 5
"""Of the controllers, at 100 Hz: ns, and in physics steps of 2 ms."""
FEWEST_CYCLES = 24


def is_due(name, stamp):
    """Whether the cycle at this time, ns, sends this: odometry comes at 0, 30, 50, 70 … ms."""
    return name == 'joint_states' or stamp == 0 or (stamp > CYCLE and stamp % (2 * CYCLE) == CYCLE)


def cycle(sim, driver, stamp):
    """One cycle of the controllers, and every message that it brings; ``stamp``: its time, ns."""
    sim.do(StepSimulation, steps=CYCLE_STEPS)
    names = [name for name in OF_THE_SIMULATOR if is_due(name, stamp)]
    sim.wait(lambda: all(driver.heard[name][-1:] == [stamp] for name in names))
    if stamp >= LONGEST_DELAY:
        sim.wait(lambda: driver.heard[OF_THE_PUBLISHER][-1:] >= [stamp - LONGEST_DELAY])


def hears_all_after_a_cycle(sim, driver):
    sim.do(StepSimulation, steps=CYCLE_STEPS)
    return all(driver.heard[name] for name in HEARD)


def test_ten_resets_in_lock_step_lose_nothing_and_begin_at_exactly_zero(sim, publisher, driver):
    sim.wait(lambda: hears_all_after_a_cycle(sim, driver))
    # Until nothing of before the first reset is on its way.
    latest = nanoseconds(sim.do(GetEntityState, entity='amr').state.header.stamp)
    sim.wait(lambda: driver.heard['joint_states'][-1] >= latest - CYCLE)
    sim.wait(lambda: min(driver.heard[name][-1] for name in ODOMETRY) >= latest - 2 * CYCLE)
    for _ in range(10):
        sim.do(ResetSimulation, scope=KEEPING)
        driver.forget()
        for number in count():
            cycle(sim, driver, number * CYCLE)
            # It drives at the next reset, whenever the first command has come.
            drives = driver.odometry[-1].twist.twist.linear.x > 0.1
            if drives and number >= FEWEST_CYCLES:
                break
        # Without a gap, from the first cycle on: nothing is lost, nothing comes late.
        times = [each * CYCLE for each in range(number + 1)]
        for name in OF_THE_SIMULATOR:
            assert driver.heard[name] == [stamp for stamp in times if is_due(name, stamp)], name
        first = driver.odometry[0]
        place = first.pose.pose
        assert (place.position.x, place.position.y, place.orientation.w) == (0.0, 0.0, 1.0)
        assert first.twist.twist.linear.x == 0.0


@pytest.mark.parametrize('count', [2, pytest.param(20, marks=pytest.mark.long)])
def test_resets_while_driving_silence_nothing_and_odometry_begins_at_zero(
    sim, publisher, driver, count
):
    turn(sim, SimulationState.STATE_PLAYING)
    for _ in range(count):
        reset_and_drive_on(sim, driver)
    assert 'is active already' in spawn_controllers(names=['joint_state_broadcaster'])
    client = ManagerClient(sim.node, 'controller_manager', timeout=PATIENCE)
    assert client.switch(deactivate=['diff_drive_controller']) is None
    assert client.unload('diff_drive_controller')
    spawn_controllers(names=['diff_drive_controller'])
    driver.forget()
    sim.wait(lambda: driver.odometry)


def reset_and_drive_on(sim, driver):
    """One reset of several."""
    # Messages of after the reset are known by times that have gone back. On a busy machine those
    # of a second and more are lost: time has to have gone on for longer than that.
    sim.wait(
        lambda: (
            driver.travelled > 0.05
            and all(driver.heard[name][-1:] >= [2 * NANOSECONDS] for name in HEARD)
        )
    )
    before = {name: driver.heard[name][-1] for name in HEARD}
    driver.forget()
    sim.do(ResetSimulation, scope=KEEPING)
    # What was on its way at the reset still bears a time of before.
    for name in HEARD:
        sim.wait(lambda: has_gone_back([before[name], *driver.heard[name]]))  # noqa: B023
    sim.wait(lambda: driver.travelled > 0.05)
    sim.wait(lambda: all(len(since_reset(driver.heard[name])) > 5 for name in HEARD))
    # How much simulated time passes until another process gets a processor, who knows: what the
    # publisher of the wheels' transforms does at a reset is looked at in lock-step, above.
    for name in OF_THE_SIMULATOR:
        count = len(since_reset([stamp for stamp, _ in driver.sent[name]]))
        (_, number), *sent = driver.sent[name][-count - 1 :]
        since = [(0, number), *sent]
        silences = [b - a for (a, first), (b, second) in pairwise(since) if second == first + 1]
        assert silences, name
        assert max(silences) <= LONGEST_SILENCE, name
    first = min(driver.heard['odom'])
    place = driver.odometry[driver.heard['odom'].index(first)].pose.pose.position
    assert math.hypot(place.x, place.y) <= FASTEST * first / NANOSECONDS
    compare_with_truth(sim, driver)


def has_gone_back(stamps):
    return any(after < before for before, after in pairwise(stamps))


def since_reset(stamps):
    """The stamps from the last one that is smaller than the one before it."""
    begin = max((at for at in range(1, len(stamps)) if stamps[at] < stamps[at - 1]), default=0)
    return stamps[begin:]


def test_a_reset_of_the_state_alone_puts_the_robot_back_and_time_goes_on(sim, publisher, driver):
    before = sim.time
    sim.wait(lambda: driver.travelled > 0.1)
    sim.do(ResetSimulation, scope=ResetSimulation.Request.SCOPE_STATE)
    sim.wait(lambda: driver.travelled < 0.05)
    assert driver.heard['odom'] == sorted(driver.heard['odom'])
    assert sim.time > before
    sim.wait(lambda: driver.travelled > 0.1)


def test_a_reset_of_time_alone_lets_the_robot_go_on_from_where_it_is(sim, publisher, driver):
    sim.wait(lambda: driver.travelled > 0.1)
    before = driver.heard['odom'][-1]
    travelled = driver.travelled
    sim.do(ResetSimulation, scope=ResetSimulation.Request.SCOPE_TIME)
    sim.wait(lambda: driver.heard['odom'][-1] < before)
    assert driver.travelled >= travelled
    sim.wait(lambda: driver.travelled > travelled + 0.1)


ODOMETRY_STEPS = 10
"""Physics steps of 2 ms between two messages of odometry."""


def drive_on(sim, driver, done):
    """Step from one message of odometry to the next until ``done()``."""
    while not done():
        due = driver.heard['odom'][-1] + 20 * MS
        sim.do(StepSimulation, steps=ODOMETRY_STEPS)
        sim.wait(lambda due=due: driver.heard['odom'][-1] >= due)


def test_a_robot_is_removed_and_comes_again_while_another_drives_on(sim):
    spawn(sim, 'one', '/one', y=2.0)
    spawn(sim, 'two', '/two', y=4.0)
    bystander = Driver(sim, '/two', angular=0.5)
    sim.wait(lambda: bystander.travelled > 0.1)
    # In lock-step, as a writer keeps one sample: what is missing was not sent.
    turn(sim, SimulationState.STATE_PAUSED)
    paused = nanoseconds(sim.do(GetEntityState, entity='two').state.header.stamp)
    sim.do(StepSimulation, steps=ODOMETRY_STEPS)
    sim.wait(lambda: bystander.heard['odom'][-1] >= paused)
    begin, begun_at = len(bystander.heard['odom']) - 1, bystander.travelled
    drive_on(sim, bystander, lambda: bystander.travelled > begun_at + 0.01)
    sim.do(DeleteEntity, entity='one')
    drive_on(sim, bystander, lambda: '/one' not in namespaces(sim))
    assert '/two' in namespaces(sim)
    _, reason = sim.refused(GetEntityState, entity='one')
    assert 'there are: amr, two' in reason
    insert(sim, 'one', '/one', y=2.0)
    with ThreadPoolExecutor() as pool:
        spawned = pool.submit(spawn_controllers, '/one/controller_manager')
        drive_on(sim, bystander, spawned.done)
        spawned.result()
    again = Driver(sim, '/one')
    drive_on(sim, bystander, lambda: again.travelled > 0.1)
    stamps = bystander.heard['odom'][begin:]
    assert {after - last for last, after in pairwise(stamps)} == {20 * MS}
    turn(sim, SimulationState.STATE_PLAYING)
    sim.do(DeleteEntity, entity='two')
    insert(sim, 'three', '/two', y=4.0)  # by another name, what was its namespace is free
    for each in (bystander, again):
        each.close()


def test_stopped_is_empty_and_a_robot_comes_up_again(sim, driver):
    turn(sim, SimulationState.STATE_STOPPED)
    sim.wait(lambda: 'controller_manager' not in sim.node.get_node_names())
    spawn(sim, 'amr')
    turn(sim, SimulationState.STATE_PLAYING)
    sim.wait(lambda: driver.travelled > 0.1)
