# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Simulated lidars and range finders: what they measure, without ROS.

Ranges are as REP 117 wants them: +inf where nothing is met up to the largest range, -inf where
something is nearer than the smallest one. Noise, as in gz-sensors, is that of ranges which are
neither; it follows from seed, sensor and simulated time alone.

Like a rendered sensor of Gazebo, a lidar looks through what it is built into: of the parts that
cannot move against it, nothing is seen that is nearer than the smallest range, or from inside.
These parts keep their distances, which are computed once; nothing of them is cast at later.
"""

from dataclasses import dataclass
import math
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from amr_description.model.frames import matrix_from_quaternion
from amr_description.model.sensors import Lidar, ScanAxis
from amr_description.sim.rays import Floats, Hits, Mask, RayScene
from amr_description.sim.robot_view import RobotView
from amr_description.sim.sensor_schedule import noise_generator

Singles: TypeAlias = NDArray[np.float32]

_FULL_CIRCLE_FROM = 6.10865
"""rad, 350°; see :func:`scan_angles`."""
_INCREMENT_OF_ONE = math.radians(1.0)
_LUMINANCE = 255.0 * np.array([0.2126, 0.7152, 0.0722])
"""Of linear red, green and blue by ITU-R BT.709; 255 is white."""
_SKIN = 1e-6
"""m: how far behind a surface that is looked through the ray goes on."""
_MOST_LAYERS = 64


@dataclass(frozen=True, slots=True)
class LidarScan:
    """
    One measurement of a lidar.

    Attributes:
        time: Of the measurement, simulated, ns.
        ranges: (rings, samples) m, as REP 117 wants them; rings from the lowest elevation up.
        intensities: (rings, samples): the luminance of the surface's color, 0 (black, or nothing
            met) to 255 (white).
    """

    time: int
    ranges: Singles
    intensities: Singles

    @property
    def middle_ring(self) -> int:
        """The index of the ring that a 2-D scan shows, as gz-sim's bridge chooses it."""
        return len(self.ranges) // 2


def scan_angles(axis: ScanAxis) -> tuple[float, float, float]:
    """
    Return ``angle_min``, ``angle_max`` and ``angle_increment`` of a LaserScan, all float32.

    As in gz, ``angle_increment = (max - min) / (samples - 1)``. slam_toolbox refuses scans whose
    length is not what it computes of these three (``laser_utils.cpp``, and Karto's
    ``LaserRangeFinder::Update``): one ray less, where it takes the scan for a full circle whose
    last ray would be the first one again. It does so for scans of up to 350° that leave a gap
    smaller than one increment: for these, of less than 36 rays, ``angle_max`` is the end of the
    last ray's sector, one increment later. So its rule holds for every geometry.
    """
    lower, upper = np.float32(axis.lower), np.float32(axis.upper)
    if axis.samples == 1 or lower == upper:
        return float(lower), float(lower), float(np.float32(_INCREMENT_OF_ONE))
    span = float(upper) - float(lower)
    increment = float(np.float32(span / (axis.samples - 1)))
    if span <= _FULL_CIRCLE_FROM and abs(span - 2.0 * math.pi) < increment:
        upper = np.float32(float(lower) + axis.samples * increment)
    return float(lower), float(upper), increment


def ray_directions(lidar: Lidar) -> Floats:
    """Return the unit directions of all rays, (rings · samples, 3), in the sensor's axes."""
    azimuth = _angles(lidar.horizontal)[None, :]
    elevation = _angles(lidar.vertical)[:, None]
    flat = np.cos(elevation)
    x, y = flat * np.cos(azimuth), flat * np.sin(azimuth)
    z = np.broadcast_to(np.sin(elevation), x.shape)
    return np.stack((x, y, z), axis=-1).reshape(-1, 3)


def cloud_rays(lidar: Lidar) -> Singles:
    """Return the unit directions of all rays, (rings, samples, 3), as points are made of them."""
    shape = (lidar.vertical.samples, lidar.horizontal.samples, 3)
    return ray_directions(lidar).astype(np.float32).reshape(shape)


def met_ranges(scan: LidarScan) -> Singles:
    """Return the ranges of a scan, (rings, samples); NaN where they are infinite."""
    return np.where(np.isfinite(scan.ranges), scan.ranges, np.float32(np.nan))


def _angles(axis: ScanAxis) -> Floats:
    return np.arange(axis.samples, dtype=np.float64) * axis.increment + axis.lower


