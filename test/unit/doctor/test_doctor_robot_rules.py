# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Rules on frames, descriptions, controllers and sensors: each fault is found, and no other."""

from dataclasses import replace
import math

import pytest
from support import doctor_robots as robots
from support.doctor_hosts import MACHINE
from support.doctor_robots import (
    BROADCASTER,
    DRIVE,
    DRIVER,
    IMAGE,
    IMU,
    JOINTS,
    SCAN,
    STATES,
    SYSTEM,
    TRAVEL,
    URDF,
    with_description,
    with_drive,
    with_edges,
    with_manager,
    with_sensors,
)

from amr_description.doctor.observations import Observations
from amr_description.doctor.observations.controllers import ObservedController, ObservedControllers
from amr_description.doctor.observations.description import Description, DescriptionTopic
from amr_description.doctor.observations.sensors import ObservedSensors
from amr_description.doctor.observations.transforms import Edge, ObservedTransforms, Tree
from amr_description.doctor.table import examine
from amr_description.navigation.contract.observations import (
    ContractObservations as Navigation,
    ContractTopic,
)

LESS = replace(JOINTS, names=JOINTS.names[1:], positions=3)
OTHER = '/static_transform_publisher'
ODOM = robots.EDGES[0]
CLAIMED = "command interface 'a/velocity' is currently claimed by another controller"


def edge(parent, child, publisher=OTHER, **fields):
    return Edge(parent=parent, child=child, publisher=publisher, **fields)


def inactive(name, *commands, kind='forward_command_controller/ForwardCommandController'):
    return ObservedController(name=name, type_name=kind, state='inactive', commands=commands)


def prefixed(prefix):
    return tuple(
        replace(each, parent=prefix + each.parent, child=prefix + each.child)
        for each in robots.EDGES
    )


