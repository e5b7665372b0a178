# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
pid_controller/PidController: a PID for each degree of freedom, alone or in a chain.

References come from ``~/reference``, or from a preceding controller as
``<controller>/<dof>/<interface>``; what is measured from the states of the same names, or from
``~/measured_state``. With one interface the error is differentiated by differences; a second one
is the derivative of the first. Nothing is commanded while a reference or a measurement is
missing::

    command = pid(reference − measured) + feedforward_gain · reference (of the second interface)

The second term counts while ``enable_feedforward``, or ``~/set_feedforward_control``, says so.

Differences from pid_controller 4.x:

- values of a ``~/reference`` with names are sorted by these; the original mixes them up;
- on deactivation, velocity, acceleration and effort commands, which would keep the joint moving,
  are set to zero; the original leaves the last command;
- gains that are set while it is active count from the next ``configure`` on.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
import math
from typing import Any, ClassVar, TypeVar

from amr_description.clock import NANOSECONDS
from amr_description.control.contracts import (
    Controller,
    ControllerContext,
    Input,
    Output,
    Port,
    Qos,
    Service,
    ServicePort,
)
from amr_description.control.dof_samples import (
    DofCommandSample,
    DofState,
    DofStatesSample,
    PidStateSample,
    SetBoolRequest,
    SetBoolResponse,
)
from amr_description.control.interfaces import (
    ACCELERATION,
    CommandInterface,
    EFFORT,
    InterfaceRequest,
    NO_INTERFACES,
    StateInterface,
    VELOCITY,
)
from amr_description.controllers.pid import Pid, PidGains, STRATEGIES
from amr_description.errors import ControllerError
from amr_description.former_parameters import CLAMP, FormerParameter
from amr_description.log import Severity
from amr_description.parameters import keyed_group, parameter

Handle = TypeVar('Handle')

_NEWEST = Qos(depth=1, reliability='best_effort')
_COMMAND = 'control_msgs/msg/MultiDOFCommand'
_RATES = (VELOCITY, ACCELERATION, EFFORT)
_MOST_INTERFACES = 2


@dataclass(frozen=True)
class DofGains:
    """The gains of one degree of freedom."""

    former: ClassVar[tuple[FormerParameter, ...]] = (CLAMP,)
    p: float = parameter(0.0, 'Proportional gain')
    i: float = parameter(0.0, 'Integral gain')
    d: float = parameter(0.0, 'Derivative gain')
    u_clamp_max: float = parameter(math.inf, 'Highest output', nan=True)
    u_clamp_min: float = parameter(-math.inf, 'Lowest output', nan=True)
    antiwindup: bool = parameter(
        False, 'Deprecated, of the legacy strategy: clamp the integral, not only its part'
    )
    i_clamp_max: float = parameter(math.inf, 'Deprecated: highest integral term', nan=True)
    i_clamp_min: float = parameter(-math.inf, 'Deprecated: lowest integral term', nan=True)
    antiwindup_strategy: str = parameter(
        'legacy', 'Anti-windup strategy of the integral', choices=STRATEGIES
    )
    tracking_time_constant: float = parameter(
        0.0, 'Time constant of back_calculation; 0: from the gains', unit='s'
    )
    error_deadband: float = parameter(1e-16, 'Errors up to this size are not integrated')
    feedforward_gain: float = parameter(0.0, 'Gain of the feed-forward')
    angle_wraparound: bool = parameter(False, 'Take the error of an angle the short way round')
    save_i_term: bool = parameter(True, 'Keep the integral over a deactivation')
    activate_state_publisher: bool = parameter(False, 'Publish ~/<dof>/pid_state')

    def of_pid(self) -> PidGains:
        """Return those of the PID itself."""
        return PidGains(
            p=self.p,
            i=self.i,
            d=self.d,
            u_max=self.u_clamp_max,
            u_min=self.u_clamp_min,
            i_max=self.i_clamp_max,
            i_min=self.i_clamp_min,
            strategy=self.antiwindup_strategy,
            antiwindup=self.antiwindup,
            tracking_time_constant=self.tracking_time_constant,
            error_deadband=self.error_deadband,
        )


