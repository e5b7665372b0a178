# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The controllers of a robot's parameters, each brought as far as it goes.

Parameter files often list controllers that cannot be active together: one for trajectories and one
for plain commands of the same joints. So all are configured, then activated in rounds until none
comes any further (a chained controller waits for the one that it commands); and those that are
left get their turn in place of the ones that hold their interfaces.
"""

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
import re
from typing import Any

from controller_manager_msgs.msg import ControllerState
from controller_manager_msgs.srv import (
    ListControllers,
    ListControllerTypes,
    ListHardwareInterfaces,
)
from lifecycle_msgs.msg import State

from amr_description.control.ros.client import ManagerClient
from amr_description.controller_manager.spawner import Spawner
from amr_description.controller_manager.spawner_arguments import parse
from amr_description.errors import AmrError, SimulationError
from amr_description.ros.log_thread import LoggerLog
from amr_description.testing.simulation import Simulation
from amr_description.testing.trial.findings import ControllerFinding
from amr_description.testing.trial.parts import (
    is_here,
    named_in_parameters,
    NO_SUCH_INTERFACES,
    NOT_HERE,
)

SERVICE = 'controller_manager_msgs/srv/ListControllers'
_TIMEOUT = 30.0
"""s of the wall clock for the manager to come."""
_GRACE = 3.0
"""s of the wall clock for a manager that nobody promised."""
_DISCOVERY = 5.0
"""s of the wall clock, after which a node that is known has no such topic."""
_LOG_LINE = re.compile(r'^\[(WARN|ERROR|FATAL)\] (?:\[[^]]*\] ?)*:? ?(.*)', re.MULTILINE)


def logged(log: str) -> list[str]:
    """Return the texts of the WARN, ERROR and FATAL lines of a log, each once, in order."""
    lines = [f'{severity}: {text.strip()}' for severity, text in _LOG_LINE.findall(log)]
    return list(dict.fromkeys(lines))


@dataclass(frozen=True)
class Active:
    """An active controller and what it holds."""

    name: str
    type: str
    namespace: str
    claimed: tuple[str, ...]
    """Command interfaces: ``joint/velocity``."""
    is_chained: bool


def find_manager(sim: Simulation, *, is_promised: bool) -> ManagerClient | None:
    """
    Return a client of the robot's controller manager, whatever its name; None: it has none.

    ``is_promised``: whether the description has ``<ros2_control>``; then its absence is an error.
    """

    def names() -> list[str]:
        services = sim.node.get_service_names_and_types()
        return [name for name, types in services if SERVICE in types]

    try:
        found = sim.wait(names, 'a controller manager', _TIMEOUT if is_promised else _GRACE)
    except AmrError:
        if is_promised or not sim.is_alive:
            raise
        return None
    return ManagerClient(sim.node, found[0].rpartition('/')[0], timeout=_TIMEOUT, silent=5.0)


class BringUp:
    """The controllers of one manager."""

    def __init__(
        self,
        sim: Simulation,
        manager: ManagerClient,
        self_typed: Mapping[str, Path],
        files: Sequence[Path] = (),
    ) -> None:
        """``self_typed``: controllers that the manager does not know, with their files, of all."""
        self._sim = sim
        self._manager = manager
        self._self_typed = self_typed
        self._files = files
        self.findings: list[ControllerFinding] = []

    def run(self) -> None:
        """Load, configure and activate all that the manager has a type for, and all it runs."""
        for component in self._manager.components():
            if component.state.id != State.PRIMARY_STATE_ACTIVE:  # as its parameters may say
                target = State(id=State.PRIMARY_STATE_ACTIVE, label='active')
                self._manager.set_component_state(component.name, target)
        before = self._manager.states()
        typed = self._manager.typed_controllers()
        for name in dict.fromkeys([*before, *typed, *self._self_typed]):
            finding = ControllerFinding(name, '', 'not loaded')
            self.findings.append(finding)
            if before.get(name) not in ('active', 'inactive'):
                self._prepare(finding, is_known=name in before or name in typed)
        self._take_over()
        waiting = [each for each in self.findings if each.state == 'inactive']
        while waiting:
            left = [each for each in waiting if not self._activate(each)]
            if len(left) == len(waiting):
                break
            waiting = left
        self._take_over()
        self._say_what_lacks()

    def active(self) -> list[Active]:
        """Return the controllers that are active now."""
        return [_active(each, self._manager) for each in self._listed() if each.state == 'active']

    def turns(self) -> Iterator[Active]:
        """Activate each that is left in place of those that stand in its way; yield it then."""
        for finding in [each for each in self.findings if each.state == 'inactive']:
            listed = self._listed()
            me = next((each for each in listed if each.name == finding.name), None)
            if me is None:
                continue
            wanted = set(me.required_command_interfaces)
            in_the_way = in_the_way_of(wanted, listed)
            reason = finding.reason
            if not in_the_way or not self._activate(finding, in_the_way):
                continue
            finding.reason = f'in place of {", ".join(in_the_way)} ({reason})'
            finding.state = 'active'
            for each in self._listed():
                if each.name == finding.name:
                    yield _active(each, self._manager)

    # --- steps ---------------------------------------------------------------------------------

    def _prepare(self, finding: ControllerFinding, *, is_known: bool) -> None:
        """Load and configure a controller; keep why not."""
        words = [finding.name, '--inactive']
        if not is_known:
            words += ['--param-file', str(self._self_typed[finding.name])]
        try:
            Spawner(LoggerLog(self._sim.node.get_logger()), self._manager, parse(words)).spawn()
        except AmrError as error:
            finding.reason = str(error)

    def _activate(self, finding: ControllerFinding, instead: Sequence[str] = ()) -> bool:
        refusal = self._manager.switch(activate=[finding.name], deactivate=instead)
        if refusal is not None:
            finding.reason = refusal
            return False
        finding.state, finding.reason = 'active', ''
        return True

    def _say_what_lacks(self) -> None:
        """Say of each that is not active what it cannot be active without, and what it names."""
        listed = {each.name: each for each in self._listed()}
        answer = self._manager.query(ListHardwareInterfaces)
        commands = {each.name for each in answer.command_interfaces}
        states = {each.name for each in answer.state_interfaces}
        known = self._manager.query(ListControllerTypes).types
        for finding in self.findings:
            if finding.state == 'active':
                continue
            needed: list[str] = []
            if each := listed.get(finding.name):
                needed = [*each.required_command_interfaces, *each.required_state_interfaces]
                if not (
                    commands.issuperset(each.required_command_interfaces)
                    and states.issuperset(each.required_state_interfaces)
                ):
                    finding.without = NO_SUCH_INTERFACES
            else:
                finding.type = finding.type or self._manager.type_of(finding.name)
                if finding.type and not is_here(finding.type, known):
                    finding.without = NOT_HERE
            joints = {name.rpartition('/')[0] for name in needed}
            finding.names = sorted(joints | named_in_parameters(finding.name, self._files))

    def _take_over(self) -> None:
        """Take type and state of each from the manager."""
        listed = {each.name: each for each in self._listed()}
        for finding in self.findings:
            if each := listed.get(finding.name):
                finding.type, finding.state = each.type, each.state

    def _listed(self) -> list[ControllerState]:
        return list(self._manager.query(ListControllers).controller)


def in_the_way_of(wanted: set[str], listed: Sequence[ControllerState]) -> list[str]:
    """
    Return the active controllers in the place of which interfaces may be had.

    They hold these, or others of the same joints (of position, velocity and effort a joint follows
    one), or they command those that do.
    """
    joints = {each.rpartition('/')[0] for each in wanted}
    names = [
        each.name
        for each in listed
        if each.state == 'active'
        and joints & {name.rpartition('/')[0] for name in each.required_command_interfaces}
    ]
    for name in names:  # it grows meanwhile
        names += [
            each.name
            for each in listed
            if each.state == 'active'
            and each.name not in names
            and any(i.startswith(f'{name}/') for i in each.required_command_interfaces)
        ]
    return names


def _active(each: ControllerState, manager: ManagerClient) -> Active:
    return Active(
        each.name,
        each.type,
        manager.namespace,
        tuple(each.claimed_interfaces) or tuple(each.required_command_interfaces),
        bool(each.is_chained),
    )


def topics_of(
    sim: Simulation,
    find: Callable[[str, str], Any],
    controller: Active,
    wanted: Collection[str],
) -> list[tuple[str, str]]:
    """
    Return the topics of some types of a controller's node, each with its type.

    Args:
        sim: The simulation.
        find: ``get_subscriber_names_and_types_by_node``, or that of publishers.
        controller: Active.
        wanted: The types.
    """
    name, inside = controller.name, controller.namespace

    def is_there() -> bool:
        return (name, inside) in sim.node.get_node_names_and_namespaces()

    def found() -> list[tuple[str, str]]:
        topics = find(name, inside)
        return [(topic, kind) for topic, kinds in topics for kind in kinds if kind in wanted]

    sim.wait(is_there, f"the node of '{name}'")
    try:  # a node is known before its topics are
        sim.wait(found, f"a topic of '{name}'", _DISCOVERY)
    except SimulationError:
        return []
    return found()
