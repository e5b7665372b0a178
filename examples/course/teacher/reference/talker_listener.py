"""A node that talks, and a node that listens."""

from rclpy.node import Node
from std_msgs.msg import String


class Talker(Node):
    """Publishes a numbered greeting on ``chatter`` every 0.5 s."""

    def __init__(self) -> None:
        super().__init__('talker')
        self._count = 0
        self._publisher = self.create_publisher(String, 'chatter', 10)
        self._timer = self.create_timer(0.5, self._talk)

    def _talk(self) -> None:
        self._count += 1
        self._publisher.publish(String(data=f'Hello {self._count}'))


class Listener(Node):
    """Keeps in ``heard`` the texts of all messages on ``chatter``, the oldest first."""

    def __init__(self) -> None:
        super().__init__('listener')
        self.heard: list[str] = []
        self._subscription = self.create_subscription(String, 'chatter', self._hear, 10)

    def _hear(self, message: String) -> None:
        self.heard.append(message.data)
