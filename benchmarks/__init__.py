# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What ``scripts/bench`` (``python -m benchmarks``) measures; not installed.

=============================  ===================================================================
``__main__.py``                runs all and prints the figures
``startup.py``                 the phases of a warm start, from the output of a bring-up
``real_time.py``               the real-time factor of a running simulator
``bare_loop.py``               that of ``mj_step`` alone, for comparison
``fleet.py``                   many robots in one simulator
``cycle.py``                   the processor time of a cycle of the control loop, by part
``probed_simulator.py``        mujoco_sim with the probe that measures it
``call_tree.py``               the calls below a function, and their time
``command_line.py``            the ``ros2`` command
``robot_state_publisher.py``   rate and load of robot_state_publisher
``viewer.py``                  load of the page's node, delay from a key to the command
=============================  ===================================================================
"""
