# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Robots that are a script: what the page's server needs of them, without ROS and the same each time.

A :class:`Scene` is all that a page is told. The states of a scene are sent once, quickly, and then
the last of them again and again: what is drawn of it no longer changes.
"""

from collections.abc import Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
import math

import numpy as np
from support.paths import ROOT

from amr_description.errors import ViewerError
from amr_description.viewer.backend import Answer
from amr_description.viewer.description import describe_robot
from amr_description.viewer.forms import CallInfo, CallService, FieldInfo, Services
from amr_description.viewer.introspection import (
    Endpoint,
    FindingInfo,
    Findings,
    FrameStatus,
    Log,
    LogLine,
    ParameterInfo,
    TopicInfo,
    Topics,
    Transforms,
)
from amr_description.viewer.protocol import (
    Ages,
    Command,
    ControllerInfo,
    Controllers,
    DiagnosticItem,
    Diagnostics,
    Finding,
    FrameInfo,
    Graph,
    HardwareComponentInfo,
    Layout,
    Notice,
    RobotAges,
    RobotInfo,
    RobotLayout,
    SensorInfo,
    SimulationStatus,
    SimulatorInfo,
)
from amr_description.viewer.requests import Definition, ListParameters
from amr_description.viewer.server import Server, ServerSettings
from amr_description.viewer.states import StateFrame

AMR = (ROOT / 'urdf' / 'amr.urdf').read_text()
RATE = 100.0
"""Calls of ``take_state`` a second."""
REPEAT = 5
"""Of so many calls one gets a state, once the script is through."""
PERIOD = 0.1
"""s of the scene's time between two states."""
SECONDS = 6.0
WHEELS = ('front_left', 'front_right', 'back_left', 'back_right')
LIMITS = '<limit lower="{}" upper="{}" effort="10" velocity="1"/>'


@dataclass(frozen=True)
class Scene:
    """What a page is told: messages, each with whom it is about, and the states after them."""

    messages: tuple[tuple[str, object], ...]
    layout: Layout
    states: tuple[bytes, ...]
    notices: tuple[Notice, ...] = ()
    ages: Ages | None = None
    latest: Mapping[str, object] = field(default_factory=dict)
    """What pages that watch a part of the graph are sent, by the part."""
    answers: Mapping[type, object] = field(default_factory=dict)
    """The data that requests are answered with, by their types."""


class ScriptedRobots:
    """The backend of a :class:`Server` that shows one scene; it takes note of what pages ask."""

    def __init__(self, scene):
        self.scene = scene
        self.server = None
        self.handlers = self
        self.asked = []
        self._calls = 0
        self._is_begun = False

    def show(self, scene):
        """Show another scene, also to the pages that are open."""
        self.server.call(lambda: self._show(scene))

    def _show(self, scene):
        self.scene = scene
        self.server.pages.retain(['/none'])
        self.open()

    def open(self):
        for subject, message in self.scene.messages:
            self.server.pages.publish(subject, message)
        self._calls = 0
        self._is_begun = False

    def close(self):
        pass

    def watch(self, watched):
        pass

    def take_state(self):
        messages = () if self._is_begun else (self.scene.layout, *self.scene.notices)
        self._is_begun = True
        states, number = self.scene.states, self._calls
        self._calls += 1
        if self.scene.ages and number % REPEAT == 0:
            messages = (*messages, self.scene.ages)
        if number < len(states):
            return messages, states[number]
        return messages, states[-1] if states and number % REPEAT == 0 else None

    def take_samples(self, wanted):
        return ()

    def robots(self):
        return ['/']

    def known(self):
        return ['/']

    def hold(self, robots):
        return {}

    def drive(self, robot, linear, angular, sideways=0.0):
        pass

    def push(self, simulator, entity, link, force, torque):
        pass

    def set_joints(self, robot, positions):
        self.asked.append(dict(positions))

    def hold_joints(self, robot):
        pass

    async def carry_out(self, request, page):
        self.asked.append(request)
        if (data := self.scene.answers.get(type(request))) is None:
            raise ViewerError('these robots are a script: they do nothing that they are asked')
        return Answer('', data)

    def forget(self, page):
        pass

    def latest(self, part):
        return self.scene.latest.get(part)

    def mesh(self, name):
        return None


