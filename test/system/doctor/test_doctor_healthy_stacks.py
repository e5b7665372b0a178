# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Of a stack in good order the doctor finds nothing."""

import json
import os

from fixtures.bringup.running import Bringup
from fixtures.cli.commands import ros2
import pytest
from support.doctor_hosts import BUSY_MACHINE
from support.paths import ROOT

BUSY = {*BUSY_MACHINE, 'slow_simulation', 'navigation_contract'}
"""What is true of any stack on a machine that is too busy."""

SIMULATION = ('simulation', 'viewer:=false')
STACKS = {
    'mock': ('mock', 'viewer:=false'),
    'simulation': SIMULATION,
    'sensors': (*SIMULATION, 'sensors:=true', 'world:=warehouse'),
    'page': ('simulation',),
    'fleet': ('fleet', 'viewer:=false'),
    'navigation': ('navigation', 'viewer:=false'),
    'display': ('display', 'viewer:=false'),
    'rover': (
        *SIMULATION,
        f'urdf:={ROOT}/examples/rover/urdf/rover.urdf.xacro',
        f'controllers:={ROOT}/examples/rover/config/rover.yaml',
    ),
}
SHORT = {'sensors'}


@pytest.mark.parametrize(
    'arguments',
    [
        pytest.param(stack, id=name, marks=() if name in SHORT else pytest.mark.long)
        for name, stack in STACKS.items()
    ],
)
def test_nothing_is_found_where_nothing_is_wrong(tmp_path, arguments):
    path = os.environ['AMENT_PREFIX_PATH']
    with Bringup(tmp_path, *arguments, AMENT_PREFIX_PATH=path) as bringup:
        bringup.expect(r'\[launch\]: ready in')
        result = ros2('doctor', '--json')
        assert result.stdout, result.stderr
        found = json.loads(result.stdout)['findings']
        assert [each for each in found if each['rule'] not in BUSY] == []