class SimulatedLidar:
    """
    A lidar on a robot.

    :meth:`body` is called on the control thread, everything else on any one, but one at a time.
    """

    def __init__(self, lidar: Lidar, robot: RobotView) -> None:
        """
        Take a lidar.

        Args:
            lidar: Its description.
            robot: The robot that carries it.

        Raises:
            SimulationError: The robot has no such link.
        """
        self.lidar = lidar
        self._robot = robot
        self._shape = (lidar.vertical.samples, lidar.horizontal.samples)
        self._binding: _Binding | None = None
        self._drawn: tuple[tuple[int, ...], float] | None = None
        """The bias of a seed."""
        mount = lidar.mount.pose
        self._offset = np.array(mount.translation)
        self._turned = ray_directions(lidar) @ np.array(matrix_from_quaternion(mount.rotation)).T
        self.body()

    def body(self) -> int:
        """Return the id of its link, good for one generation."""
        return self._robot.body(self.lidar.mount.link)

    def is_bound_to(self, scene: RayScene) -> bool:
        """Whether it knows already what is its own in this scene."""
        return self._binding is not None and self._binding.key is scene.all_seen

    def measure(self, time: int, body: int, scene: RayScene) -> LidarScan:
        """
        Return what the lidar measures.

        Args:
            time: Simulated, ns.
            body: The id of its link.
            scene: What there is at this time.
        """
        hits = self.hits(body, scene)
        assert self._binding is not None, 'it was bound for the hits'
        distances, geoms, binding = hits.distances, hits.geoms, self._binding
        # A miss has the id -1, which is the last one here: 0.
        intensities = binding.intensities[geoms]
        intensities[distances > self.lidar.range_max] = 0.0
        return LidarScan(
            time,
            self._measured(distances, time).astype(np.float32).reshape(self._shape),
            intensities.reshape(self._shape),
        )

    def hits(self, body: int, scene: RayScene) -> Hits:
        """Return what its rays meet, at the true distances, m, inf where nothing is met."""
        binding = self._binding
        if binding is None or not self.is_bound_to(scene):
            binding = self._binding = self._bind(body, scene)
        origin, directions = self._rays(body, scene)
        hits = scene.cast(origin, directions, mask=binding.mask, cutoff=self.lidar.range_max)
        distances, geoms = hits.distances, hits.geoms
        distances[geoms < 0] = math.inf
        if binding.own is not None:
            is_own = binding.own.distances < distances
            distances[is_own] = binding.own.distances[is_own]
            geoms[is_own] = binding.own.geoms[is_own]
        return hits

    def _measured(self, distances: Floats, time: int) -> Floats:
        lidar, noise = self.lidar, self.lidar.noise
        is_near, is_far = distances < lidar.range_min, distances > lidar.range_max
        if noise.stddev > 0.0:
            generator = noise_generator(self._robot.seed, self.lidar.mount.path, time)
            distances += noise.stddev * generator.standard_normal(len(distances))
        distances += noise.mean + self._bias()
        for step in (noise.precision, lidar.range_resolution):
            if step > 0.0:
                distances = np.round(distances / step) * step
        np.clip(distances, lidar.range_min, lidar.range_max, out=distances)
        distances[is_near], distances[is_far] = -math.inf, math.inf
        return distances

    def _bias(self) -> float:
        """Return the bias of the seed; see :class:`~amr_description.model.gazebo.tags.Noise`."""
        noise, seed = self.lidar.noise, self._robot.seed
        if not (noise.bias_mean or noise.bias_stddev):
            return 0.0
        if self._drawn is None or self._drawn[0] != seed:
            generator = noise_generator(seed, self.lidar.mount.path, -1)
            draw, sign = generator.standard_normal(2).tolist()
            bias = math.copysign(1.0, sign) * (noise.bias_mean + noise.bias_stddev * draw)
            self._drawn = seed, bias
        return self._drawn[1]

    def _rays(self, body: int, scene: RayScene) -> tuple[Floats, Floats]:
        """Return origin and directions in the world."""
        position, rotation = scene.pose(body)
        return position + rotation @ self._offset, self._turned @ rotation.T

    def _bind(self, body: int, scene: RayScene) -> '_Binding':
        intensities = np.append(scene.colors[:, :3] @ _LUMINANCE, 0.0).astype(np.float32)
        name = self._robot.name
        if not self.lidar.sees_robot:
            mask = scene.mask(without=scene.geoms_of(name))
            return _Binding(scene.all_seen, mask, intensities)
        carried = scene.geoms_fixed_to(name, body)
        mask = scene.mask(without=carried)
        # Where the joints are makes no difference but for rounding; so when this is done does not.
        start = scene.at_start()
        origin, directions = self._rays(body, start)
        own = _own_parts(origin, directions, start, scene.mask(only=carried), self.lidar)
        is_seen = bool(np.isfinite(own.distances).any())
        return _Binding(scene.all_seen, mask, intensities, own if is_seen else None)


@dataclass(frozen=True, slots=True)
class _Binding:
    """What follows from the geoms of one generation of the world."""

    key: Mask
    """That of the scene, and of its copies."""
    mask: Mask
    intensities: Singles
    """Of each geom, and of none."""
    own: Hits | None = None
    """On the parts that cannot move against the lidar; the distance is inf where none is met."""


def _own_parts(
    origin: Floats, directions: Floats, scene: RayScene, mask: Mask, lidar: Lidar
) -> Hits:
    """Return where the lidar sees the parts of ``mask``; the distance is inf where it does not."""
    first = scene.cast(origin, directions, mask=mask, cutoff=lidar.range_max, normals=True)
    distances, geoms, normals = first.distances, first.geoms, first.normals
    assert normals is not None, 'they were asked for'
    distances[geoms < 0] = math.inf
    rays = np.flatnonzero(
        np.isfinite(distances)
        & ((distances < lidar.range_min) | (_along(normals, directions) >= 0.0))
    )
    passed = np.maximum(distances[rays] + _SKIN, lidar.range_min)
    distances[rays], geoms[rays] = math.inf, -1
    if not len(rays):
        return first
    cast = scene.cast_each_at_start(mask)
    for _ in range(_MOST_LAYERS):
        ways = directions[rays]
        hits = cast(origin + passed[:, None] * ways, ways)
        assert hits.normals is not None, 'they are always there'
        passed += hits.distances
        is_met = hits.geoms >= 0
        is_seen = is_met & (_along(hits.normals, ways) < 0.0)
        distances[rays[is_seen]] = passed[is_seen]
        geoms[rays[is_seen]] = hits.geoms[is_seen]
        goes_on = is_met & ~is_seen
        rays, passed = rays[goes_on], passed[goes_on] + _SKIN
        if not len(rays):
            break
    return Hits(distances, geoms)


def _along(normals: Floats, directions: Floats) -> Floats:
    """Return cosines between normals and directions: below 0 where a ray comes from outside."""
    cosines: Floats = np.einsum('ij,ij->i', normals, directions)
    return cosines
