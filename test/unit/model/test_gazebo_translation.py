# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Gazebo's plugins as hardware and controllers: names, defaults, topics, and what is left out."""

from fixtures.sim.plugin_robot import cart, classic_drive, gz_drive, JOINTS, plugin, wheel
import pytest

from amr_description.controllers import CONTROLLERS
from amr_description.controllers.checks.wheeled_drive_files import rollers_of_plugins
from amr_description.model.gazebo.builder import CLAIMED_JOINTS
from amr_description.model.gazebo.plugins import kind_of
from amr_description.model.gazebo.translation import translate
from amr_description.model.ros2_control_tag import hardware_of
from amr_description.model.urdf import parse
from amr_description.parameters import build

REAL = 1e12


def translated(*plugins, reference=''):
    return translate(parse(cart(*plugins, reference=reference), 'cart.urdf'))


def only(*plugins, reference=''):
    """The controllers by name, each of which must take its parameters."""
    found = {each.name: each for each in translated(*plugins, reference=reference).controllers}
    for each in found.values():
        table = CONTROLLERS.find(each.type).parameters_type
        build(table, {k: v for k, v in each.parameters.items() if k != 'update_rate'})
    return found


@pytest.mark.parametrize(
    'filename, name, kind',
    [
        ('libgazebo_ros_diff_drive.so', 'my drive', 'gazebo-ros-diff-drive'),
        ('/opt/lib/libgazebo_ros_p3d.so', '', 'gazebo-ros-p3d'),
        ('gz-sim-diff-drive-system', 'gz::sim::systems::DiffDrive', 'diff-drive'),
        ('', 'gz::sim::systems::DiffDrive', 'diff-drive'),
        ('libgz-sim8-diff-drive-system.so', 'x', 'diff-drive'),
        ('libignition-gazebo-diff-drive-system.so', 'x', 'diff-drive'),
        ('x', 'ignition::gazebo::systems::JointStatePublisher', 'joint-state-publisher'),
        ('x', 'gz::sim::v8::systems::VelocityControl', 'velocity-control'),
        ('libmaker_diff_drive.so', 'maker::DiffDrive', ''),
    ],
)
def test_kinds(filename, name, kind):
    assert kind_of(filename, name) == kind


def test_a_drive_of_new_gazebo():
    drive = only(
        gz_drive("""<topic>/model/cart/cmd_vel</topic><odom_topic>wheel/odom</odom_topic>
        <max_linear_acceleration>2</max_linear_acceleration>
        <min_linear_acceleration>-3</min_linear_acceleration>
        <max_velocity>0.7</max_velocity><odom_publish_frequency>20</odom_publish_frequency>""")
    )['diff_drive']
    assert drive.type == 'amr_description/GazeboDiffDrive'
    assert drive.topics == {'~/cmd_vel': 'cmd_vel', '~/odom': 'wheel/odom', '/tf': '/tf'}
    assert drive.parameters == {
        'left_wheel_names': ['left_joint'],
        'right_wheel_names': ['right_joint'],
        'wheel_separation': 0.3,
        'wheel_radius': 0.05,
        'linear.x.max_velocity': 0.7,
        'linear.x.max_acceleration': 2.0,
        'linear.x.max_deceleration_reverse': 2.0,
        'linear.x.max_deceleration': -3.0,
        'linear.x.max_acceleration_reverse': -3.0,
        'angular.z.max_velocity': 0.7,
        'odom_frame_id': 'odom',
        'base_frame_id': 'base_link',
        'publish_rate': 20.0,
        'enable_odom_tf': True,
    }


def test_defaults_of_new_gazebo():
    found = only(plugin('gz-sim-diff-drive-system', 'gz::sim::systems::DiffDrive', JOINTS))
    assert found['diff_drive'].topics == {'~/cmd_vel': 'cmd_vel', '~/odom': 'odom', '/tf': '/tf'}
    parameters = found['diff_drive'].parameters
    assert (parameters['wheel_separation'], parameters['wheel_radius']) == (1.0, 0.2)
    assert parameters['publish_rate'] == 50.0


def test_defaults_of_classic_publish_nothing():
    found = only(plugin('libgazebo_ros_diff_drive.so', 'drive', JOINTS))
    drive = found['drive']
    assert list(found) == ['drive', 'joint_state_broadcaster']
    parameters = drive.parameters
    assert (parameters['wheel_separation'], parameters['wheel_radius']) == (0.34, 0.075)
    assert parameters['publish_rate'] == 100.0
    assert not parameters['publish_odom'] and not parameters['enable_odom_tf']
    assert 'max_wheel_acceleration' not in parameters


