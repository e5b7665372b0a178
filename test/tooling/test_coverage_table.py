# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The table of scripts/coverage."""

import importlib.util

from support.paths import ROOT


def test_branches_are_counted_by_folder():
    file = ROOT / 'scripts' / 'environment' / 'coverage_table.py'
    spec = importlib.util.spec_from_file_location('coverage_table', file)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)

    def summary(branches, taken):
        counts = {'num_branches': branches, 'covered_branches': taken}
        return {'summary': counts | {'num_statements': 10, 'covered_lines': 9}}

    report = {
        'files': {
            'amr_description/clock.py': summary(0, 0),
            'amr_description/control/loop.py': summary(4, 3),
            'amr_description/control/ros/services.py': summary(6, 6),
            'amr_description/controllers/drives/odometry.py': summary(2, 1),
        }
    }
    assert module.table(report).splitlines()[2:] == [
        '| . | 0 |  | 90.0 % |',
        '| control | 4 | 75.0 % | 90.0 % |',
        '| control/ros | 6 | 100.0 % | 90.0 % |',
        '| controllers/drives | 2 | 50.0 % | 90.0 % |',
        '| all | 12 | 83.3 % | 90.0 % |',
    ]
    assert module.table(report, ['controllers']).splitlines()[2:] == [
        '| controllers/drives | 2 | 50.0 % | 90.0 % |',
        '| all | 2 | 50.0 % | 90.0 % |',
    ]
