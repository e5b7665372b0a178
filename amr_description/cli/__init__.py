# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The commands that a shell sees: ``ros2`` and ``check_urdf``.

They serve where no ROS is installed; ``ros2`` has the flags, texts and exit codes of Jazzy's.
A verb is one small file: a docstring, which is its help, ``add_arguments(parser)``, and
``main(args)``, which returns the exit code. To add one, write ``<command>/<verb>.py`` and its
line in the table ``VERBS`` of ``<command>/__init__.py``; to add a command, write its line in
``COMMANDS`` of :mod:`~amr_description.cli.ros2`.

===================== =========================================================================
main.py               the way in: standard streams, errors -> exit codes, Ctrl-C
program.py            a command line read by tables; nothing is imported before it is needed
completion.py         what may come next, for Tab in bash and zsh; from completers/
ros2.py               the commands of ``ros2``
topic/ node/ ...      a command each, its verbs in files of their own
run.py launch.py      commands without verbs
check_urdf.py         a description and what is wrong with it; urdf_report.py prints it
arguments.py          flags that verbs share, and the types of values
qos_arguments.py      the ``--qos-*`` flags
streams.py            line buffering, a closed pipe, the noise of C++ libraries
colors.py             when to colour, and how
launch_files.py       what ``ros2 launch`` is asked for -> what the bring-up starts
packages.py           packages and their executables, from the ament index
yaml_input.py         what was typed -> a mapping, or one line that says where it is wrong
shorten.py            what was typed, as an error line may repeat it
message_fields.py     a mapping -> the fields of a message; ``auto`` and ``now``
message_text.py       a message -> YAML or CSV
session.py            a hidden node while a verb runs; waiting and stopping
local_participants.py how many others run on this host, from the UDP ports in use
graph.py              who is there: topics, types, nodes
services.py           who is there: services with their types
actions.py            who is there: actions with their types, clients and servers
names.py              names of topics, services and actions, as they are typed
qos.py                QoS from flags, and matched to the publishers there are
mismatch.py           tells who is there, but with another type
message_filter.py     ``--filter``
*_meter.py, spread.py rates, bandwidths and delays of messages that arrive
service_calls.py      requests and their responses
===================== =========================================================================

rclpy and messages are imported by the part from ``session.py`` on, and that part only inside a
verb's ``main``: ``ros2 --help`` takes a tenth of a second.
"""
