# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Messages of ROS as plain data, without the packages that ROS has for them.

========================= =========================================================================
``definitions.py``        what the messages are that controllers and sensors use
``plain.py``              messages as objects: of defaults, and of what a dict says
``parts.py``              what is written into parts of them: stamps, poses
``readers.py``            messages → samples of controllers
``commands.py``           what is sent to an input: sample, dict or bytes
``writers.py``            samples of controllers → messages
``dof_writers.py``        … of PID controllers and grippers
``sensor_writers.py``     … of the broadcasters of sensors, batteries, GPIOs
``trajectory_writers.py`` … of joint trajectories
``encoders.py``           … as bytes, for what is published in every cycle
``lifecycle.py``          what a manager says of states, as bytes
========================= =========================================================================
"""
