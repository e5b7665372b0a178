# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The interfaces of a controller and of a hardware component: the page to read before writing one.

What a component sees of a simulated world is in :mod:`amr_description.control.world`.

Nothing here depends on ROS, MuJoCo or a clock. A single thread, **the control thread**, calls
every method below except :meth:`Controller.configure`; data from other threads arrives through
:class:`Input` and :class:`Action`. Times and periods are integer nanoseconds, all else is SI.

A transition or an update that fails raises (:mod:`amr_description.errors`); no flag is returned.
"""

from abc import ABC, abstractmethod
from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass
import enum
from typing import Any, ClassVar, Generic, TYPE_CHECKING, TypeVar

from amr_description.control.interfaces import (
    CommandInterface,
    InterfaceRequest,
    NO_INTERFACES,
    StateInterface,
)
from amr_description.control.world import World
from amr_description.log import Log as Log, null_log as null_log, Severity as Severity

if TYPE_CHECKING:
    from amr_description.model.ros2_control_tag import HardwareInfo
    from amr_description.model.urdf import Robot

Sample = TypeVar('Sample')
Request = TypeVar('Request')
Response = TypeVar('Response')
Feedback = TypeVar('Feedback')
Result = TypeVar('Result')


# --- Ports: the topics, services and actions of a controller -------------------------------------


@dataclass(frozen=True, slots=True)
class Qos:
    """A quality of service; ``'system_default'`` leaves the choice to the middleware."""

    depth: int = 0
    reliability: str = 'system_default'
    durability: str = 'system_default'


SYSTEM_DEFAULT = Qos()


@dataclass(frozen=True, slots=True)
class Port:
    """
    One topic of a controller, declared instead of created.

    ``name`` is resolved by the controller's node (``~/cmd_vel``, ``joint_states``, ``/tf``).
    ``message`` is the ROS type. What goes through the port, a *sample*, may be of any type; a
    frozen dataclass is best. One of two fields says how it becomes a message:

    - ``convert`` names a function, ``module:function``: for an input ``(message) -> sample``, for
      an output ``(sample, message) -> None``, which fills a message that is created once and
      reused.
    - ``sample`` is a type of :mod:`amr_description.control.samples`, for which there is a
      converter already.
    """

    name: str
    message: str
    convert: str = ''
    qos: Qos = SYSTEM_DEFAULT
    sample: type | None = None
    is_optional: bool = False
    """An output that is left out, with a warning, where its message package is not installed."""


class Input(Generic[Sample]):
    """
    The queue of a subscribed topic: any thread puts samples, the control thread drains them.

    It is closed, and takes nothing, until the controller is activated.
    """

    def __init__(
        self, port: Port, capacity: int = 16, check: Callable[[Sample, int], str] | None = None
    ) -> None:
        """
        Declare it.

        Args:
            port: name and type.
            capacity: if more samples arrive between two updates, the oldest are dropped.
            check: ``(sample, time in ns) -> why it is dropped``, which is logged; '' to take it.
                It is called in another thread, so it reads only what ``configure`` has set.
        """
        self.port = port
        self.check = check
        self.is_open = False
        self.on_drain: Callable[[list[bytes]], None] | None = None
        """Called with the messages of the samples that are drained, for who records them."""
        self._samples: deque[tuple[Sample, bytes]] = deque(maxlen=capacity)

    def put(self, sample: Sample, message: bytes = b'') -> bool:
        """
        Store a sample; return False if the input is closed, which drops it.

        ``message``: that it was made of, serialized, for :attr:`on_drain`; empty: none.
        """
        if self.is_open:
            self._samples.append((sample, message))
        return self.is_open

    def drain(self) -> list[Sample]:
        """Return all samples since the last call, oldest first."""
        samples = self._samples
        if not samples:
            return []
        taken = [samples.popleft() for _ in range(len(samples))]
        if self.on_drain is not None:
            self.on_drain([message for _, message in taken if message])
        return [sample for sample, _ in taken]

    def open(self) -> None:
        """Start to take samples; the manager calls it when the controller is activated."""
        self._samples.clear()
        self.is_open = True

    def close(self) -> None:
        """Take no more samples and drop the waiting ones."""
        self.is_open = False
        self._samples.clear()


class Output(Generic[Sample]):
    """A published topic; the control thread sends samples."""

    def __init__(self, port: Port) -> None:
        self.port = port
        self.sink: Callable[[Sample], None] | None = None
        """Set along with the controller's node. None (in a unit test): samples are dropped."""

    def send(self, sample: Sample) -> None:
        """Publish a sample at the end of this cycle, after the ``/clock`` of the same instant."""
        if self.sink is not None:
            self.sink(sample)


