# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Log every greeting that arrives on ``topic``."""

from rclpy.node import Node
from std_msgs.msg import String

from amr_description.ros.node_help import print_help
from amr_description.ros.runtime import run


class MinimalSubscriber(Node):
    """A node with a subscription. It knows no talker."""

    def __init__(self) -> None:
        super().__init__('minimal_subscriber')
        # The same message type and topic name as the talker: that is all the two agree on.
        self.subscription = self.create_subscription(String, 'topic', self.log_greeting, 10)

    def log_greeting(self, message: String) -> None:
        """Log one greeting; called for every message on the topic."""
        self.get_logger().info(f'I heard: "{message.data}"')


def main(args: list[str] | None = None) -> int:
    """Run the listener until Ctrl-C."""
    if print_help(args, 'listener', 'Log every greeting that arrives on the topic "topic".'):
        return 0
    return run(MinimalSubscriber, args)


if __name__ == '__main__':
    raise SystemExit(main())
