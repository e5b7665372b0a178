# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Drive a physically true ROS 2 robot: model, control, simulation, bring-up and command line."""
