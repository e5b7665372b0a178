# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The ROS face of the simulator."""
