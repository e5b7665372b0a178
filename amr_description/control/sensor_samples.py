# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The samples that broadcasters of sensors, batteries and interfaces publish: plain values.

Stamps are integer nanoseconds; quaternions are (x, y, z, w); what is not known is NaN.
"""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class WrenchSample:
    """A geometry_msgs/WrenchStamped."""

    stamp: int
    frame_id: str
    force: tuple[float, ...]
    """N, along x, y, z of the frame."""
    torque: tuple[float, ...]
    """N·m, about x, y, z of the frame."""


@dataclass(frozen=True, slots=True)
class PoseSample:
    """A geometry_msgs/PoseStamped, or the same as a transform."""

    stamp: int
    frame_id: str
    child_frame_id: str
    """Of the transform: the frame that has this pose."""
    position: tuple[float, ...]
    """m."""
    orientation: tuple[float, ...]
    """(x, y, z, w)."""


@dataclass(frozen=True, slots=True)
class RangeConstants:
    """The constant part of a Range message."""

    frame_id: str
    radiation_type: int
    """0: ultrasound, 1: infrared."""
    field_of_view: float
    """rad."""
    min_range: float
    """m."""
    max_range: float
    """m."""
    variance: float
    """m²."""


@dataclass(frozen=True, slots=True)
class RangeSample:
    """A sensor_msgs/Range."""

    stamp: int
    range: float
    """m."""
    constants: RangeConstants


@dataclass(frozen=True, slots=True)
class NavSatFixSample:
    """A sensor_msgs/NavSatFix."""

    stamp: int
    frame_id: str
    status: int
    service: int
    latitude: float
    """Degrees, north is positive."""
    longitude: float
    """Degrees, east is positive."""
    altitude: float
    """m, above the ellipsoid."""
    position_covariance: tuple[float, ...]
    """m², 3 × 3 by rows: east, north, up."""
    position_covariance_type: int


@dataclass(frozen=True, slots=True)
class MagneticFieldSample:
    """A sensor_msgs/MagneticField."""

    stamp: int
    frame_id: str
    field: tuple[float, ...]
    """T, along x, y, z of the frame."""
    covariance: tuple[float, ...]
    """T², 3 × 3 by rows."""


@dataclass(frozen=True, slots=True)
class NamesSample:
    """A control_msgs/Keys: the names of values that another topic publishes."""

    stamp: int
    names: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class ValuesSample:
    """A control_msgs/Float64Values: values of any unit."""

    stamp: int
    values: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class BatterySample:
    """A sensor_msgs/BatteryState."""

    stamp: int
    frame_id: str
    voltage: float
    """V."""
    temperature: float
    """°C."""
    current: float
    """A, negative while discharging."""
    charge: float
    """A·h."""
    capacity: float
    """A·h."""
    design_capacity: float
    """A·h."""
    percentage: float
    power_supply_status: int
    power_supply_health: int
    power_supply_technology: int
    present: bool
    location: str
    serial_number: str


@dataclass(frozen=True, slots=True)
class BatteriesSample:
    """A control_msgs/BatteryStateArray."""

    batteries: tuple[BatterySample, ...]


@dataclass(frozen=True, slots=True)
class InterfaceGroup:
    """Interfaces of one GPIO, with their values."""

    name: str
    interfaces: tuple[str, ...]
    values: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class InterfaceGroupsSample:
    """A control_msgs/DynamicInterfaceGroupValues."""

    stamp: int
    groups: tuple[InterfaceGroup, ...]