@dataclass(frozen=True, slots=True)
class ServicePort:
    """
    One service of a controller, declared instead of created.

    ``name`` is resolved by the controller's node (``~/query_state``), ``service`` is the ROS type.
    ``request`` and ``response`` say how these messages and their samples become each other: a type
    of :mod:`amr_description.control.samples`, for which there is a converter already, or a
    function, ``module:function``, as in :class:`Port`: ``(message) -> sample`` of a request,
    ``(sample, message) -> None`` of a response.
    """

    name: str
    service: str
    request: type | str
    response: type | str


class Service(Generic[Request, Response]):
    """
    A service that the controller answers in every state from inactive on.

    ``answer`` is called on the control thread, between two cycles, also while time stands: it must
    not take long. If it raises, that is logged, and the client gets a response of defaults.
    """

    def __init__(self, port: ServicePort, answer: Callable[[Request], Response]) -> None:
        self.port = port
        self.answer = answer


@dataclass(frozen=True, slots=True)
class ActionPort:
    """
    One action of a controller, declared instead of created; see :class:`ServicePort`.

    ``goal`` is read, ``feedback`` and ``result`` are written. ``rate``, Hz of the wall clock, is
    how often results and the newest feedback are looked for.
    """

    name: str
    action: str
    goal: type | str
    feedback: type | str
    result: type | str
    rate: float = 20.0


class GoalStatus(enum.IntEnum):
    """How a goal ended, with the numbers of ``action_msgs/msg/GoalStatus``."""

    SUCCEEDED = 4
    CANCELED = 5
    ABORTED = 6


class Goal(Generic[Request, Feedback, Result]):
    """
    An accepted goal of an action, which the control thread follows until it ends it.

    Only attributes are written here, and the ROS thread looks at them: nothing blocks either one.
    The first of the calls that end a goal counts.
    """

    __slots__ = ('request', 'is_cancel_requested', 'feedback', 'outcome')

    def __init__(self, request: Request) -> None:
        self.request = request
        self.is_cancel_requested = False
        """Set by the client. The controller ends the goal when it sees it, as it likes."""
        self.feedback: Feedback | None = None
        """The newest; over ROS, that has not been published yet."""
        self.outcome: tuple[GoalStatus, Result | None] | None = None
        """Set once; a result of None becomes a message of defaults."""

    @property
    def is_live(self) -> bool:
        """False once it has ended."""
        return self.outcome is None

    def send_feedback(self, feedback: Feedback) -> None:
        """Have the newest feedback published; what was not published yet is dropped."""
        self.feedback = feedback

    def succeed(self, result: Result | None) -> None:
        """End: what was asked for is done."""
        self._end(GoalStatus.SUCCEEDED, result)

    def abort(self, result: Result | None) -> None:
        """End: it cannot be done."""
        self._end(GoalStatus.ABORTED, result)

    def cancel(self, result: Result | None) -> None:
        """End: the client, or a newer goal, wants something else."""
        self._end(GoalStatus.CANCELED, result)

    def _end(self, status: GoalStatus, result: Result | None) -> None:
        if self.outcome is None:
            self.outcome = (status, result)


