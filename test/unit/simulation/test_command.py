# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``amr``, by ``python -m amr_description``: a robot on a page, and what it says of bad words."""

import re
import signal
import subprocess
import sys

import pytest
from support.running_programs import PATIENCE
from support.shown_page import ShownPage

from amr_description.simulation.command import main
from amr_description.simulation.in_process import Simulation

COMMAND = [sys.executable, '-m', 'amr_description']


def test_a_page_drives_the_robot_until_ctrl_c():
    words = [*COMMAND, '--port', '0', '--token', '--world', 'ramp']
    with subprocess.Popen(words, stdout=subprocess.PIPE, text=True) as program:
        try:
            said = program.stdout.readline()
            url = re.fullmatch(r'The page is at (\S+token=\S+); Ctrl-C ends it\n', said)[1]
            with ShownPage(url) as page:

                def has_driven():
                    page.say('drive', robot='/', linear=0.5, angular=0.0)
                    return page.truth()[0] > 0.1

                page.wait(has_driven)
            program.send_signal(signal.SIGINT)
            assert (program.wait(PATIENCE), program.stdout.read()) == (0, '')
        finally:
            program.kill()


XACRO = """
<robot name="box" xmlns:xacro="http://ros.org/wiki/xacro"><xacro:arg name="mass" default="0"/>
  <link name="base">
    <collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision>
    <inertial><mass value="$(arg mass)"/>
      <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial></link>
</robot>
"""


def test_arguments_of_xacro_and_a_fixed_root_reach_the_robot(tmp_path, monkeypatch):
    file, seen = tmp_path / 'box.urdf.xacro', []
    file.write_text(XACRO)

    def show(sim, **_):
        box = sim.world.robot('box')
        seen.append((box.description.root.name, sim.world.engine.model.body_subtreemass[0]))

    monkeypatch.setattr(Simulation, 'show', show)
    assert main([str(file), '--xacro-args', 'mass:=2.5', '--fixed']) == 0
    assert main([str(file), '--xacro-args', 'mass:=1.5']) == 0
    assert seen == [('world', 2.5), ('base', 1.5)]


@pytest.mark.parametrize(
    ('words', 'code', 'said'),
    [
        (['nowhere.urdf'], 1, r'amr: cannot read the description "nowhere.urdf": No such file'),
        (['--world', 'nowhere'], 1, r"amr: world 'nowhere': neither a file nor a shipped world"),
        (['--port', '65536'], 2, r".*'65536' is no port; 0 to 65535 will do"),
        (['a.urdf', '--xacro-args', "'"], 2, 'amr: xacro_args are "\'": No closing quotation'),
        (['--port', '-1'], 2, r".*'-1' is no port"),
        (['--help'], 0, ''),
    ],
)
def test_what_cannot_be_shown_is_said_in_a_line(words, code, said, capsys):
    try:
        given = main(words)
    except SystemExit as end:  # argparse's
        given = end.code
    *_, last = capsys.readouterr().err.splitlines() or ['']
    assert given == code
    assert re.match(said, last)