FAULTS = {
    'tf_two_parents': with_edges(edge('map', 'base_footprint', is_static=True)),
    'tf_two_publishers': with_edges(replace(ODOM, publisher='/ekf_node')),
    'tf_static_and_dynamic': with_edges(edge('odom', 'base_footprint', is_static=True)),
    'tf_no_rotation': with_edges(edge('base_link', 'camera', rotation=(0.0, 0.0, 0.0, 0.0))),
    'tf_future': with_edges(edge('map', 'odom', youngest=-(10**12), oldest=-(10**12))),
    'tf_stale': with_edges(edge('map', 'odom', youngest=10**11, oldest=10**12)),
    'joints_without_state': replace(
        with_edges(without=('wheel_front_left',)),
        sensors=with_sensors(
            joints=(replace(JOINTS, names=JOINTS.names[1:], positions=3),)
        ).sensors,
    ),
    'tf_islands': with_edges(edge('base_lnk', 'camera', is_static=True)),
    'tf_leading_slash': with_edges(edge('base_link', 'camera', has_slash=True, is_static=True)),
    'description_missing': with_description(publishers=(), texts=()),
    'description_not_latched': with_description(volatile=(STATES,)),
    'description_invalid': with_description(
        publishers=('/other',), texts=('<robot name="r"><link/></robot>',)
    ),
    'descriptions_differ': with_description(
        publishers=(STATES, '/other'), texts=(URDF, '<robot name="r"><link name="a"/></robot>')
    ),
    'description_of_another_robot': with_manager(
        components=(replace(SYSTEM, interfaces=('joint_arm/velocity', *SYSTEM.interfaces)),)
    ),
    'controller_manager_missing': robots.robot(
        controllers=ObservedControllers(spawners=('/spawner_diff_drive_controller',))
    ),
    'controller_manager_silent': with_manager(answers=False, controllers=(), components=()),
    'hardware_inactive': with_manager(components=(replace(SYSTEM, state='unconfigured'),)),
    'controller_type_unknown': with_manager(wanted={'arm': 'no_package/NoController'}),
    'drive_contradicts_description': with_drive(wheel_radius=0.2),
    'controller_unconfigured': with_manager(
        controllers=(replace(DRIVER, state='unconfigured'), BROADCASTER)
    ),
    'interfaces_claimed': with_manager(
        controllers=(DRIVER, BROADCASTER, inactive('wheels', *DRIVER.commands[:1])),
        log=[('/controller_manager', f'wheels: {CLAIMED}', True)],
    ),
    'no_joint_state_broadcaster': replace(
        with_manager(controllers=(DRIVER,)), sensors=with_sensors(joints=()).sensors
    ),
    'controller_inactive': with_manager(
        controllers=(replace(DRIVER, state='inactive'), BROADCASTER)
    ),
    'former_parameters': with_manager(
        log=[
            (DRIVE, "parameter 'publish_cmd' is true: it is of ROS 1, and has no effect: …", False)
        ]
    ),
    'joint_state_publishers': with_sensors(
        joints=(JOINTS, replace(JOINTS, publisher='/joint_state_publisher'))
    ),
    'joint_state_fields': with_sensors(joints=(replace(JOINTS, positions=3),)),
    'sensor_frame_missing': with_sensors(scans=(replace(SCAN, frame='robot/base_link/laser'),)),
    'sensor_stamp': with_sensors(scans=(replace(SCAN, age=10**12),)),
    'scan_length': with_sensors(scans=(replace(SCAN, count=361),)),
    'scan_empty': with_sensors(scans=(replace(SCAN, hits=0, infinite=0, zeros=360),)),
    'image_layout': with_sensors(images=(replace(IMAGE, encoding='rgba8'),)),
    'camera_info': with_sensors(images=(replace(IMAGE, info_size=(640, 480)),)),
    'imu_orientation': with_sensors(imus=(replace(IMU, orientation=(0.0, 0.0, 0.0, 0.0)),)),
    'odometry_diverges': with_sensors(travels=(replace(TRAVEL, true_distance=0.2),)),
    'navigation_contract': robots.robot(
        navigation=Navigation(
            **{
                name: ContractTopic(f'/{name}')
                for name in ('clock', 'tf', 'odom', 'scan', 'cmd_vel', 'map', 'initial_pose')
            }
        )
    ),
}
HEALTHY = {
    'a robot': robots.robot(),
    'two that publish the same static transform': with_edges(
        edge('base_footprint', 'base_link', is_static=True)
    ),
    'AMCL, which stamps into the future': with_edges(
        edge('map', 'odom', youngest=-(10**9), oldest=-(10**9))
    ),
    'static transforms that have not come yet': robots.robot(
        transforms=ObservedTransforms(
            trees=(Tree(edges=robots.EDGES[:1] + robots.EDGES[2:], is_complete=False),)
        )
    ),
    'frames that nobody knows the age of': with_edges(edge('map', 'odom')),
    'two ways to command the wheels, one of which nobody has tried': with_manager(
        controllers=(DRIVER, BROADCASTER, inactive('wheels', *DRIVER.commands))
    ),
    'a spawner that is at work': robots.robot(
        controllers=replace(robots.robot().controllers, spawners=('/spawner_imu',))
    ),
    'an empty world': with_sensors(scans=(replace(SCAN, hits=0, infinite=360),)),
    'an IMU that says that it has no orientation': with_sensors(
        imus=(replace(IMU, orientation=(0.0, 0.0, 0.0, 0.0), has_orientation=False),)
    ),
    'joint states of two halves of a robot': with_sensors(
        joints=(
            replace(JOINTS, names=JOINTS.names[:2], positions=2),
            replace(JOINTS, names=JOINTS.names[2:], positions=2, publisher='/other'),
        )
    ),
    'wheels with a frame_prefix that ends without a slash': replace(
        with_sensors(joints=(), scans=(), images=(), imus=()),
        transforms=ObservedTransforms(trees=(Tree(edges=prefixed('r1_')),)),
    ),
    'pictures of another node beside the camera': with_sensors(
        images=(IMAGE, replace(IMAGE, width=64, step=192, size=46080, publishers=('/marks',)))
    ),
    'pictures in planes': with_sensors(
        images=(replace(IMAGE, encoding='nv12', step=320, size=320 * 240 * 3 // 2),)
    ),
    'a robot that hardly moves': with_sensors(
        travels=(replace(TRAVEL, distance=0.2, true_distance=0.0, turn=0.1, true_turn=0.0),)
    ),
    'a recorder that has outlived a robot': with_description(
        subscribers=('/rosbag2_recorder',), publishers=(), texts=()
    ),
    'a program that waits for no description': with_description(subscribers=(), publishers=()),
    'joints that only the URDF has, and TF': with_sensors(joints=()),
    'two robots in namespaces': robots.robot(
        description=Description(
            topics=tuple(
                DescriptionTopic(
                    topic=f'/r{number}/robot_description', publishers=(STATES,), texts=(URDF,)
                )
                for number in (1, 2)
            )
        ),
        transforms=with_edges(edge('r2/odom', 'r2/base')).transforms,
    ),
}


@pytest.mark.parametrize('rule', FAULTS)
def test_the_fault_is_named_and_nothing_else(rule):
    found = examine(FAULTS[rule])
    assert {each.rule for each in found} == {rule}
    for each in found:
        lines = (each.what, each.why, each.fix)
        assert all(lines), each
        assert '\n' not in ''.join(lines)
        assert not any(text.endswith('.') for text in lines), each


@pytest.mark.parametrize('name', HEALTHY)
def test_a_healthy_robot_has_no_finding(name):
    assert examine(HEALTHY[name]) == []


def first(seen):
    return examine(seen)[0]


def test_two_parents_name_both_publishers_and_how_the_drive_is_mended():
    found = first(with_edges(replace(ODOM, child='base_link'), without=('base_footprint',)))
    assert found.rule == 'tf_two_parents'
    assert DRIVE in found.what
    assert STATES in found.what
    assert 'base_frame_id: base_footprint' in found.fix


def test_a_misspelt_frame_is_told_with_what_was_meant():
    found = first(FAULTS['tf_islands'])
    assert found.fix == f"write 'base_link' in the place of 'base_lnk' in {OTHER}"


def test_why_a_controller_is_unconfigured_is_told_from_its_log():
    log = [(DRIVE, 'parameter wheel_radius must be above 0', True)]
    drive = replace(DRIVER, state='unconfigured')
    found = first(with_manager(controllers=(drive, BROADCASTER), log=log))
    assert found.what.endswith('its log says: parameter wheel_radius must be above 0')


def test_a_wheel_that_the_description_lacks_is_named():
    found = first(with_drive(left_wheel_names=['wheel_left', 'joint_wheel_back_left']))
    assert found.rule == 'drive_contradicts_description'
    assert '"wheel_left"' in found.what


def test_a_base_with_two_parents_to_be_is_told_by_its_parameters():
    found = first(with_drive(base_frame_id='base_link'))
    assert 'base_frame_id: base_footprint' in found.fix


def test_a_frame_of_gazebo_is_told_with_that_of_the_description():
    found = first(FAULTS['sensor_frame_missing'])
    assert "to 'laser'" in found.fix or "'base_link'" in found.fix


def test_numbers_that_are_none_are_no_rotation():
    bad = edge('base_link', 'camera', rotation=(math.nan, 0.0, 0.0, 1.0))
    assert first(with_edges(bad)).rule == 'tf_no_rotation'


def without_states(**sections):
    seen = with_edges(without=[f'wheel_{side}' for side in robots.SIDES])
    return replace(seen, sensors=with_sensors(joints=()).sensors, **sections)


def test_what_mends_joints_without_state_makes_up_none_of_a_robot_that_has_some():
    assert 'joint_state_publisher' not in first(FAULTS['joints_without_state']).fix
    fix = first(without_states()).fix
    assert fix.endswith('spawner joint_state_broadcaster -c /controller_manager')
    fix = first(without_states(controllers=None)).fix
    assert fix == 'ros2 run joint_state_publisher joint_state_publisher'


def test_stamps_of_a_bag_set_no_clock_of_a_machine():
    old = replace(SCAN, age=10**15, publishers=('/rosbag2_player',))
    transforms = ObservedTransforms(
        trees=(Tree(edges=(edge('laser', 'x', '/rosbag2_player', youngest=10**15),)),)
    )
    found = examine(Observations(sensors=ObservedSensors(scans=(old,)), transforms=transforms))
    assert [each.rule for each in found] == ['tf_stale', 'sensor_stamp']
    for each in found:
        assert 'play the bag with --clock 100' in each.fix
        assert 'chronyc' not in each.fix


def test_a_camera_without_calibration_is_a_warning_whatever_size_it_says():
    (found,) = examine(with_sensors(images=(replace(IMAGE, info_size=(0, 0)),)))
    assert (found.rule, found.severity) == ('camera_info', 'warning')
    assert 'is not calibrated' in found.what


def test_a_finalized_component_is_not_to_be_activated():
    found = first(with_manager(components=(replace(SYSTEM, state='finalized'),)))
    assert found.fix.startswith('restart /controller_manager')


def test_a_finalized_controller_is_loaded_anew():
    drive = replace(DRIVER, state='finalized')
    found = first(with_manager(controllers=(drive, BROADCASTER)))
    assert found.rule == 'controller_unconfigured'
    assert 'ros2 control unload_controller diff_drive_controller && ros2 run' in found.fix
    assert 'set_controller_state' not in found.fix


def test_the_name_of_a_frame_is_no_command_of_a_shell():
    frame = 'x; reboot'
    found = first(with_sensors(scans=(replace(SCAN, frame=frame),)))
    assert found.fix.endswith("--child-frame-id 'x; reboot'")
    found = first(with_edges(edge(frame, '$(reboot)', is_static=True)))
    assert found.fix.endswith("--child-frame-id 'x; reboot'")


def test_a_manager_is_not_called_silent_where_nobody_gets_a_processor():
    silent = with_manager(answers=False, controllers=(), components=())
    busy = replace(silent, machine=replace(MACHINE, load=9.0))
    assert [each.rule for each in examine(busy)] == ['overloaded']


def test_the_log_of_a_silent_manager_is_asked_for_by_the_name_of_its_logger():
    found = first(with_manager(name='/r1/controller_manager', answers=False, controllers=()))
    assert found.rule == 'controller_manager_silent'
    assert "m.name=='r1.controller_manager'" in found.fix
