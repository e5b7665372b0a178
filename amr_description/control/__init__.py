# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
ros2_control's heart. Knows no ROS, no simulator, no clock; one thread, the owner, runs it all.

=========================== ======================================================================
``contracts.py``            the page to read: Controller, HardwareComponent, World, Port, Log
``interfaces.py``           the words: interface names, handles, lifecycle states
``samples.py``              what goes through the ports of the shipped controllers

``owned_component.py``      one hardware component inside the manager: lifecycle, read, write
``resource_manager.py``     which component owns which interface; claims
``loaded_controller.py``    one controller inside the manager: state, interfaces, when it is due
``switching.py``            whether controllers may be switched as asked
``switch_execution.py``     … and how it is done
``controller_manager.py``   load, configure, switch; read -> update -> write
``foreign_errors.py``       what a stranger's controller or component raises, as one line

``snapshots.py``            what other threads may read of a manager
``taking_snapshots.py``     … and how it is taken

``loop.py``                 the owner's loop; stepper, pacer, queue and publisher are its ports
=========================== ======================================================================
"""
