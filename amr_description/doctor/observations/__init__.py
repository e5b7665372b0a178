# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What was seen of a machine and a ROS graph. A section that was not observed is None.

===================  =============================================================================
``machine.py``       the machine: system, Python, memory, disks, network
``environment.py``   the environment variables of this process
``processes.py``     the processes of this host that are of ROS
``graph.py``         nodes, topics, services and their types and QoS
``clock.py``         ``/clock``, ``use_sim_time``, stamps, the real-time factor
``commands.py``      velocity commands, and who listens to them
``transforms.py``    ``/tf`` and ``/tf_static``
``description.py``   ``robot_description``, as published and as simulated
``controllers.py``   controller managers, controllers, hardware components
``sensors.py``       scans, pictures, IMUs and odometry
===================  =============================================================================
"""

from collections.abc import Mapping
from dataclasses import dataclass

from amr_description.doctor.observations.clock import Clock
from amr_description.doctor.observations.commands import ObservedCommands
from amr_description.doctor.observations.controllers import ObservedControllers
from amr_description.doctor.observations.description import Description
from amr_description.doctor.observations.environment import Environment
from amr_description.doctor.observations.graph import ObservedGraph
from amr_description.doctor.observations.machine import Machine
from amr_description.doctor.observations.processes import Processes
from amr_description.doctor.observations.sensors import ObservedSensors
from amr_description.doctor.observations.transforms import ObservedTransforms
from amr_description.navigation.contract.observations import ContractObservations as Navigation


@dataclass(frozen=True, slots=True, kw_only=True)
class Observations:
    """All that was seen; a rule is silent about a section that is None."""

    machine: Machine | None = None
    environment: Environment | None = None
    processes: Processes | None = None
    graph: ObservedGraph | None = None
    clock: Clock | None = None
    commands: ObservedCommands | None = None
    transforms: ObservedTransforms | None = None
    description: Description | None = None
    controllers: ObservedControllers | None = None
    sensors: ObservedSensors | None = None
    navigation: Navigation | None = None
    """Of a robot to which Nav2 or slam_toolbox listen."""
    faults: Mapping[str, str] | None = None
    """Sections that could not be observed → why; None: all that were tried could be."""