def test_odometry_of_classic_is_that_of_the_world_or_of_the_wheels():
    wanted = '<publish_odom>true</publish_odom><publish_odom_tf>true</publish_odom_tf>'
    rules = '<ros><namespace>/r1</namespace><remapping>odom:=wheel/odom</remapping></ros>'
    found = only(classic_drive(wanted + rules + '<robot_base_frame>base_link</robot_base_frame>'))
    truth = found['drive_odometry']
    assert truth.type == 'amr_description/GazeboOdometryPublisher'
    assert truth.topics['~/odom'] == 'wheel/odom'
    assert truth.namespace == 'r1'
    assert truth.parameters['link'] == truth.parameters['base_frame_id'] == 'base_link'
    assert truth.parameters['pose_covariance_diagonal'] == [1e-5, 1e-5, REAL, REAL, REAL, 1e-3]
    assert not found['drive'].parameters['publish_odom']
    found = only(classic_drive(f'{wanted}<odometry_source>0</odometry_source>'))
    assert found['drive'].parameters['publish_odom'] and 'drive_odometry' not in found
    assert found['drive'].topics['~/odom'] == 'odom'


def four_wheels(*plugins):
    """A car of four wheels; the front ones are steered."""
    links = ''.join(f'<link name="{name}"/>' for name in ('b', 'sl', 'sr', 'fl', 'fr', 'rl', 'rr'))

    def joint(name, parent, kind, xyz, limit=''):
        return f"""<joint name="{name}_joint" type="{kind}"><parent link="{parent}"/>
        <child link="{name}"/><origin xyz="{xyz}"/><axis xyz="0 1 0"/>{limit}</joint>"""

    limit = '<limit lower="-1" upper="1" effort="1" velocity="1"/>'
    joints = ''.join(
        (
            joint('sl', 'b', 'revolute', '0.5 0.2 0', limit),
            joint('sr', 'b', 'revolute', '0.5 -0.2 0', limit),
            joint('fl', 'sl', 'continuous', '0 0.05 0'),
            joint('fr', 'sr', 'continuous', '0 -0.05 0'),
            joint('rl', 'b', 'continuous', '-0.3 0.3 0'),
            joint('rr', 'b', 'continuous', '-0.3 -0.3 0'),
        )
    )
    text = f'<robot name="car">{links}{joints}<gazebo>{"".join(plugins)}</gazebo></robot>'
    found = translate(parse(text))
    for each in found.controllers:
        build(CONTROLLERS.find(each.type).parameters_type, each.parameters)
    return found


def test_mecanum_wheels_of_new_gazebo():
    corners = ('front_left', 'front_right', 'back_left', 'back_right')
    joints = ''.join(
        f'<{corner}_joint>{name}_joint</{corner}_joint>'
        for corner, name in zip(corners, ('fl', 'fr', 'rl', 'rr'), strict=True)
    )
    sizes = """<wheelbase>0.8</wheelbase><wheel_separation>0.6</wheel_separation>
    <wheel_radius>0.1</wheel_radius><max_linear_velocity>2</max_linear_velocity>"""
    one = plugin('', 'gz::sim::systems::MecanumDrive', joints + sizes)
    found = four_wheels(one)
    drive, _ = found.controllers
    assert drive.type == 'amr_description/GazeboMecanumDrive'
    assert drive.parameters['rear_right_wheel_command_joint_name'] == 'rr_joint'
    reach = drive.parameters['kinematics.sum_of_robot_center_projection_on_X_Y_axis']
    assert reach == pytest.approx(0.7)
    assert drive.parameters['linear.y.max_velocity'] == 2.0
    assert [*rollers_of_plugins(found)] == ['fl_joint', 'fr_joint', 'rr_joint', 'rl_joint']
    assert drive.topics == {'~/cmd_vel': 'cmd_vel', '~/odometry': 'odom', '/tf': '/tf'}


STEERED = """<left_steering_joint>sl_joint</left_steering_joint>
<right_steering_joint>sr_joint</right_steering_joint>"""


REAR = '<left_joint>rl_joint</left_joint><right_joint>rr_joint</right_joint>'


