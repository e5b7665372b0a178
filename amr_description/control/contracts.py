# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The interfaces of a controller and of a hardware component: the page to read before writing one.

What a component sees of a simulated world is in :mod:`amr_description.control.world`.

Nothing here depends on ROS, MuJoCo or a clock. A single thread, **the control thread**, calls
every method below except :meth:`Controller.configure`; data from other threads arrives through
:class:`Input`. Times and periods are integer nanoseconds, all physical values SI.

A transition or an update that fails raises (:mod:`amr_description.errors`); nothing returns a
flag.
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
    The logger of a component, which has no other way to log.

    The calling thread only stores the line; another one emits it, under the component's own
    logger.
    """

    def __call__(self, severity: Severity, text: str, *, throttle: float = 0.0) -> None:
        """
        Log ``text``.

        Args:
            severity: of the line.
            text: one line.
            throttle: least time between two lines of the same format, s; ``math.inf``: log once.
                Lines that are equal up to their first digit have the same format.
        """


def null_log(severity: Severity, text: str, *, throttle: float = 0.0) -> None:
    """Log nothing."""


# --- Ports: the topics of a controller -----------------------------------------------------------


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


class Input[Sample]:
    """
    The queue of a subscribed topic: any thread puts samples, the control thread drains them.

    It is closed, and takes nothing, until the controller is activated.
    """

    def __init__(self, port: Port, capacity: int = 16) -> None:
        """``capacity``: if more samples arrive between two updates, the oldest are dropped."""
        self.port = port
        self.is_open = False
        self._samples: deque[Sample] = deque(maxlen=capacity)

    def put(self, sample: Sample) -> bool:
        """Store a sample; return False if the input is closed, which drops it."""
        if self.is_open:
            self._samples.append(sample)
        return self.is_open

    def drain(self) -> list[Sample]:
        """Return all samples since the last call, oldest first."""
        samples = self._samples
        return [samples.popleft() for _ in range(len(samples))]

    def open(self) -> None:
        """Start to take samples; the manager calls it when the controller is activated."""
        self._samples.clear()
        self.is_open = True

    def close(self) -> None:
        """Take no more samples and drop the waiting ones."""
        self.is_open = False
        self._samples.clear()


class Output[Sample]:
    """A published topic; the control thread sends samples."""

    def __init__(self, port: Port) -> None:
        self.port = port
        self.sink: Callable[[Sample], None] | None = None
        """Set along with the controller's node. None (in a unit test): samples are dropped."""

    def send(self, sample: Sample) -> None:
        """Publish a sample at the end of this cycle, after the ``/clock`` of the same instant."""
        if self.sink is not None:
            self.sink(sample)


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
