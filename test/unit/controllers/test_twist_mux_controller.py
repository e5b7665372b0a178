# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""twist_mux_controller: the input of the highest priority that is fresh commands the drive."""

import math

import pytest
from support.control_fakes import FakeHardware, FakeLog, LEFT, make_manager, MS, RIGHT
from support.controller_bench import ControllerBench

from amr_description.control.contracts import ControllerContext
from amr_description.control.samples import TwistSample
from amr_description.control.switching import Strictness
from amr_description.controllers import CONTROLLERS
from amr_description.errors import ControllerError
from amr_description.parameters import build

MUX = 'twist_mux_controller/TwistMuxController'
INPUTS = {
    'cmd_vel_inputs.manual.priority': 100,
    'cmd_vel_inputs.manual.timeout': 0.2,
    'cmd_vel_inputs.autonomous.topic': '/nav/cmd_vel',
    'cmd_vel_inputs.autonomous.priority': 10,
}


class Bench(ControllerBench):
    """An active mux of two inputs."""

    def __init__(self, **values):
        super().__init__(MUX, **{**INPUTS, **values})
        self.activate()
        self.manual, self.autonomous = self.controller.inputs()

    def command(self, port, *twist, stamp=None):
        ahead, turn, *left = twist
        stamp = self.time if stamp is None else stamp
        port.put(TwistSample(stamp, ahead, turn, lateral=left[0] if left else 0.0))
        return self.update()


def test_its_topics_are_those_of_its_parameters_the_highest_priority_first():
    bench = Bench()
    assert [each.port.name for each in bench.controller.inputs()] == [
        'manual/cmd_vel',
        '/nav/cmd_vel',
    ]
    assert {each.port.message for each in bench.controller.inputs()} == {
        'geometry_msgs/msg/TwistStamped'
    }
    (source,) = bench.controller.outputs()
    assert (source.port.name, source.port.qos.durability) == ('~/source', 'transient_local')


def test_the_highest_priority_counts_until_it_is_old_and_then_the_next_and_then_none():
    bench = Bench()
    assert bench.update() == [0.0, 0.0]
    assert bench.command(bench.autonomous, 0.1, 0.2) == [0.1, 0.2]
    assert bench.command(bench.manual, 0.3, 0.4) == [0.3, 0.4]
    bench.autonomous.put(TwistSample(bench.time, 0.5, 0.6))
    assert bench.update(18) == [0.3, 0.4]  # 190 ms old
    assert bench.update() == [0.5, 0.6]  # 200 ms
    assert bench.update(40) == [0.0, 0.0]
    names = ['not_published', 'autonomous', 'manual', 'autonomous', 'not_published']
    assert bench.sent['~/source'] == names


def test_a_holonomic_drive_is_commanded_sideways_too():
    bench = Bench(holonomic=True, command_interface_linear_y='drive/linear/y/velocity')
    assert bench.command(bench.manual, 0.1, 0.2, 0.3) == [0.1, 0.3, 0.2]
    assert bench.controller.command_interfaces().names[1] == 'drive/linear/y/velocity'
    names = ['it/linear/x/velocity', 'it/linear/y/velocity', 'it/angular/z/velocity']
    assert [each.name for each in bench.controller.references()] == names


def test_what_is_not_finite_or_too_old_does_not_count():
    bench = Bench()
    bench.update(100)
    assert bench.command(bench.autonomous, 0.1, 0.2) == [0.1, 0.2]
    assert bench.command(bench.manual, math.nan, 0.0) == [0.1, 0.2]
    assert bench.command(bench.manual, 1.0, 0.0, stamp=MS) == [0.1, 0.2]


@pytest.mark.parametrize('ending', ['deactivate', 'reset', 'set_clock'])
def test_no_command_outlives_an_end(ending):
    bench = Bench()
    bench.command(bench.manual, 0.3, 0.4)
    bench.manual.put(TwistSample(bench.time, 0.5, 0.6))
    getattr(bench.controller, ending)(bench.time)
    if ending == 'deactivate':
        assert [each.value for each in bench.commands] == [0.0, 0.0]
        bench.activate()
    assert bench.update() == [0.0, 0.0]


def test_without_an_input_it_is_refused():
    with pytest.raises(ControllerError, match="'cmd_vel_inputs' is empty; it takes cmd_vel_"):
        ControllerBench(MUX)


def test_before_a_diff_drive_controller_it_drives_the_wheels():
    hardware = FakeHardware()
    manager = make_manager(hardware)
    sizes = {'wheel_separation': 0.3, 'wheel_radius': 0.1}
    references = {
        'command_interface_linear_x': 'drive/linear/velocity',
        'command_interface_angular_z': 'drive/angular/velocity',
    }
    for name, kind, values in (
        (
            'drive',
            'diff_drive_controller/DiffDriveController',
            {'left_wheel_names': LEFT, 'right_wheel_names': RIGHT, **sizes},
        ),
        ('mux', MUX, {**INPUTS, **references}),
    ):
        found = CONTROLLERS.find(kind)
        manager.load(found(ControllerContext(name, FakeLog())), kind)
        mux = manager.configure(name, build(found.parameters_type, values))
    manager.switch(['drive', 'mux'], [], Strictness.STRICT, 0)
    assert mux.inputs()[1].put(TwistSample(0, 0.5, 0.0))
    manager.tick(10 * MS)
    assert list(hardware.written.values()) == pytest.approx([0.5 / 0.1] * 4)
    manager.switch([], ['drive', 'mux'], Strictness.STRICT, 20 * MS)
    manager.tick(20 * MS)
    assert list(hardware.written.values()) == [0.0] * 4
