# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
battery_state_broadcaster/BatteryStateBroadcaster: batteries, each and all together.

``~/raw_battery_states`` has every battery as it is, ``~/battery_state`` what they are together:
means of voltage, temperature, current and percentage, sums of charge and capacities, the highest
status and health. Each has the state ``battery_voltage``, and those that ``interfaces`` enables. A
percentage that is not measured goes linearly from 0 at minimum_voltage to 100 at maximum_voltage.

With the deprecated ``sensor_name`` it is one battery of the state ``voltage``.
"""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
import math
from typing import Any

from amr_description.control.contracts import ControllerContext, Output, Port
from amr_description.control.sensor_samples import BatteriesSample, BatterySample
from amr_description.controllers.broadcasters.sensor_broadcaster import below, SensorBroadcaster
from amr_description.errors import ControllerError
from amr_description.log import Severity
from amr_description.parameters import keyed_group, parameter

_OPTIONAL = (
    'battery_temperature',
    'battery_current',
    'battery_charge',
    'battery_percentage',
    'battery_power_supply_status',
    'battery_power_supply_health',
    'battery_present',
)
_NAN: dict[str, Any] = {'nan': True, 'read_only': True}
_MOST_TECHNOLOGIES = 8


def _enabled(what: str) -> Any:
    return parameter(False, f'Read the {what} from the battery', read_only=True)


@dataclass(frozen=True)
class BatteryInterfaces:
    """Which states a battery has, besides its voltage."""

    battery_temperature: bool = _enabled('temperature (degrees Celsius)')
    battery_current: bool = _enabled('current (A)')
    battery_charge: bool = _enabled('charge (A h)')
    battery_percentage: bool = _enabled('percentage, 0 to 100')
    battery_power_supply_status: bool = _enabled('status')
    battery_power_supply_health: bool = _enabled('health')
    battery_present: bool = _enabled('presence')


@dataclass(frozen=True)
class BatteryProperties:
    """What is known of a battery without measuring."""

    minimum_voltage: float = parameter(math.nan, 'Empty, for the percentage', unit='V', **_NAN)
    maximum_voltage: float = parameter(math.nan, 'Full, for the percentage', unit='V', **_NAN)
    capacity: float = parameter(math.nan, 'When it was last full', unit='A h', **_NAN)
    design_capacity: float = parameter(math.nan, 'When it was new', unit='A h', **_NAN)
    power_supply_technology: int = parameter(
        0,
        'As in sensor_msgs/BatteryState',
        minimum=0,
        maximum=_MOST_TECHNOLOGIES,
        read_only=True,
    )
    location: str = parameter('', 'Slot or plug', read_only=True)
    serial_number: str = parameter('', 'Serial number', read_only=True)


@dataclass(frozen=True)
class BatteryParameters:
    """The table of battery_state_broadcaster/BatteryStateBroadcaster."""

    batteries: tuple[str, ...] = parameter(
        (), 'Batteries, as <ros2_control> names them', unique=True, read_only=True
    )
    sensor_name: str = parameter('', 'Deprecated: use batteries', read_only=True)
    design_capacity: float = parameter(math.nan, 'Deprecated: of sensor_name', unit='A h', **_NAN)
    power_supply_technology: int = parameter(
        0,
        'Deprecated: of sensor_name',
        minimum=0,
        maximum=_MOST_TECHNOLOGIES,
        read_only=True,
    )
    interfaces: Mapping[str, BatteryInterfaces] = keyed_group(
        'interfaces', 'batteries', BatteryInterfaces
    )
    properties: Mapping[str, BatteryProperties] = keyed_group('', 'batteries', BatteryProperties)


@dataclass(frozen=True, slots=True)
class _Battery:
    """One battery, and which states it has."""

    name: str
    interfaces: tuple[str, ...]
    properties: BatteryProperties

    def sample(self, time: int, values: Mapping[str, float]) -> BatterySample:
        """Return it as measured: values by interface."""
        known = self.properties
        voltage = values['battery_voltage']
        return BatterySample(
            stamp=time,
            frame_id=self.name,
            voltage=voltage,
            temperature=values.get('battery_temperature', math.nan),
            current=values.get('battery_current', math.nan),
            charge=values.get('battery_charge', math.nan),
            capacity=known.capacity,
            design_capacity=known.design_capacity,
            percentage=values.get('battery_percentage', self._percentage(voltage)),
            power_supply_status=_enumerated(values.get('battery_power_supply_status', 0.0)),
            power_supply_health=_enumerated(values.get('battery_power_supply_health', 0.0)),
            power_supply_technology=known.power_supply_technology,
            present=bool(values.get('battery_present', not math.isnan(voltage) and voltage)),
            location=known.location,
            serial_number=known.serial_number,
        )

    def _percentage(self, voltage: float) -> float:
        empty, full = self.properties.minimum_voltage, self.properties.maximum_voltage
        return (voltage - empty) * 100.0 / (full - empty)

    @property
    def has_percentage(self) -> bool:
        """Whether it is measured, or follows from the voltage."""
        known = self.properties
        return 'battery_percentage' in self.interfaces or not math.isnan(
            known.minimum_voltage + known.maximum_voltage
        )


class BatteryStateBroadcaster(SensorBroadcaster):
    """Publishes the batteries at every update."""

    parameters_type = BatteryParameters

    def __init__(self, context: ControllerContext) -> None:
        super().__init__(context)
        self._batteries: tuple[_Battery, ...] = ()

    def configure(self, parameters: BatteryParameters) -> None:
        """Determine batteries and interfaces. Raises ControllerError: none, or both ways."""
        self._batteries = tuple(self._read(parameters))
        voltage = 'voltage' if parameters.sensor_name else 'battery_voltage'
        self._state: Output[BatterySample] = Output(
            Port('~/battery_state', 'sensor_msgs/msg/BatteryState', sample=BatterySample)
        )
        self._raw: Output[BatteriesSample] = Output(
            Port(
                '~/raw_battery_states',
                'control_msgs/msg/BatteryStateArray',
                sample=BatteriesSample,
            )
        )
        self._read_from(
            (
                name
                for battery in self._batteries
                for name in below(battery.name, voltage, *battery.interfaces[1:])
            ),
            self._state,
            self._raw,
        )
        self.log(Severity.INFO, 'configure successful')

    def update(self, time: int, period: int) -> None:
        """Publish each, and all together."""
        values = iter(self._values())
        measured = [
            battery.sample(time, {name: next(values) for name in battery.interfaces})
            for battery in self._batteries
        ]
        self._raw.send(BatteriesSample(tuple(measured)))
        self._state.send(self._together(time, measured))

    def _read(self, parameters: BatteryParameters) -> Iterable[_Battery]:
        if parameters.sensor_name and parameters.batteries:
            raise ControllerError(
                "You cannot use both 'sensor_name' and 'batteries' parameters. Please use only "
                "'batteries' going forward."
            )
        if parameters.sensor_name:
            self.log(
                Severity.WARN,
                "The 'sensor_name' parameter is deprecated and will be removed in future "
                "releases. Please use 'batteries' parameter instead.",
            )
            old = BatteryProperties(
                design_capacity=parameters.design_capacity,
                power_supply_technology=parameters.power_supply_technology,
            )
            return [_Battery(parameters.sensor_name, ('battery_voltage',), old)]
        if not parameters.batteries:
            raise ControllerError("'batteries' parameter has to be specified.")
        return [
            _Battery(name, ('battery_voltage', *_chosen(parameters.interfaces[name])), known)
            for name, known in self._checked(parameters.properties)
        ]

    def _checked(
        self, properties: Mapping[str, BatteryProperties]
    ) -> Iterable[tuple[str, BatteryProperties]]:
        for name, known in properties.items():
            if known.minimum_voltage >= known.maximum_voltage:
                raise ControllerError(
                    f"battery '{name}': Maximum battery voltage level must be greater than minimum"
                    ' voltage level.'
                )
            yield name, known

    def _together(self, time: int, measured: list[BatterySample]) -> BatterySample:
        def mean(field: Callable[[BatterySample], float], among: Iterable[bool]) -> float:
            chosen = [field(s) for s, has in zip(measured, among, strict=True) if has]
            return sum(chosen) / len(chosen) if chosen else math.nan

        def having(interface: str) -> list[bool]:
            return [interface in battery.interfaces for battery in self._batteries]

        charges = [s.charge for s in measured if not math.isnan(s.charge)]
        technologies = {s.power_supply_technology for s in measured}
        return BatterySample(
            stamp=time,
            frame_id='',
            voltage=mean(lambda s: s.voltage, [True] * len(measured)),
            temperature=mean(lambda s: s.temperature, having('battery_temperature')),
            current=mean(lambda s: s.current, having('battery_current')),
            charge=sum(charges) if charges else math.nan,
            capacity=sum(s.capacity for s in measured),
            design_capacity=sum(s.design_capacity for s in measured),
            percentage=mean(
                lambda s: s.percentage, [battery.has_percentage for battery in self._batteries]
            ),
            power_supply_status=max(s.power_supply_status for s in measured),
            power_supply_health=max(s.power_supply_health for s in measured),
            power_supply_technology=technologies.pop() if len(technologies) == 1 else 0,
            present=True,
            location=', '.join(s.location for s in measured if s.location),
            serial_number=', '.join(s.serial_number for s in measured if s.serial_number),
        )


def _chosen(interfaces: BatteryInterfaces) -> tuple[str, ...]:
    return tuple(name for name in _OPTIONAL if getattr(interfaces, name))


def _enumerated(value: float) -> int:
    """Return a number of an enumeration; 0, unknown, for what is none."""
    return int(value) if 0 <= value <= 255 else 0
