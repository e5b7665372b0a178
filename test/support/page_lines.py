# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Lines of a page, run as they stand by a forked program: a tenth of what a shell costs."""

import shlex
import sys

from support import preloaded
from support.paths import ROOT
from support.running_programs import PATIENCE
from support.shells import line_of


def command(page, beginning):
    """The words of the line of a page, for Python."""
    line = line_of(page.text, beginning).replace('\\\n', ' ')
    program, *words = shlex.split(line, comments=True)
    return [sys.executable, '-m', 'amr_description.cli', program, *words]


def typed(page, beginning, folder=ROOT, code=0, **options):
    """Run the line of a page that begins so; return what it printed."""
    words = command(page, beginning)
    done = preloaded.run(words, timeout=PATIENCE, cwd=folder, **options)
    assert done.returncode == code, done.stdout + done.stderr
    return done.stdout
