# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The simulator over ROS: the services of ``simulation_interfaces``, robots, and topics.

=========================== =======================================================================
``simulation.py``           the simulation in a process: world, robots, control thread, ``/clock``
``entities.py``             robots are spawned and removed, each with its controller manager
``other_clock.py``          ends, or warns, where another simulator publishes ``/clock``
``run_recording.py``        begins and ends recordings, as the parameter ``record`` says
``run_recorder.py``         records what this process publishes, and the commands, to a bag
``loop_timing.py``          warns when real time is not kept, with the slow stage of the loop

``service_replies.py``      services from handlers that raise
``simulation_services.py``  state, steps, reset, world
``spawn_services.py``       spawn, delete, list spawnables
``source_folders.py``       folders that a request names
``entity_services.py``      states, info and bounds of entities; filters
``wrench_topics.py``        ``~/wrench``: pushes from outside

``measure_service.py``      ``~/measure``: the present instant, while time stands still
``spawned_topics.py``       ``~/spawned/NAME``: with what each entity was spawned
``world_publisher.py``      ``~/world``: the static geometry as markers
=========================== =======================================================================
"""
