# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Which class stands for a ``<plugin>`` in the simulator: nearly always the simulated one.

A description comes with the plugin of another simulator, of the mock, or of a driver in C++ that
exists on the robot alone. In each case its joints and sensors are those that are simulated. A
class in Python that can be imported is used as it is.
"""

from collections.abc import Callable
import re
from typing import TypeAlias

from amr_description.control.contracts import HardwareComponent
from amr_description.errors import HardwareError
from amr_description.hardware import HARDWARE
from amr_description.log import Log, Severity
from amr_description.model.hardware_info import HardwareInfo

SIMULATED = 'amr_description/MujocoSystem'
MOCKS = ('mock_components/GenericSystem', 'fake_components/GenericSystem')
_DRIVERS = ('amr_description/SerialBaseSystem',)
# Words in the package of a plugin; variants of these simulators are many.
_SIMULATORS = re.compile(
    '(^|_)(gz|ign|ignition|gazebo|mujoco|webots|isaac|topic_based|joint_state_topic)(_|$)'
)

HardwareClass: TypeAlias = Callable[..., HardwareComponent]


def class_in_simulator(
    info: HardwareInfo, log: Log, simulates_mocks: bool, name: str
) -> HardwareClass:
    """
    Return the class of a component in the simulator; one line says what is not used.

    Args:
        info: the component.
        log: of the component.
        simulates_mocks: mock hardware is simulated, too; False: it stays a mock.
        name: of its plugin.

    Raises:
        HardwareError: the plugin names a module of Python that cannot be imported.
    """
    package, *_ = re.split('/|::', name)
    if name in MOCKS:
        if not simulates_mocks:
            return _find(name)
        _log(info, log, Severity.INFO, 'is simulated; mock_hardware:=mock keeps the mock')
        return _find(SIMULATED)
    if name not in _DRIVERS:
        try:
            return _find(name)
        except HardwareError:
            if '.' in package:
                raise  # a module of Python: drivers in C++ have no dot in their names
    if name and not _SIMULATORS.search(package):
        text = 'drives real hardware and is not used here: its joints and sensors are simulated'
        _log(info, log, Severity.WARN, text)
    return _find(SIMULATED)


def _find(name: str) -> HardwareClass:
    found: HardwareClass = HARDWARE.find(name)
    return found


def _log(info: HardwareInfo, log: Log, severity: Severity, text: str) -> None:
    log(severity, f"hardware component '{info.name}': plugin '{info.plugin}' {text}")
