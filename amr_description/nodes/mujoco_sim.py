# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``mujoco_sim``: the simulator, in Gazebo's place.

It publishes ``/clock``, spawns robots and runs their controller managers. Its services are those
of ``simulation_interfaces``, below ``/mujoco_sim/``::

    ~/spawn_entity, ~/delete_entity …     sim/ros/spawn_services.py
    ~/get_entity_state …                  sim/ros/entity_services.py
    ~/set_simulation_state, ~/step_simulation, ~/reset_simulation …
                                          sim/ros/simulation_services.py
    ~/get_available_worlds …              sim/ros/simulation_services.py

Robots are pushed by ``~/wrench`` (sim/ros/wrench_topics.py).

It publishes its static surroundings as markers on ``~/world``
(simulation/topics/world_markers.py), with what each entity was spawned on ``~/spawned/NAME``
(sim/ros/spawned_topics.py), and on
``~/received`` which commands have arrived (control/ros/loop_publisher.py).
"""

from collections.abc import Sequence
import sys

from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node

from amr_description.errors import SimulationError
from amr_description.log import Severity
from amr_description.ros.firewall import guard
from amr_description.ros.node_help import print_help
from amr_description.ros.parameters import declare
from amr_description.ros.runtime import argument_errors, program, ros, serve
from amr_description.ros.service_calls import wait_for_clients
from amr_description.ros_arguments import inherited, ros_arguments
from amr_description.sim.ros import (
    entity_services,
    simulation_services,
    spawn_services,
)
from amr_description.sim.ros.entity_services import EntityServices
from amr_description.sim.ros.other_clock import Other, OtherClock
from amr_description.sim.ros.simulation import (
    Simulation,
    SimulationState,
)
from amr_description.sim.ros.simulation_services import SimulationServices, WorldServices
from amr_description.sim.ros.spawn_services import SpawnServices
from amr_description.sim.ros.world_publisher import WorldPublisher
from amr_description.sim.ros.wrench_topics import WrenchTopics
from amr_description.simulation.parameters import SimulationParameters
from amr_description.streams import never_wait_for_stderr

FEATURES = (
    *simulation_services.FEATURES,
    *spawn_services.FEATURES,
    *entity_services.FEATURES,
)


class MujocoSim:
    """The node, the simulation and its services."""

    def __init__(self, executor: SingleThreadedExecutor, args: Sequence[str]) -> None:
        """Make the node and the world. Raises SimulationError, ParameterError."""
        self.node = Node('mujoco_sim')
        guard(self.node)
        try:
            parameters = declare(self.node, SimulationParameters)
            passed_on = inherited(ros_arguments(args), with_parameters=False)
            self.simulation = Simulation(self.node, executor, parameters, passed_on)
        except Exception:
            self.node.destroy_node()
            raise
        SpawnServices(self.node, self.simulation)
        EntityServices(self.node, self.simulation)
        WorldServices(self.node, self.simulation)
        WrenchTopics(self.node, self.simulation)
        surroundings = WorldPublisher(self.node, self.simulation.world, self.simulation.publisher)
        surroundings.publish()
        self.simulation.on_world = surroundings.publish
        self._services = SimulationServices(
            self.node, self.simulation, FEATURES, spawn_services.SPAWN_FORMATS
        )
        self.refusal: SimulationError | None = None
        """Another simulator was there before."""
        OtherClock(self.node, lambda: self.simulation.world.time, self._on_other_clock)
        factor = parameters.real_time_factor
        self.node.get_logger().info(
            f"World '{parameters.world}', "
            + (f'real-time factor {factor:g}' if factor else 'as fast as possible')
            + (', paused' if parameters.paused else '')
            + f'; waiting for robots on {self.node.get_name()}/spawn_entity'
        )

    @property
    def has_ended(self) -> bool:
        """Whether the process shall end."""
        return self.simulation.has_ended or self.refusal is not None

    def _on_other_clock(self, other: Other, line: str) -> None:
        if other is Other.AHEAD:
            self.refusal = SimulationError(line)
        else:
            self.simulation.log(Severity.WARN, line)

    def close(self) -> None:
        """End the simulation and remove all nodes."""
        self.simulation.close()
        self._services.close()
        self.node.destroy_node()


def simulate(args: list[str] | None) -> int:
    """Run until asked to stop; return 1 when the control thread failed, else 0."""
    with ros(args) as stop:
        executor = SingleThreadedExecutor()
        with argument_errors():
            sim = MujocoSim(executor, sys.argv[1:] if args is None else args)
        simulation = sim.simulation
        executor.add_node(sim.node)
        try:
            serve(executor, stop, simulation.start, until=lambda: sim.has_ended)
            if simulation.state is SimulationState.QUITTING:
                wait_for_clients(sim.node, '~/set_simulation_state')
        finally:
            sim.close()
            executor.shutdown()
        if sim.refusal is not None:
            raise sim.refusal
    return 1 if simulation.loop_thread.failed else 0


def main(args: list[str] | None = None) -> int:
    """Run the executable; return its exit code."""
    purpose = 'Simulate robots in MuJoCo: publish /clock, spawn robots, run their controllers.'
    if print_help(args, 'mujoco_sim', purpose, SimulationParameters):
        return 0
    never_wait_for_stderr()
    return program(lambda: simulate(args), stopped=0)


if __name__ == '__main__':
    sys.exit(main())
