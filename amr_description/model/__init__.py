# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What a robot is, in plain frozen data. Knows no ROS, no simulator, no clock.

============================ ==================================================================
``frames.py``                SE(3): transforms, quaternions and their orders, forward kinematics
``robot.py``                 Robot, Link, Joint, Inertial and the shapes: the result of reading
``urdf.py``                  URDF text -> Robot: ``parse(text, source)``, ``load(path)``
``urdf_links.py``            its ``<link>`` and ``<material>`` elements
``urdf_joints.py``           its ``<joint>`` elements
``tree.py``                  the rules that make them one tree
``ros2_control_tag.py``      the ``<ros2_control>`` blocks -> HardwareInfo: ``hardware_of(robot)``
``gazebo_tag.py``            the ``<gazebo>`` plugins: ``gazebo_plugins_of(robot)``
``checks.py``                the checker: ``RULES``, ``examine(text)``, ``require_sound(text)``
``findings.py``              Finding: severity, place, what, found, expected, fix
``xml_source.py``            safe XML with true line numbers
``element_reader.py``        attributes of XML elements, read with a clear word on every fault
============================ ==================================================================
"""