@dataclass(frozen=True)
class PidParameters:
    """The table of pid_controller/PidController."""

    dof_names: tuple[str, ...] = parameter(
        (), 'Degrees of freedom that are commanded', not_empty=True, unique=True, read_only=True
    )
    reference_and_state_dof_names: tuple[str, ...] = parameter(
        (),
        'Degrees of freedom of references and states; empty: dof_names',
        unique=True,
        read_only=True,
    )
    command_interface: str = parameter(
        '', 'Interface that is commanded', not_empty=True, read_only=True
    )
    reference_and_state_interfaces: tuple[str, ...] = parameter(
        (), 'Interface of reference and state, and its derivative', not_empty=True, read_only=True
    )
    set_current_state_as_first_setpoint: bool = parameter(
        True, 'After activation, hold the present state', read_only=True
    )
    use_external_measured_states: bool = parameter(
        False, 'Measure by ~/measured_state, not by state interfaces'
    )
    enable_feedforward: bool = parameter(False, 'Use the feedforward_gain')
    gains: Mapping[str, DofGains] = keyed_group('gains', 'dof_names', DofGains)


class _Dof:
    """One degree of freedom: its PID, references, measurements and command."""

    def __init__(self, name: str, state_name: str, gains: DofGains, controller: str) -> None:
        self.name = name
        self.state_name = state_name
        self.gains = gains
        self.pid = Pid(gains.of_pid())
        self.output = 0.0
        """Of the PID alone."""
        self.references: tuple[CommandInterface, ...] = ()
        self.exports: tuple[StateInterface, ...] = ()
        self.state: Output[PidStateSample] = Output(
            Port(f'~/{name}/pid_state', 'control_msgs/msg/PidState', sample=PidStateSample)
        )
        self._controller = controller

    def export(self, interfaces: Sequence[str]) -> None:
        """Make references and exported states."""
        names = [f'{self.state_name}/{interface}' for interface in interfaces]
        self.references = tuple(CommandInterface(self._controller, name) for name in names)
        self.exports = tuple(StateInterface(self._controller, name) for name in names)

    @property
    def error(self) -> float:
        """Reference − measured, of the first interface."""
        error = self.references[0].value - self.exports[0].value
        return _short_way(error) if self.gains.angle_wraparound else error

    @property
    def error_rate(self) -> float:
        """The same of the second interface; NaN: there is none."""
        if len(self.references) < _MOST_INTERFACES:
            return math.nan
        return self.references[1].value - self.exports[1].value

    def command(self, period: float, *, has_feedforward: bool) -> float | None:
        """Return the command; None: reference or measurement is missing. period: s."""
        error = self.error
        if not math.isfinite(error):
            return None
        rate = self.error_rate
        command = self.pid.compute(error, period, rate if math.isfinite(rate) else None)
        self.output = command
        reference = self.references[-1].value
        if has_feedforward and math.isfinite(reference):
            command += reference * self.gains.feedforward_gain
        return command

    def publish(self, time: int, period: int) -> None:
        """Publish what is inside of the PID."""
        pid, gains = self.pid, self.gains
        self.state.send(
            PidStateSample(
                stamp=time,
                time_step=period,
                error=pid.error,
                error_rate=pid.error_rate,
                p_error=pid.error,
                i_error=pid.integral / gains.i if gains.i else 0.0,
                d_error=pid.error_rate,
                p_term=gains.p * pid.error,
                i_term=pid.integral,
                d_term=gains.d * pid.error_rate,
                i_max=gains.i_clamp_max,
                i_min=gains.i_clamp_min,
                output=self.output,
            )
        )


