# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The ``talker`` of demo_nodes_py, where that is not installed: a greeting a second."""

from rclpy.node import Node
from std_msgs.msg import String

from amr_description.ros.node_help import print_help
from amr_description.ros.runtime import run


class Talker(Node):
    """A node ``talker`` that publishes on ``chatter``."""

    def __init__(self) -> None:
        super().__init__('talker')
        self.publisher = self.create_publisher(String, 'chatter', 10)
        self.timer = self.create_timer(1.0, self.publish_greeting)
        self.count = 0

    def publish_greeting(self) -> None:
        """Log and publish the next greeting; called by the timer."""
        message = String(data=f'Hello World: {self.count}')
        self.count += 1
        self.get_logger().info(f'Publishing: "{message.data}"')
        self.publisher.publish(message)


def main(args: list[str] | None = None) -> int:
    """Run the talker until Ctrl-C."""
    if print_help(args, 'demo_talker', 'Publish a greeting on the topic "chatter" each second.'):
        return 0
    return run(Talker, args)


if __name__ == '__main__':
    raise SystemExit(main())
