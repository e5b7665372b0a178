"""A controller of ros2_control: it turns a wheel, gently."""

from dataclasses import dataclass
import math
from typing import Any

from amr_description.control.contracts import Controller, Input, Port
from amr_description.control.interfaces import InterfaceRequest
from amr_description.parameters import parameter


@dataclass(frozen=True)
class SpeedParameters:
    """What the YAML file of the controller may set."""

    joint: str = parameter('', 'The joint to turn', not_empty=True)
    max_acceleration: float = parameter(2.0, 'Of the joint', unit='rad/s²', above=0.0)
    timeout: float = parameter(0.5, 'A command holds so long', unit='s', above=0.0)


class SpeedController(Controller):
    """
    Turns a joint at the speed, rad/s, of the newest std_msgs/msg/Float64 on ``~/command``.

    - The speed changes by no more than ``max_acceleration`` allows.
    - After ``timeout`` without a command the joint is braked to 0, likewise gently.
    - A command that is not finite is ignored.
    - A controller that is switched off leaves a speed of 0.
    """

    parameters_type = SpeedParameters

    def configure(self, parameters: SpeedParameters) -> None:
        """Take the parameters; nothing moves yet."""
        self._parameters = parameters
        self._input = Input(Port('~/command', 'std_msgs/msg/Float64', 'speed_controller:read'))

    def command_interfaces(self) -> InterfaceRequest:
        """Claim the speed of the joint."""
        return InterfaceRequest.individual([f'{self._parameters.joint}/velocity'])

    def inputs(self) -> tuple[Input, ...]:
        """Say what it subscribes to."""
        return (self._input,)

    def activate(self, commands: Any, states: Any, time: int) -> None:
        """Begin: ``self._speed.value`` is the command to the joint, rad/s."""
        (self._speed,) = commands
        self._speed.value = self._wanted = 0.0
        self._heard = time

    def update(self, time: int, period: int) -> None:
        """
        Do one cycle.

        Args:
            time: Now, ns.
            period: Since the last cycle, ns.
        """
        for command in self._input.drain():  # what has come since the last cycle
            if math.isfinite(command):
                self._wanted, self._heard = command, time
        if time - self._heard > self._parameters.timeout * 1e9:
            self._wanted = 0.0
        most = self._parameters.max_acceleration * period * 1e-9
        change = self._wanted - self._speed.value
        self._speed.value += max(-most, min(change, most))

    def deactivate(self, time: int) -> None:
        """End."""
        self._speed.value = 0.0


def read(message: Any) -> float:
    """Return what a message says."""
    return message.data