class Action(Generic[Request, Feedback, Result]):
    """
    An action that the controller serves: the ROS thread puts goals, the control thread takes them.

    Like an :class:`Input` it is closed until the controller is activated, and again before it is
    deactivated; goals that the controller then leaves without an end are aborted.
    """

    def __init__(
        self, port: ActionPort, check: Callable[[Request, int], str], capacity: int = 16
    ) -> None:
        """
        Declare it.

        Args:
            port: name and types.
            check: ``(request, time in ns) -> why it is rejected``, '' to accept it. It is called
                on the ROS thread, so it reads only what ``configure`` has set.
            capacity: if more goals arrive between two updates, the oldest are canceled.
        """
        self.port = port
        self.check = check
        self.is_open = False
        self._capacity = capacity
        self._waiting: deque[Goal[Request, Feedback, Result]] = deque()
        self._live: list[Goal[Request, Feedback, Result]] = []

    def refusal(self, request: Request, time: int) -> str:
        """Return why a goal is rejected at ``time``, ns; '': it is accepted."""
        if not self.is_open:
            return "Can't accept new action goals. Controller is not running."
        return self.check(request, time)

    def put(self, goal: Goal[Request, Feedback, Result]) -> bool:
        """Queue an accepted goal; return False if the action is closed, which leaves it alone."""
        if self.is_open:
            self._waiting.append(goal)
        return self.is_open  # again: what is put while it closes nobody may take any more

    def drain(self) -> list[Goal[Request, Feedback, Result]]:
        """
        Return the goals that have arrived since the last call, oldest first.

        A controller that follows one goal at a time takes the last, and cancels the others.
        """
        waiting = self._waiting
        if not waiting:
            return []
        goals = [waiting.popleft() for _ in range(len(waiting))]
        for goal in goals[: -self._capacity]:
            goal.cancel(None)
        goals = goals[-self._capacity :]
        self._live = [goal for goal in self._live if goal.is_live] + goals
        return goals

    def open(self) -> None:
        """Start to take goals; the manager calls it when the controller is activated."""
        self.end()
        self.is_open = True

    def close(self) -> None:
        """Take no more goals; the manager calls it before the controller is deactivated."""
        self.is_open = False

    def end(self) -> None:
        """Abort what has no end yet; the manager calls it when the controller is inactive."""
        for goal in (*self._live, *self.drain()):
            goal.abort(None)
        self._live.clear()


# --- Controller ----------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class ControllerContext:
    """What a controller is given at construction."""

    name: str
    log: Log
    namespace: str = '/'
    update_rate: int = 100
    """Hz, of this controller."""
    robot: 'Robot | None' = None
    """The robot's description, if the manager has one."""


class Controller(ABC):
    """
    Computes commands from states; one object per controller name.

    Lifecycle: constructed (unconfigured) → ``configure`` → inactive → ``activate`` → active,
    ``update`` every period → ``deactivate`` → inactive → ``cleanup`` → unconfigured. After
    ``cleanup`` it can be configured again.
    """

    parameters_type: ClassVar[type]
    """The frozen dataclass of its parameters, see :mod:`amr_description.parameters`."""

    is_chainable: ClassVar[bool] = False
    """True: other controllers may use its :meth:`references` and :meth:`exported_states`."""

    def __init__(self, context: ControllerContext) -> None:
        self.context = context
        self.log = context.log
        self.is_chained = False
        """True while a preceding controller commands its references; the manager sets it."""

    @abstractmethod
    def configure(self, parameters: Any) -> None:
        """
        Take over checked parameters (an instance of ``parameters_type``).

        It may take long: this is the only method that runs on a worker thread, while the control
        thread goes on. No other method of the controller is called meanwhile; access to anything
        that it shares with others is for the controller to synchronize.

        Raises:
            ControllerError: it stays unconfigured.
        """

    def command_interfaces(self) -> InterfaceRequest:
        """Return the command interfaces to claim; called after ``configure``."""
        return NO_INTERFACES

    def state_interfaces(self) -> InterfaceRequest:
        """Return the state interfaces to read; called after ``configure``."""
        return NO_INTERFACES

    def references(self) -> tuple[CommandInterface, ...]:
        """
        Return what a preceding controller may command in chained mode, named
        ``<controller>/<reference>``; called after ``configure``.
        """
        return ()

    def exported_states(self) -> tuple[StateInterface, ...]:
        """
        Return what other controllers may read, named ``<controller>/<state>``; called after
        ``configure``.
        """
        return ()

    def set_chained_mode(self, is_chained: bool) -> None:
        """
        Take commands from the references (True) or from the topics; called while inactive.

        Raises ControllerError to refuse.
        """
        self.is_chained = is_chained

    def inputs(self) -> tuple[Input[Any], ...]:
        """Return the topics to subscribe to; called after ``configure``, opened at activation."""
        return ()

    def outputs(self) -> tuple[Output[Any], ...]:
        """Return the topics to publish; called after ``configure``."""
        return ()

    def services(self) -> tuple[Service[Any, Any], ...]:
        """Return the services to serve; called after ``configure``."""
        return ()

    def actions(self) -> tuple[Action[Any, Any, Any], ...]:
        """Return the actions to serve; called after ``configure``, opened at activation."""
        return ()

    @abstractmethod
    def activate(
        self, commands: Sequence[CommandInterface], states: Sequence[StateInterface], time: int
    ) -> None:
        """
        Take the interfaces on loan.

        Args:
            commands: in the order of :meth:`command_interfaces`.
            states: in the order of :meth:`state_interfaces`.
            time: simulated or system time, ns.

        Raises:
            ControllerError: it stays inactive, and the interfaces are released.
        """

    @abstractmethod
    def update(self, time: int, period: int) -> None:
        """
        Read states, compute, write commands. An exception deactivates the controller.

        Args:
            time: of this update, ns.
            period: since the previous update of this controller, ns; the nominal period at the
                first.
        """

    def deactivate(self, time: int) -> None:
        """Leave the actuators safe (a drive: at rest) and drop the interfaces."""

    def cleanup(self) -> None:
        """Undo ``configure``."""

    def reset(self, time: int) -> None:
        """
        The simulation was reset to ``time``, ns: forget every stamp, and start from the present
        states. Called while inactive or active.
        """

    def set_clock(self, time: int) -> None:
        """
        The clock jumped, forward or back, to ``time``, ns, while the robot went on: forget every
        stamp, and keep the rest. Called while inactive or active.
        """
        self.reset(time)


