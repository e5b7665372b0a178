# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Publish a greeting on ``topic`` twice per second."""

from rclpy.node import Node
from std_msgs.msg import String

from amr_description.ros.node_help import print_help
from amr_description.ros.runtime import run


class MinimalPublisher(Node):
    """A node with a publisher and a timer. It knows no listener."""

    def __init__(self) -> None:
        super().__init__('minimal_publisher')
        # Message type, topic name, and how many messages to keep for a slow subscriber.
        self.publisher = self.create_publisher(String, 'topic', 10)
        self.timer = self.create_timer(0.5, self.publish_greeting)  # every 0.5 s
        self.count = 0

    def publish_greeting(self) -> None:
        """Publish the next greeting and log it; called by the timer."""
        message = String(data=f'Hello World: {self.count}')
        self.publisher.publish(message)
        self.get_logger().info(f'Publishing: "{message.data}"')
        self.count += 1


def main(args: list[str] | None = None) -> int:
    """Run the talker until Ctrl-C."""
    if print_help(args, 'talker', 'Publish a greeting on the topic "topic" twice per second.'):
        return 0
    return run(MinimalPublisher, args)


if __name__ == '__main__':
    raise SystemExit(main())
