# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Asks and listens to the ROS graph: ``collector.py``, and a module for each probe."""
