# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Simulations: what can be done with one, here without ROS, in ``testing/`` over it.

========================== ========================================================================
``in_process.py``          Simulation: in this process, without ROS
``robot.py``               … a robot of it
``sensors.py``             … its sensors, and their topics
``measuring.py``           … what they see at an instant
``local_manager.py``       … its controller manager
``plain_controllers.py``   … its controllers, and their ports
``films.py``               … films and plots of it
``goal_drive.py``          … a robot of it driven to a goal, by a planner of one's own, too
``alterations.py``         … what a test changes in it: physics, sensors, motors, commands
``command.py``             … the command ``amr``: a robot on a page
``playing.py``             … time that passes by the wall clock
``shown.py``               … its page, and what pages do
``shown_scene.py``         … … what it shows: robots, world, states, sensors
``page_backend.py``        … … for its server, which has a thread of its own

``api.py``                 what a simulation and its robots can do, wherever they run
``given.py``               what one is given: a description, its arguments, parameter files
``spawn_cost.py``          how long a robot keeps it waiting when it is spawned
``readings.py``            what is read of a robot: motion, joints, scans, pictures, clouds
``parameters.py``          the parameters of a simulation, which are those of the simulator's node
``published.py``           what it publishes beside its controllers, and the recording of all
``publishing.py``          … at the end of a cycle, to who records
``topics/``                what it publishes: sensors, ground truth, transforms
``run_recording.py``       begins and ends recordings of a run
``run_recorder.py``        … records what is published, and the commands, to a bag
``recorded_run.py``        what a bag has to be run again, and what of two runs differs
``tracebacks.py``          which of our frames a failed test shows

``engine.py``              the engine: world, loop, and robots that come and go with their managers
``manager_arguments.py``   what such a manager is given: parameter files
``plugin_controllers.py``  starts the controllers that stand for Gazebo's plugins
``spawned_controllers.py`` the controllers of a robot, as its files say; its topics
========================== ========================================================================
"""
