"""Publish a greeting on ``topic`` twice per second."""

from contextlib import suppress

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import String


def greeting(count: int) -> str:
    """Return the text of a message."""
    return f'Hello World: {count}'


class MinimalPublisher(Node):
    """A node with a publisher and a timer."""

    def __init__(self) -> None:
        super().__init__('minimal_publisher')
        self.publisher = self.create_publisher(String, 'topic', 10)
        self.timer = self.create_timer(0.5, self.publish_greeting)
        self.count = 0

    def publish_greeting(self) -> None:
        """Publish the next greeting."""
        message = String(data=greeting(self.count))
        self.publisher.publish(message)
        self.get_logger().info(f'Publishing: "{message.data}"')
        self.count += 1


def main(args: list[str] | None = None) -> None:
    """Run the talker until Ctrl-C."""
    rclpy.init(args=args)
    # Nothing is shut down here: at Ctrl-C rclpy's own signal handler does that.
    with suppress(KeyboardInterrupt, ExternalShutdownException):
        rclpy.spin(MinimalPublisher())
