# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Frames, controllers and sensors of a healthy robot, to be changed by a fault each."""

from dataclasses import replace
import math

from support.paths import ROOT

from amr_description.clock import NANOSECONDS
from amr_description.doctor.observations import Observations
from amr_description.doctor.observations.controllers import (
    Component,
    ObservedController,
    ObservedControllers,
    ObservedLogLine,
    ObservedManager,
)
from amr_description.doctor.observations.description import Description, DescriptionTopic
from amr_description.doctor.observations.sensors import (
    Imu,
    ObservedImage,
    ObservedJoints,
    ObservedScan,
    ObservedSensors,
    ObservedTravel,
)
from amr_description.doctor.observations.transforms import Edge, ObservedTransforms, Tree

URDF = (ROOT / 'urdf/amr.urdf').read_text(encoding='utf-8')
SIDES = ('front_left', 'front_right', 'back_left', 'back_right')
WHEELS = tuple(f'joint_wheel_{side}' for side in SIDES)
STATES = '/robot_state_publisher'
DRIVE = '/diff_drive_controller'
COMMANDS = tuple(f'{name}/velocity' for name in WHEELS)

EDGES = (
    Edge(parent='odom', child='base_footprint', publisher=DRIVE, youngest=0, oldest=9_000_000),
    Edge(parent='base_footprint', child='base_link', publisher=STATES, is_static=True),
    Edge(parent='base_link', child='laser', publisher=STATES, is_static=True),
    *(
        Edge(parent='base_link', child=f'wheel_{side}', publisher=STATES, youngest=0, oldest=0)
        for side in SIDES
    ),
)
PARAMETERS = {
    'left_wheel_names': ['joint_wheel_front_left', 'joint_wheel_back_left'],
    'right_wheel_names': ['joint_wheel_front_right', 'joint_wheel_back_right'],
    'wheel_separation': 0.3,
    'wheel_radius': 0.1,
    'wheel_separation_multiplier': 2.82,
    'base_frame_id': 'base_footprint',
    'odom_frame_id': 'odom',
    'enable_odom_tf': True,
    'position_feedback': True,
    'open_loop': False,
}
BROADCASTER = ObservedController(
    name='joint_state_broadcaster', type_name='joint_state_broadcaster/JointStateBroadcaster'
)
DRIVER = ObservedController(
    name='diff_drive_controller',
    type_name='diff_drive_controller/DiffDriveController',
    commands=COMMANDS,
    parameters=PARAMETERS,
)
SYSTEM = Component(
    name='AmrSystem',
    plugin='amr_description/MujocoSystem',
    interfaces=(*COMMANDS, *COMMANDS, *(f'{name}/position' for name in WHEELS)),
)
MANAGER = ObservedManager(
    controllers=(DRIVER, BROADCASTER),
    components=(SYSTEM,),
    types=(DRIVER.type_name, BROADCASTER.type_name),
    wanted={each.name: each.type_name for each in (DRIVER, BROADCASTER)},
)
DESCRIPTION = DescriptionTopic(publishers=(STATES,), subscribers=('/mujoco_sim',), texts=(URDF,))
SCAN = ObservedScan(
    topic='/scan',
    publishers=('/mujoco_sim',),
    frame='laser',
    age=0,
    angle_min=-math.pi,
    angle_max=math.pi - math.radians(1.0),
    angle_increment=math.radians(1.0),
    count=360,
    hits=100,
    infinite=260,
)
IMAGE = ObservedImage(
    topic='/camera/image_raw',
    publishers=('/camera_driver',),
    frame='base_link',
    age=0,
    width=320,
    height=240,
    step=960,
    encoding='rgb8',
    size=240 * 960,
    info_topic='/camera/camera_info',
    info_publishers=('/camera_driver',),
    info_size=(320, 240),
    focal_length=277.0,
)
IMU = Imu(topic='/imu', publishers=('/imu_driver',), frame='base_link', age=0)
JOINTS = ObservedJoints(
    topic='/joint_states',
    publishers=('/joint_state_broadcaster',),
    publisher='/joint_state_broadcaster',
    names=WHEELS,
    positions=4,
    age=0,
)
TRAVEL = ObservedTravel(
    topic='/odom',
    publishers=(DRIVE,),
    distance=1.0,
    true_distance=1.05,
    turn=3.0,
    true_turn=2.8,
    seconds=2.5,
)


def robot(**sections):
    """All that was seen of a healthy robot; ``sections`` in the place of some of it."""
    whole = {
        'transforms': ObservedTransforms(trees=(Tree(edges=EDGES),), is_simulated=True),
        'description': Description(topics=(DESCRIPTION,), of_state_publishers={STATES: URDF}),
        'controllers': ObservedControllers(managers=(MANAGER,)),
        'sensors': ObservedSensors(
            scans=(SCAN,), images=(IMAGE,), imus=(IMU,), joints=(JOINTS,), travels=(TRAVEL,)
        ),
    }
    return Observations(**{**whole, **sections})


def with_edges(*edges, without=()):
    """A robot with further transforms, and without some of its own, by their children."""
    kept = [each for each in EDGES if each.child not in without]
    return robot(
        transforms=ObservedTransforms(trees=(Tree(edges=(*kept, *edges)),), is_simulated=True)
    )


def with_description(**fields):
    """A robot whose topic of descriptions is otherwise."""
    topic = replace(DESCRIPTION, **fields)
    return robot(description=Description(topics=(topic,), of_state_publishers={STATES: URDF}))


def with_manager(log=(), **fields):
    """A robot whose controller manager is otherwise; ``log``: node, text, whether an error."""
    lines = tuple(ObservedLogLine(node=node, text=text, is_error=bad) for node, text, bad in log)
    return robot(
        controllers=ObservedControllers(managers=(replace(MANAGER, **fields),), log=lines)
    )


def with_drive(**fields):
    """A robot whose drive has other parameters."""
    driver = replace(DRIVER, parameters={**PARAMETERS, **fields})
    return with_manager(controllers=(driver, BROADCASTER))


def with_sensors(**kinds):
    """A robot with other sensors of some kinds."""
    assert robot().sensors is not None
    return robot(sensors=replace(robot().sensors, **kinds))


def seconds(time):
    """s -> ns."""
    return round(time * NANOSECONDS)
