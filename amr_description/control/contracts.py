# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The page to read before writing a controller or a hardware component; what a component sees of a
simulated world stands in :mod:`amr_description.control.world`.

Nothing here knows ROS, MuJoCo or a clock. One thread, **the owner**, calls every method below but
:meth:`Controller.configure`; what comes from other threads arrives through :class:`Input`. Times
and periods are integer nanoseconds. All physical values are SI.

A transition or an update that cannot be done raises (:mod:`amr_description.errors`); nothing
returns a flag.
"""

from abc import ABC, abstractmethod
from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass
import enum
from typing import Any, ClassVar, Protocol, TYPE_CHECKING

from amr_description.control.interfaces import (
    CommandInterface,
    InterfaceRequest,
    NO_INTERFACES,
    StateInterface,
)
from amr_description.control.world import World

if TYPE_CHECKING:
    from amr_description.model.ros2_control_tag import HardwareInfo
    from amr_description.model.urdf import Robot


# --- Log -----------------------------------------------------------------------------------------


class Severity(enum.IntEnum):
    """Severities with rcutils' numbers."""

    DEBUG = 10
    INFO = 20
    WARN = 30
    ERROR = 40
    FATAL = 50


class Log(Protocol):
    """
    Where a component says something; it never logs by itself.

    The caller's thread only stores the line. Whoever owns the node emits it, under the component's
    own logger.
    """

    def __call__(self, severity: Severity, text: str, *, throttle: float = 0.0) -> None:
        """
        Say ``text``.

        ``throttle``: the least time in s between two lines with the same format (``math.inf``:
        once); the key is the text up to its first digit, so that a changing number does not defeat
        it.
        """


# --- Ports: what a controller hears and says -----------------------------------------------------


@dataclass(frozen=True, slots=True)
class Qos:
    """
    A quality of service; ``'system_default'`` leaves the choice to the middleware, as rmw does.
    """

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


class Input[Sample]:
    """
    The mailbox of an input port: any thread puts, the owner drains.

    Closed (the state before activation) it takes nothing. When more than ``capacity`` samples
    arrive between two updates, the oldest go.
    """

    def __init__(self, port: Port, capacity: int = 16) -> None:
        self.port = port
        self.is_open = False
        self._samples: deque[Sample] = deque(maxlen=capacity)

    def put(self, sample: Sample) -> bool:
        """Store a sample; ``False`` when the input is closed, and the sample is gone."""
        if self.is_open:
            self._samples.append(sample)
        return self.is_open

    def drain(self) -> list[Sample]:
        """All samples since the last call, oldest first."""
        samples = self._samples
        return [samples.popleft() for _ in range(len(samples))]

    def open(self) -> None:
        """Begin to take samples; the manager calls it when the controller is activated."""
        self._samples.clear()
        self.is_open = True

    def close(self) -> None:
        """Take no more samples and forget those that wait."""
        self.is_open = False
        self._samples.clear()


class Output[Sample]:
    """
    The outlet of an output port; the owner sends.

    ``sink`` is set by whoever gives the controller its node; without one (in a test, say) what is
    sent is dropped.
    """

    def __init__(self, port: Port) -> None:
        self.port = port
        self.sink: Callable[[Sample], None] | None = None

    def send(self, sample: Sample) -> None:
        """
        Publish a sample after this turn of the loop, behind the ``/clock`` of the same instant.
        """
        if self.sink is not None:
            self.sink(sample)


# --- Controller ----------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class ControllerContext:
    """What a controller may know of its surroundings; handed over once, at construction."""

    name: str
    log: Log
    namespace: str = '/'
    update_rate: int = 100
    """Hz, of this controller."""
    robot: 'Robot | None' = None
    """The robot's description, when the manager has one."""


