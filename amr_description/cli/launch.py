# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Run a launch file: one of ROS, which imports launch and launch_ros, in Python, XML or YAML.

Or a stack: one of amr_description's by its name, or a Python file with a function that returns
one (amr_description/bringup/__init__.py shows how). Ctrl-C stops all that it started.

examples:
  ros2 launch my_package my.launch.py
  ros2 launch path/to/my.launch.py use_sim_time:=true
  ros2 launch amr_description simulation
  ros2 launch amr_description simulation --show-args
  ros2 launch amr_description simulation rtf:=0
  ros2 launch --domain 5 --discovery subnet amr_description simulation
  ros2 launch my_stack.py times:=3
"""

from argparse import ArgumentParser, Namespace
import os
from pathlib import Path
import sys


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the command."""
    _add_options(parser)
    parser.add_argument(
        'package_name',
        help='Name of the ROS package which contains the launch file, or path of a file',
    )
    parser.add_argument(
        'launch_file_name', nargs='?', help='Name of the launch file, or of a stack'
    )
    parser.add_argument(
        'launch_arguments',
        nargs='*',
        metavar='name:=value',
        help='Arguments of the launch file; for duplicates, the last one wins',
    )


def _add_options(parser: ArgumentParser) -> None:
    # Here, as every `ros2 --help` imports this file.
    from amr_description.bringup import environment, run_registry

    parser.add_argument(
        '-n',
        '--noninteractive',
        action='store_true',
        help='Accepted for scripts: each process is told to stop once, terminal or not',
    )
    parser.add_argument(
        '-d',
        '--debug',
        action='store_true',
        help='Accepted for scripts: what each process says is in the log folder anyway',
    )
    parser.add_argument(
        '-p',
        '--print',
        '--print-description',
        action='store_true',
        help='Print what would be started, and when, without starting it',
    )
    parser.add_argument(
        '-s',
        '--show-args',
        '--show-arguments',
        action='store_true',
        help='Show arguments that may be given to the launch file',
    )
    parser.add_argument(
        '-a',
        '--show-all-subprocesses-output',
        action='store_true',
        help='Accepted for scripts: the output of every process is shown anyway',
    )
    run_registry.add_option(parser)
    environment.add_options(parser)
    parser.add_argument(
        '--launch-prefix',
        default='',
        help='Prefix command that should go before all executables: gdb -ex run --args',
    )
    parser.add_argument(
        '--launch-prefix-filter',
        metavar='REGEX',
        default='',
        help='Regular expression; only executables whose names match it get the prefix',
    )


def main(args: Namespace) -> int:
    """Become the bring-up; return its exit code."""
    from amr_description.bringup import environment
    from amr_description.bringup.main import main as bringup
    from amr_description.cli.launch_files import find_launch_file, is_launch_file

    stack, arguments = find_launch_file(
        args.package_name, args.launch_file_name, args.launch_arguments
    )
    source = None
    if is_launch_file(stack):
        from amr_description.launch_api.launch_file import launch_by_the_original, LaunchFile

        if not (args.print or args.launch_prefix):  # which only the bring-up knows here
            os.environ |= environment.variables(args, os.environ)
            code = launch_by_the_original(Path(stack), arguments, show=args.show_args)
            if code is not None:
                return code
        source = LaunchFile(Path(stack))
    options = [
        *(['--show-args'] if args.show_args else []),
        *(['--print'] if args.print else []),
        f'--launch-prefix={args.launch_prefix}',
        f'--launch-prefix-filter={args.launch_prefix_filter}',
        *(['--force'] if args.force else []),
        *environment.as_arguments(args),
    ]
    sys.stdout.flush()
    return bringup([*options, stack, *arguments], prog='ros2 launch', source=source)
