# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What can be done with a simulation, in this process and over DDS: one set of tests for both."""

import itertools
import math
import warnings

import pytest
from support.paths import ROOT

from amr_description import Simulation
from amr_description.errors import AmrError, SimulationError
from amr_description.model.description_file import description_at
from amr_description.model.frames import Transform
from amr_description.testing.simulation import Simulation as SimulationOverDds

URDF = ROOT / 'urdf' / 'amr.urdf'
SENSORS = ROOT / 'urdf' / 'amr_sensors.urdf.xacro'
CMD_VEL = '/diff_drive_controller/cmd_vel'
SPREAD = 0.03
"""m: six times the deviation of the lidar's noise."""
BUMPER = """
  <gazebo reference="base_link">
    <sensor name="bumper" type="contact">
      <topic>bumper</topic><contact><collision>base_link_collision</collision></contact>
    </sensor>
  </gazebo>
</robot>
"""
KINDS = {'in process': Simulation, 'over DDS': SimulationOverDds}


@pytest.fixture(scope='module', params=KINDS)
def simulation(request):
    """A function that returns a simulation of this kind, started once, at time 0."""
    running = {}

    def make(*args, **options):
        key = repr((args, options))
        if key not in running:
            sim = KINDS[request.param](*args, **options)
            sim.start()
            running[key] = sim
        running[key].reset()
        return running[key]

    yield make
    for sim in running.values():
        sim.close()


@pytest.fixture
def sim(simulation):
    return simulation(URDF)


@pytest.fixture
def seeing(simulation):
    return simulation(SENSORS, world='walls')


@pytest.fixture
def fleet(simulation):
    """Two robots with bumpers."""
    text = description_at(str(SENSORS), warn=pytest.fail)
    poses = {'robot1': Transform(), 'robot2': Transform((1.0, 0.0, 0.0))}
    return simulation(text.replace('</robot>', BUMPER), world='walls', robots=poses)


def bits(sim):
    """All that can be read of it."""
    return sim.truth, sim.odometry, repr(sim.joints)


def command(linear, angular=0.0):
    return {'twist': {'linear': {'x': linear}, 'angular': {'z': angular}}}


def test_it_goes_as_far_as_it_is_told(sim):
    assert (sim.time, sim.truth.time) == (0.0, 0.0)
    sim.drive(0.5, 0.0, seconds=2)
    assert sim.truth.x == pytest.approx(1.0, rel=0.01)
    assert sim.odometry.x == pytest.approx(sim.truth.x, abs=0.005)
    assert sim.truth.linear == pytest.approx((0.0, 0.0, 0.0), abs=2e-3)
    joint = sim.joints['joint_wheel_front_left']
    assert joint.position == pytest.approx(sim.truth.x / 0.1, rel=0.01)


def test_it_turns_and_moves_in_its_own_axes(sim):
    sim.drive(0.0, 0.5, seconds=2, stop=False)
    truth = sim.truth
    assert truth.yaw == pytest.approx(1.0, abs=0.06)
    assert truth.angular[2] == pytest.approx(0.5, rel=0.05)
    sim.drive(0.4, 0.0, seconds=1, stop=False)
    assert sim.truth.linear[0] == pytest.approx(0.4, rel=0.02)
    assert sim.odometry.linear[0] == pytest.approx(0.4, rel=0.02)


def test_time_passes_only_as_asked(sim):
    sim.step()
    assert sim.time == sim.timestep == sim.truth.time
    sim.run(0.25)
    assert sim.time == sim.truth.time == 0.25 + sim.timestep
    with pytest.raises(SimulationError, match='-1 steps are asked'):
        sim.step(-1)
    with pytest.raises(SimulationError, match='nan s are asked'):
        sim.run(float('nan'))


def test_a_reset_begins_anew_bit_by_bit(sim):
    def scenario():
        sim.drive(0.5, 0.8, seconds=0.5, stop=False)
        sim.drive(-0.3, 0.2, seconds=0.33)
        return bits(sim)

    first = scenario()
    for _ in range(3):
        sim.reset()
        assert sim.truth.x == pytest.approx(0.0, abs=1e-6)
        assert scenario() == first


