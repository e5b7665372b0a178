# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
For tests of robots: a simulation in lock-step with the test, over real ROS.

::

    from amr_description.testing.simulation import Simulation

    with Simulation('my_robot.urdf', 'controllers.yaml') as sim:
        sim.drive(0.5, 0.0, seconds=2)
        assert sim.truth.x == pytest.approx(1.0, rel=0.01)

====================  =========================================================================
simulation.py         what a test holds in its hand
fixtures.py           the same as pytest fixtures
lock_step.py          the simulator's services, and commands that are known to have arrived
robot.py              the robot: spawned, controlled, and found by its topics
latest.py             the newest message of a topic
program.py            the simulator's process: its start, its words, its end
domains.py            ROS domains that nobody else is in
readings.py           pure: what is read of a robot
message_readings.py   messages → readings
recorded_drive.py     a controller that drives a course and writes down every tick
determinism.py        two runs of it, compared byte by byte
====================  =========================================================================
"""
