"""TF: where in another frame a lidar has hit something."""

from rclpy.time import Time
from tf2_ros import Buffer


def hit_in_frame(
    buffer: Buffer, frame: str, lidar: str, stamp: Time, angle: float, distance: float
) -> tuple[float, float] | None:
    """
    Return x and y of what a ray of the lidar has hit, m, in ``frame``.

    Args:
        buffer: Knows the transforms of the last ten seconds.
        frame: In which the answer is wanted.
        lidar: The frame in which the lidar measures.
        stamp: When it has measured. The robot may have moved since.
        angle: Of the ray, rad, from the x axis of the lidar, counter-clockwise.
        distance: How far the ray went, m.

    Returns:
        None, if nobody knows that transform.
    """
    # Your turn: buffer.lookup_transform has it as a translation and a quaternion.
    return None
