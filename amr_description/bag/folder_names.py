# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The name of a bag that was given none."""

from datetime import datetime


def default_folder() -> str:
    """Return the folder, named by the local time as ``ros2 bag record`` does."""
    return datetime.now().strftime('rosbag2_%Y_%m_%d-%H_%M_%S')
