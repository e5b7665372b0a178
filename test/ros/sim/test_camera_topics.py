# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The topics of a camera over DDS, of a world that is stepped by hand."""

from contextlib import contextmanager
from dataclasses import replace
import threading

from fixtures.sim.driving import AMR
import numpy as np
import pytest
import rclpy
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data, QoSProfile
from sensor_msgs.msg import CameraInfo, CompressedImage, Image, PointCloud2
from sensor_msgs_py import point_cloud2
from support.running_programs import PATIENCE

from amr_description.control.ros.loop_publisher import ClockedLoopPublisher, NodeTopics
from amr_description.model.frames import Transform
from amr_description.model.gazebo.tags import Noise
from amr_description.model.sensors import Camera, SensorMount
from amr_description.ros.messages import nanoseconds
from amr_description.ros.service_calls import wait_until
from amr_description.sim.cameras.renderer import RenderedPicture
from amr_description.sim.world import MujocoWorld
from amr_description.simulation.topics.sensor_manager import SensorManager

TURN = 10_000_000
"""ns, of the loop."""
CAMERA = Camera(
    SensorMount('front', 'base_link', Transform((0.0, 0.0, 0.5)), 'camera_optical', rate=20.0),
    64,
    48,
    1.2,
    noise=Noise(stddev=0.02),
    image_topic='camera/image',
    camera_info_topic='camera/camera_info',
    depth_topic='camera/depth_image',
    points_topic='camera/points',
)


class Host:
    """World and topics, as the simulator has them; ``turn`` is its loop."""

    def __init__(self):
        self.node = Node('host')
        self.world = MujocoWorld('warehouse')
        self.is_paced = False
        self.lines = []
        self.loop_publisher = ClockedLoopPublisher(self.node, look_period=0)
        self.sensors = SensorManager(
            NodeTopics(self.node, self.loop_publisher),
            self.world,
            self.log,
            lambda: self.is_paced,
            begin_thread=lambda: None,
        )

    def log(self, _, text, **__):
        self.lines.append(text)

    def spawn(self, *cameras, namespace='/'):
        self.world.spawn('amr', AMR, Transform())
        self.sensors.add('amr', namespace, cameras)

    @property
    def task(self):
        """What the first camera asks for measurements."""
        ((_, camera, _), *_) = self.sensors._robots['amr']  # noqa: SLF001
        return camera._task  # noqa: SLF001

    def turn(self, count=1):
        for _ in range(count):
            self.loop_publisher.publish(self.world.time)
            self.world.advance(TURN)

    @contextmanager
    def heard(self, message_type, topic, qos=qos_profile_sensor_data):
        """The list of messages on a topic, from the time on when the publisher knows of us."""
        messages = []
        publisher = next(p for p in self.node.publishers if p.topic_name == topic)
        before = publisher.get_subscription_count()
        subscription = self.node.create_subscription(message_type, topic, messages.append, qos)
        self.wait(lambda: publisher.get_subscription_count() > before)
        self.wait(lambda: subscription.get_publisher_count() > 0)
        yield messages
        self.node.destroy_subscription(subscription)

    def wait(self, condition):
        assert wait_until(self.node, lambda: condition() or None, timeout=PATIENCE)


@pytest.fixture
def host():
    rclpy.init(args=[])
    host = Host()
    yield host
    host.sensors.close()
    host.node.destroy_node()
    rclpy.try_shutdown()


def pixels(message, kind=np.uint8):
    values = np.frombuffer(message.data.tobytes(), kind)
    return values.reshape(message.height, message.width, -1)


def stamp_of(message):
    return nanoseconds(message.header.stamp)


def test_pictures_depth_and_points_of_one_instant_fit_together(host):
    host.spawn(CAMERA, namespace='/fleet')
    with (
        host.heard(Image, '/fleet/camera/image') as images,
        host.heard(Image, '/fleet/camera/depth_image') as depths,
        host.heard(PointCloud2, '/fleet/camera/points') as clouds,
        host.heard(CameraInfo, '/fleet/camera/camera_info') as infos,
        host.heard(CompressedImage, '/fleet/camera/image/compressed') as jpegs,
    ):
        host.turn(11)
        host.wait(lambda: all(map(len, (images, depths, clouds, infos, jpegs))))
        host.wait(lambda: len(infos) == 2)
    image, depth, cloud, info, jpeg = (each[0] for each in (images, depths, clouds, infos, jpegs))
    assert {each.header.frame_id for each in (image, depth, cloud, info, jpeg)} == {
        'fleet/camera_optical'
    }
    assert {stamp_of(each) for each in (image, depth, cloud, info, jpeg)} == {50_000_000}
    assert (image.encoding, image.step, len(image.data)) == ('rgb8', 64 * 3, 64 * 48 * 3)
    assert (depth.encoding, depth.step) == ('32FC1', 64 * 4)
    assert jpeg.format == 'rgb8; jpeg compressed bgr8'
    assert bytes(jpeg.data[:2]) == b'\xff\xd8'
    points = point_cloud2.read_points(cloud, ('x', 'y', 'z', 'rgb')).reshape(48, 64)
    is_seen = np.isfinite(points['z'])
    assert is_seen.any()
    assert (points['z'][is_seen] == pixels(depth, np.float32)[..., 0][is_seen]).all()
    # The bits of each colour: 0x00RRGGBB.
    packed = points['rgb'].copy().view(np.uint32)
    red, _, blue = np.moveaxis(pixels(image).astype(np.uint32), -1, 0)
    assert (packed >> 16 == red).all()
    assert (packed & 255 == blue).all()
    k = np.reshape(info.k, (3, 3))
    v, u = np.nonzero(is_seen)
    x, y, z = (points[name][is_seen] for name in 'xyz')
    assert k[0, 0] * x / z + k[0, 2] == pytest.approx(u, abs=1e-2)
    assert k[1, 1] * y / z + k[1, 2] == pytest.approx(v, abs=1e-2)


