# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The simulated world, and the only package that imports MuJoCo.

===================  =========================================================================
``world``            :class:`MujocoWorld`: spawn, remove, step, reset; the one to start from
``robot_view``       what a hardware component sees of it: one robot, by its URDF's names
``joint_group``      some joints of one robot, cheap to read and command in the tick
``array_views``      … by views into MuJoCo's arrays
``efforts``          … the force that reaches a joint from its actuators
``engine``           the MuJoCo model and its state; integer time; survives a recompile
``stepping``         control period → physics step
``world_file``       a world's name or path → MuJoCo spec
``compiling``        what MuJoCo's compiler warns of, as lines of the log
``silent_friction``  the friction of what a world leaves without
``world_settings``   gravity, friction, step, solver: parameters, and the measured defaults
``robot_spec``       a URDF → MuJoCo spec of one robot
``meshes``           the mesh files of a URDF, found and judged, or read for MuJoCo
``actuators``        command interface → MuJoCo actuators
``drives``           which of a joint's actuators act
``initial_state``    where joints begin
``contact``          how a wheel touches the ground
``link_friction``    the friction that a URDF made for Gazebo gives its links
``wheel_trim``       … so that each robot rests on its wheels' true radius
``wheel_contacts``   … and how much it bears and slips
``spawning``         the request to spawn, checked; simulation_interfaces' codes
``overlap``          a robot spawned inside something, and how much higher it would stand free
``resources``        ``package://`` and ``file://``, world names
``faults``           MuJoCo's warnings, non-finite states and falls, told once, in one line
``drop``             the physical test of a description, in numbers
``surroundings``    the static world as shapes to draw
``bare_loop``        the physics alone, to measure against
===================  =========================================================================

Not thread-safe: one owner calls everything.
"""