@pytest.mark.parametrize('ticks', [0, 1, 7])
def test_a_command_acts_at_the_step_it_was_sent_before(sim, ticks):
    """
    At 100 Hz: five physics steps a tick.

    The wheels begin to turn in the first step; the floor holds against that from the next on.
    """
    sim.step(5 * ticks)
    before = sim.truth.linear[0]
    assert before == pytest.approx(0.0, abs=1e-6)
    sim.send(CMD_VEL, command(0.5))
    assert sim.truth.linear[0] == before
    sim.step(2)
    assert sim.truth.linear[0] > 0.02


def test_of_many_commands_at_an_instant_the_last_counts(sim):
    for linear in (0.5, -0.5, 0.3, 0.1):
        sim.send(CMD_VEL, command(linear))
    sim.run(0.4)
    assert sim.truth.linear[0] == pytest.approx(0.1, rel=0.01)


def test_one_message_may_be_sent_again_and_again(sim):
    """Longer than the timeout of a command: each time it is a new one."""
    message = command(0.3)
    for _ in range(10):
        sim.send(CMD_VEL, message)
        sim.run(0.1)
    assert message == command(0.3)
    assert sim.truth.linear[0] == pytest.approx(0.3, rel=0.02)


def test_nothing_is_said_at_time_zero(sim):
    for read in (lambda: sim.odometry, lambda: sim.joints):
        with pytest.raises(SimulationError, match='at time 0; let time pass'):
            read()


# --- sensors ------------------------------------------------------------------------------------


def test_a_wall_is_where_it_is_at_every_instant(seeing):
    """Also between two measurements of the sensor, and at time 0."""
    for _ in range(3):
        scan = seeing.scan
        assert (scan.time, scan.frame) == (seeing.time, 'lidar_link')
        assert scan.angles[180] == pytest.approx(0.0, abs=1e-6)
        assert scan.ranges[0] == pytest.approx(3.0 + seeing.truth.x, abs=SPREAD)
        assert scan.ranges[90] == pytest.approx(2.0 + seeing.truth.y, abs=SPREAD)
        seeing.drive(0.3, 0.0, seconds=0.312, stop=False)


def test_the_same_calls_give_the_same_bits(seeing):
    found = []
    for _ in range(2):
        seeing.reset()
        found.append([seeing.scan.ranges.tobytes()])
        seeing.drive(0.5, 0.7, seconds=0.4)
        found[-1] += [seeing.scan.ranges.tobytes(), seeing.scan.ranges.tobytes()]
    assert found[0] == found[1]
    first, second, again = found[0]
    assert first != second == again


def test_a_camera_sees_the_wall_before_it(seeing):
    """The east wall, 0.5 m high, of which the camera sees the middle; it is 0.24 m before base."""
    seeing.drive(0.0, -0.6, seconds=0.2)
    depth, image = seeing.depth(), seeing.image('camera/image')
    assert depth.time == image.time == seeing.time
    assert (depth.frame, image.frame) == ('camera_optical_frame',) * 2
    assert (depth.pixels.shape, image.pixels.shape) == ((240, 320), (240, 320, 3))
    # Along the optical axis, through the middle of the picture.
    expected = (3.0 - seeing.truth.x) / math.cos(seeing.truth.yaw) - 0.24
    assert depth.pixels[120, 160] == pytest.approx(expected, abs=0.01)
    assert image.pixels[120, 160] == pytest.approx(image.pixels[120, 161], abs=40)


@pytest.mark.parametrize(
    'read, words',
    [
        (
            lambda sim: sim.contacts(),
            "no sensor of 'amr' has a topic of ros_gz_interfaces/msg/Co",
        ),
        (
            lambda sim: sim.points(),
            "'amr' has 2 topics of sensor_msgs/msg/PointCloud2; name one: ",
        ),
        (
            lambda sim: sim.scan_of('front'),
            "has a topic '/front' of sensor_msgs/msg/LaserScan; ",
        ),
        (
            lambda sim: sim.depth('/scan'),
            'its sensors have: /scan (sensor_msgs/msg/LaserScan), ',
        ),
    ],
)
def test_a_topic_that_is_not_there_is_one_line_with_those_that_are(seeing, read, words):
    with pytest.raises(SimulationError) as caught:
        read(seeing)
    assert words in str(caught.value)
    assert '\n' not in str(caught.value)


