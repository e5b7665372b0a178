# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""How much of the graph a program of ours is told of."""

import os

from amr_description.ros.discovery import use_whole_graph


def test_through_a_discovery_server_all_is_seen_unless_a_user_says_otherwise(monkeypatch):
    monkeypatch.delenv('ROS_SUPER_CLIENT', raising=False)
    use_whole_graph()
    assert os.environ['ROS_SUPER_CLIENT'] == 'TRUE'
    monkeypatch.setenv('ROS_SUPER_CLIENT', 'FALSE')
    use_whole_graph()
    assert os.environ['ROS_SUPER_CLIENT'] == 'FALSE'
