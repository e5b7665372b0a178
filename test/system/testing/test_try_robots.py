# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``try_robots``: our robot comes through all stages; one that does not is a row all the same."""

import json
import shutil
import sys

from support.paths import ROOT
from support.running_programs import Program


def test_a_robot_that_is_fine_and_one_that_is_refused(tmp_path):
    robots = tmp_path / 'robots'
    robots.mkdir()
    shutil.copy(ROOT / 'urdf' / 'amr.urdf', robots)
    shutil.copy(ROOT / 'config' / 'controllers.yaml', robots / 'amr.yaml')
    (robots / 'bad.urdf').write_text('<robot name="bad"><link name="@LINK@"/></robot')
    report = tmp_path / 'report.json'
    options = ['--jobs', '2', '--json', str(report), '--replace', '@LINK@=base']
    module = 'amr_description.testing.trial'
    with Program(sys.executable, '-m', module, str(robots), *options) as program:
        assert program.end() == 1
    good, bad = json.loads(report.read_text())
    assert (good['stage'], good['faults']) == ('done', [])
    assert [each['state'] for each in good['controllers']] == ['active', 'active']
    assert [each['what'] for each in good['motions']] == ['forward', 'turn']
    assert all(abs(each['truth'] / each['asked'] - 1) < 0.02 for each in good['motions'])
    assert good['rest']['seconds'] < 1.0
    assert bad['spawn_seconds'] is None
    assert bad['faults'][0].startswith('spawn: ')
    assert '2 tried: 1 moved as told; 0 moved, off; 1 did not move' in program.output