def test_a_car_of_new_gazebo():
    wheels = ''.join(
        f'<{side}_joint>{name}_joint</{side}_joint>'
        for side, name in (('left', 'fl'), ('right', 'fr'), ('left', 'rl'), ('right', 'rr'))
    )
    found = four_wheels(plugin('', 'gz::sim::systems::AckermannSteering', wheels + STEERED))
    car = found.controllers[0].parameters
    assert car['traction_joints_names'] == ['rr_joint', 'rl_joint']
    assert car['steering_joints_names'] == ['sr_joint', 'sl_joint']
    assert (car['wheelbase'], car['steering_track_width']) == (1.0, 0.8)
    assert found.notes == (
        'plugin "gz::sim::systems::AckermannSteering": "rr_joint", "rl_joint" are driven; its '
        'other wheels roll freely',
    )
    alone = four_wheels(plugin('', 'gz::sim::systems::AckermannSteering', REAR + STEERED))
    assert alone.controllers[0].parameters['traction_joints_names'] == ['rr_joint', 'rl_joint']
    assert alone.notes == ()


def test_a_car_of_classic_is_measured():
    corners = ('front_left', 'front_right', 'rear_left', 'rear_right')
    wheels = ''.join(
        f'<{corner}_joint>{name}_joint</{corner}_joint>'
        for corner, name in zip(corners, ('fl', 'fr', 'rl', 'rr'), strict=True)
    )
    inside = f'{wheels}{STEERED}<wheel_radius>0.3</wheel_radius><publish_odom>1</publish_odom>'
    found = four_wheels(plugin('libgazebo_ros_ackermann_drive.so', 'car', inside))
    car, truth, _ = found.controllers
    assert truth.name == 'car_odometry'
    assert car.parameters['angular_is_steering'] and car.parameters['max_steer'] == 0.6
    sizes = [car.parameters[name] for name in ('wheelbase', 'traction_track_width')]
    assert sizes == pytest.approx([0.8, 0.6])
    assert car.parameters['steering_track_width'] == pytest.approx(0.5)
    assert car.parameters['traction_wheels_radius'] == 0.3


@pytest.mark.parametrize('hinges', [True, False])
@pytest.mark.parametrize(
    'library', ['libgazebo_ros_ackerman.so', 'libgazebo_ros_ackerman_drive.so']
)
def test_a_car_of_a_vendor_is_told_a_turn_and_finds_what_steers_above_its_wheels(library, hinges):
    corners = ('leftFront', 'rightFront', 'leftRear', 'rightRear')
    inside = ''.join(
        f'<{corner}Joint>{name}_joint</{corner}Joint>'
        for corner, name in zip(corners, ('fl', 'fr', 'rl', 'rr'), strict=True)
    )
    if hinges:
        inside += '<leftHingeJoint>sl_joint</leftHingeJoint>'
        inside += '<rightHingeJoint>sr_joint</rightHingeJoint>'
    inside += '<commandTopic>car/cmd_vel</commandTopic><wheelDiameter>0.6</wheelDiameter>'
    car, truth, _ = four_wheels(plugin(library, 'car', inside)).controllers
    assert car.type == 'amr_description/GazeboAckermannDrive'
    assert car.parameters['traction_joints_names'] == ['rr_joint', 'rl_joint']
    assert car.parameters['steering_joints_names'] == ['sr_joint', 'sl_joint']
    assert not car.parameters['angular_is_steering']
    assert car.parameters['traction_wheels_radius'] == 0.3
    assert car.topics['~/cmd_vel'] == 'car/cmd_vel'
    assert truth.topics['~/odom'] == 'odom'


def test_names_of_ros_1():
    found = only(
        plugin(
            'libgazebo_ros_skid_steer_drive.so',
            'skid',
            """<leftFrontJoint>left_joint</leftFrontJoint>
            <rightFrontJoint>right_joint</rightFrontJoint>
            <wheelSeparation>0.3</wheelSeparation><wheelDiameter>0.1</wheelDiameter>
            <commandTopic>drive/cmd_vel</commandTopic><odometrySource>encoder</odometrySource>""",
        )
    )
    skid = found['skid']
    assert skid.topics == {'~/cmd_vel': 'drive/cmd_vel', '~/odom': 'odom', '/tf': '/tf'}
    assert skid.parameters['publish_odom'] and skid.parameters['wheel_radius'] == 0.05


def test_the_torque_of_the_wheels_is_limited():
    robot = translated(classic_drive('<max_wheel_torque>20</max_wheel_torque>')).robot
    assert [robot.joint(f'{side}_joint').limit.effort for side in ('left', 'right')] == [20, 20]
    assert translated(classic_drive()).robot.joint('left_joint').limit.effort == 5.0
    assert translated(gz_drive()).robot.joint('left_joint').limit is None


