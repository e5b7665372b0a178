# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``spawner``: load, configure and activate controllers, one by one, and end.

Arguments, messages and exit codes as the ``spawner`` of Jazzy's controller_manager: 0 when all is
done, 1 when a step failed, 2 for a wrong command line. What is better than there:

- a manager that does not come is explained: nobody there, in another namespace, waiting for a
  robot description, no clock; a failed step tells its reason here, not only in the manager's log;
- a controller that is active already is left alone (0), so that a bring-up can be run again;
- there is no machine-wide lock: only spawners of the same controller wait for each other;
- a request that changes something is sent once: a manager that is only slow is not asked again;
- interrupted before all is done it exits with 128 + the signal, so that nobody takes it for done;
- ``--unload-on-kill`` unloads all that were spawned, those that are inactive too, and does so
  whenever it is interrupted once it has begun.
"""

from collections.abc import Callable
from contextlib import AbstractContextManager
from functools import partial
import sys
import threading

from rclpy.node import Node
from rclpy.utilities import remove_ros_args

from amr_description.control.ros.client import ManagerClient, SPAWNER_SERVICES
from amr_description.control.ros.spawner_lock import exclusive_lock
from amr_description.controller_manager.spawner import Spawner, yellow
from amr_description.controller_manager.spawner_arguments import parse, SpawnOptions
from amr_description.controller_manager.spawner_files import files_in_arguments
from amr_description.errors import ParameterError
from amr_description.ros.log_thread import LoggerLog
from amr_description.ros.runtime import program, ros
from amr_description.ros.service_calls import client_node
from amr_description.ros.signals import StopRequests


def spawn(args: list[str] | None) -> None:
    """Spawn as the command line asks."""
    with ros(args) as stop:
        words = ['spawner', *args] if args is not None else sys.argv
        options = parse(remove_ros_args(words)[1:])
        node = client_node(f'spawner_{options.plans[0].name}')
        try:
            manager = ManagerClient(
                node,
                _manager_name(node, options),
                timeout=options.manager_timeout,
                call_timeout=options.call_timeout,
                soon=SPAWNER_SERVICES,
            )
            log = LoggerLog(node.get_logger())
            spawner = Spawner(log, manager, options, files_in_arguments(words))
            alone = partial(
                exclusive_lock, node, manager.name, [plan.name for plan in options.plans]
            )
            if options.unload_on_kill:
                _spawn_and_stay(node, spawner, stop, alone)
            else:
                with alone():
                    spawner.spawn()
        except KeyboardInterrupt:
            node.get_logger().info('KeyboardInterrupt received! Exiting....')
            raise
        finally:
            node.destroy_node()


def _spawn_and_stay(
    node: Node,
    spawner: Spawner,
    stop: StopRequests,
    alone: Callable[[], AbstractContextManager[None]],
) -> None:
    """Spawn, wait until asked to stop, and unload; a stop before that ends the wait at once."""
    log, interrupted = node.get_logger(), threading.Event()
    with stop.on_stop(interrupted.set):
        with alone():
            spawner.spawn(interrupted.is_set)
        log.info('Waiting until interrupt to unload controllers')
        interrupted.wait()
    log.info('KeyboardInterrupt successfully captured!')
    with alone():
        spawner.unload()


def _manager_name(node: Node, options: SpawnOptions) -> str:
    """Return the manager's name with ``--namespace``. Raises ParameterError: there are two."""
    if not options.namespace:
        return options.manager
    if node.get_namespace() != '/':
        raise ParameterError(
            f"Setting namespace through both '--namespace {options.namespace}' arg and the ROS 2 "
            f"standard way '--ros-args -r __ns:={node.get_namespace()}' is not allowed!"
        )
    node.get_logger().warning(
        yellow(
            "The '--namespace' argument is deprecated and will be removed in future releases. Use "
            'the ROS 2 standard way of setting the node namespacing using --ros-args -r '
            '__ns:=<namespace>'
        )
    )
    inside = f'/{options.namespace.strip("/")}/'
    return options.manager if options.manager.startswith('/') else inside + options.manager


def main(args: list[str] | None = None) -> int:
    """Run the executable; return its exit code."""
    return program(lambda: spawn(args))


if __name__ == '__main__':
    sys.exit(main())
