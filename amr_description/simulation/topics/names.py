# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Names of topics and frames of the simulator, for clients too: it imports no MuJoCo."""

ODOM_TOPIC = 'ground_truth/odom'
WHEELS_TOPIC = 'ground_truth/wheels'
WORLD_FRAME = 'world'
"""The frame of every pose that the simulator accepts or reports."""