# --- Hardware ------------------------------------------------------------------------------------


class HardwareComponent(ABC):
    """
    The driver of a device, simulated or real: commands to actuators, sensors to states.

    Its lifecycle is that of a controller, and ends in finalized. ``read`` is called while inactive
    or active, ``write`` only while active, and never for a sensor; with ``rw_rate`` both are
    called at that rate, with the true period. Neither may block: a component with slow I/O does it
    on a thread of its own and exchanges snapshots with it.

    If one of them raises, the component and all others of its ``group`` are brought down
    (``deactivate``, ``cleanup``), so that no actuator keeps moving; if ``write`` raises
    :class:`~amr_description.errors.HardwareDeactivationError`, the component only becomes
    inactive. Either way the controllers that need its interfaces are deactivated, and it can be
    configured again.
    """

    def __init__(self, info: 'HardwareInfo', log: Log, world: World | None) -> None:
        """
        Take over the description.

        Args:
            info: the ``<ros2_control>`` block.
            log: the component's logger.
            world: the simulated world; None on a real robot.

        Raises:
            HardwareError: ``info`` asks for something that it does not support.
        """
        self.info = info
        self.log = log
        self.world = world

    @abstractmethod
    def state_interfaces(self) -> Sequence[StateInterface]:
        """
        Return its state interfaces, made by ``StateInterface.of(joint, interface)``; called once,
        after construction.
        """

    @abstractmethod
    def command_interfaces(self) -> Sequence[CommandInterface]:
        """
        Return its command interfaces, made by ``CommandInterface.of(joint, interface)``; called
        once, after construction.
        """

    def configure(self) -> None:
        """Open the device."""

    def activate(self) -> None:
        """Power the actuators, holding still."""

    def deactivate(self) -> None:
        """Stop the actuators."""

    def cleanup(self) -> None:
        """Close the device."""

    def shutdown(self) -> None:
        """Unconfigured → finalized: the last call."""

    def prepare_command_mode_switch(self, start: Sequence[str], stop: Sequence[str]) -> None:
        """
        Check a switch of command interfaces; change nothing yet, as another component may refuse.

        Args:
            start: names of its command interfaces that are to be claimed.
            stop: names of those that are to be released.

        Raises:
            HardwareError: it refuses.
        """

    def perform_command_mode_switch(self, start: Sequence[str], stop: Sequence[str]) -> None:
        """
        Carry out a switch of command interfaces; arguments as above.

        It was not always prepared: with an empty ``start``, a controller may have failed.
        """

    def reset(self, time: int) -> None:
        """The simulation was reset to ``time``, ns; called while inactive or active."""

    @abstractmethod
    def read(self, time: int, period: int) -> None:
        """Update the state interfaces; times in ns, see the class. Raises HardwareError."""

    @abstractmethod
    def write(self, time: int, period: int) -> None:
        """
        Send the commands to the actuators; times in ns, see the class. Raises HardwareError.

        NaN means that there is no command. Infinite commands never arrive here: the manager
        replaces them by 0.0 (velocity, effort, acceleration, jerk) or NaN.
        """
