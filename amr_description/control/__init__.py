# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
ros2_control's heart. Knows no ROS, no simulator, no clock; one thread, the owner, runs it all.

=========================== ======================================================================
``contracts.py``            the page to read: Controller, HardwareComponent, Port, Log
``world.py``                … what a simulated hardware component sees: World, JointGroup
``interfaces.py``           the words: interface names, handles, lifecycle states
``samples.py``              what goes through the ports of the shipped controllers

``owned_component.py``      one hardware component inside the manager: lifecycle, read, write
``joint_limits.py``         the limits of a joint, from the URDF and its parameters
``limits.py``               how a command is brought within them
``hardware_components.py``  all components of a robot: first states, reads, writes, faults
``resource_manager.py``     which component owns which interface; claims
``loaded_controller.py``    one controller inside the manager: state, interfaces, when it is due
``configuring.py``          its configuration, which may take its time on another thread
``update_stride.py``        how often it is updated
``chains.py``               which controllers command or read others; the order that follows
``controller_list.py``      all controllers, in that order
``switching.py``            from the request of a switch to a plan
``switch_request.py``       … who comes, who goes, who changes its mode
``switch_checks.py``        … and whether they may
``switch_execution.py``     … and how it is done
``faults.py``               what becomes of controllers that fail; fallbacks
``manager_defaults.py``     what the parameters ``defaults.…`` decide
``lifecycles.py``           load, configure, clean up, unload
``controller_manager.py``   switch; read -> update -> write
``foreign_errors.py``       what a stranger's controller or component raises, as one line

``snapshots.py``            what other threads may read of a manager
``taking_snapshots.py``     … and how it is taken

``loop.py``                 the owner's loop; stepper, pacer, queue and publisher are its ports
=========================== ======================================================================
"""
