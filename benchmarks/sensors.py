# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What lidars and cameras cost: by themselves, published, unheard, and to the control loop.

Everything is that of ``amr`` with its sensors in the world ``warehouse``. What has no wall time in
it is processor time, in turn with what it is compared with, so that a busy machine changes both.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
import statistics
import time
from typing import Any

from rclpy.node import Node
from sensor_msgs.msg import Image, LaserScan, PointCloud2

from amr_description.ament_index import package_share
from amr_description.clock import NANOSECONDS
from amr_description.errors import BringupError
from amr_description.model.description_file import description_at
from amr_description.model.frames import Transform
from amr_description.model.gazebo.translation import translate
from amr_description.model.sensors import Camera, Lidar
from amr_description.model.urdf import parse
from amr_description.ros.service_calls import wait_until
from amr_description.sim.cameras.ray_renderer import RayRenderer
from amr_description.sim.cameras.renderer import Shot
from amr_description.sim.lidar import SimulatedLidar
from amr_description.sim.state_copy import StateCopier
from amr_description.sim.world import MujocoWorld
from benchmarks.cycle import controlled_robot, Simulator
from benchmarks.figures import Figures
from benchmarks.processes import thread_times
from benchmarks.punctuality import punctuality, Tick
from benchmarks.stack import TIMEOUT

WORLD = 'warehouse'
TOPICS: Mapping[str, Any] = {
    '/scan': LaserScan,
    '/scan/points': PointCloud2,
    '/camera/image': Image,
    '/camera/depth_image': Image,
    '/camera/points': PointCloud2,
}
"""Of all sensors that look at the world."""
_MODULES = ('amr_description/simulation/topics/', 'amr_description/sim/sensor_schedule')
_RATE = 100
"""Hz, of the control loop."""
_ROUNDS = 3
_KNOWN = 1.0
"""s until the simulator knows who has come, or gone."""
_RINGS, _COLUMNS = 16, 1024


def described() -> str:
    """Return amr with its sensors."""
    share = package_share('amr_description')
    return description_at(str(share / 'urdf' / 'amr_sensors.urdf.xacro'), warn=print)


def with_rings(text: str) -> str:
    """Return a description with a lidar of 16 × 1024 rays in place of 360."""
    rings = (
        f'<vertical><samples>{_RINGS}</samples><min_angle>-0.26</min_angle>'
        '<max_angle>0.26</max_angle></vertical></scan>'
    )
    return text.replace('<samples>360</samples>', f'<samples>{_COLUMNS}</samples>').replace(
        '</scan>', rings
    )


def sensor_figures(node: Node, seconds: float) -> Figures:
    """Measure all figures; ``seconds``: wall time of each measurement."""
    heard = heard_figures(node, seconds / 2)
    values = {
        **casting(seconds / 2),
        **heard.values,
        'unheard': unheard(seconds),
        'rings': rings_factor(node, seconds),
    }
    return Figures(values, heard.text)


# --- by themselves, in this process -------------------------------------------------------------


