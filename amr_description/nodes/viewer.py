# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``viewer``: RViz, joint_state_publisher_gui and the Gazebo window, as one page in the browser.

``ros2 run amr_description viewer`` prints the address of the page. It shows every robot that is in
the ROS graph, ours or another, and drives it; of a simulator it shows the world, and asks its
services. The parameters are in :class:`Settings`.

========= =================================== =================================================
direction topic, for each robot               used for
========= =================================== =================================================
hears     ``robot_description``               model, meshes, what check_urdf finds
hears     ``joint_states``, odometry          states
hears     ``ground_truth/odom``, ``…/wheels`` states: the simulator's truth
both      the command topic                   driving: Twist or TwistStamped, as it is wanted
publishes ``…/set_joint_positions``           sliders, where joint_state_publisher runs
hears     ``~/introspection_data/…`` of its   states: velocities that joints are commanded
          manager
hears     ``/tf``, ``/tf_static``, ``/clock``,
          ``/diagnostics``, ``~/activity`` of
          managers, ``~/world`` of simulators
========= =================================== =================================================

While no page is open nothing is subscribed. Commands carry the time of ``/clock`` where there is
one, whatever ``use_sim_time`` says.

The page is for this host; for others ``-p host:=0.0.0.0`` (or an address of this host) makes one
whose address holds a random token. That is plain HTTP: for a network that is trusted.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
import secrets
import sys

from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node

from amr_description.parameters import parameter
from amr_description.ros.parameters import declare
from amr_description.ros.runtime import argument_errors, program, ros, spin
from amr_description.viewer.ros.backend import GraphBackend
from amr_description.viewer.server import DEFAULT_HOST, Server, Settings as ServerSettings


@dataclass(frozen=True)
class Settings:
    """The parameters of the node ``viewer``."""

    host: str = parameter(
        DEFAULT_HOST,
        'Address to listen on; any other than a loopback makes a token part of the URL',
        read_only=True,
    )
    port: int = parameter(
        8080,
        'Port to listen on, or the next one that is free; 0: any',
        read_only=True,
        minimum=0,
        maximum=65535,
    )
    rate: float = parameter(
        60.0, 'States a second, at most', unit='Hz', read_only=True, minimum=1.0, maximum=240.0
    )


def view(args: list[str] | None) -> None:
    """Serve the page until asked to stop."""
    with ros(args) as stop:
        executor = SingleThreadedExecutor()
        with argument_errors():
            node = Node('viewer')
        try:
            with argument_errors():
                server = _server(node, executor)
            executor.add_node(node)
            is_stopping = False

            def end() -> None:
                nonlocal is_stopping
                is_stopping = True
                executor.wake()

            with stop.on_stop(end):
                server.start()
                try:
                    node.get_logger().info(f'The page is at {server.url}')
                    spin(executor, lambda: is_stopping)
                finally:
                    server.stop()
        finally:
            stop.leave()
            executor.shutdown()
            node.destroy_node()


def _server(node: Node, executor: SingleThreadedExecutor) -> Server:
    """Make the server and its backend. Raises AmrError."""
    settings = declare(node, Settings)
    backend = GraphBackend(node, executor, node.get_logger().error)
    backend.server = Server(
        ServerSettings(
            host=settings.host,
            port=settings.port,
            rate=settings.rate,
            token=secrets.token_urlsafe(18),
            version=_version(),
            domain=node.context.get_domain_id(),
        ),
        backend,
        node.get_logger().error,
    )
    return backend.server


def _version() -> str:
    try:
        return version('amr_description')
    except PackageNotFoundError:  # a source tree that is not built
        return ''


def main(args: Sequence[str] | None = None) -> int:
    """Run the executable; return its exit code."""
    return program(lambda: view(None if args is None else list(args)), stopped=0)


if __name__ == '__main__':
    sys.exit(main())
