# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Send the robot to a pose: ``python send_goal.py X Y``, m in the frame map. Nav2 will do, too.

Ctrl-C cancels the goal, and the robot stops.
"""

import sys
from typing import Any

from nav2_msgs.action import NavigateToPose
import rclpy
from rclpy.action import ActionClient
from rclpy.signals import SignalHandlerOptions
from rclpy.task import Future

try:
    x, y = map(float, sys.argv[1:])
except ValueError:
    sys.exit('python send_goal.py X Y: two numbers, m in the frame map')
goal = NavigateToPose.Goal()
goal.pose.header.frame_id = 'map'
goal.pose.pose.position.x, goal.pose.pose.position.y = x, y


def show(message: Any) -> None:
    """Print how far it is, once for each."""
    global shown
    text = f'{message.feedback.distance_remaining:.2f} m left'
    if text != shown:
        print(text)
    shown = text


def wait(future: Future) -> Any:
    """Return what is answered. Ctrl-C is noticed between two looks."""
    while not future.done():
        rclpy.spin_until_future_complete(node, future, timeout_sec=0.1)
    return future.result()


# At Ctrl-C the node is needed once more: rclpy must not end it.
rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
node = rclpy.create_node('send_goal')
client = ActionClient(node, NavigateToPose, 'navigate_to_pose')
sent = None
shown = ''
try:
    while not client.wait_for_server(1.0):
        print('waiting for navigate_to_pose: scripts/run navigation, or Nav2')
    sent = client.send_goal_async(goal, show)
    result = wait(wait(sent).get_result_async()).result
except KeyboardInterrupt:
    if sent is not None:
        wait(wait(sent).cancel_goal_async())
    sys.exit('cancelled')
print(result.error_msg or 'there')
sys.exit(result.error_code != NavigateToPose.Result.NONE)
