# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Controllers that publish states, and command nothing.

====================================== ============================================================
``joint_state_broadcaster.py``         joint states → ``/joint_states``
``sensor_broadcaster.py``              what those of sensors have in common
``sensor_broadcasters.py``             IMU, pose, range, GPS, magnetometer
``state_interfaces_broadcaster.py``    any states, as numbers
``force_torque_sensor_broadcaster.py`` a wrench → ``~/wrench``
``battery_state_broadcaster.py``       batteries → ``~/battery_state``
====================================== ============================================================
"""
