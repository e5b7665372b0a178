"""Log every greeting that arrives on ``topic``."""

from contextlib import suppress

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import String


class MinimalSubscriber(Node):
    """A node with a subscription."""

    def __init__(self) -> None:
        super().__init__('minimal_subscriber')
        self.subscription = self.create_subscription(String, 'topic', self.log_greeting, 10)

    def log_greeting(self, message: String) -> None:
        """Log one greeting."""
        self.get_logger().info(f'I heard: "{message.data}"')


def main(args: list[str] | None = None) -> None:
    """Run the listener until Ctrl-C."""
    rclpy.init(args=args)
    # Nothing is shut down here: at Ctrl-C rclpy's own signal handler does that.
    with suppress(KeyboardInterrupt, ExternalShutdownException):
        rclpy.spin(MinimalSubscriber())