@contextmanager
def serving(scene, **settings):
    """Serve a page with the robots of a scene; yields the backend and the address."""
    backend = ScriptedRobots(scene)
    problems = []
    asked = ServerSettings(port=0, rate=RATE, version='1.0.0', domain=7, **settings)
    server = backend.server = Server(asked, backend, problems.append)
    server.start()
    try:
        yield backend, server.url
    finally:
        server.stop()
    assert problems == []


def simulation(*, wheels=True):
    """Return the shipped robot in a simulator, with something of everything to be seen."""
    robot = RobotInfo(
        id='/',
        name='amr',
        command=Command('/diff_drive_controller/cmd_vel', 'geometry_msgs/msg/TwistStamped'),
        odometry='/diff_drive_controller/odom',
        truth='/ground_truth/odom',
        wheels='/wheels' if wheels else None,
        joint_states='/joint_states',
        joint_publisher=None,
        manager='/controller_manager',
        present=True,
    )
    sensors = (
        SensorInfo('/scan', '/', 'scan', 'sensor_msgs/msg/LaserScan'),
        SensorInfo('/camera/image/compressed', '/', 'picture', 'sensor_msgs/msg/CompressedImage'),
    )
    simulators = (SimulatorInfo('/mujoco_sim', ('amr',), 'empty', ('empty', 'warehouse')),)
    model = replace(describe_robot('/', AMR).message, findings=FINDINGS)
    layout, states = _driving(model)
    return Scene(
        messages=(
            ('', Graph((robot,), simulators, None, sensors)),
            ('/', model),
            ('/', CONTROLLERS),
            ('/', Diagnostics('/', DIAGNOSTICS)),
            ('/mujoco_sim', SimulationStatus('/mujoco_sim', 'playing', SECONDS, 1.0, 0.98)),
        ),
        layout=layout,
        states=states,
        ages=Ages(0.0, 0.0, (RobotAges('/', 0.0, 0.0, 0.0, 0.0),)),
        latest={
            'topics': TOPICS,
            'services': SERVICES,
            'transforms': TRANSFORMS,
            'log': LOG,
            'findings': DOCTOR,
        },
        answers={ListParameters: PARAMETERS, Definition: FORM, CallService: RESPONSE},
    )


FINDINGS = (
    Finding('error', 12, 12, 'link "base_link" has a mass of 0 kg', 'Give it what it weighs.'),
    Finding('warning', 34, 34, 'joint "wheel" has no limit of effort', 'Add <limit effort="…"/>.'),
    Finding('note', None, None, 'no collision shape is a mesh', ''),
)
DIAGNOSTICS = (
    DiagnosticItem(
        'error',
        'controller_manager: Controllers Activity',
        'High execution jitter or mean error : [ diff_drive_controller joint_state_broadcaster ]',
    ),
    DiagnosticItem('warn', 'battery: Voltage', 'Low voltage: 21.9 V'),
    DiagnosticItem(
        'ok', 'controller_manager: Controller Manager Activity', 'Controller Manager is running'
    ),
)
CONTROLLERS = Controllers(
    '/',
    (
        ControllerInfo(
            'diff_drive_controller',
            'diff_drive_controller/DiffDriveController',
            'active',
            tuple(f'{name}_wheel_joint/velocity' for name in WHEELS),
        ),
        ControllerInfo(
            'joint_state_broadcaster',
            'joint_state_broadcaster/JointStateBroadcaster',
            'inactive',
            (),
        ),
    ),
    (HardwareComponentInfo('AmrSystem', 'amr_description/MujocoSystem', 'active'),),
)

DRIVE = '/diff_drive_controller'
RELIABLE = 'reliable, volatile'


def _topic(name, kind, publishers, subscriptions=(), rate=None):
    ends = (
        tuple(Endpoint(node, RELIABLE) for node in nodes) for nodes in (publishers, subscriptions)
    )
    return TopicInfo(name, (kind,), *ends, rate)


