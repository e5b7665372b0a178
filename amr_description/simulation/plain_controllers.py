# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Controllers without nodes: their ports by the names that topics, services and actions would have.

What is sent to a topic goes into the inputs of that name, what a controller publishes is kept, the
newest sample of each output. Who calls a service, or sends a goal, does so by the port, too.
"""

from collections import deque
from collections.abc import Callable, Iterator, Sequence
from typing import Any, TYPE_CHECKING, TypeVar

from amr_description.control.contracts import Action, Controller, Input, Output, Service
from amr_description.control.interfaces import LifecycleState
from amr_description.controller_manager.made_controllers import make_controller
from amr_description.controller_manager.plain_parameters import PlainParameters
from amr_description.log import Log
from amr_description.messages.lifecycle import TRANSITION_EVENT, transition_event
from amr_description.model.robot import Robot
from amr_description.ros_arguments import NodeNames
from amr_description.simulation.publishing import (
    metadata_of,
    PlainInput,
    PlainPublisher,
    PlainTopic,
)
from amr_description.simulation.topics.advertising import Encode

if TYPE_CHECKING:  # its libraries are for who records
    from amr_description.simulation.run_recorder import RunRecorder

_Result = TypeVar('_Result')
SIM_TIME = {'use_sim_time': True}
"""What every node of a simulator is given."""


class Newest(PlainTopic):
    """The newest sample of one output, which is recorded, too."""

    def __init__(self, name: str, output: Output[Any], publisher: PlainPublisher) -> None:
        """
        Take what is sent from now on.

        Args:
            name: Of the topic.
            output: Of the controller.
            publisher: Of the loop.
        """
        port = self.port = output.port
        self._output = output
        self._samples: deque[Any] = deque(maxlen=1)
        metadata = metadata_of(name, port.message, port.qos)
        super().__init__(metadata, self._encoder_of_bytes, publisher)
        self._choose_sink()

    def _encoder_of_bytes(self) -> Encode:
        from amr_description.messages.encoders import bytes_encoder_of  # with all samples

        return bytes_encoder_of(self._output.port)

    def attach(self, recorder: 'RunRecorder | None') -> None:
        """Record from now on; None: no more."""
        super().attach(recorder)
        self._choose_sink()

    def _choose_sink(self) -> None:
        keep = self._samples.append  # a call into C, in each cycle
        if not (self.has_subscribers or self.is_latched):
            self._output.sink = keep
            return

        def keep_and_send(sample: Any) -> None:
            keep(sample)
            self.send(sample)

        self._output.sink = keep_and_send

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
        publisher: PlainPublisher,
        time: Callable[[], int],
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
            publisher: Of the loop.
            time: Returns the present time, ns.

        Raises:
            ParameterError: A parameter has another type, or is out of its bounds.
            Exception: Whatever the constructor of a third party's controller raises.
        """
        node = f'{namespace.rstrip("/")}/{name}'
        self.ports: dict[type, dict[str, list[Any]]] = {Input: {}, Service: {}, Action: {}}
        """What it takes, by kind and full name; outputs are by their full names, too."""
        self.outputs: dict[str, Newest] = {}
        self._all_outputs = all_outputs
        self._publisher, self._time = publisher, time
        self._recorded: list[Newest | PlainInput] = []
        self._transitions = publisher.messages(f'{node}/transition_event', TRANSITION_EVENT)
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
        names = self._names
        for each in self.controller.inputs():
            name = self._take(Input, each, names.resolve)
            self._recorded.append(self._publisher.add(PlainInput(name, each)))
        for service in self.controller.services():
            self._take(Service, service, names.resolve_service)
        for action in self.controller.actions():
            self._take(Action, action, names.expanded)
        for output in self.controller.outputs():
            name = names.resolve(output.port.name)
            newest = self.outputs[name] = Newest(name, output, self._publisher)
            self._recorded.append(self._publisher.add(newest))
        self._all_outputs |= self.outputs

    def _take(self, kind: type, port: Any, full: Callable[[str], str]) -> str:
        name = full(port.port.name)
        self.ports[kind].setdefault(name, []).append(port)
        return name

    def disconnect(self) -> None:
        """Forget its ports."""
        for topic in self.outputs:
            self._all_outputs.pop(topic, None)
        for ports in self.ports.values():
            ports.clear()
        self.outputs.clear()
        self._publisher.forget(self._recorded)
        self._recorded.clear()

    def destroy(self) -> None:
        """Forget its ports."""
        self.disconnect()
        self._publisher.forget([self._transitions])

    def publish_transition(
        self, start: LifecycleState, goal: LifecycleState, reached: LifecycleState | None
    ) -> None:
        """Publish that a transition has begun, or (``reached``) has ended."""
        time = self._time()
        self._transitions.publish(lambda: transition_event(time, start, goal, reached))

    def subscribed(self, message: str) -> Iterator[str]:
        """Yield the topics that it subscribes to, of a type of messages."""
        for topic, inputs in self.ports[Input].items():
            if any(each.port.message == message for each in inputs):
                yield topic

    def published(self, message: str) -> Iterator[str]:
        """Yield the topics that it publishes, of a type of messages."""
        for topic, output in self.outputs.items():
            if output.port.message == message:
                yield topic


class PlainHost:
    """
    Makes the controllers of a manager, in one thread with it.

    It is a :class:`~amr_description.controller_manager.requests.Host`.
    """

    def __init__(
        self,
        namespace: str,
        log_of: Callable[[str], Log],
        time: Callable[[], int],
        publisher: PlainPublisher,
    ) -> None:
        """
        Serve no controller yet.

        Args:
            namespace: Of the manager, absolute.
            log_of: Returns the log of a node, by its full name.
            time: Returns the present time, ns.
            publisher: Of the loop.
        """
        self._publisher = publisher
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
            publisher=self._publisher,
            time=self._time,
        )
        self.made[name] = made
        return made

    async def ask(self, call: Callable[[], _Result]) -> _Result:
        """Make a call: this is the control thread."""
        return call()

    async def run_aside(self, call: Callable[[], None], name: str) -> None:
        """Make a call, however long it takes: time waits."""
        call()
