"""Exercise 4: a controller of ros2_control."""

import math

from conftest import expect
import pytest

from amr_description.control.contracts import ControllerContext
from amr_description.control.controller_manager import ControllerManager
from amr_description.control.resource_manager import ResourceManager
from amr_description.control.switching import Strictness
from amr_description.hardware import HARDWARE
from amr_description.model import ros2_control_tag, urdf
from amr_description.parameters import build

PERIOD = 10_000_000  # ns
ROBOT = """
<robot name="lever">
  <link name="base"/><link name="arm"/>
  <joint name="hinge" type="continuous"><parent link="base"/><child link="arm"/></joint>
  <ros2_control name="lever" type="system">
    <hardware><plugin>mock_components/GenericSystem</plugin></hardware>
    <joint name="hinge"><command_interface name="velocity"/></joint>
  </ros2_control>
</robot>
"""


class Lever:
    """A joint of mock hardware, and the controller of the student."""

    def __init__(self, module):
        resources = ResourceManager(lambda *_args, **_options: None)
        for info in ros2_control_tag.hardware_of(urdf.parse(ROBOT)):
            resources.load(info, HARDWARE.find, None)
        resources.start_components()
        self._manager = ControllerManager(resources, 100, lambda *_args, **_options: None)
        context = ControllerContext('lever', lambda *_args, **_options: None)
        self._controller = module.SpeedController(context)
        self._manager.load(self._controller, 'speed_controller/SpeedController')
        self._manager.configure('lever', build(module.SpeedParameters, {'joint': 'hinge'}))
        self._manager.switch(['lever'], [], Strictness.STRICT, time=0)
        self._command = resources.available_commands()['hinge/velocity']
        self._tick = 0

    def speeds(self, command, cycles):
        """Send a command, and return the speed of the joint after each cycle, rad/s."""
        self._controller.inputs()[0].put(command)
        return [self._after_a_cycle() for _ in range(cycles)]

    def _after_a_cycle(self):
        self._tick += 1
        self._manager.tick(self._tick * PERIOD)
        return self._command.value

    def switched_off(self):
        """Return the speed that its last words leave, rad/s; the manager would brake, too."""
        self._controller.deactivate(self._tick * PERIOD)
        return self._command.value


@pytest.fixture
def lever(submitted):
    return Lever(submitted('speed_controller'))


@pytest.mark.points(5)
def test_gently(lever):
    """The speed changes no faster than allowed."""
    speeds = lever.speeds(0.5, 40)
    expect(max(speeds) > 0.0, 'the joint stands: write self._speed.value')
    fastest = max(b - a for a, b in zip([0.0, *speeds], speeds, strict=False)) * 100.0
    expect(fastest < 2.001, f'the speed changes by {fastest:.0f} rad/s²; 2 rad/s² are allowed')
    expect(abs(speeds[-1] - 0.5) < 0.01, f'told 0.5 rad/s it turns at {speeds[-1]:.2f} rad/s')


@pytest.mark.points(4)
def test_timeout(lever):
    """Without commands it brakes."""
    speeds = lever.speeds(0.5, 120)
    said = f'0.7 s after the last command it still turns at {speeds[-1]:.2f} rad/s'
    expect(abs(speeds[-1]) < 0.01, f'{said}; after 0.5 s it is to brake')
    expect(speeds[48] > 0.4, 'it brakes before 0.5 s have passed')
    rates = [a - b for a, b in zip(speeds, speeds[1:], strict=False)]
    expect(max(rates) < 0.021, 'it brakes at once; it is to brake as gently as it starts')


@pytest.mark.points(3)
def test_nonsense(lever):
    """A command that is no number changes nothing."""
    lever.speeds(0.5, 30)
    (speed,) = lever.speeds(math.nan, 1)
    expect(abs(speed - 0.5) < 0.03, f'after a command of NaN the speed is {speed}: math.isfinite')


@pytest.mark.points(3)
def test_off(lever):
    """Switched off, it leaves a joint that stands."""
    lever.speeds(0.5, 30)
    left = lever.switched_off()
    expect(
        left == 0.0, f'switched off it leaves {left:.2f} rad/s: deactivate() is the last to write'
    )
