# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Of what a recorded run consists, as it is in a bag; the hashes of types."""

from dataclasses import replace

import pytest

from amr_description.bag.run_description import from_text, RunDescription, RunRobot
from amr_description.bag.type_hashes import type_hash
from amr_description.errors import BagError

RUN = RunDescription(
    {'world': 'ramp', 'seed': 3},
    ('controller_manager: {}',),
    (RunRobot('amr', '/', (0.1, 0.2, 1 / 3), (0.0, 0.0, 0.6, 0.8), '<robot name="ä"/>'),),
    ('/cmd_vel',),
)


@pytest.mark.parametrize('files', [(), ('controller_manager: {}',), ('a: {}', 'b: {}')])
def test_it_is_read_as_it_was_written(files):
    run = replace(RUN, controllers=files)
    assert from_text(run.to_text()) == run


@pytest.mark.parametrize('text', ['', '[]', '{}', RUN.to_text().replace('0.6, 0.8', '0.6')])
def test_what_is_none_is_refused(text):
    with pytest.raises(BagError, match=r'^/mujoco_sim/run: not the description of a run: '):
        from_text(text)


def test_hashes_are_those_of_the_installed_types():
    known = 'RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18'
    assert type_hash('std_msgs/msg/String') == known
    assert type_hash('no_msgs/msg/None') == ''