SERVICES = Services(
    tuple(
        CallInfo(name, kind, '/action/' in kind)
        for name, kind in (
            ('/arm/follow_joint_trajectory', 'control_msgs/action/FollowJointTrajectory'),
            ('/controller_manager/get_parameters', 'rcl_interfaces/srv/GetParameters'),
            (
                '/controller_manager/list_controllers',
                'controller_manager_msgs/srv/ListControllers',
            ),
            ('/mujoco_sim/set_simulation_state', 'simulation_interfaces/srv/SetSimulationState'),
        )
    )
)
RESPONSE = "result:\n  result: 2\n  error_message: 'there is no entity; there are: amr'\n"
FORM = (
    FieldInfo(
        'state',
        'simulation_interfaces/msg/SimulationState',
        None,
        (FieldInfo('state', 'uint8', None, (), 0, {'STATE_STOPPED': 0, 'STATE_PLAYING': 1}),),
        None,
        {},
    ),
    FieldInfo('names', 'string', 0, (), None, {}),
    FieldInfo('stamp', 'builtin_interfaces/msg/Time', None, (), None, {}),
)
TOPICS = Topics(
    ('/controller_manager', DRIVE, '/mujoco_sim', '/robot_state_publisher', '/viewer'),
    (
        _topic('/clock', 'rosgraph_msgs/msg/Clock', ['/mujoco_sim'], [DRIVE, '/viewer'], 100.0),
        _topic(f'{DRIVE}/cmd_vel', 'geometry_msgs/msg/TwistStamped', [], [DRIVE]),
        _topic(f'{DRIVE}/odom', 'nav_msgs/msg/Odometry', [DRIVE], ['/viewer'], 50.0),
        _topic(
            '/joint_states',
            'sensor_msgs/msg/JointState',
            ['/controller_manager'],
            ['/robot_state_publisher', '/viewer'],
            50.0,
        ),
        _topic('/tf', 'tf2_msgs/msg/TFMessage', [DRIVE, '/robot_state_publisher'], ['/viewer']),
    ),
)
TRANSFORMS = Transforms(
    (
        FrameStatus('odom', 'world', ('world',), True, None, None, ('/tf_static',)),
        FrameStatus('base_footprint', 'odom', ('odom',), False, 50.0, 0.02, ('/tf',)),
        FrameStatus(
            'base_link', 'base_footprint', ('base_footprint',), True, None, None, ('/tf_static',)
        ),
        FrameStatus('laser', 'base_link', ('base_link', 'odom'), False, 10.0, 3.2, ('/tf',)),
    ),
    {'/tf': (DRIVE, '/robot_state_publisher'), '/tf_static': ('/robot_state_publisher',)},
)
DOCTOR = Findings(
    (
        FindingInfo(
            'warning',
            'controller_inactive',
            "the controller 'imu' (imu_sensor_broadcaster/IMUSensorBroadcaster) of "
            '/controller_manager is inactive',
            'it is silent: it neither takes commands nor publishes',
            '`ros2 control set_controller_state imu active`',
        ),
    )
)
LOG = Log(
    tuple(
        LogLine(number, 1_700_000_000.0 + number, level, node, text, 'on_timer (node.py:23)')
        for number, (level, node, text) in enumerate(
            (
                ('info', 'controller_manager', 'Configured and activated diff_drive_controller'),
                ('debug', 'mujoco_sim', 'step 1200'),
                (
                    'warning',
                    'mujoco_sim',
                    'real time is not kept: 0.62 of it over the last second',
                ),
                (
                    'error',
                    'diff_drive_controller',
                    'the command is older than its time-out of 0.5 s',
                ),
                ('fatal', 'planner', 'no map'),
            )
        )
    )
)
PARAMETERS = (
    ParameterInfo(
        'wheel_radius', 'double', 0.1, False, 'of the wheels', 'positive', 0.01, 1.0, None
    ),
    ParameterInfo('use_sim_time', 'bool', True, False, '', '', None, None, None),
    ParameterInfo('update_rate', 'integer', 100, True, 'Hz', '', 1.0, 1000.0, 1.0),
    ParameterInfo('wheel_names', 'string_array', WHEELS, False, '', '', None, None, None),
    ParameterInfo('base_frame_id', 'string', 'base_link', False, '', '', None, None, None),
)


