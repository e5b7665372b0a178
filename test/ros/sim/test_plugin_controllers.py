# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What is logged of Gazebo's plugins at spawn, and the ROS arguments of their controllers."""

from fixtures.sim.plugin_robot import cart, classic_drive, plugin
import pytest
import rclpy
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from support.control_fakes import FakeLog
from support.ros_processes import PATIENCE

from amr_description.log import Severity
from amr_description.model.gazebo.translation import translate
from amr_description.model.urdf import parse
from amr_description.sim.ros.entities import abandon, run_in
from amr_description.simulation.plugin_controllers import log_translation, node_arguments

RULES = '<ros><namespace>/r1</namespace><remapping>odom:=wheel/odom</remapping></ros>'


def translated(*plugins, reference=''):
    return translate(parse(cart(*plugins, reference=reference)))


@pytest.mark.parametrize(
    'namespace, inside, states, eye',
    [('/', '/r1', '/r1/joint_states', '/eye'), ('/r2', '/r2', '/r2/joint_states', '/r2/eye')],
)
def test_a_line_for_each_plugin_and_one_for_all_that_is_not_simulated(
    namespace, inside, states, eye
):
    found = translated(
        classic_drive(f'<publish_odom>1</publish_odom>{RULES}'),
        plugin('libmaker.so', 'maker'),
        reference='<sensor name="eye" type="camera"/><sensor name="fix" type="navsat"/>',
    )
    log = FakeLog()
    log_translation('cart', found, namespace, log)
    assert log.lines == [
        (
            Severity.INFO,
            '\'cart\': for plugin "drive" runs the controller drive '
            f'(amr_description/GazeboDiffDrive): {inside}/cmd_vel',
        ),
        (
            Severity.INFO,
            '\'cart\': for plugin "drive" runs the controller drive_odometry '
            f'(amr_description/GazeboOdometryPublisher): {inside}/wheel/odom',
        ),
        (
            Severity.INFO,
            "'cart': for the transforms of its joints runs the controller joint_state_broadcaster "
            f'(joint_state_broadcaster/JointStateBroadcaster): '
            f'{states}',
        ),
        (
            Severity.INFO,
            f'\'cart\': sensor "eye": {eye}/image, {eye}/camera_info',
        ),
        (
            Severity.WARN,
            "'cart': declared for Gazebo and not simulated: sensor navsat (fix); "
            'plugin libmaker.so (maker)',
        ),
    ]


def test_arguments_of_a_node():
    sensor = """<sensor name="unit" type="imu"><update_rate>200</update_rate>
    <topic>imu/data</topic></sensor>"""
    (unit,) = translated(reference=sensor).controllers
    assert node_arguments(unit, '/r2', 100) == [
        '-p',
        'sensor_name:="unit"',
        '-p',
        'frame_id:="r2/base_link"',
        '-p',
        'update_rate:=100',
        '-r',
        '~/imu:=/r2/imu/data',
    ]


@pytest.fixture
def context():
    context = Context()
    rclpy.init(context=context)
    yield context
    rclpy.shutdown(context=context)


@pytest.mark.filterwarnings('ignore:coroutine .* was never awaited')
def test_who_waits_for_an_executor_that_never_runs_is_released(context):
    ended, waiting = (
        SingleThreadedExecutor(context=context),
        SingleThreadedExecutor(context=context),
    )

    async def start():
        pytest.fail('its executor does not run')

    work = start()
    started = run_in(ended, work, waiting)

    async def wait():
        await started

    task = waiting.create_task(wait)
    waiting.spin_once(timeout_sec=0.0)
    assert not task.done()
    ended.shutdown()
    abandon(started, waiting)
    abandon(started, waiting)
    waiting.spin_until_future_complete(task, timeout_sec=PATIENCE)
    assert task.done()
    work.close()
    waiting.shutdown()


@pytest.mark.parametrize('namespace, frame', [('/', 'base'), ('/r2', 'r2/base')])
def test_messages_of_an_imu_have_the_prefix_of_the_other_frames_of_the_robot(namespace, frame):
    imu = '<sensor name="imu" type="imu"><gz_frame_id>base</gz_frame_id></sensor>'
    [unit] = [each for each in translated(reference=imu).controllers if 'imu' in each.type]
    assert f'frame_id:="{frame}"' in node_arguments(unit, namespace, 100)