def test_the_hardware_has_all_joints():
    robot = translated(gz_drive()).robot
    (info,) = hardware_of(robot)
    assert [each.name for each in info.joints] == ['left_joint', 'right_joint']
    assert [each.name for each in info.joints[0].command_interfaces] == ['velocity']
    assert translate(robot).robot == robot


def test_classics_force_based_move_is_planar_move():
    one = plugin('libgazebo_ros_force_based_move.so', 'move', '<commandTopic>go</commandTopic>')
    move = only(one)['move']
    assert move.type == 'amr_description/GazeboPlanarMove'
    assert move.topics['~/cmd_vel'] == 'go'


def test_a_body_that_is_moved():
    found = translated(plugin('libgazebo_ros_planar_move.so', 'planar'))
    base = found.robot.plugin_hardware[-1]
    assert base.plugin == 'amr_description/SimulatedBase'
    assert [each.name for each in base.sensors] == ['base_link/ground_truth']
    move, odometry, states = found.controllers
    assert states.type == 'joint_state_broadcaster/JointStateBroadcaster'
    assert move.type == 'amr_description/GazeboPlanarMove'
    assert odometry.name == 'planar_odometry'
    assert odometry.parameters['publish_rate'] == 20.0
    found = only(plugin('', 'gz::sim::systems::VelocityControl'))
    assert list(found) == ['velocity_control', 'joint_state_broadcaster']


def test_a_body_without_joints_has_no_joint_states():
    drive = plugin('libgazebo_ros_planar_move.so', 'planar')
    found = translate(
        parse(
            f'<robot name="puck"><link name="disc"/><gazebo>{drive}</gazebo></robot>', 'puck.urdf'
        )
    )
    assert [each.name for each in found.controllers] == ['planar', 'planar_odometry']


def test_joint_state_publishers():
    one = '<joint_name>left_joint</joint_name><joint_name>arm</joint_name>'
    found = translated(plugin('libgazebo_ros_joint_state_publisher.so', 'states', one))
    (states,) = found.controllers
    assert states.parameters['joints'] == ['left_joint']
    assert states.parameters['update_rate'] == 100
    assert found.notes[0] == ('plugin "states": there is no joint "arm"; it publishes the others')
    (states,) = translated(plugin('', 'gz::sim::systems::JointStatePublisher')).controllers
    assert (states.name, states.topics) == (
        'joint_state_publisher',
        {'joint_states': 'joint_states'},
    )
    assert 'joints' not in states.parameters


def test_true_odometry():
    body = '<body_name>left_wheel</body_name><xyz_offset>1 2 3</xyz_offset>'
    p3d = only(plugin('libgazebo_ros_p3d.so', 'p3d', body))['p3d'].parameters
    assert p3d['link'] == 'left_wheel' and p3d['odom_frame_id'] == 'world'
    assert p3d['offset.xyz'] == [1, 2, 3] and p3d['twist_in_world'] and not p3d['enable_odom_tf']
    publisher = plugin('', 'gz::sim::systems::OdometryPublisher')
    alone = only(publisher)['odometry_publisher']
    assert alone.topics == {'~/odom': 'odom', '/tf': '/tf'} and alone.parameters['enable_odom_tf']
    beside = only(publisher, gz_drive())['odometry_publisher']
    assert beside.topics['~/odom'] == 'odometry' and not beside.parameters['enable_odom_tf']
    asked = publisher.replace('></', '><tf_topic>/model/cart/pose</tf_topic></')
    assert only(gz_drive(), asked)['odometry_publisher'].parameters['enable_odom_tf']


@pytest.mark.parametrize(
    'inside, name, topic, frame',
    [
        ('', 'imu_0', 'imu', 'base_link'),
        ('<topic>imu/raw</topic><gz_frame_id>f</gz_frame_id>', 'imu_0', 'imu/raw', 'f'),
        (plugin('libgazebo_ros_imu_sensor.so', 'unit'), 'unit', '~/out', 'base_link'),
        (
            plugin(
                'libgazebo_ros_imu_sensor.so',
                'unit',
                '<ros><remapping>~/out:=imu</remapping></ros><frame_name>f</frame_name>',
            ),
            'unit',
            'imu',
            'f',
        ),
    ],
)
def test_inertial_measurement_units(inside, name, topic, frame):
    sensor = f'<sensor name="imu_0" type="imu"><update_rate>50</update_rate>{inside}</sensor>'
    found = translated(reference=sensor)
    (unit,) = found.controllers
    assert unit.name == name and unit.topics == {'~/imu': topic}
    assert unit.parameters == {'sensor_name': 'imu_0', 'frame_id': frame, 'update_rate': 50}
    assert found.robot.plugin_hardware[0].sensors[0].name == 'imu_0'
    assert not found.not_simulated