def test_what_nobody_hears_is_not_rendered(host):
    host.spawn(CAMERA)
    shots = []
    renderer = host.sensors._equipment.renderer  # noqa: SLF001
    render = renderer.render
    renderer.render = lambda shot: (shots.append(shot), render(shot))[1]
    host.turn(11)
    with host.heard(CameraInfo, '/camera/camera_info') as infos:
        host.turn(11)
        host.wait(lambda: infos)
    assert shots == []
    with host.heard(Image, '/camera/depth_image') as depths:
        host.turn(11)
        host.wait(lambda: depths)
    assert {(shot.with_color, shot.with_depth) for shot in shots} == {(False, True)}


def test_while_time_waits_each_measurement_is_made_and_two_runs_are_equal(host):
    host.spawn(CAMERA)
    runs = []
    for _ in range(2):
        with host.heard(Image, '/camera/image', QoSProfile(depth=100)) as images:
            host.turn(41)
            host.wait(lambda: 400_000_000 in map(stamp_of, images))  # noqa: B023
        runs.append({stamp_of(each): each.data.tobytes() for each in images})
        host.world.reset()
    runs[1].pop(0, None)  # where the second one begins, the first had no camera yet
    assert [*runs[0]] == [50_000_000 * k for k in range(1, 9)]
    assert runs[0] == runs[1]
    assert len({*runs[0].values()}) == 8  # the noise differs


def test_cameras_of_one_name_on_two_links_have_noise_of_their_own(host):
    scene = Camera(SensorMount('eye', 'base_link', rate=20.0), 64, 48, 1.2, noise=CAMERA.noise)
    links = ('base_link', 'wheel_front_left')
    host.spawn(
        *(
            replace(scene, mount=replace(scene.mount, link=link), image_topic=f'{link}/image')
            for link in links
        )
    )
    picture = RenderedPicture(np.full((48, 64, 3), 100, np.uint8), None)
    host.sensors._equipment.renderer.render = lambda _: picture  # noqa: SLF001
    with (
        host.heard(Image, f'/{links[0]}/image') as first,
        host.heard(Image, f'/{links[1]}/image') as second,
    ):
        host.turn(11)
        host.wait(lambda: first and second)
    assert stamp_of(first[0]) == stamp_of(second[0])
    assert (pixels(first[0]) != pixels(second[0])).any()


def test_a_stop_does_not_wait_for_a_picture_that_time_waits_for(host):
    host.spawn(CAMERA)
    begun, go_on = threading.Event(), threading.Event()
    host.sensors._equipment.renderer.render = lambda _: (begun.set(), go_on.wait(PATIENCE))  # noqa: SLF001
    with host.heard(Image, '/camera/image'):
        loop = threading.Thread(target=host.turn, args=(9,))
        loop.start()
        assert begun.wait(PATIENCE)
        host.sensors.stop()
        loop.join(PATIENCE)
        assert not loop.is_alive()
        go_on.set()


def test_while_cycles_are_paced_none_waits_for_a_picture(host):
    host.spawn(CAMERA)
    host.is_paced = True
    begun, go_on = threading.Event(), threading.Event()
    renderer = host.sensors._equipment.renderer  # noqa: SLF001
    render = renderer.render

    def slow(shot):
        if shot.state.time > 50_000_000:
            begun.set()
            assert go_on.wait(PATIENCE)
        return render(shot)

    renderer.render = slow
    with host.heard(Image, '/camera/image') as images:
        host.turn(6)
        # A picture is heard a moment before its measurement is over.
        host.wait(lambda: images and not host.task.is_busy)
        host.turn(5)
        assert begun.wait(PATIENCE)
        host.turn(20)  # four more are due
        go_on.set()
        host.wait(lambda: len(images) == 2)
    assert [*map(stamp_of, images)] == [50_000_000, 100_000_000]
    _, line = host.lines  # the other one says what renders
    assert line.startswith(
        "camera 'front' of 'amr': 1 of 3 measurements were left out, as one takes "
    )
    assert line.endswith('a lower <update_rate> or a smaller <image> would do')


def test_a_camera_goes_with_its_robot_and_another_robot_does_not_disturb_it(host):
    host.spawn(CAMERA)
    with host.heard(Image, '/camera/image') as images:
        host.turn(6)
        host.world.spawn('other', AMR, Transform((2.0, 0.0, 0.0)))
        host.turn(6)
        host.wait(lambda: len(images) == 2)
    difference = np.abs(pixels(images[0]).astype(int) - pixels(images[1]).astype(int))
    assert difference.max() > 100  # it stands in view
    host.sensors.remove('amr')
    host.world.remove('amr')
    host.turn(6)
    assert not [each for each in host.node.publishers if '/camera/' in each.topic_name]
