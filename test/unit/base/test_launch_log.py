# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The warnings of a bring-up, read from its log; the log is written by its own console."""

from amr_description.launch_log import launch_warnings

LOG = """1795411302.9887798 [INFO] [launch]: All log files can be found below ~/.ros/log/x
1795411302.9892819 [WARNING] [launch]: the file was saved [twice]: look
1795411303.1429629 [INFO] [mujoco_sim-1]: process started with pid [18703]
[mujoco_sim-1] [ERROR] [1795411303.2] [mujoco_sim]: of a node, which has /rosout
1795411304.5 [ERROR] [spawner-4]: process has died [pid 1, exit code 1, cmd 'x'].
"""


def test_warnings_and_errors_of_the_bring_up_are_found(tmp_path):
    file = tmp_path / 'launch.log'
    file.write_text(LOG)
    found = [
        (each.stamp, each.is_error, each.source, each.text) for each in launch_warnings(str(file))
    ]
    assert found == [
        (1795411302.9892819, False, 'launch', 'the file was saved [twice]: look'),
        (1795411304.5, True, 'spawner-4', "process has died [pid 1, exit code 1, cmd 'x']."),
    ]


def test_no_file_is_no_warning(tmp_path):
    assert launch_warnings('') == launch_warnings(str(tmp_path / 'gone.log')) == []