def test_a_leading_slash_means_nothing_in_gazebo():
    """Two robots of one description have topics of their own."""
    found = translated(reference='<sensor name="a" type="imu"><topic>/imu</topic></sensor>')
    (unit,) = found.controllers
    assert unit.names_of_topics('/robot1') == {'~/imu': '/robot1/imu'}


def test_a_topic_that_begins_with_the_namespace_has_it_once():
    found = translated(reference='<sensor name="a" type="imu"><topic>/r1/imu</topic></sensor>')
    (unit,) = found.controllers
    assert unit.names_of_topics('/r1') == {'~/imu': '/r1/imu'}
    assert unit.names_of_topics('/r') == {'~/imu': '/r/r1/imu'}


def test_a_magnetometer():
    noise = '<noise type="gaussian"><stddev>2e-7</stddev></noise>'
    found = translated(
        reference=f"""<sensor name="compass" type="magnetometer"><update_rate>50</update_rate>
        <topic>/model/amr/mag</topic><magnetometer><x>{noise}</x></magnetometer></sensor>"""
    )
    (compass,) = found.controllers
    assert compass.type == 'magnetometer_broadcaster/MagnetometerBroadcaster'
    assert (compass.name, compass.topics) == ('compass', {'~/magnetic_field': 'mag'})
    covariance = compass.parameters['static_covariance']
    assert covariance == pytest.approx([4e-14] + [0.0] * 8)
    (sensor,) = found.robot.plugin_hardware[0].sensors
    assert [each.name for each in sensor.state_interfaces] == [
        f'magnetic_field.{axis}' for axis in 'xyz'
    ]
    assert not found.not_simulated


@pytest.mark.parametrize(
    ('inside', 'frame'),
    [
        ('', 'child'),
        ('<force_torque><frame>parent</frame></force_torque>', 'parent'),
        ('<gz_frame_id>tool</gz_frame_id>', 'tool'),
    ],
)
def test_a_force_torque_sensor_of_a_joint(inside, frame):
    urdf = f"""<robot name="r"><link name="parent"/><link name="child"/>
        <joint name="wrist" type="fixed"><parent link="parent"/><child link="child"/></joint>
        <gazebo reference="wrist"><sensor name="ft" type="force_torque">{inside}</sensor></gazebo>
        </robot>"""
    found = translate(parse(urdf, 'r.urdf'))
    (broadcaster,) = found.controllers
    assert broadcaster.parameters == {'sensor_name': 'ft', 'frame_id': frame}
    assert broadcaster.topics == {'~/wrench': 'ft/force_torque'}
    (sensor,) = found.robot.plugin_hardware[0].sensors
    assert len(sensor.state_interfaces) == 6
    assert not found.not_simulated


def test_a_force_torque_sensor_of_classic():
    urdf = """<robot name="r"><link name="parent"/><link name="child"/>
        <joint name="wrist" type="fixed"><parent link="parent"/><child link="child"/></joint>
        <gazebo><plugin name="ft" filename="libgazebo_ros_ft_sensor.so"><ros>
        <namespace>/arm</namespace><remapping>wrench:=force</remapping></ros>
        <update_rate>50</update_rate><joint_name>%s</joint_name></plugin></gazebo></robot>"""
    found = translate(parse(urdf % 'wrist', 'r.urdf'))
    (broadcaster,) = found.controllers
    assert broadcaster.names_of_topics('') == {'~/wrench': '/arm/force'}
    assert broadcaster.parameters == {'sensor_name': 'ft', 'frame_id': 'child', 'update_rate': 50}
    (sensor,) = found.robot.plugin_hardware[0].sensors
    assert sensor.parameters == {'link': 'child'}
    lost = translate(parse(urdf % 'elbow', 'r.urdf'))
    assert lost.notes == ('plugin "ft": it is left out: there is no joint "elbow"',)


@pytest.mark.parametrize(
    ('kind', 'inside', 'note'),
    [
        (
            'magnetometer',
            '<update_rate>fast</update_rate>',
            '<update_rate> is "fast", where Hz from 0 on are expected; it is published at the '
            'rate of the controller manager',
        ),
        (
            'force_torque',
            '<force_torque><frame>moon</frame></force_torque>',
            '<frame> is "moon", which is none of child, parent, sensor; child is taken',
        ),
        (
            'force_torque',
            '<force_torque><measure_direction>up</measure_direction></force_torque>',
            '<measure_direction> is "up", which is none of child_to_parent, parent_to_child; '
            'child_to_parent is taken',
        ),
    ],
)
def test_what_a_sensor_says_and_cannot_be_is_told(kind, inside, note):
    urdf = f"""<robot name="r"><link name="base"/><link name="tip"/>
        <joint name="j" type="fixed"><parent link="base"/><child link="tip"/></joint>
        <gazebo reference="tip"><sensor name="s" type="{kind}">{inside}</sensor></gazebo>
        </robot>"""
    found = translate(parse(urdf, 'r.urdf'))
    assert len(found.controllers) == 1
    assert found.notes == (f'sensor "s": {note}',)


