"""Exercise 5: TF."""

import math

from conftest import expect
from geometry_msgs.msg import TransformStamped
import pytest
from rclpy.time import Time
from tf2_ros import Buffer

from amr_description.maps.pose import Pose

LIDAR = Pose(0.2, 0.0, math.pi)  # of the robot's base: it looks backwards


@pytest.fixture
def hit(submitted):
    """The function of the student, over a robot that drives at 1 m/s and turns at 1 rad/s."""
    buffer = Buffer()
    for tick in range(11):
        place(buffer, 'odom', 'base', 0.1 * tick, 0.0, 0.1 * tick, stamp=tick * 100_000_000)
        place(buffer, 'base', 'lidar', *LIDAR, stamp=tick * 100_000_000)

    def ask(frame, seconds, angle, distance):
        stamp = Time(nanoseconds=round(seconds * 1e9))
        return submitted('frames').hit_in_frame(buffer, frame, 'lidar', stamp, angle, distance)

    return ask


def place(buffer, parent, child, x, y, yaw, stamp):
    transform = TransformStamped()
    transform.header.frame_id, transform.child_frame_id = parent, child
    transform.header.stamp = Time(nanoseconds=stamp).to_msg()
    transform.transform.translation.x, transform.transform.translation.y = x, y
    transform.transform.rotation.z = math.sin(0.5 * yaw)
    transform.transform.rotation.w = math.cos(0.5 * yaw)
    buffer.set_transform(transform, 'exercise')


def near(found, x, y):
    return found is not None and math.hypot(found[0] - x, found[1] - y) < 0.01


@pytest.mark.points(4)
def test_fixed(hit):
    """Between frames that do not move."""
    found = hit('base', 0.0, 0.5 * math.pi, 1.0)
    expect(found is not None, 'it returns None for a transform that is known')
    expect(
        not near(found, 0.2, 1.0),
        'it adds the position of the lidar, but not how it is turned: the lidar looks backwards',
    )
    said = f'yours is at ({found[0]:.2f}, {found[1]:.2f}), the wall at (0.20, -1.00)'
    expect(near(found, 0.2, -1.0), said)


@pytest.mark.points(4)
def test_then(hit):
    """In a frame in which the robot moves: at the time of the scan."""
    ray = Pose(1.0, 0.0, 0.0)
    then, late = (Pose(at, 0.0, at).compose(LIDAR) for at in (0.3, 1.0))
    x, y, _ = then.compose(ray)
    found = hit('odom', 0.3, 0.0, 1.0)
    expect(found is not None, 'it returns None for a transform that is known')
    newest, swapped = late.compose(ray), then.inverse().compose(ray)
    expect(not near(found, *newest[:2]), 'it takes the newest transform; the scan has a stamp')
    told = 'lookup_transform(target, source, time): yours are swapped'
    expect(not near(found, *swapped[:2]), told)
    said = f'yours is at ({found[0]:.2f}, {found[1]:.2f}), the wall at ({x:.2f}, {y:.2f})'
    expect(near(found, x, y), said)


@pytest.mark.points(2)
def test_unknown(hit):
    """What nobody knows is None."""
    expect(hit('map', 0.3, 0.0, 1.0) is None, 'nobody knows the frame map: None was asked for')
    expect(hit('odom', 9.0, 0.0, 1.0) is None, 'nobody knows the future: None was asked for')
