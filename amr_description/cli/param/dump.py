# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Show all of the parameters of a node in a YAML file format.

examples:
  ros2 param dump /my_node > my_node.yaml
  ros2 run my_package my_node --ros-args --params-file my_node.yaml
"""

from argparse import ArgumentParser, Namespace

from amr_description.cli.arguments import add_remote_node_arguments


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    add_remote_node_arguments(parser)


def main(args: Namespace) -> int:
    """Print the file; 0."""
    from rclpy.parameter import parameter_value_to_python

    from amr_description.cli.param.remote import remote_parameters
    from amr_description.parameter_files import parameter_file_text

    with remote_parameters(args) as parameters:
        names = parameters.names()
        messages = parameters.values(names)
        node = parameters.node
    values = {
        name: parameter_value_to_python(messages[name]) if name in messages else None
        for name in names
    }
    print(parameter_file_text(node, values))
    return 0