class PidController(Controller):
    """Runs the PIDs at every update; see the module."""

    parameters_type = PidParameters
    is_chainable = True

    def __init__(self, context: ControllerContext) -> None:
        super().__init__(context)
        self._dofs: tuple[_Dof, ...] = ()
        self._handles: tuple[CommandInterface, ...] = ()
        self._states: tuple[StateInterface, ...] = ()

    # --- transitions -------------------------------------------------------------------------

    def configure(self, parameters: PidParameters) -> None:
        """Make the PIDs. Raises ControllerError: the parameters contradict each other."""
        names = parameters.dof_names
        state_names = parameters.reference_and_state_dof_names or names
        interfaces = parameters.reference_and_state_interfaces
        if len(names) != len(state_names):
            raise ControllerError(
                f"Size of 'dof_names' ({len(names)}) and 'reference_and_state_dof_names' "
                f'({len(state_names)}) parameters has to be the same!'
            )
        if len(interfaces) > _MOST_INTERFACES:
            raise ControllerError(
                "'reference_and_state_interfaces' may be one interface, and its derivative; found "
                f'{", ".join(interfaces)}'
            )
        self._parameters = parameters
        self._has_feedforward = parameters.enable_feedforward
        self._dofs = tuple(
            _Dof(name, state_name, parameters.gains[name], self.context.name)
            for name, state_name in zip(names, state_names, strict=True)
        )
        for dof in self._dofs:
            dof.export(interfaces)
            if dof.gains.feedforward_gain and not parameters.enable_feedforward:
                self.log(
                    Severity.WARN,
                    f"'gains.{dof.name}.feedforward_gain' has no effect: enable_feedforward is "
                    'false',
                )
        self._make_ports()
        self.log(Severity.INFO, 'configure successful')

    def command_interfaces(self) -> InterfaceRequest:
        """Return the command interface of each degree of freedom."""
        interface = self._parameters.command_interface
        return InterfaceRequest.individual(f'{dof.name}/{interface}' for dof in self._dofs)

    def state_interfaces(self) -> InterfaceRequest:
        """Return the first interface of each, then the second; none if measured by a topic."""
        if self._parameters.use_external_measured_states:
            return NO_INTERFACES
        return InterfaceRequest.individual(
            f'{dof.state_name}/{interface}'
            for interface in self._parameters.reference_and_state_interfaces
            for dof in self._dofs
        )

    def references(self) -> tuple[CommandInterface, ...]:
        """Return ``<dof>/<interface>``: the first interface of each, then the second."""
        return _by_interface([dof.references for dof in self._dofs])

    def exported_states(self) -> tuple[StateInterface, ...]:
        """Return what is measured, in the same order."""
        return _by_interface([dof.exports for dof in self._dofs])

    def inputs(self) -> tuple[Input[Any], ...]:
        """Return ``~/reference`` and, if asked for, ``~/measured_state``."""
        if self._parameters.use_external_measured_states:
            return self._reference, self._measured
        return (self._reference,)

    def outputs(self) -> tuple[Output[Any], ...]:
        """Return ``~/controller_state`` and, if asked for, ``~/<dof>/pid_state``."""
        watched = [dof.state for dof in self._dofs if dof.gains.activate_state_publisher]
        return (self._state, *watched)

    def services(self) -> tuple[Service[Any, Any], ...]:
        """Return ``~/set_feedforward_control``."""
        return (self._switch,)

    def activate(
        self, commands: Sequence[CommandInterface], states: Sequence[StateInterface], time: int
    ) -> None:
        """Take the interfaces. Raises ControllerError: some are missing."""
        self.command_interfaces().require_all(commands, 'command')
        self.state_interfaces().require_all(states, 'state')
        self._handles, self._states = tuple(commands), tuple(states)
        self._start_over()

    def deactivate(self, time: int) -> None:
        """Stop what would keep moving."""
        if self._parameters.command_interface in _RATES:
            for handle in self._handles:
                handle.value = 0.0
        self._handles = self._states = ()

    def reset(self, time: int) -> None:
        """Start from the present states: the simulation was reset."""
        for port in self.inputs():
            port.drain()
        self._start_over()

    def set_clock(self, time: int) -> None:
        """Do nothing: it has no stamps."""

    # --- the cycle ---------------------------------------------------------------------------

    def update(self, time: int, period: int) -> None:
        """Read, compute, write and publish."""
        self._measure()
        self._receive()
        if self._is_fresh and self._parameters.set_current_state_as_first_setpoint:
            self._hold()
        seconds = period / NANOSECONDS
        states = []
        for dof, handle in zip(self._dofs, self._handles, strict=True):
            command = dof.command(seconds, has_feedforward=self._has_feedforward)
            if command is not None:
                handle.value = command
                dof.publish(time, period)
            states.append(
                DofState(
                    name=dof.state_name,
                    reference=dof.references[0].value,
                    feedback=dof.exports[0].value,
                    feedback_rate=dof.exports[1].value if len(dof.exports) > 1 else 0.0,
                    error=dof.error,
                    error_rate=dof.error_rate if len(dof.exports) > 1 else 0.0,
                    time_step=seconds,
                    output=handle.value,
                )
            )
        self._state.send(DofStatesSample(time, tuple(states)))

    def _measure(self) -> None:
        if not self._parameters.use_external_measured_states:
            for export, state in zip(self.exported_states(), self._states, strict=True):
                export.value = state.value
            return
        for sample in self._measured.drain():
            if not self._fits(sample, needs_names=True):
                continue
            for index, dof in enumerate(self._dofs):
                dof.exports[0].value = sample.values[index]
                if len(dof.exports) > 1 and sample.rates:
                    dof.exports[1].value = sample.rates[index]

    def _receive(self) -> None:
        """Take references of the topic; in chained mode the preceding controller sets them."""
        samples = self._reference.drain()
        if self.is_chained:
            if samples:
                self.log(
                    Severity.WARN,
                    "Ignoring references on '~/reference': in chained mode the preceding "
                    'controller commands',
                    throttle=1.0,
                )
            return
        for sample in samples:
            if self._fits(sample, needs_names=False):
                self._refer(sample)

    def _refer(self, sample: DofCommandSample) -> None:
        names = [dof.state_name for dof in self._dofs]
        if not sample.names:
            self.log(
                Severity.WARN,
                'Reference massage does not have DoF names defined. Assuming that value have '
                'order as defined state DoFs',
                throttle=math.inf,
            )
        order = sample.names or tuple(names)
        for name in order:
            if name not in names:
                self.log(
                    Severity.WARN,
                    f"DoF name '{name}' not found in the defined list of state DoFs.",
                    throttle=1.0,
                )
                return
        for index, name in enumerate(order):
            references = self._dofs[names.index(name)].references
            values = (sample.values[index], *(sample.rates[index : index + 1]))
            for reference, value in zip(references, values, strict=False):
                if not math.isnan(value):
                    reference.value = value

    def _fits(self, sample: DofCommandSample, *, needs_names: bool) -> bool:
        """Return whether a message has a value for each degree of freedom; log why not."""
        count, names = len(self._dofs), len(sample.names)
        is_named = names == count or (names == 0 and not needs_names)
        if is_named and len(sample.values) == count and len(sample.rates) in (0, count):
            return True
        self.log(
            Severity.ERROR,
            f'Size of input data names ({names}), values ({len(sample.values)}) and/or values_dot '
            f'({len(sample.rates)}) is not matching the expected size ({count}).',
            throttle=1.0,
        )
        return False

    def _hold(self) -> None:
        """Refer to the present states, once they are known."""
        self._is_fresh = False
        for dof in self._dofs:
            if math.isnan(dof.references[0].value):
                for reference, state in zip(dof.references, dof.exports, strict=True):
                    reference.value = state.value
            self._is_fresh |= math.isnan(dof.references[0].value)

    def _start_over(self) -> None:
        self._is_fresh = True
        for dof in self._dofs:
            dof.pid.reset(keep_integral=dof.gains.save_i_term)
            for handle in (*dof.references, *dof.exports):
                handle.value = math.nan

    def _make_ports(self) -> None:
        self._reference: Input[DofCommandSample] = Input(
            Port('~/reference', _COMMAND, qos=_NEWEST, sample=DofCommandSample)
        )
        self._measured: Input[DofCommandSample] = Input(
            Port('~/measured_state', _COMMAND, qos=_NEWEST, sample=DofCommandSample)
        )
        self._state: Output[DofStatesSample] = Output(
            Port(
                '~/controller_state',
                'control_msgs/msg/MultiDOFStateStamped',
                sample=DofStatesSample,
            )
        )
        self._switch = Service(
            ServicePort(
                '~/set_feedforward_control',
                'std_srvs/srv/SetBool',
                SetBoolRequest,
                SetBoolResponse,
            ),
            self._set_feedforward,
        )

    def _set_feedforward(self, request: SetBoolRequest) -> SetBoolResponse:
        self._has_feedforward = request.is_on
        self.log(
            Severity.WARN,
            'This service will be deprecated in favour of setting the ``feedforward_gain`` '
            'parameter to a non-zero value.',
        )
        return SetBoolResponse(success=True)


def _by_interface(rows: Sequence[tuple[Handle, ...]]) -> tuple[Handle, ...]:
    """Return the first of each row, then the second."""
    return tuple(handle for column in zip(*rows, strict=True) for handle in column)


def _short_way(angle: float) -> float:
    """Return an angle in (−π, π]."""
    if not math.isfinite(angle):
        return angle
    wrapped = math.remainder(angle, 2.0 * math.pi)
    return math.pi if wrapped == -math.pi else wrapped
