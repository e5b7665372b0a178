# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The parameters of a ``controller_manager`` node, as the manager needs them."""

from collections.abc import Sequence
from typing import Any

from rclpy.node import Node
from rclpy.parameter import Parameter

from amr_description.control.switching import Strictness
from amr_description.errors import ControllerError, ParameterError
from amr_description.nodes.ros_arguments import inherited


class ManagerParameters:
    """
    Reads the node each time: ``ros2 param set`` before a load counts.

    ``arguments`` are the manager's own ROS arguments, which every controller gets too.
    """

    def __init__(self, node: Node, arguments: Sequence[str]) -> None:
        """Raise ParameterError where ``update_rate`` is not a positive integer."""
        self._node = node
        self._arguments = list(arguments)
        self.update_rate = self._read_update_rate()

    def type_of(self, name: str) -> str:
        """Return the type of a controller. Raises ControllerError naming those that have one."""
        type_name = self._get(f'{name}.type')
        if not type_name:
            raise ControllerError(
                f"The 'type' param was not defined for '{name}'. Controllers with a type in the "
                f'parameters of {self._node.get_fully_qualified_name()}: '
                f'{", ".join(self._typed_controllers()) or "none"}'
            )
        return type_name

    def arguments_of(self, name: str) -> list[str]:
        """Return the manager's own arguments, then the controller's files and options."""
        files = self._get(f'{name}.params_file') or []
        files = [files] if isinstance(files, str) else files
        options = self._get(f'{name}.node_options_args') or []
        return [
            *inherited(self._arguments),
            *(argument for path in files for argument in ('--params-file', path)),
            *(option for option in options if option != '--ros-args'),
        ]

    def strictness(self, requested: int) -> Strictness:
        """Return the strictness of a request; 0 asks for the default."""
        if requested == 0 and self._get('defaults.switch_controller.strictness') == 'strict':
            return Strictness.STRICT
        return Strictness.STRICT if requested == Strictness.STRICT else Strictness.BEST_EFFORT

    def _get(self, name: str) -> Any:
        return self._node.get_parameter_or(name, Parameter(name)).value

    def _typed_controllers(self) -> list[str]:
        return sorted(
            name.removesuffix('.type')
            for name in self._node.get_parameters_by_prefix('')
            if name.endswith('.type')
        )

    def _read_update_rate(self) -> int:
        rate = self._get('update_rate')
        rate = 100 if rate is None else rate
        if type(rate) is not int or rate <= 0:
            raise ParameterError(
                f"parameter 'update_rate' of {self._node.get_name()} must be an integer above "
                f'0 Hz, found {rate!r}'
            )
        return rate
