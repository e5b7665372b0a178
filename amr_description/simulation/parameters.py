# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The parameters of a simulation, which are those of the node ``mujoco_sim``."""

from dataclasses import dataclass

from amr_description.parameters import group, parameter
from amr_description.sim.cameras import CHOICES
from amr_description.sim.world_file import WorldSettings

CLOCK_PERIOD = 10_000_000
"""ns: the longest time between two cycles, and so between two messages on ``/clock``."""


@dataclass(frozen=True)
class SimulationParameters:
    """The parameters of the node ``mujoco_sim``."""

    world: str = parameter('empty', 'A shipped world, or the path of an MJCF file', read_only=True)
    physics: WorldSettings = group('physics', WorldSettings)
    real_time_factor: float = parameter(
        1.0,
        'Simulated seconds per second of the wall clock; 0: as fast as possible',
        minimum=0.0,
        magnitude=(1e-9, 1e6),
    )
    paused: bool = parameter(
        False, 'Begin with time standing still, until ~/set_simulation_state', read_only=True
    )
    controllers: str = parameter(
        '',
        'Parameter files of the controller managers, between commas, one over the other; empty: '
        'what the <gazebo> block of the URDF names, else that of this package, if it is for this '
        'robot',
        read_only=True,
    )
    bridge: str = parameter(
        '',
        'Configuration file of ros_gz_bridge, by which topics of sensors and plugins of Gazebo '
        'are called; empty: as they are usually bridged',
        read_only=True,
    )
    strict: bool = parameter(
        False,
        'Refuse a description that would have to be taken as something else, such as a link that '
        'moves and has no mass; else that is said, and it is spawned',
        read_only=True,
    )
    mock_hardware: str = parameter(
        'simulate',
        'Whether mock_components/GenericSystem is simulated as any other hardware, or is a mock, '
        'whose states follow commands while the robot in the world stands still',
        choices=('simulate', 'mock'),
        read_only=True,
    )
    lift: bool = parameter(
        True,
        'Whether a robot that would be spawned inside the ground, or another static body, is '
        'lifted until it is free; else it is refused',
        read_only=True,
    )
    on_fault: str = parameter(
        'continue',
        'What the simulation does when the physics goes wrong, beside saying so',
        choices=('continue', 'pause'),
    )
    record: str = parameter(
        '',
        'Folder of a bag to which the run is recorded from now on, in simulated time and '
        'without loss; empty: end the recording',
    )
    record_below: str = parameter(
        '',
        'Below which folder a bag may be that record names later, when every user of the host can '
        'set it; empty: the one that the simulator was started in',
        read_only=True,
    )
    record_regex: str = parameter(
        '', 'Of the names of topics: which are recorded; empty: all, pictures of cameras, too'
    )
    record_exclude_regex: str = parameter('', 'Of the names of topics: which are not recorded')
    seed: int = parameter(
        0, 'From which the noise of every sensor follows', minimum=0, read_only=True
    )
    camera_renderer: str = parameter(
        'auto',
        'What makes the pictures of cameras: OpenGL, or rays, which need none, and give the same '
        'bits on each machine; auto: OpenGL where it works',
        choices=CHOICES,
        read_only=True,
    )
    ground_truth_rate: float = parameter(
        50.0,
        'Rate of ground_truth/odom and ground_truth/wheels of every robot; 0: none',
        unit='Hz',
        minimum=0.0,
        magnitude=(1e-3, 1e5),
        read_only=True,
    )
