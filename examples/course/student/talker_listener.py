"""A node that talks, and a node that listens."""

from rclpy.node import Node


class Talker(Node):
    """
    Publishes a std_msgs/msg/String on ``chatter`` every 0.5 s.

    The texts are ``Hello 1``, ``Hello 2``, ``Hello 3`` …
    """

    def __init__(self) -> None:
        super().__init__('talker')
        # Your turn: a publisher, and a timer.


class Listener(Node):
    """Keeps in ``heard`` the texts of all messages on ``chatter``, the oldest first."""

    def __init__(self) -> None:
        super().__init__('listener')
        self.heard: list[str] = []
        # Your turn: a subscription.
