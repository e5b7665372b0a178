# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``viewer``: RViz, joint_state_publisher_gui and the Gazebo window, as one page in the browser.

``ros2 run amr_description viewer`` logs the address of the page. It shows and drives every robot
of the ROS graph, also third-party ones. For a simulator it shows the world, and calls its
services. The parameters are in :class:`ViewerSettings`.

========== =================================== ================================================
direction  topic, for each robot               used for
========== =================================== ================================================
subscribes ``robot_description``               model, meshes, findings of check_urdf
subscribes ``joint_states``, odometry          states
subscribes ``ground_truth/odom``, ``…/wheels`` states: ground truth of the simulator
both       the command topic                   driving: Twist or TwistStamped, as subscribed
publishes  ``emergency_stop``                  STOP: true 10 times per second, false once released
publishes  ``…/set_joint_positions``           sliders, if joint_state_publisher runs
subscribes ``~/introspection_data/…`` of its   states: commanded joint velocities
           manager
subscribes LaserScan, PointCloud2, Image,      what pages show of sensors: subscribed only while a
           CompressedImage, Range, contacts    page shows the topic
subscribes ``/tf``, ``/tf_static``, ``/clock``,
           ``/diagnostics``, ``~/activity`` of
           managers, ``~/world`` of simulators
========== =================================== ================================================

For each robot that a page spawns, and for one in a world that nobody else describes, there is a
``robot_state_publisher`` in its namespace, which publishes its description and the transforms of
its links until the robot is deleted, or somebody else does so.

``ros2 run amr_description viewer --bag PATH`` shows a bag instead, a folder or a file, with a time
line: no node, no DDS.

While no page is open, nothing is subscribed. Commands are stamped with the time of ``/clock`` if
it is published, whatever ``use_sim_time`` is.

Behind a proxy, of TLS or at a path, it needs to know the origin that browsers see:
``-p allowed_origins:="['https://hub.example']"``.