def _driving(model):
    """Return layout and states of a robot that drives an arc, at an even speed, and then rests."""
    frames = (
        FrameInfo('odom', 'world'),
        FrameInfo('base_footprint', 'odom'),
        FrameInfo('base_link', 'base_footprint'),
        *(FrameInfo(f'{name}_wheel', 'base_link') for name in WHEELS),
    )
    joints = tuple(joint.name for joint in model.joints)
    layout = Layout(1, frames, (RobotLayout('/', joints, joints),))
    frame = StateFrame(layout)
    states = []
    for number in range(round(SECONDS / PERIOD)):
        time = number * PERIOD
        speed = 0.5 if 1.0 < time < 4.0 else 0.0
        turned = 0.5 * min(max(time - 1.0, 0.0), 3.0)
        frame.poses[:] = (0, 0, 0, 0, 0, 0, 1)
        where = (math.sin(turned), 1.0 - math.cos(turned), 0, *_yaw(turned))
        frame.poses[1] = where
        (robot,) = frame.robots
        robot.positions[:], robot.velocities[:] = 5.0 * turned, 10.0 * speed
        robot.commanded[:] = 10.0 * speed
        motion = (*where, speed, speed, 0.0)
        robot.odometry[:], robot.truth[:] = motion, motion
        robot.command[:] = (speed, speed, 0.0)
        robot.wheels[:] = (1.0, 17.2, 0.001, 0.0)
        states.append(frame.encode(number, time))
    return layout, tuple(states)


def _yaw(angle):
    return 0.0, 0.0, math.sin(0.5 * angle), math.cos(0.5 * angle)


def arm(joints=20):
    """Return a description to look at, as ``display`` shows it: an arm on a lift, with sliders."""
    links = ['<link name="base"/>', '<link name="l0"/>']
    links += [f'<link name="l{number}"/>' for number in range(1, joints)]
    lift = _joint('lift', 'prismatic', 'base', 'l0', LIMITS.format(0, 0.45))
    turns = (
        _joint(f'joint_{number}', 'revolute', f'l{number - 1}', f'l{number}', LIMITS.format(-2, 2))
        for number in range(1, joints)
    )
    text = f'<robot name="arm">{"".join(links)}{lift}{"".join(turns)}</robot>'
    robot = RobotInfo(
        id='/',
        name='arm',
        command=None,
        odometry=None,
        truth=None,
        wheels=None,
        joint_states='/joint_states',
        joint_publisher='/joint_state_publisher',
        manager=None,
        present=True,
    )
    model = replace(describe_robot('/', text).message, findings=())
    names = tuple(joint.name for joint in model.joints)
    parents = ('base', *(f'l{number}' for number in range(joints - 1)))
    frames = tuple(FrameInfo(f'l{n}', parent) for n, parent in enumerate(parents))
    layout = Layout(2, frames, (RobotLayout('/', names, ()),))
    frame = StateFrame(layout)
    frame.poses[:] = (0, 0, 0.1, 0, 0, 0, 1)
    frame.robots[0].positions[:] = np.linspace(0.0, 0.4, len(names))
    states = tuple(frame.encode(number, PERIOD * number) for number in range(3))
    messages = (('', Graph((robot,), (), None)), ('/', model))
    return Scene(messages=messages, layout=layout, states=states)


def _joint(name, kind, parent, child, inside):
    return (
        f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>'
        f'<axis xyz="0 0 1"/>{inside}</joint>'
    )


def nothing():
    """Return a graph in which there is no robot."""
    hint = (
        'nothing publishes /robot_description in ROS domain 7; start a robot, such as: '
        '`ros2 launch amr_description simulation`'
    )
    return Scene(messages=(('', Graph((), (), hint)),), layout=Layout(3, (), ()), states=())