def casting(seconds: float) -> dict[str, float]:
    """Return processor time of a scan, ms, and pictures per second of it."""
    text = described()
    world = MujocoWorld(WORLD)
    robot = world.spawn('amr', text, Transform((0.0, 0.0, 0.0)))
    world.step(NANOSECONDS // world.timestep)
    sensors = translate(parse(text)).sensors
    lidar = SimulatedLidar(next(each for each in sensors if isinstance(each, Lidar)), robot)
    camera = next(each for each in sensors if isinstance(each, Camera))
    renderer, states = RayRenderer(), StateCopier(world)
    shot = Shot(
        camera,
        robot.pose(camera.mount.link),
        f'amr/{camera.mount.link}',
        states.copy(),
        with_color=True,
        with_depth=False,
    )
    depth = replace(shot, with_color=False, with_depth=True)

    def scan() -> None:
        lidar.measure(world.time, lidar.body(), world.ray_scene())

    calls: Sequence[Callable[[], object]] = (
        scan,
        lambda: renderer.render(shot),
        lambda: renderer.render(depth),
    )
    of_scan, of_picture, of_depth = _quickest(calls, seconds)
    return {'scan': 1e3 * of_scan, 'picture': 1.0 / of_picture, 'depth': 1.0 / of_depth}


def _quickest(calls: Sequence[Callable[[], object]], seconds: float) -> list[float]:
    """Return the least processor time of each call, s; in turn, each some times in a row."""
    best = [float('inf')] * len(calls)
    for _ in range(_ROUNDS):
        for number, call in enumerate(calls):
            call()  # with cold caches, and what is made only once
            end = time.monotonic() + seconds / _ROUNDS
            while time.monotonic() < end:
                begin = time.thread_time()
                call()
                best[number] = min(best[number], time.thread_time() - begin)
    return best


# --- in the simulator ---------------------------------------------------------------------------


def unheard(seconds: float) -> float:
    """Return what the modules of sensors that nobody hears take of a cycle, µs."""
    with controlled_robot(description=described(), world=WORLD) as simulator:
        modules = simulator.profile_at_rest(seconds).tree.by_module()
    return sum(own for name, own in modules.items() if name.startswith(_MODULES))


def heard_figures(node: Node, seconds: float) -> Figures:
    """Return what a heard lidar takes of a core, and how much later cycles are with all heard."""
    loads: dict[str, list[float]] = {'nobody': [], 'scan': [], 'all': []}
    late: dict[str, list[float]] = {'nobody': [], 'all': []}
    with controlled_robot(factor=1.0, description=described(), world=WORLD) as simulator:
        for _ in range(_ROUNDS):
            for heard, topics in (('nobody', ()), ('scan', ('/scan',)), ('all', tuple(TOPICS))):
                with listening(node, topics):
                    load, lateness = _load_and_lateness(simulator, seconds)
                loads[heard].append(load)
                if heard in late:
                    late[heard].append(lateness)
    load_of = {heard: statistics.median(each) for heard, each in loads.items()}
    late_of = {heard: statistics.median(each) for heard, each in late.items()}
    lines = ['mujoco_sim at factor 1, amr with sensors          CPU   lateness p99']
    for heard, load in load_of.items():
        shown = f'{late_of[heard]:9.2f} ms' if heard in late_of else ''
        lines.append(f'heard by {heard:<32}{load:8.1f} % {shown}'.rstrip())
    values = {
        'scan load': load_of['scan'] - load_of['nobody'],
        'sensors late': late_of['all'] - late_of['nobody'],
    }
    return Figures(values, '\n'.join(lines))


def rings_factor(node: Node, seconds: float) -> float:
    """Return the real-time factor with a lidar of 16 × 1024 rays at 10 Hz, asked for factor 1."""
    text = with_rings(described())
    with (
        controlled_robot(factor=1.0, description=text, world=WORLD) as simulator,
        listening(node, ('/scan/points',)),
    ):
        begin, before = time.monotonic(), simulator.time()
        time.sleep(seconds)
        return (simulator.time() - before) / (time.monotonic() - begin)


def _load_and_lateness(simulator: Simulator, seconds: float) -> tuple[float, float]:
    """Return the processor time of the simulator (% of a core), and its lateness p99 (ms)."""
    before, begin = thread_times(simulator.pid), time.monotonic()
    simulator.ask('ticks', seconds=seconds)
    ticks = [Tick(*each) for each in simulator.answer()]
    load = (thread_times(simulator.pid) - before) / (time.monotonic() - begin)
    return 100.0 * load, punctuality(ticks, NANOSECONDS // _RATE).late


@contextmanager
def listening(node: Node, topics: Sequence[str]) -> Iterator[None]:
    """Subscribe to sensors while inside; the simulator knows of it, and of those that are gone."""
    subscriptions = [
        node.create_subscription(TOPICS[topic], topic, lambda _: None, 10, raw=True)
        for topic in topics
    ]
    try:
        if not wait_until(
            node,
            lambda: all(each.get_publisher_count() for each in subscriptions) or None,
            timeout=TIMEOUT,
        ):
            raise BringupError(f'nobody publishes {" or ".join(topics)}')
        time.sleep(_KNOWN)
        yield
    finally:
        for each in subscriptions:
            node.destroy_subscription(each)
