# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Messages of ROS as the bytes that DDS sends and bags have, without ROS: plain CDR.

================= =================================================================================
``layouts.py``    how the messages of a type are laid out
``cursor.py``     a place in a message, which goes on from part to part
``fields.py``     some parts of messages of any type, by their paths
``tree.py``       … or all of one, shortened, as JSON has it
``serialized.py`` messages of any type as bytes, and back
``template.py``   … of which only numbers change: one ``struct.pack``
``writer.py``     … written field by field
``padding.py``    … with zeros where bytes only align numbers
================= =================================================================================

Plain CDR (DDS-XTypes 1.3, 7.4.1) is what every vendor of DDS sends for ROS: four bytes of which
the second names the byte order (0 big, 1 little) and the last two are options, then the fields,
numbers aligned to their size from there on; strings and sequences begin with their length as
uint32, that of a string counts the zero at its end. What follows the last field is padding.
"""
