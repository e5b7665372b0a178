# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What a robot is, in plain frozen data. Knows no ROS, no simulator, no clock.

=================================== ==============================================================
``frames.py``                       SE(3): transforms, quaternion orders, forward kinematics
``robot.py``                        Robot, Link, Joint, Inertial, shapes: the result of reading
``hardware_info.py``                HardwareInfo and its interfaces: likewise

``description_file.py``             file -> URDF text, xacro expanded
``urdf.py``                         URDF -> Robot: ``parse(text, source)``, ``load(path)``
``urdf_links.py``                   … its ``<link>`` and ``<material>`` elements
``urdf_joints.py``                  … its ``<joint>`` elements
``tree.py``                         … the rules that make them one tree
``ros2_control_tag.py``             ``<ros2_control>`` -> HardwareInfo: ``hardware_of(robot)``
``ros2_control_interfaces.py``      … its inner elements
``gazebo_tag.py``                   ``<gazebo>`` plugins: ``gazebo_plugins_of(robot)``
``gazebo_sensors.py``               ``<gazebo>`` sensors: ``gazebo_sensors_of(robot)``

``transform_buffer.py``             frames over time, as tf2's buffer: ``lookup(target, source)``
``frame_tree.py``                   … which frame is in which
``transform_cache.py``              … where one frame was, and interpolation
``transform_input.py``              … what is taken in, and who quarrels about a frame

``checks.py``                       the checker: ``RULES``, ``examine``, ``require_sound``
``rules_mass.py`` …                 … its rules, by what they judge
``subject.py``                      … what a rule may look at: ``Subject``, ``Surroundings``
``drive_settings.py``               … what controllers believe of the robot
``urdf_grammar.py``                 … the elements and attributes that there are
``wheels.py``                       … which links are wheels
``shapes.py``, ``convex.py``        … shapes as solids: inertia, extent, overlap
``meshes.py``, ``collada.py``       mesh files as triangles: ``load_mesh(path, scale)``
``mesh_solids.py``                  … as solids: closed or not, mass, inertia, hull
``convex_hull.py``                  … the volume of a convex hull
``mesh_paths.py``                   … relative paths made absolute, where the file is known
``mesh_uses.py``                    … those of a robot, each file read once
``nearest.py``                      … the word that was meant

``findings.py``                     Finding: severity, place, what, found, expected, fix
``xml_source.py``                   files and XML from strangers, safely, with true line numbers
``element_reader.py``               attributes of XML elements, read with a clear word on faults
=================================== ==============================================================
"""
