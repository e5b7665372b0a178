# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``check_urdf --drop`` as a command: what it prints where, and its exit code."""

from fixtures.cli.commands import python
import pytest
from support.paths import ROOT

CART = (ROOT / 'test/fixtures/urdf_good/cart.urdf').read_text()


@pytest.mark.parametrize(
    ('axis', 'code', 'verdict'), [('0 0 1', 0, 'passed'), ('1 0 0', 1, 'failed')]
)
def test_a_robot_that_goes_sideways_fails_the_drop(tmp_path, axis, code, verdict):
    path = tmp_path / 'r.urdf'
    path.write_text(CART.replace('<axis xyz="0 0 1"/>', f'<axis xyz="{axis}"/>', 2))
    result = python('-m', 'amr_description.cli', 'check_urdf', str(path), '--drop')
    lines = result.stdout.splitlines()
    assert (result.returncode, lines[-1].strip()) == (code, verdict)
    assert any(line.startswith('    0.5 s forward: x') for line in lines), 'it was driven'
    assert any(line.startswith('    1 s turning left: yaw') for line in lines), 'and turned'
    words = 'error: dropped: it goes sideways: positive wheel speeds carry it by '
    assert [line.startswith(words) for line in result.stderr.splitlines()] == [True] * code
