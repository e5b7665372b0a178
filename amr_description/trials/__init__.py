# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
How often does it succeed? A trial is a function, run with many seeds, on all cores or a cluster.

::

    from amr_description.trials.runner import trials
    from amr_description.trials.variations import scale_friction, uniform, vary

    @vary(speed=[0.3, 0.6], grip=uniform(0.4, 1.0))
    def drive_straight(simulate, rng, speed, grip):
        sim = simulate('package://amr_description/urdf/amr.urdf')
        scale_friction(sim, grip)
        sim.drive(speed, 0.0, seconds=3)
        assert abs(sim.truth.y) < 0.01

    print(trials(drive_straight, seeds=100))

======================  ==========================================================================
``runner.py``           trials: runs a function with all its seeds, where an executor says
``function.py``         the function, as other processes find it; its parameters by grid and draw
``one_run.py``          a run: what the function gets, and what becomes of it
``processes.py``        … in processes of this machine, that may hang and die
``report.py``           the report: statistic, text, JSON, JUnit
``page.py``             … as a page of plots
``variations.py``       what varies: draws, masses, frictions, wheels, poses
``faults.py``           what fails: sensors, motors, wheels, commands, the level of the floor
``command.py``          ``python -m amr_description.trials``, ``ros2 run amr_description trials``
======================  ==========================================================================
"""