The page is for this host only. With ``-p host:=0.0.0.0`` (or an address of this host) it can be
opened from other hosts, at an address with a random token. It is plain HTTP: use it only in a
trusted network.
"""

from argparse import ArgumentParser
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
import os
from pathlib import Path
import secrets
import sys
import threading

from rclpy.executors import SingleThreadedExecutor
from rclpy.logging import get_logger, LoggingSeverity, set_logger_level
from rclpy.node import Node
from rclpy.parameter import Parameter

from amr_description.errors import ParameterError
from amr_description.nodes.robot_state_publisher import RobotStatePublisher
from amr_description.parameter_files import load_yaml
from amr_description.parameters import build, parameter
from amr_description.ros.firewall import guard
from amr_description.ros.node_help import print_help
from amr_description.ros.parameters import declare
from amr_description.ros.runtime import argument_errors, program, ros, serve
from amr_description.ros.signals import StopRequests
from amr_description.ros_arguments import other_arguments, parameters_in
from amr_description.viewer.access import Proxies
from amr_description.viewer.backend import Backend
from amr_description.viewer.ros.backend import GraphBackend
from amr_description.viewer.ros.bag_backend import BagBackend
from amr_description.viewer.server import DEFAULT_HOST, Server, ServerSettings


@dataclass(frozen=True)
class ViewerSettings:
    """The parameters of the node ``viewer``."""

    host: str = parameter(
        DEFAULT_HOST,
        'Address to listen on; any other than a loopback makes a token part of the URL',
        read_only=True,
    )
    token: bool = parameter(
        False,
        'Make a token part of the URL on a loopback, too: not every user of this host may use it',
        read_only=True,
    )
    port: int = parameter(
        8080,
        'Port to listen on, or the next one that is free; 0: any',
        read_only=True,
        minimum=0,
        maximum=65535,
    )
    allowed_origins: tuple[str, ...] = parameter(
        (),
        'Origins of pages behind a proxy, such as https://hub.example; GitHub Codespaces is known',
        read_only=True,
    )
    allowed_hosts: tuple[str, ...] = parameter(
        (),
        'What a proxy may send as Host, where that is neither this host nor one of those origins',
        read_only=True,
    )
    frame_ancestors: tuple[str, ...] = parameter(
        (), 'Origins of pages of which this one may be a frame', read_only=True
    )
    bag_folder: str = parameter(
        '',
        'Folder in which pages record bags; empty: the one in which the viewer was started',
        read_only=True,
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
        guard(node)
        try:
            with argument_errors():
                backend = _backend(node, executor)
            server = backend.server
            executor.add_node(node)

            def start() -> None:
                server.start()
                _say_where(server, node.get_logger().info)

            try:
                serve(executor, stop, start)
            finally:
                server.stop()
                backend.disconnect()
        finally:
            stop.leave()
            executor.shutdown()
            node.destroy_node()


def _say_where(server: Server, log: Callable[[str], object]) -> None:
    """Log the address; its secret, if it has one, goes to stdout alone: all read /rosout."""
    address, _, secret = server.url.partition('?')
    if secret:
        print(f'The page is at {server.url}', flush=True)
        log(f'The page is at {address}, for those who have its secret, which stdout has')
    else:
        log(f'The page is at {address}')
    for origin in server.origins:
        log(f'Pages of {origin} may use it')


def _backend(node: Node, executor: SingleThreadedExecutor) -> GraphBackend:
    """Create the backend and its server. Raises AmrError."""
    settings = declare(node, ViewerSettings)
    bags = Path(settings.bag_folder).expanduser().absolute()
    backend = GraphBackend(node, executor, node.get_logger().error, _publish_description, bags)
    domain = node.context.get_domain_id()
    backend.server = _server(settings, backend, node.get_logger().error, domain)
    return backend


def _server(
    settings: ViewerSettings, backend: Backend, log_error: Callable[[str], object], domain: int
) -> Server:
    """Create the server of a backend. Raises ViewerError."""
    proxies = Proxies(settings.allowed_hosts, settings.allowed_origins, settings.frame_ancestors)
    return Server(
        ServerSettings(
            host=settings.host,
            port=settings.port,
            rate=settings.rate,
            token=secrets.token_urlsafe(18),
            always_token=settings.token,
            version=_version(),
            domain=domain,
            proxies=proxies.and_those_of(os.environ),
        ),
        backend,
        log_error,
    )


def view_bag(path: Path, args: Sequence[str]) -> None:
    """
    Serve the page of a bag until asked to stop.

    Args:
        path: of its folder, or of a file.
        args: the command line, of which the parameters count.

    Raises:
        BagError: there is no bag, or it cannot be read.
        ParameterError: a parameter is not what it has to be.
    """
    settings = _settings(args)
    log = get_logger('viewer')
    stopped = threading.Event()
    with StopRequests(wake=stopped.set) as stop:
        backend = BagBackend(path, log.error)
        try:
            backend.server = server = _server(settings, backend, log.error, 0)
            if backend.recorded.broken:
                log.warning(f'{backend.recorded.broken} messages of {path} are broken: left out')
            if backend.left_out:
                others = ', '.join(map(str, backend.left_out))
                log.warning(
                    f'{path}: only the last run, after a reset, is shown; others: {others}'
                )
            with stop.on_stop(stopped.set):
                server.start()
                _say_where(server, log.info)
                stopped.wait()
            server.stop()
        finally:
            backend.close_bag()


def _settings(args: Sequence[str]) -> ViewerSettings:
    """Return the parameters of a command line, without a node. Raises ParameterError."""
    values = {}
    for name, text in parameters_in(args).items():
        try:
            values[name] = load_yaml(text)
        except ParameterError as error:
            raise ParameterError(f'-p {name}:={text}: {error}') from error
    return build(ViewerSettings, values)


def _bag(args: Sequence[str]) -> Path | None:
    """Return the bag that a command line names; None: it names none."""
    parser = ArgumentParser('viewer', add_help=False, allow_abbrev=False)
    parser.add_argument('--bag', type=Path)
    found, _ = parser.parse_known_args(other_arguments(args))
    return found.bag


def _publish_description(namespace: str, urdf: str) -> Node:
    """Return a robot_state_publisher in simulated time; it logs warnings only. Raises AmrError."""
    prefix = f'{namespace}/'.lstrip('/')
    set_logger_level(f'{prefix.replace("/", ".")}robot_state_publisher', LoggingSeverity.WARN)
    overrides = {'robot_description': urdf, 'frame_prefix': prefix, 'use_sim_time': True}
    return RobotStatePublisher(
        namespace=namespace,
        use_global_arguments=False,  # they are for the viewer
        parameter_overrides=[Parameter(key, value=value) for key, value in overrides.items()],
    )


def _version() -> str:
    try:
        return version('amr_description')
    except PackageNotFoundError:  # a source tree that is not installed
        return ''


def main(args: Sequence[str] | None = None) -> int:
    """Run the executable; return its exit code."""
    purpose = 'Show and drive the robots of the ROS graph, on a page in the browser.'
    words = '[--bag PATH]'
    notes = (
        '--bag PATH shows a bag, a folder or a file, in place of the ROS graph: with a time line, '
        'and without any ROS running.'
    )
    if print_help(args, 'viewer', purpose, ViewerSettings, words=words, notes=notes):
        return 0
    given = sys.argv[1:] if args is None else list(args)
    if (bag := _bag(given)) is not None:
        return program(lambda: view_bag(bag, given), stopped=0)
    return program(lambda: view(None if args is None else list(args)), stopped=0)


if __name__ == '__main__':
    sys.exit(main())
