# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Reads this machine, its processes and the environment, without ROS; changes nothing."""
