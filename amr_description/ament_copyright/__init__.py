# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``ament_copyright``: what ``test/test_copyright.py`` of a Python package of ROS imports.

In the environment of ``scripts/setup`` it is imported under its name; ``main.py`` has the check.
"""
