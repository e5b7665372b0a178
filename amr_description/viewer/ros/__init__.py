# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The robots of the ROS graph, for the page."""
