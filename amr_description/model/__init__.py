# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What a robot is, in frozen dataclasses, and how it is read and checked. No ROS, no simulator.

========================= =========================================================================
module                   what it holds
========================= =========================================================================
``frames.py``             rigid transforms (SE(3)), quaternions, rotation conventions
``plain_xml.py``         XML as every parser takes it
``robot.py``              Robot, Link, Joint, Inertial, shapes: the result of reading a URDF
``kinematics.py``         forward kinematics: the poses of links for joint positions
``hardware_info.py``      HardwareInfo and its interfaces: the result of reading ``<ros2_control>``

``description_file.py``   file -> URDF text, xacro expanded
``xacro_markup.py``       … whether it is xacro, by what is in it
``xacro_lines.py``        … the lines that its elements come from
``origins.py``            … how these travel with the text, and findings name them
``urdf.py``               URDF -> Robot: ``parse(text, source)``, ``load(path)``
``urdf_links.py``         its ``<link>`` and ``<material>`` elements
``urdf_joints.py``        its ``<joint>`` elements
``ros2_control_tag.py``   ``<ros2_control>`` -> HardwareInfo: ``hardware_of(robot)``
``fixing.py``             a robot bolted to the ground
``gazebo/``               ``<gazebo>`` blocks: plugins, sensors, physics
``sensors.py``            lidars, cameras and contact sensors: what a simulator needs to know
``base_interfaces.py``    the interfaces of a simulated robot's body as a whole
``controller_files.py``   parameter files: those of a robot, and the controllers that they name
``findings.py``           Finding: severity, line, what, found, expected, fix
``xml_reader.py``         XML of unknown origin, and attributes with true line numbers

``wheels.py``             which links are wheels
``collision_names.py``    what Gazebo calls the collisions of links
``axles.py``              where their axles point, and what would mend it
``shapes.py``             primitive shapes as solids: inertia, extent, overlap
``meshes.py``             mesh files as triangles: ``load_mesh(path, scale)``
``mesh_solids.py``        meshes as solids: closed or not, mass, inertia, hull
``planar_hull.py``         convex hulls in the plane, and bodies seen from above
``footprint.py``          the polygon of a robot on the ground, for costmaps
``mended_inertials.py``   mass and inertia as a solver needs them, where a file has others
``mesh_paths.py``         relative mesh paths made absolute
``mesh_uses.py``          the meshes of a robot, each file read once

``checks/``               the checker: ``RULES``, ``examine``, ``require_sound``
========================= =========================================================================
"""
