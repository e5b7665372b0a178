# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What ``scripts/bench`` (``python -m benchmarks``) measures; not installed.

=============================  ===================================================================
``__main__.py``                runs the parts, prints the figures
``options.py``                 the command line, and which parts it asks for
``goals.py``                   the table of figures and goals, and which are missed
``figures.py``                 what a part returns
``machine.py``                 whether the machine was quiet
``stack.py``                   starts, drives and ends what is measured
``environment.py``            that of a shell without a checkout
``processes.py``               processor time and memory of processes
``cycle.py``                   one robot in a simulator with a probe: its speed, a cycle by part
``probed_simulator.py``        mujoco_sim with the probe
``probe.py``                   measures cycles of the control loop
``call_tree.py``               the calls below a function, and their time
``profiles.py``                what the probe finds out, as text
``adapted_controllers.py``     the shipped controllers' file, as a measurement needs it
``latency.py``                 from a command to the wheels; cycles of 1 kHz
``punctuality.py``             their formulas
``startup.py``                 the phases of a warm start, from the output of a bring-up
``load.py``                    what a whole stack takes; an hour; ten robots; a cold set-up
``real_time.py``               the real-time factor of a running simulator
``bare_loop.py``               that of ``mj_step`` alone, for comparison
``fleet.py``                   many robots in one simulator
``sensors.py``                  what lidars and cameras take
``recording.py``               ``ros2 bag record``
``playing.py``                 ``ros2 bag play``
``command_line.py``            the ``ros2`` command
``robot_state_publisher.py``   rate and load of robot_state_publisher
``page.py``                    many pages, plots, and the page in a browser
``viewer.py``                  load of the page's node, delay from a key to the command
``churn.py``                   readers that are killed, for the tests
=============================  ===================================================================
"""