def test_robots_see_each_other_in_frames_of_their_own(fleet):
    one, two = fleet.robots.values()
    assert (one.scan.frame, two.scan.frame) == ('robot1/lidar_link', 'robot2/lidar_link')
    # From the middle of one to the lidar of the other, radius 0.04.
    assert one.scan.ranges[180] == pytest.approx(0.96, abs=SPREAD)
    assert two.scan_of('scan').ranges[0] == pytest.approx(0.96, abs=SPREAD)
    assert math.isclose(one.scan.ranges[90], two.scan.ranges[90], abs_tol=2 * SPREAD)


def test_a_bumper_says_what_it_touches_and_that_it_touches_nothing(fleet):
    one, two = fleet.robots.values()
    assert one.contacts() == two.contacts() == []
    fleet.drive_all({'robot1': (0.4, 0.0)}, seconds=1.5, stop=False)
    contacts = one.contacts()
    assert {each.first for each in contacts} == {'robot1::base_link::base_link_collision'}
    assert all(each.second.startswith('robot2::wheel_back_') for each in contacts)


# --- what is wrong -------------------------------------------------------------------------------


@pytest.mark.parametrize('kind', KINDS.values(), ids=KINDS)
@pytest.mark.parametrize(
    ('arguments', 'message'),
    [
        ({'urdf': 'no.urdf'}, 'no.urdf'),
        ({'urdf': '<robot'}, 'line 1'),
        ({'urdf': '<robot name="a"/>'}, 'no <link>'),
        ({'urdf': ROOT / 'test/fixtures/urdf_broken/joint_twice.urdf'}, 'joint_twice.urdf:'),
        ({'controllers': 'no.yaml'}, 'no.yaml'),
        ({'controllers': ROOT / 'urdf'}, 'it is a folder'),
        ({'world': 'mars'}, "world 'mars': neither a file nor a shipped world"),
        ({'activate': ['nobody']}, 'nobody'),
        ({'parameters': {'on_fault': 'cry'}}, "'on_fault' must be one of continue, pause"),
        ({'parameters': {'physics.integrator': 'none'}}, "'physics.integrator' must be one of"),
        ({'parameters': {'bridge': 'no.yaml'}}, 'no.yaml'),
        ({'rtf': -1.0}, 'rtf is -1.0'),
        ({'rtf': math.nan}, 'rtf is nan'),
        ({'name': 'a', 'robots': {'b': Transform()}}, "name is 'a', and robots have the names of"),
        ({'pose': Transform((math.inf, 0.0, 0.0))}, 'finite numbers'),
        ({'robots': {'7up': Transform()}}, "namespace is '7up', which ROS does not allow"),
    ],
)
def test_what_cannot_be_started_says_so_in_a_line(kind, arguments, message):
    sim = kind(**{'urdf': URDF, **arguments}) if not refuses(kind, arguments, message) else None
    if sim is not None:
        with pytest.raises(AmrError, match=message) as refusal:
            sim.start()
        assert '\n' not in str(refusal.value)
        assert not sim._is_running


def refuses(kind, arguments, message):
    """Whether it is refused before it is started."""
    try:
        kind(**{'urdf': URDF, **arguments})
    except AmrError as error:
        assert message in str(error)
        assert '\n' not in str(error)
        return True
    return False


