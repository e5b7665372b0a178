# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The simulated world, without ROS; the only package that imports MuJoCo.

======================  ==========================================================================
``world.py``            MujocoWorld: spawn, remove, step, reset; start reading here
``robot_view.py``       one robot by the names of its URDF: the World of a hardware component
``joint_group.py``      some joints of a robot, read and commanded in every control cycle
``engine.py``           the MuJoCo model and its state; integer time; recompiling; physics steps
``fleet_solver.py``     how its constraints are solved when there are many robots

``world_file.py``       the world: MJCF file, physics options, measured defaults
``gazebo_physics.py``   frictions, springs, gravity, self-collision that Gazebo is told of
``friction.py``         sliding friction of geoms without one, of links and of wheels

``spawning.py``         checks of a request to spawn; the codes of simulation_interfaces
``robot_spec.py``       URDF to MuJoCo spec: bodies, wheels, initial joint states
``prepared_xml.py``     the URDF as MuJoCo's reader needs it
``meshes.py``           the mesh files of a URDF
``overlap.py``          rejects a robot that is spawned inside something else

``actuators.py``        command interface to MuJoCo actuators
``base_servo.py``       moves the body of a robot over the ground
``actuator_modes.py``   which of a joint's actuators are active, and the force they exert

``wheel_shapes.py``     which links are wheels, and the geoms with which they touch
``wheel_contact.py``    the contact of a wheel with the ground: the measured settings
``wheel_trim.py``       the same, trimmed so that each robot rests at its true height
``rollers.py``          … their contacts
``wheel_slip.py``       load and slip of wheels: ground truth

``faults.py``           MuJoCo's warnings, lost states and falls, each as one line of log
``containment.py``      a robot whose state is lost stands still, the others go on
``entity_state.py``     pose, motion and bounds of a robot; setting them
``wrenches.py``         pushes from outside
``model_changes.py``    masses, frictions, wheels, gravity: changed until a reset
``contact_sensor.py``   a contact sensor on a robot
``contacts.py``         what touches the collisions of a robot
``static_geometry.py``  the visible shapes of a world
``rays.py``             rays into the world: what is visible, and where they meet it
``terrain.py``          height fields as meshes, for rays
``sections.py``         what of a geom is at a height
``occupancy.py``        the map of a world: what is free, occupied and unknown
``lidar.py``            what a lidar measures
``own_views.py``        what lidars see of the robot that carries them
``cameras/``            pictures of the world, in colour and depth
``state_copy.py``       copies of the state, for threads that measure
``sensor_schedule.py``  when a sensor measures, and the random numbers of its noise
``drop_test.py``        a physical test of a description, in numbers

``ros/``                the ROS interface of the simulator
======================  ==========================================================================

Not thread-safe: the control thread makes all calls.
"""
