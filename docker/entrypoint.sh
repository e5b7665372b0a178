#!/bin/bash
# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
# Runs a command in a shell that has sourced ROS and the workspace.
set -e
. /opt/ros/jazzy/setup.bash
. /ws/install/setup.bash
exec "$@"