class Controller(ABC):
    """
    The logic between states and commands; one object per controller name.

    Life: constructed (unconfigured) → ``configure`` → inactive → ``activate`` → active, ``update``
    every period → ``deactivate`` → inactive → ``cleanup`` → unconfigured. ``configure`` may come
    again after ``cleanup``.
    """

    parameters_type: ClassVar[type]
    """The frozen dataclass of its parameters, see :mod:`amr_description.parameters`."""

    is_chainable: ClassVar[bool] = False
    """True when others may stand before it, by :meth:`references` or :meth:`exported_states`."""

    def __init__(self, context: ControllerContext) -> None:
        self.context = context
        self.log = context.log
        self.is_chained = False
        """True while a preceding controller commands its references; the manager sets it."""

    @abstractmethod
    def configure(self, parameters: Any) -> None:
        """
        Take over checked parameters (an instance of ``parameters_type``). Raises ControllerError.

        May take its time: it alone of all methods runs on a worker thread, while the owner's loop
        goes on. Nobody else touches the controller meanwhile; what it shares with others is its
        own affair.
        """

    def command_interfaces(self) -> InterfaceRequest:
        """The command interfaces to claim; asked after ``configure``."""
        return NO_INTERFACES

    def state_interfaces(self) -> InterfaceRequest:
        """The state interfaces to read; asked after ``configure``."""
        return NO_INTERFACES

    def references(self) -> tuple[CommandInterface, ...]:
        """
        What a preceding controller may command in chained mode, named
        ``<controller>/<reference>``; asked after ``configure``.
        """
        return ()

    def exported_states(self) -> tuple[StateInterface, ...]:
        """
        What other controllers may read of it, named ``<controller>/<state>``; asked after
        ``configure``.
        """
        return ()

    def set_chained_mode(self, is_chained: bool) -> None:
        """
        Take commands from the references (``True``) or from the topics; while inactive.

        Raises ControllerError to refuse.
        """
        self.is_chained = is_chained

    def inputs(self) -> tuple[Input[Any], ...]:
        """The topics it hears; asked after ``configure``, opened by ``activate``."""
        return ()

    def outputs(self) -> tuple[Output[Any], ...]:
        """The topics it says; asked after ``configure``."""
        return ()

    @abstractmethod
    def activate(
        self, commands: Sequence[CommandInterface], states: Sequence[StateInterface], time: int
    ) -> None:
        """
        Take the lent handles, in the order of the requests.

        ``time``: of the simulation or the machine, ns. Raises ControllerError; the handles are
        then taken back.
        """

    @abstractmethod
    def update(self, time: int, period: int) -> None:
        """
        Read states, compute, write commands.

        ``time``: of this update, ns. ``period``: since this controller's previous update, ns; the
        nominal one at the first. Raising deactivates the controller.
        """

    def deactivate(self, time: int) -> None:
        """Leave the actuators safe (a drive: at rest) and forget the handles."""

    def cleanup(self) -> None:
        """Forget what ``configure`` made."""

    def reset(self, time: int) -> None:
        """
        The world began anew at ``time``, ns, while inactive or active: forget every stamp, and
        start from the present states.
        """

    def set_clock(self, time: int) -> None:
        """
        The clock was set, forward or back, to ``time``, ns, while the robot went on: forget every
        stamp, and keep the rest; while inactive or active.
        """
        self.reset(time)


# --- Hardware ------------------------------------------------------------------------------------


class HardwareComponent(ABC):
    """
    The one layer that is swapped on a real robot: it turns commands into motion and encoders into
    states.

    Life as a controller's, and at its end finalized. ``read`` is called while inactive or active,
    ``write`` only while active, and not of a sensor; with ``rw_rate`` both come at that rate, with
    the true period. Neither may block: a component that owns a device lets a thread of its own do
    the I/O and exchanges snapshots with it. When one of them raises, the component is brought down
    (``deactivate``, ``cleanup``), so that nothing goes on moving by itself, and with it all of its
    ``group``; a ``write`` that raises
    :class:`~amr_description.errors.HardwareDeactivationError` only makes it inactive. Either way
    controllers that need its interfaces are deactivated, and it may be configured again.
    """

    def __init__(self, info: 'HardwareInfo', log: Log, world: World | None) -> None:
        """
        ``world`` is ``None`` on a real robot. Raises HardwareError when ``info`` asks what it
        cannot do.
        """
        self.info = info
        self.log = log
        self.world = world

    @abstractmethod
    def state_interfaces(self) -> Sequence[StateInterface]:
        """Its gauges, ``StateInterface.of(joint, interface)``; asked once, after construction."""

    @abstractmethod
    def command_interfaces(self) -> Sequence[CommandInterface]:
        """Its knobs, ``CommandInterface.of(joint, interface)``; asked once, after construction."""

    def configure(self) -> None:
        """Open the device."""

    def activate(self) -> None:
        """Power the actuators, holding still."""

    def deactivate(self) -> None:
        """Stop the actuators."""

    def cleanup(self) -> None:
        """Close the device."""

    def shutdown(self) -> None:
        """The very last call, when it is finalized; it is unconfigured by then."""

    def prepare_command_mode_switch(self, start: Sequence[str], stop: Sequence[str]) -> None:
        """
        These of its command interfaces are to be claimed and released. Raises HardwareError to
        refuse; changes nothing yet, as another component may refuse.
        """

    def perform_command_mode_switch(self, start: Sequence[str], stop: Sequence[str]) -> None:
        """
        These of its command interfaces are now claimed and released.

        Not always announced: where ``start`` is empty their controller may have failed.
        """

    def reset(self, time: int) -> None:
        """The world began anew at ``time``, ns, while inactive or active."""

    @abstractmethod
    def read(self, time: int, period: int) -> None:
        """Bring the state cells up to date. Raises HardwareError."""

    @abstractmethod
    def write(self, time: int, period: int) -> None:
        """
        Put the command cells to the actuators. Raises HardwareError.

        A NaN command is no command; an infinite one never comes here: the manager makes it
        standing still (velocity, effort, acceleration) or none.
        """
