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


@pytest.mark.parametrize(
    ('words', 'code', 'said'),
    [
        (['nowhere.urdf'], 1, r'amr: cannot read the description "nowhere.urdf": No such file'),
        (['--world', 'nowhere'], 1, r"amr: world 'nowhere': neither a file nor a shipped world"),
        (['--port', '65536'], 2, r".*'65536' is no port; 0 to 65535 will do"),
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
