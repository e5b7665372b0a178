# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Messages of ROS as the bytes that DDS sends and bags have, without ROS: plain CDR.

================= =================================================================================
``layouts.py``    how the messages of a type are laid out
``cursor.py``     a place in a message, which goes on from part to part
``serialized.py`` messages of any type as bytes, and back
``template.py``   … of which only numbers change: one ``struct.pack``
``writer.py``     … written field by field
``padding.py``    … with zeros where bytes only align numbers
================= =================================================================================

What reads single fields of messages of rclpy is in ``ros/cdr*.py``.
"""
