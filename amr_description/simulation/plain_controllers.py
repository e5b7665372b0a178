# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Controllers without nodes: their ports by the names that their topics would have.

What is sent to a topic goes into the inputs of that name, what a controller publishes is kept, the
newest sample of each output. Services and actions are not served: they are ROS's.
"""

from collections import deque
from collections.abc import Callable, Iterator, Sequence
from typing import Any, TypeVar

from amr_description.control.contracts import Controller, Input, Log, Output
from amr_description.control.loaded_controller import ignore_transition, TransitionCallback
from amr_description.controller_manager.made_controllers import make_controller
from amr_description.controller_manager.plain_parameters import PlainParameters
from amr_description.model.robot import Robot
from amr_description.ros_arguments import NodeNames

_Result = TypeVar('_Result')
SIM_TIME = {'use_sim_time': True}
"""What every node of a simulator is given."""


class Newest:
    """The newest sample of one output."""

    def __init__(self, output: Output[Any]) -> None:
        """Take what is sent from now on."""
        self.message = output.port.message
        self._samples: deque[Any] = deque(maxlen=1)
        output.sink = self._samples.append  # a call into C, in each cycle

    @property
    def sample(self) -> Any | None:
        """The newest since :meth:`forget`; None: there is none."""
        return self._samples[0] if self._samples else None

    def forget(self) -> None:
        """Drop it: time went back."""
        self._samples.clear()


class PlainController:
    """
    A controller and its ports.

    It is a :class:`~amr_description.controller_manager.requests.ServedController`.
    """

    publish_transition: TransitionCallback = staticmethod(ignore_transition)

    def __init__(
        self,
        name: str,
        controller_class: type[Controller],
        arguments: Sequence[str],
        *,
        namespace: str,
        update_rate: int,
        robot: Robot | None,
        log: Log,
        all_outputs: dict[str, Newest],
    ) -> None:
        """
        Make a controller.

        Args:
            name: Of the controller.
            controller_class: Called with a ControllerContext.
            arguments: ROS arguments: parameters, and names of topics.
            namespace: Of the manager, absolute.
            update_rate: Of the manager, Hz.
            robot: Handed to the controller.
            log: Of the controller.
            all_outputs: Those of all controllers of the manager, to which its own are added.

        Raises:
            ParameterError: A parameter has another type, or is out of its bounds.
            Exception: Whatever the constructor of a third party's controller raises.
        """
        node = f'{namespace.rstrip("/")}/{name}'
        self.inputs: dict[str, list[Input[Any]]] = {}
        """By the full names of their topics; so are the outputs."""
        self.outputs: dict[str, Newest] = {}
        self._all_outputs = all_outputs
        self._table = controller_class.parameters_type
        self._names = NodeNames(node, arguments)
        self._parameters = PlainParameters(node, arguments, SIM_TIME)
        self.controller = make_controller(
            controller_class,
            self._parameters,
            name=name,
            namespace=namespace,
            log=log,
            update_rate=update_rate,
            robot=robot,
        )

    def parameters(self) -> Any:
        """Return its parameters as they are now. Raises ParameterError."""
        self._parameters.declare_added(self._table)
        return self._parameters.values(self._table)

    def connect(self) -> None:
        """Find its ports by the names of their topics."""
        self.disconnect()
        for each in self.controller.inputs():
            self.inputs.setdefault(self._names.resolve(each.port.name), []).append(each)
        for output in self.controller.outputs():
            self.outputs[self._names.resolve(output.port.name)] = Newest(output)
        self._all_outputs |= self.outputs

    def disconnect(self) -> None:
        """Forget its ports."""
        for topic in self.outputs:
            self._all_outputs.pop(topic, None)
        self.inputs.clear()
        self.outputs.clear()

    def destroy(self) -> None:
        """Forget its ports."""
        self.disconnect()

    def subscribed(self, message: str) -> Iterator[str]:
        """Yield the topics that it subscribes to, of a type of messages."""
        for topic, inputs in self.inputs.items():
            if any(each.port.message == message for each in inputs):
                yield topic

    def published(self, message: str) -> Iterator[str]:
        """Yield the topics that it publishes, of a type of messages."""
        for topic, output in self.outputs.items():
            if output.message == message:
                yield topic


class PlainHost:
    """
    Makes the controllers of a manager, in one thread with it.

    It is a :class:`~amr_description.controller_manager.requests.Host`.
    """

    def __init__(
        self, namespace: str, log_of: Callable[[str], Log], time: Callable[[], int]
    ) -> None:
        """
        Serve no controller yet.

        Args:
            namespace: Of the manager, absolute.
            log_of: Returns the log of a node, by its full name.
            time: Returns the present time, ns.
        """
        self._namespace, self._log_of, self._time = namespace, log_of, time
        self.made: dict[str, PlainController] = {}
        """By name."""
        self.outputs: dict[str, Newest] = {}
        """Of all of them, by topic."""

    @property
    def time(self) -> int:
        """Present time, ns."""
        return self._time()

    def make(
        self,
        name: str,
        controller_class: type[Controller],
        arguments: Sequence[str],
        *,
        update_rate: int,
        robot: Robot | None,
    ) -> PlainController:
        """Make a controller. Raises ParameterError, or whatever its constructor raises."""
        made = PlainController(
            name,
            controller_class,
            arguments,
            namespace=self._namespace,
            update_rate=update_rate,
            robot=robot,
            log=self._log_of(f'{self._namespace.rstrip("/")}/{name}'),
            all_outputs=self.outputs,
        )
        self.made[name] = made
        return made

    async def ask(self, call: Callable[[], _Result]) -> _Result:
        """Make a call: this is the control thread."""
        return call()

    async def run_aside(self, call: Callable[[], None], name: str) -> None:
        """Make a call, however long it takes: time waits."""
        call()
