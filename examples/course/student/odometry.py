"""Odometry: where a robot of two driven sides is, told by its wheels."""


class Odometry:
    """
    The pose of the robot in the frame in which it has begun.

    Args:
        wheel_radius: m.
        wheel_separation: Between the left and the right wheels, m.
    """

    def __init__(self, wheel_radius: float, wheel_separation: float) -> None:
        self.x = 0.0
        """m, forward."""
        self.y = 0.0
        """m, to the left."""
        self.yaw = 0.0
        """rad, counter-clockwise."""

    def update(self, left: float, right: float) -> None:
        """
        Take what the encoders read now.

        Args:
            left: How far the left wheels have turned since the beginning, rad.
            right: The right ones.
        """
        # Your turn: what have the wheels done since the last call?
