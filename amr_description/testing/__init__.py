# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
For tests of robots: a simulation in lock-step with the test, over real ROS.

::

    from amr_description.testing.simulation import Simulation

    with Simulation('my_robot.urdf', 'controllers.yaml') as sim:
        sim.drive(0.5, 0.0, seconds=2)
        assert sim.truth.x == pytest.approx(1.0, rel=0.01)

================ =============================================================================
simulation.py    what a test holds in its hand
fixtures.py      the same as pytest fixtures: pytest_plugins = ['amr_description.testing.fixtures']
lock_step.py     the simulator's services and the receipts of commands
program.py       the simulator's process: its start, its words, its end
readings.py      pure: what is read of a robot
domains.py       ROS domains that nobody else is in
================ =============================================================================
"""