def test_of_two_sensors_of_one_name_the_first_counts():
    sensor = '<sensor name="s" type="magnetometer"/>'
    found = translated(reference=sensor + sensor)
    assert len(found.controllers) == 1 and not found.not_simulated
    assert found.notes == (
        'sensor "s" stands twice; the second one is left out, give it another name',
    )


def test_a_rate_above_the_highest_is_told():
    found = translated(
        reference='<sensor name="unit" type="imu"><update_rate>1000</update_rate></sensor>'
    )
    assert found.notes == (
        'sensor "unit" asks for 1000 Hz, and is published at 200 Hz, '
        'the most that sensors have here',
    )


def test_what_is_not_simulated_is_named_once():
    sensors = """<sensor name="eye" type="camera"/><sensor name="height" type="altimeter"/>
    <sensor name="fix" type="navsat"/><sensor name="fix_2" type="navsat"/>
    <sensor name="rear" type="camera">
      <plugin filename="libgazebo_ros_thermal.so" name="c"/></sensor>
    <sensor name="unit" type="imu"/>"""
    found = translated(
        gz_drive(),
        plugin('gz-sim-sensors-system', 'gz::sim::systems::Sensors'),
        plugin('gz-sim-imu-system', 'gz::sim::systems::Imu'),
        plugin('gz-sim-navsat-system', 'gz::sim::systems::NavSat'),
        plugin('gz-sim-forcetorque-system', 'gz::sim::systems::ForceTorque'),
        plugin('gz_ros2_control-system', 'gz_ros2_control::GazeboSimROS2ControlPlugin'),
        plugin('libmaker_suspension.so', 'maker::Suspension'),
        plugin('libmaker_suspension.so', 'maker::Suspension'),
        reference=sensors,
    )
    assert found.not_simulated == (
        'declared for Gazebo and not simulated: sensors altimeter (height), navsat (fix, fix_2), '
        'camera (rear); plugin libmaker_suspension.so (maker::Suspension)'
    )
    assert not translated(gz_drive()).not_simulated


def test_a_robot_that_says_nothing_is_noted():
    assert translated().remarks == (
        'nothing drives it: there is no <ros2_control>, and no drive plugin of Gazebo; its joints '
        'are free, as there: "left_joint", "right_joint"',
    )
    assert not translated(gz_drive()).remarks
    legged = """<robot name="r"><link name="body"/><link name="leg"/><link name="foot"/>
    <joint name="hip" type="revolute"><parent link="body"/><child link="leg"/>
      <limit lower="-1" upper="1" effort="9" velocity="9"/></joint>
    <joint name="toe" type="revolute"><parent link="leg"/><child link="foot"/>
      <limit lower="-1" upper="1" effort="0" velocity="9"/></joint></robot>"""
    (remark,) = translate(parse(legged, 'r.urdf')).remarks
    assert remark.endswith('; its joints are free, as there: "toe"')


def test_joints_that_are_commanded_by_a_number():
    inside = '<joint_name>left_joint</joint_name><initial_position>0.5</initial_position>'
    found = translated(
        plugin('', 'gz::sim::systems::JointPositionController', inside),
        plugin(
            '',
            'gz::sim::systems::JointController',
            '<joint_name>right_joint</joint_name><topic>spin</topic>',
        ),
    )
    position, velocity, _ = found.controllers
    assert position.name == 'left_joint_position'
    assert position.topics == {'~/command': '/model/cart/joint/left_joint/cmd_pos'}
    assert velocity.parameters == {'joints': ['right_joint'], 'interface_name': 'velocity'}
    assert velocity.topics == {'~/command': 'spin'}
    left, right = found.robot.plugin_hardware[0].joints
    assert left.state_interfaces[0].initial_value == 0.5
    assert [each.name for each in right.command_interfaces] == ['velocity']