FILE = """
controller_manager:
  ros__parameters:
    update_rate: {rate}
    joint_state_broadcaster: {{type: joint_state_broadcaster/JointStateBroadcaster}}
    diff_drive_controller: {{type: {type}}}
diff_drive_controller:
  ros__parameters:
    left_wheel_names: {left}
    right_wheel_names: [joint_wheel_front_right]
    wheel_separation: {separation}
    wheel_radius: {radius}
    {more}
"""
GOOD = {
    'rate': 100,
    'type': 'diff_drive_controller/DiffDriveController',
    'left': '[joint_wheel_front_left]',
    'separation': 0.3,
    'radius': 0.1,
    'more': 'publish_rate: 50.0',
}
FAR = Transform((0.0, 2.0, 0.0))
FAULTS = [
    {'rate': 0},
    {'type': 'diff_drive_controller/DiffDriveControler'},
    {'type': 'no_such_package/Nothing'},
    {'left': '[no_such_joint]'},
    {'separation': "'wide'"},
    {'radius': 'nan'},
    {'more': 'publish_rate: -1.0'},
    {'more': 'wheel_radus: 0.2'},
    {'more': '- a list'},
    {'rate': "'fast'"},
    {'rate': -5},
    {'type': 'no.such.module/Nothing'},
    {'type': "''"},
    {'left': '[]'},
    {'left': 'joint_wheel_front_left'},
    {'left': '[1, 2]'},
    {'separation': 0.0},
    {'separation': 300.0, 'radius': -0.1},
    {'radius': 'yes'},
    {'more': 'odom_frame_id: 7'},
    {'more': 'position_feedback: maybe'},
    {'more': 'pose_covariance_diagonal: [1.0]'},
    {'more': "open_loop: 'true'"},
    {'more': 'cmd_vel_timeout: [1]'},
    {'more': 'linear.x.max_velocity: -1.0'},
    {'more': 'tab:\t{{'},
]


USUAL = 8
ONLY_THE_DRIVE, ALL_THAT_CAN_BE = ['diff_drive_controller'], None


@pytest.mark.parametrize(
    ('fault', 'wanted'),
    # In turn: what is said of a file hangs on neither.
    [
        pytest.param(fault, wanted, marks=[pytest.mark.long] if number > USUAL else [])
        for number, (fault, wanted) in enumerate(
            zip(FAULTS, itertools.cycle([ONLY_THE_DRIVE, ALL_THAT_CAN_BE]), strict=False)
        )
    ],
    ids=str,
)
def test_a_file_of_controllers_is_refused_in_the_same_words(tmp_path, fault, wanted):
    """Or taken with the same warnings."""
    file = tmp_path / 'controllers.yaml'
    file.write_text(FILE.format(**{**GOOD, **fault}))
    here, there = (said_of(kind, file, wanted) for kind in KINDS.values())
    assert here == there
    assert here


@pytest.mark.parametrize('kind', KINDS.values(), ids=KINDS)
def test_a_robot_whose_controllers_cannot_be_spawned_is_removed_again(tmp_path, kind):
    file = tmp_path / 'controllers.yaml'
    good = FILE.format(**GOOD).replace('\ncontroller_manager:', '\n/**/controller_manager:')
    file.write_text(good.replace('\ndiff_drive', '\n/**/diff_drive'))
    drives = ['diff_drive_controller']
    with kind(URDF, file, activate=drives, robots={'one': Transform()}) as sim:
        file.write_text(good.replace('\ndiff_drive', '\n/one/diff_drive'))
        with pytest.raises(AmrError, match='there is /two/diff_drive_controller'):
            sim.spawn('two', FAR)
        assert list(sim.robots) == ['one']
        sim.run(0.1)
        file.write_text(good.replace('\ndiff_drive', '\n/**/diff_drive'))
        assert sim.spawn('two', FAR).truth.y == pytest.approx(2.0, abs=0.01)


def said_of(kind, file, wanted):
    said = []
    with warnings.catch_warnings(record=True) as warned:
        warnings.simplefilter('always', UserWarning)
        try:
            with kind(URDF, file, activate=wanted):
                said.append('fine')
        except AmrError as error:
            said.append(str(error).removeprefix('spawn_entity: '))
    said += [str(each.message) for each in warned if each.category is UserWarning]
    assert not any('\n' in each for each in said)
    return said
