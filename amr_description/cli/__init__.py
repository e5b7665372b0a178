# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The commands that a shell sees: ``ros2`` and ``check_urdf``.

They need no ROS installation; ``ros2`` has the flags, texts and exit codes of Jazzy's.
A verb is a module or a class: a docstring, which is its help, ``add_arguments(parser)``, and
``main(args)``, which returns the exit code. To add one, write it and its line in the table
``VERBS`` of its command; to add a command, write its line in ``COMMANDS`` of
:mod:`~amr_description.cli.ros2`.

======================= =======================================================================
main.py                 the entry point: standard streams, errors -> exit codes, Ctrl-C
lazy_parser.py          a parser that imports only the modules of its command line
completion.py           tab completion in bash and zsh, with the functions in completers/
ros2.py                 the commands of ``ros2``
topic/ node.py ...      a command each; a file for verbs that are alike, or one that is long
graph_verbs.py          the verbs of all commands that only look at the graph
run.py launch.py        commands without verbs; launch_files.py
check_urdf.py           a description and its findings; urdf_report.py, inertia.py
arguments.py            flags that several verbs have, and the types of values
qos_arguments.py        the ``--qos-*`` flags
yaml_input.py           YAML from the command line
meters.py               rates, delays and bandwidths of messages

session.py              the hidden node of a verb; waiting and stopping
discovery.py            when all that there is is known
graph.py actions.py     topics, services, nodes, actions of the ROS graph
names.py                names of topics, services and actions, as they are typed
qos.py                  QoS from flags, or matched to publishers
mismatch.py             warnings about nodes with another message type
message_filter.py       ``--filter``
echo_printer.py         the output of ``ros2 topic echo``
service_calls.py        service calls
======================= =======================================================================

The modules from ``session.py`` on import rclpy and messages, so they are imported only inside a
verb's ``main``: ``ros2 --help`` takes a tenth of a second.
"""
