# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Parameter files, held against the tables of controllers and against a robot.

========================== ========================================================================
``parameter_sections.py``  the sections of parameter files, with their lines
``parameter_faults.py``    what is wrong in them, by its cause: misspelt names, types
``drive_files.py``         their differential drives, for ``check_urdf``
``wheeled_drive_files.py`` their other wheeled drives; mecanum and omni wheels, for the simulator
``drive_calibration.py``   multipliers of a differential drive from known motion
========================== ========================================================================
"""
