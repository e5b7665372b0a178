# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The parameters of a ``controller_manager``: its own, and those that it keeps for a controller.

The tables of :mod:`amr_description.control.manager_parameters` say what there is;
:class:`ManagerParameters` declares and reads them, in a node of ROS or without.
"""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
import os
from pathlib import Path

from amr_description.control.controller_manager import ManagerDefaults
from amr_description.control.manager_parameters import ControllerEntry, ManagerTable
from amr_description.control.switching import Strictness
from amr_description.controller_manager.parameter_store import ParameterStore
from amr_description.controllers.checks.parameter_faults import (
    controller_parameters,
    errors_of,
    manager_faults,
    type_fault,
    type_here,
)
from amr_description.controllers.checks.parameter_sections import listed_controllers, read_sections
from amr_description.errors import ControllerError, ParameterError
from amr_description.log import Log, Severity
from amr_description.model.findings import Finding
from amr_description.parameter_files import read_parameter_file
from amr_description.ros_arguments import files_in, inherited, ros_arguments


class ManagerParameters:
    """
    Declares the parameters of a manager, and reads them whenever they are needed.

    So what ``ros2 param set`` has set before a controller is loaded counts.
    """

    def __init__(self, store: ParameterStore, arguments: Sequence[str], log: Log) -> None:
        """
        Declare the parameters.

        Args:
            store: Has what the manager was given.
            arguments: Its ROS arguments, which every controller gets too.
            log: Of the manager.

        Raises:
            ParameterError: A value has the wrong type, or is out of its bounds.
        """
        self.store = store
        self._arguments = list(arguments)
        self._log = log
        uses_sim_time = store.value('use_sim_time')
        with self._explained(self._own_faults):
            store.declare(ManagerTable, defaults={'overruns.print_warnings': not uses_sim_time})
            self.start = store.values(ManagerTable)
            """The values at the start."""
            store.declare_given()
        store.check_sets(ManagerTable)
        if not self.start.handle_exceptions:
            log(
                Severity.WARN,
                'handle_exceptions is false; what raises an exception is taken down all the same, '
                'and the others go on',
            )

    @property
    def update_rate(self) -> int:
        """Hz."""
        return self.start.update_rate

    def now(self) -> ManagerTable:
        """Return the present values."""
        return self.store.values(ManagerTable)

    def entry_of(self, name: str) -> ControllerEntry:
        """
        Return the parameters for a controller, which are declared from now on.

        Raises:
            ControllerError: It has no type; the controllers that have one are named.
            ParameterError: A value has the wrong type.
        """
        if not self.store.value(f'{name}.type'):
            causes = '; '.join(each.text for each in errors_of(self._own_faults()))
            raise ControllerError(
                f"no type is set for '{name}': {causes}"
                if causes
                else f"The 'type' param was not defined for '{name}'. Controllers with a type in "
                f'the parameters of {self.store.node}: '
                f'{", ".join(self.typed_controllers()) or "none"}'
            )
        prefix = f'{name}.'
        self.store.declare(ControllerEntry, prefix=prefix)
        file = self.store.value(f'{prefix}params_file')
        lone = {f'{prefix}params_file': [file]} if isinstance(file, str) else {}
        return self.store.values(ControllerEntry, lone, prefix=prefix)

    def arguments_of(self, entry: ControllerEntry) -> list[str]:
        """
        Return a controller's ROS arguments: the manager's, then its own files and options.

        Raises ParameterError: a file cannot be read.
        """
        for path in map(Path, entry.params_file):
            # A request may name a pipe without end. (``Path.exists()`` would raise.)
            if os.path.exists(path) and not os.path.isfile(path):
                raise ParameterError(f"parameter file '{path}': it is no regular file")
            read_parameter_file(path)  # rcl would not say where it is wrong
        uses_sim_time = self.store.value('use_sim_time')
        return [
            *inherited(self._arguments),
            *(argument for path in entry.params_file for argument in ('--params-file', path)),
            *(['-p', 'use_sim_time:=true'] if uses_sim_time else []),
            *ros_arguments(['--ros-args', *entry.node_options_args]),
        ]

    @contextmanager
    def explained(self, name: str, entry: ControllerEntry) -> Iterator[None]:
        """
        Name what is wrong with a controller's parameters in its files, while it is made inside.

        What does not keep it from being made is logged. Raises ParameterError: in the place of one
        that is raised inside, if the files tell its cause.
        """

        def faults() -> Sequence[Finding]:
            found = read_sections(files_in(self.arguments_of(entry)))
            places = [each.location for each in listed_controllers(found) if each.name == name]
            if not places:
                return ()  # its type is from elsewhere, and so may be the parameters
            _, fault = type_fault(name, entry.type, places[-1])
            node = f'{self.store.node.rpartition("/")[0]}/{name}'
            read = controller_parameters(found, node, entry.type, places[-1])
            is_taken = type_here(entry.type) != entry.type  # which is said where it is loaded
            return [fault] if fault is not None and not is_taken else read.faults

        with self._explained(faults):
            yield

    @contextmanager
    def _explained(self, faults: Callable[[], Sequence[Finding]]) -> Iterator[None]:
        try:
            found = faults()
        except ParameterError:  # rcl has read the file, or complains of it itself
            found = ()
        causes = errors_of(found)
        try:
            yield
        except (ParameterError, ControllerError) as error:
            if causes:
                raise type(error)('; '.join(each.text for each in causes)) from error
            raise
        for each in found:
            self._log(Severity.WARN, each.text)

    def _own_faults(self) -> Sequence[Finding]:
        """Return what is wrong with the manager's own sections in its files."""
        found = read_sections(files_in(self._arguments))
        return tuple(manager_faults(found, self.store.node))

    def defaults(self) -> ManagerDefaults:
        """Return the present values of ``defaults.…``."""
        now = self.now().defaults
        return ManagerDefaults(
            strictness=Strictness[now.switch_controller.strictness.upper()],
            allow_controller_activation_with_inactive_hardware=(
                now.allow_controller_activation_with_inactive_hardware
            ),
            deactivate_controllers_on_hardware_self_deactivate=(
                now.deactivate_controllers_on_hardware_self_deactivate
            ),
        )

    def typed_controllers(self) -> list[str]:
        """Return the names of those that have a type, sorted."""
        return sorted(
            name.removesuffix('.type') for name in self.store.names() if name.endswith('.type')
        )
