# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Show which controller commands which, down to the hardware.

--dot prints the graph for Graphviz, as the original's /tmp/controller_diagram.gv.pdf shows it:

  ros2 control view_controller_chains --dot | dot -Tpdf > controller_diagram.pdf
"""

from argparse import ArgumentParser, Namespace

from amr_description.cli.control.manager import add_manager_arguments, ask


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    add_manager_arguments(parser)
    parser.add_argument('--dot', action='store_true', help='Print the graph in the DOT language')


def main(args: Namespace) -> int:
    """Print the chains; 0."""
    from controller_manager_msgs.srv import ListControllers

    from amr_description.cli.control.chains import dot, tree

    response = ask(args, ListControllers)
    if not response.controller and not args.dot:
        print('No controllers are currently loaded!')
    for line in dot(response.controller) if args.dot else tree(response.controller):
        print(line)
    return 0
