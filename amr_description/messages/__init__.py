# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Messages of ROS as plain data, without the packages that ROS has for them.

================== ================================================================================
``definitions.py`` what the messages are that controllers and sensors use; ``definitions.txt``
``plain.py``       messages as objects: of defaults, and of what a dict says
``readers.py``     messages → samples of controllers
``sent.py``        what is sent to a controller without ROS → samples
================== ================================================================================
"""
