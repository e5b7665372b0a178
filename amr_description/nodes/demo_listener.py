# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The ``listener`` of demo_nodes_py, where that is not installed."""

from rclpy.node import Node
from std_msgs.msg import String

from amr_description.ros.node_help import print_help
from amr_description.ros.runtime import run


class Listener(Node):
    """A node ``listener`` that subscribes to ``chatter``."""

    def __init__(self) -> None:
        super().__init__('listener')
        self.subscription = self.create_subscription(String, 'chatter', self.log_greeting, 10)

    def log_greeting(self, message: String) -> None:
        """Log one greeting; called for every message on the topic."""
        self.get_logger().info(f'I heard: [{message.data}]')


def main(args: list[str] | None = None) -> int:
    """Run the listener until Ctrl-C."""
    if print_help(args, 'demo_listener', 'Log each greeting that arrives on "chatter".'):
        return 0
    return run(Listener, args)


if __name__ == '__main__':
    raise SystemExit(main())
