"""TF: where in another frame a lidar has hit something."""

import math

from rclpy.time import Time
from tf2_ros import Buffer, TransformException


def hit_in_frame(
    buffer: Buffer, frame: str, lidar: str, stamp: Time, angle: float, distance: float
) -> tuple[float, float] | None:
    """Return x and y of what a ray of the lidar has hit, m, in ``frame``; None: nobody knows."""
    try:
        transform = buffer.lookup_transform(frame, lidar, stamp).transform
    except TransformException:
        return None
    rotation = transform.rotation
    # The lidar stands upright: it is turned about z alone.
    yaw = 2.0 * math.atan2(rotation.z, rotation.w)
    return (
        transform.translation.x + distance * math.cos(yaw + angle),
        transform.translation.y + distance * math.sin(yaw + angle),
    )