def test_trajectories_of_new_gazebo():
    inside = '<joint_name>left_joint</joint_name><topic>/model/cart/arm</topic>'
    kind = 'gz::sim::systems::JointTrajectoryController'
    found = only(plugin('', kind, inside))['joint_trajectory_controller']
    assert found.parameters['joints'] == ['left_joint'] and found.topics == {
        '~/joint_trajectory': 'arm'
    }
    found = only(plugin('', kind))['joint_trajectory_controller']
    assert found.parameters['joints'] == ['left_joint', 'right_joint']
    assert found.topics == {'~/joint_trajectory': 'joint_trajectory'}


def test_transmissions_of_ros_1():
    kinds = {'left': 'hardware_interface/VelocityJointInterface', 'right': 'EffortJointInterface'}
    transmissions = ''.join(
        f"""<transmission name="{side}"><joint name="{side}_joint">
        <hardwareInterface>{kind}</hardwareInterface></joint></transmission>"""
        for side, kind in kinds.items()
    )
    text = cart(plugin('libgazebo_ros_control.so', 'gazebo_ros_control'))
    found = translate(parse(text.replace('</robot>', f'{transmissions}</robot>')))
    left, right = found.robot.plugin_hardware[0].joints
    assert left.command_interfaces[0].name == 'velocity'
    assert right.command_interfaces[0].name == 'effort'
    assert found.remarks == (
        'plugin "gazebo_ros_control" is of ROS 1; its 2 joints of <transmission> can be commanded '
        'by ros2_control ("velocity", "effort"), by controllers of a parameter file that is given',
    )
    assert not found.not_simulated


POLICY = """controller_manager: {ros__parameters: {legs: {type: my_legs.policy/Policy}}}
legs: {ros__parameters: {joints: [right_joint], gain: 2.0}}
"""
ALL_THREE = ['position', 'velocity', 'effort']


@pytest.fixture
def claiming(tmp_path):
    file = tmp_path / 'legs.yaml'
    file.write_text(POLICY)
    return [file]


def commands_of(found):
    (hardware,) = found.robot.plugin_hardware
    return {each.name: [i.name for i in each.command_interfaces] for each in hardware.joints}


def test_joints_that_no_tag_commands_are_left_to_the_controllers_that_claim_them(claiming):
    wheels = parse(cart(), 'cart.urdf')
    assert not translate(wheels).robot.plugin_hardware
    found = translate(wheels, claiming)
    assert commands_of(found) == {'left_joint': [], 'right_joint': ALL_THREE}
    assert found.robot.plugin_hardware[0].name == CLAIMED_JOINTS and not found.controllers
    assert found.remarks == (
        'there is no <ros2_control>: position, velocity and effort are simulated of the joints '
        'that its controllers claim: "right_joint"',
    )


def test_of_a_robot_on_legs_all_motors_are_held_until_they_are_claimed(claiming):
    legs = cart().replace('"continuous"', '"revolute"')
    legs = legs.replace('<axis', '<limit lower="-1" upper="1" effort="9" velocity="9"/><axis')
    found = translate(parse(legs, 'legs.urdf'), claiming)
    assert commands_of(found) == {'left_joint': ALL_THREE, 'right_joint': ALL_THREE}


@pytest.mark.parametrize(
    'text',
    [
        cart(classic_drive()),
        cart().replace(
            '</robot>',
            '<ros2_control name="a" type="system"><hardware><plugin>a/B</plugin></hardware>'
            '<joint name="left_joint"><state_interface name="position"/></joint></ros2_control>'
            '</robot>',
        ),
    ],
)
def test_joints_that_a_tag_commands_stay_with_it(claiming, text):
    robot = parse(text, 'cart.urdf')
    expected = translate(robot).robot.plugin_hardware
    assert translate(robot, claiming).robot.plugin_hardware == expected


def test_transmissions_of_ros_1_leave_a_drive_its_wheels():
    """Whichever stands first, as in Gazebo; a wheel beside those is left to roll."""
    kind = '<hardwareInterface>EffortJointInterface</hardwareInterface>'
    transmissions = ''.join(
        f'<transmission name="{side}"><joint name="{side}_joint">{kind}</joint></transmission>'
        for side in ('left', 'third')
    )
    text = cart(plugin('libgazebo_ros_control.so', 'gazebo_ros_control'), classic_drive())
    third = wheel('third', 0.0)
    found = translate(parse(text.replace('</robot>', f'{third}{transmissions}</robot>')))
    assert [each.name for each in found.controllers][:1] == ['drive'] and not found.notes
    driven = dict.fromkeys(('left_joint', 'right_joint'), ['velocity'])
    assert commands_of(found) == driven | {'third_joint': []}


