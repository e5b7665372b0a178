# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Send the robot to a pose: ``python send_goal.py X Y``, m in the frame map. Nav2 will do, too."""

import sys

from nav2_msgs.action import NavigateToPose
import rclpy
from rclpy.action import ActionClient

rclpy.init()
node = rclpy.create_node('send_goal')
client = ActionClient(node, NavigateToPose, 'navigate_to_pose')
client.wait_for_server()
goal = NavigateToPose.Goal()
goal.pose.header.frame_id = 'map'
goal.pose.pose.position.x, goal.pose.pose.position.y = float(sys.argv[1]), float(sys.argv[2])
sent = client.send_goal_async(
    goal, lambda message: print(f'{message.feedback.distance_remaining:.2f} m left')
)
rclpy.spin_until_future_complete(node, sent)
ended = sent.result().get_result_async()
rclpy.spin_until_future_complete(node, ended)
result = ended.result().result
print(result.error_msg or 'there')
sys.exit(result.error_code != NavigateToPose.Result.NONE)
