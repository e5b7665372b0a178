# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
For tests of robots: a simulation in lock-step with the test, over real ROS.

::

    from amr_description.testing.simulation import Simulation

    with Simulation('my_robot.urdf', 'controllers.yaml') as sim:
        sim.drive(0.5, 0.0, seconds=2)
        assert sim.truth.x == pytest.approx(1.0, rel=0.01)

======================  ==========================================================================
``simulation.py``       Simulation: what a test uses
``fixtures.py``         the same as a pytest fixture
``trials_marker.py``    … a marker: tests that are run with many seeds, without ROS

``robot.py``            one robot: spawned, controlled, and read by its topics
``readings.py``         its motion and joint states, from messages
``sensors.py``            what its lidars, cameras and contact sensors see at an instant
``lock_step.py``        services of a paused simulator; commands that are known to have arrived
``program.py``          the simulator's process and its ROS domain
``bags.py``             recordings of tests: ``--ros-bag=on-failure``
``failure_logs.py``     the simulator's log, for a test that fails

``replay.py``           runs it again, and compares every message: ``ros2 run … replay BAG``

``recorded_drive.py``   a controller that drives a course and records every state
``determinism.py``      two runs of it, compared byte by byte

``trial/``              robots that others wrote, tried one by one: ``scripts/try_robots``
======================  ==========================================================================
"""
