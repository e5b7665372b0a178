# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Faults made on purpose on a running stack: each is the first finding, and its fix mends it.

One controller manager over mock hardware, robot_state_publisher and two controllers serve the
whole file. What is wrong is a node of this process, a parameter, or the state of a controller.
"""

from collections.abc import Callable
from contextlib import contextmanager
import math
import time

from controller_manager_msgs.srv import SetHardwareComponentState
from fixtures.cli.commands import shell
from geometry_msgs.msg import TransformStamped
from lifecycle_msgs.msg import State
from nav_msgs.msg import Odometry
import pytest
from rcl_interfaces.srv import SetParameters
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import QoSProfile
from sensor_msgs.msg import CameraInfo, Image, Imu, JointState, LaserScan
from std_msgs.msg import String
from support.paths import ROOT
from support.ros_processes import PATIENCE
from support.running_stack import running_stack
from tf2_msgs.msg import TFMessage

from amr_description.bringup.stacks.hardware import swap_hardware
from amr_description.clock import NANOSECONDS
from amr_description.control.ros.client import ManagerClient
from amr_description.doctor.ros.collector import collect
from amr_description.doctor.table import examine
from amr_description.model.frames import Transform
from amr_description.ros.messages import fill_stamp
from amr_description.ros.qos import LATCHED, TF_STATIC
from amr_description.ros.service_calls import call
from amr_description.ros.transport import udp_only
from amr_description.tf2_ros.buffer import transform_message
from amr_description.tf2_ros.time_cache import StampedTransform

URDF = swap_hardware(
    (ROOT / 'urdf/amr.urdf').read_text(encoding='utf-8'), 'mock_components/GenericSystem', {}
)
MANAGER = '/controller_manager'
DRIVE = 'diff_drive_controller'
BROADCASTER = 'joint_state_broadcaster'
STATE_BROADCASTER = 'joint_state_broadcaster/JointStateBroadcaster'
GROUP = 'velocity_controllers/JointGroupVelocityController'
PERIOD = 0.02
"""s between two messages of a fault."""
NAMELESS = '<robot name="r"><link/></robot>'
VOLATILE = QoSProfile(depth=1)


class Patient:
    """The running stack, whoever makes it ill, and the doctor."""

    def __init__(self, folder):
        self.folder = folder
        self.doctor = Node('doctor')
        self.executor = SingleThreadedExecutor()
        self.executor.add_node(self.doctor)
        self.client = ManagerClient(Node('client'), MANAGER, timeout=PATIENCE)
        self.node = self.doctor
        self.speak: Callable[[], None] = lambda: None
        """What a fault publishes again and again."""
        self._spoken = 0.0

    def spin(self, until, timeout):
        end = time.monotonic() + timeout
        while not until() and time.monotonic() < end:
            if time.monotonic() - self._spoken >= PERIOD:
                self._spoken = time.monotonic()
                self.speak()
            self.executor.spin_once(timeout_sec=PERIOD)
        return until()

    def findings(self):
        """Examine, as ``ros2 doctor`` does."""
        return examine(collect(self.doctor, self.spin))

    def until(self, holds):
        """Examine until the findings are such: discovery takes its time."""
        end = time.monotonic() + PATIENCE
        while not holds(found := self.findings()):
            assert time.monotonic() < end, found
        return found

    def names_first(self, rule):
        """Examine until a fault is seen, and return its finding, which is the first one."""
        return self.until(lambda found: any(each.rule == rule for each in found))[0]

    def is_well(self, rule):
        """Examine until a fault is gone."""
        self.until(lambda found: rule not in {each.rule for each in found})

    @contextmanager
    def intruder(self, name='intruder', namespace=''):
        """A node that makes a fault; what ends it, too."""
        self.node = Node(name, namespace=namespace)
        self.executor.add_node(self.node)
        try:
            yield self.node
        finally:
            self.speak = lambda: None
            self.executor.remove_node(self.node)
            self.node.destroy_node()

    def typed(self, line):
        """Type a fix."""
        ended = shell(line, self.folder)
        assert ended.returncode == 0, (line, ended.stdout, ended.stderr)

    def set_parameters(self, node, **values):
        """Set parameters of a node, given by their names with __ for a dot."""
        parameters = [
            Parameter(name.replace('__', '.'), value=value).to_parameter_msg()
            for name, value in values.items()
        ]
        request = SetParameters.Request(parameters=parameters)
        response = call(self.doctor, SetParameters, f'{node}/set_parameters', request)
        assert all(each.successful for each in response.results), response


@pytest.fixture(scope='module')
def patient(tmp_path_factory):
    folder = tmp_path_factory.mktemp('stack')
    with udp_only():
        rclpy.init(args=[])
    text = (ROOT / 'config/controllers.yaml').read_text()
    try:
        with running_stack(folder, URDF, controllers=text, manager=text):
            patient = Patient(folder)
            patient.until(lambda found: not found)
            yield patient
    finally:
        rclpy.try_shutdown()


def some(rules, *short):
    """All rules, of which the normal run has those in ``short`` alone."""
    return [
        each if each in short else pytest.param(each, marks=pytest.mark.long) for each in rules
    ]


# --- frames -------------------------------------------------------------------------------------


def transform(parent, child, *, offset=0.0, zeros=False):
    """A message with one transform, stamped so many s from now."""
    stamp = time.time_ns() + round(offset * NANOSECONDS)
    message: TransformStamped = transform_message(
        StampedTransform(parent, child, stamp, Transform((0.1, 0.0, 0.0)))
    )
    if zeros:
        message.transform.rotation.w = 0.0
    return TFMessage(transforms=[message])


MOVING = {
    'tf_two_publishers': ('odom', 'base_footprint', {}),
    'tf_no_rotation': ('base_link', 'camera', {'zeros': True}),
    'tf_future': ('map', 'odom', {'offset': 30.0}),
    'tf_stale': ('map', 'odom', {'offset': -30.0}),
}
STATIC = {
    'tf_two_parents': ('map', 'base_footprint'),
    'tf_static_and_dynamic': ('odom', 'base_footprint'),
    'tf_islands': ('base_lnk', 'camera'),
    'tf_leading_slash': ('/base_link', '/camera'),
}


@pytest.mark.parametrize('rule', some(MOVING, 'tf_two_publishers'))
def test_a_node_that_publishes_wrong_transforms(patient, rule):
    parent, child, how = MOVING[rule]
    with patient.intruder('ekf_node') as node:
        publisher = node.create_publisher(TFMessage, '/tf', 10)
        patient.speak = lambda: publisher.publish(transform(parent, child, **how))
        found = patient.names_first(rule)
        assert found.rule == rule
        assert '/ekf_node' in found.what
    patient.is_well(rule)


@pytest.mark.parametrize('rule', some(STATIC, 'tf_two_parents'))
def test_a_node_that_publishes_a_wrong_static_transform(patient, rule):
    with patient.intruder('mount') as node:
        publisher = node.create_publisher(TFMessage, '/tf_static', TF_STATIC)
        publisher.publish(transform(*STATIC[rule]))
        found = patient.names_first(rule)
        assert found.rule == rule
        assert '/mount' in found.what + found.fix
    patient.is_well(rule)


# --- descriptions -------------------------------------------------------------------------------


@pytest.mark.long
def test_a_description_that_nobody_publishes(patient):
    with patient.intruder(namespace='/r9') as node:
        waiting = node.create_subscription(String, 'robot_description', print, LATCHED)
        found = patient.names_first('description_missing')
        assert found.rule == 'description_missing'
        assert found.fix == 'restart it with -r /r9/robot_description:=/robot_description'
        node.destroy_subscription(waiting)
        node.create_subscription(String, '/robot_description', lambda _: None, LATCHED)
        patient.is_well('description_missing')


@pytest.mark.long
@pytest.mark.parametrize(
    ('rule', 'topic', 'text', 'qos'),
    [
        ('description_not_latched', '/r3/robot_description', URDF, VOLATILE),
        (
            'description_invalid',
            '/r3/robot_description',
            '<robot name="r"><link/></robot>',
            LATCHED,
        ),
        ('descriptions_differ', '/robot_description', URDF + '<!-- 2 -->', LATCHED),
    ],
)
def test_a_node_that_publishes_a_wrong_description(patient, rule, topic, text, qos):
    with patient.intruder('describer') as node:
        node.create_publisher(String, topic, qos).publish(String(data=text))
        found = patient.names_first(rule)
        assert found.rule == rule
        assert '/describer' in found.what
    patient.is_well(rule)


@pytest.mark.long
def test_a_description_of_another_robot_than_the_managers(patient):
    states = '/robot_state_publisher'
    other = URDF.replace('joint_wheel_front_left', 'joint_wheel_left')
    patient.set_parameters(states, robot_description=other)
    found = patient.names_first('description_of_another_robot')
    assert found.rule == 'description_of_another_robot'
    assert 'joint_wheel_left' in found.what
    patient.set_parameters(states, robot_description=URDF)
    patient.is_well('description_of_another_robot')


# --- controllers --------------------------------------------------------------------------------


@pytest.mark.long
def test_a_component_that_is_not_active(patient):
    state = State(id=State.PRIMARY_STATE_INACTIVE, label='inactive')
    patient.client.query(SetHardwareComponentState, name='AmrSystem', target_state=state)
    found = patient.names_first('hardware_inactive')
    assert found.rule == 'hardware_inactive'
    patient.typed(found.fix)
    patient.is_well('hardware_inactive')
    states = patient.client.states()
    assert patient.client.switch(activate=[n for n in states if states[n] == 'inactive']) is None


def test_a_controller_that_is_not_active(patient):
    assert patient.client.switch(deactivate=[BROADCASTER]) is None
    found = patient.names_first('controller_inactive')
    assert found.rule == 'controller_inactive'
    patient.typed(found.fix)
    patient.until(lambda found: not found)


@pytest.mark.long
def test_no_broadcaster_of_joint_states(patient):
    assert patient.client.switch(deactivate=[BROADCASTER]) is None
    assert patient.client.unload(BROADCASTER)
    found = patient.names_first('no_joint_state_broadcaster')
    assert found.rule == 'no_joint_state_broadcaster'
    patient.typed(found.fix)
    patient.until(lambda found: not found)


@pytest.mark.long
def test_a_type_that_is_not_installed(patient):
    patient.set_parameters(MANAGER, arm__type='joint_state_brodcaster/JointStateBroadcaster')
    found = patient.names_first('controller_type_unknown')
    assert found.rule == 'controller_type_unknown'
    assert STATE_BROADCASTER in found.fix
    patient.set_parameters(MANAGER, arm__type=STATE_BROADCASTER)
    patient.is_well('controller_type_unknown')


@contextmanager
def loaded(patient, name, kind, **parameters):
    """A further controller, unconfigured, which is unloaded at the end."""
    values = {f'{name}__{key}': value for key, value in {'type': kind, **parameters}.items()}
    patient.set_parameters(MANAGER, **values)
    assert patient.client.load(name)
    try:
        yield
    finally:
        if patient.client.states().get(name) == 'active':
            assert patient.client.switch(deactivate=[name]) is None
        assert patient.client.unload(name)


@pytest.mark.long
def test_a_controller_that_is_not_configured(patient):
    with loaded(patient, 'second', STATE_BROADCASTER):
        found = patient.names_first('controller_unconfigured')
        assert found.rule == 'controller_unconfigured'
        assert patient.client.configure('second')
        patient.is_well('controller_unconfigured')


@pytest.mark.long
def test_a_controller_whose_joints_another_one_commands(patient):
    with loaded(patient, 'rival', GROUP):
        patient.set_parameters('/rival', joints=['joint_wheel_front_left'])
        assert patient.client.configure('rival')
        assert 'interfaces_claimed' not in {each.rule for each in patient.findings()}
        assert patient.client.switch(activate=['rival']) is not None
        found = patient.names_first('interfaces_claimed')
        assert found.rule == 'interfaces_claimed'
        patient.typed(found.fix)
        patient.is_well('interfaces_claimed')
    assert patient.client.switch(activate=[DRIVE]) is None


def test_a_drive_with_another_radius_than_the_wheels(patient):
    patient.set_parameters(f'/{DRIVE}', wheel_radius=0.2)
    found = patient.names_first('drive_contradicts_description')
    assert found.rule == 'drive_contradicts_description'
    assert 'wheel_radius: 0.1' in found.fix
    patient.set_parameters(f'/{DRIVE}', wheel_radius=0.1)
    patient.is_well('drive_contradicts_description')


@pytest.mark.long
def test_a_parameter_of_an_earlier_release(patient, tmp_path):
    file = tmp_path / 'old.yaml'
    file.write_text('old: {ros__parameters: {publish_rate: 50}}\n')
    with loaded(patient, 'old', STATE_BROADCASTER, params_file=[str(file)]):
        assert patient.client.configure('old')
        found = patient.names_first('former_parameters')
        assert found.rule == 'former_parameters'
        assert 'update_rate' in found.what
    file.write_text('old: {ros__parameters: {update_rate: 50}}\n')
    with loaded(patient, 'old', STATE_BROADCASTER, params_file=[str(file)]):
        assert patient.client.configure('old')
        patient.is_well('former_parameters')


@pytest.mark.long
def test_a_manager_whose_services_do_not_answer(patient):
    with patient.intruder('controller_manager', '/r6'):
        found = patient.names_first('controller_manager_silent')
        assert found.rule == 'controller_manager_silent'
        assert '/r6/controller_manager' in found.what
    patient.is_well('controller_manager_silent')


# --- sensors ------------------------------------------------------------------------------------


def now(message, frame='base_link', offset=0.0):
    """The message, with a header."""
    fill_stamp(time.time_ns() + round(offset * NANOSECONDS), message.header.stamp)
    message.header.frame_id = frame
    return message


def scan(frame='base_link', offset=0.0, count=360, distance=1.0):
    message = LaserScan(range_min=0.1, range_max=10.0, ranges=[distance] * count)
    message.angle_min, message.angle_max = -math.pi, math.pi - math.radians(1.0)
    message.angle_increment = math.radians(1.0)
    return now(message, frame, offset)


def image(step=24):
    return now(Image(width=8, height=2, step=step, encoding='rgb8', data=bytes(2 * step)))


def imu(covariance):
    message = now(Imu(orientation_covariance=[covariance] + [0.0] * 8))
    message.orientation.w = 0.0
    return message


def states(count=1, name='joint_wheel_front_left'):
    return now(JointState(name=[name], position=[0.0] * count), '')


def odometry(x):
    message = now(Odometry(child_frame_id='base'), 'odom')
    message.pose.pose.position.x, message.twist.twist.linear.x = x, 0.5
    message.pose.pose.orientation.w = 1.0
    return message


def moving(speed):
    start = time.monotonic()
    return lambda: odometry(speed * (time.monotonic() - start))


# Rule: topics, each with its type and what makes its messages, well and ill.
SENSORS = {
    'sensor_frame_missing': [
        ('/r7/scan', LaserScan, scan, lambda: scan(frame='robot/base_link/laser'))
    ],
    'sensor_stamp': [('/r7/scan', LaserScan, scan, lambda: scan(offset=-30.0))],
    'scan_length': [('/r7/scan', LaserScan, scan, lambda: scan(count=361))],
    'scan_empty': [('/r7/scan', LaserScan, scan, lambda: scan(distance=0.0))],
    'image_layout': [('/r7/image', Image, image, lambda: image(step=8))],
    'camera_info': [
        ('/r7/image', Image, image, image),
        (
            '/r7/camera_info',
            CameraInfo,
            lambda: now(CameraInfo(width=8, height=2, k=[5.0] * 9)),
            lambda: now(CameraInfo(width=16, height=4, k=[5.0] * 9)),
        ),
    ],
    'imu_orientation': [('/r7/imu', Imu, lambda: imu(-1.0), lambda: imu(0.0))],
    'joint_state_publishers': [
        ('/joint_states', JointState, lambda: states(name='arm'), states),
    ],
    'joint_state_fields': [('/r7/joint_states', JointState, states, lambda: states(count=2))],
    'odometry_diverges': [
        ('/r7/ground_truth/odom', Odometry, moving(0.5), moving(0.5)),
        ('/r7/odom', Odometry, moving(0.5), moving(1.0)),
    ],
}


@pytest.mark.parametrize('rule', some(SENSORS, 'scan_length'))
def test_a_sensor(patient, rule):
    with patient.intruder('driver') as node:
        topics = SENSORS[rule]
        ends = [node.create_publisher(kind, topic, 10) for topic, kind, *_ in topics]
        for topic, kind, *_ in topics:
            if kind is Image:
                node.create_subscription(kind, topic, lambda _: None, 1)

        def speak(is_ill):
            for end, (_, _, well, ill) in zip(ends, topics, strict=True):
                end.publish(ill() if is_ill else well())

        patient.speak = lambda: speak(True)
        found = patient.names_first(rule)
        assert found.rule == rule
        assert '/driver' in found.what + found.fix
        patient.speak = lambda: speak(False)
        patient.is_well(rule)