def test_transmissions_of_ros_1_leave_what_is_claimed(claiming):
    kind = '<hardwareInterface>EffortJointInterface</hardwareInterface>'
    transmission = (
        f'<transmission name="t"><joint name="right_joint">{kind}</joint></transmission>'
    )
    text = cart(plugin('libgazebo_ros_control.so', 'gazebo_ros_control'))
    text = text.replace('</robot>', f'{transmission}</robot>')
    assert commands_of(translate(parse(text)))['right_joint'] == ['effort']
    assert commands_of(translate(parse(text), claiming))['right_joint'] == ALL_THREE


@pytest.mark.parametrize(
    'one, note',
    [
        (
            classic_drive().replace('>left_joint', '>left'),
            'plugin "drive": it cannot work: there is no joint "left" that moves; there are: '
            '"left_joint", "right_joint"',
        ),
        (
            classic_drive('<left_joint>left_joint</left_joint>'),
            'plugin "drive": it cannot work: 2 joints are on the left and 1 on the right',
        ),
        (
            gz_drive().replace('0.05', '0'),
            'plugin "gz::sim::systems::DiffDrive": it cannot work: <wheel_radius> is "0"; a '
            'number from 0.001 to 100 m will do',
        ),
        (
            classic_drive('<update_rate>fast</update_rate>'),
            'plugin "drive": <update_rate> is "fast", which is no number; its default is taken',
        ),
        (
            plugin('libgazebo_ros_p3d.so', 'p', '<body_name>b</body_name>'),
            'plugin "p": it cannot work: there is no link "b"; there are: "base_link", '
            '"left_wheel", "right_wheel"',
        ),
    ],
)
def test_what_cannot_work_is_noted(one, note):
    assert translated(one).notes[0] == note


def test_what_ros2_control_has_stays_its_own():
    block = """<ros2_control name="own" type="system">
      <hardware><plugin>amr_description/MujocoSystem</plugin></hardware>
      <joint name="left_joint"><command_interface name="velocity"/></joint>
      <sensor name="unit"><state_interface name="orientation.x"/></sensor></ros2_control>"""
    text = cart(
        classic_drive(),
        plugin('', 'gz::sim::systems::JointStatePublisher'),
        reference='<sensor name="unit" type="imu"/><sensor name="other" type="imu"/>',
    )
    found = translate(parse(text.replace('</robot>', f'{block}</robot>')))
    assert [each.name for each in found.controllers] == ['other']
    assert found.notes == (
        'plugin "drive": it is left out: <ros2_control> has the joints "left_joint"',
        'plugin "gz::sim::systems::JointStatePublisher": it is left out: the robot has '
        '<ros2_control>, whose joint_state_broadcaster publishes its joint states',
    )
    (info,) = found.robot.plugin_hardware
    assert not info.joints and [each.name for each in info.sensors] == ['other']


BESIDE = """<ros2_control name="own" type="system">
  <hardware><plugin>amr_description/MujocoSystem</plugin></hardware>{}</ros2_control></robot>"""
WHEELS = ''.join(
    f'<joint name="{side}_joint"><command_interface name="velocity"/>'
    '<state_interface name="position"/><state_interface name="velocity"/></joint>'
    for side in ('left', 'right')
)
CLAIMING = """controller_manager: {ros__parameters: {own: {
  type: diff_drive_controller/DiffDriveController}}}
own: {ros__parameters: {left_wheel_names: [left_joint], right_wheel_names: [right_joint]}}
"""


def test_a_drive_beside_ros2_control_drives_wheels_that_no_controller_claims(tmp_path):
    robot = parse(cart(classic_drive()).replace('</robot>', BESIDE.format(WHEELS)))
    found = translate(robot)
    assert [each.name for each in found.controllers] == ['drive']
    assert not found.notes
    assert not found.robot.plugin_hardware  # the wheels have what it takes already
    file = tmp_path / 'claiming.yaml'
    file.write_text(CLAIMING)
    left_out = translate(robot, [file])
    assert not left_out.controllers
    (note,) = left_out.notes
    assert note == (
        'plugin "drive": it is left out: <ros2_control> has the joints "left_joint", "right_joint"'
    )
    file.write_text(CLAIMING.replace('[left_joint]', '[a]').replace('[right_joint]', '[b]'))
    assert translate(robot, [file]).controllers


def test_slip_of_wheels_is_simulated_as_friction_and_says_nothing():
    found = translated(plugin('libgz-sim-wheel-slip-system.so', 'gz::sim::systems::WheelSlip'))
    assert not found.not_simulated
    assert not found.notes
