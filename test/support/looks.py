# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
How the page looked when somebody looked at it: recorded styles and small pictures of every tab.

The styles (``styles.json``) are those of ``page_audit.js``: by kinds of elements, independent of
fonts. The pictures are small, as fonts and browsers differ: they tell where things stand. Where
browser and fonts are those of the recording, little may differ; elsewhere more.

To look at the pictures of a run and record them: ``AMR_RECORD_LOOKS=1 python -m pytest
test/system/viewer/test_page_look.py``, then see ``build/tests/looks/`` and commit ``test/golden``.
"""

import json
import os

import numpy as np
import simplejpeg
from support.paths import ROOT

RECORDED = ROOT / 'test' / 'golden' / 'page'
SEEN = ROOT / 'build' / 'tests' / 'looks'
"""The pictures of this run; CI keeps them."""
IS_RECORDING = os.environ.get('AMR_RECORD_LOOKS') == '1'
SHRINK = 4
"""Pixels of a picture, each way, that become one of a recorded one."""
BLOCK = 4
"""Pixels of a recorded picture, each way, that are compared by their mean."""
DIFFERENT = 24
"""Of 255: means further apart are of different blocks."""
MOST_DIFFERENT = {True: 0.01, False: 0.15}
"""The share of blocks that may differ: with browser and fonts of the recording; with others."""
FEWEST_KNOWN = 0.9
"""The share of recorded kinds of elements that must still be there; else the record is old."""
AGAIN = 'if it is meant so, look at build/tests/looks/ and record it (support/looks.py)'


def compare_styles(form, kinds):
    """
    Return what looks different from what was recorded, a sentence each.

    Args:
        form: of the page.
        kinds: what ``auditPage.styles()`` found, of all tabs together.
    """
    file = RECORDED / 'styles.json'
    known = json.loads(file.read_text()) if file.exists() else {}
    if IS_RECORDING:
        known[form] = kinds
        RECORDED.mkdir(parents=True, exist_ok=True)
        file.write_text(json.dumps(known, indent=0, sort_keys=True) + '\n')
    before = known.get(form, {})
    there = {kind: looks for kind, looks in before.items() if kind in kinds}
    found = [
        f'{kind} was {look!r} and is {kinds[kind]}'
        for kind, looks in there.items()
        for look in set(looks) - set(kinds[kind])
    ]
    if len(there) < FEWEST_KNOWN * len(before) or not before:
        found.append(f'of {len(before)} kinds of elements {len(there)} are there: record again')
    return found


def compare_picture(name, jpeg, fonts):
    """
    Return the share of a picture that differs from the recorded one, and what may at most.

    Args:
        name: of the file.
        jpeg: the picture.
        fonts: what tells browser and fonts apart, as text.
    """
    SEEN.mkdir(parents=True, exist_ok=True)
    (SEEN / f'{name}.jpg').write_bytes(jpeg)
    small = means(simplejpeg.decode_jpeg(jpeg), SHRINK)
    file, about = RECORDED / f'{name}.jpg', RECORDED / 'fonts.json'
    if IS_RECORDING:
        RECORDED.mkdir(parents=True, exist_ok=True)
        about.write_text(json.dumps(fonts) + '\n')
        file.write_bytes(simplejpeg.encode_jpeg(small.astype(np.uint8), quality=85))
    if not file.exists():
        return 1.0, 0.0
    before = means(simplejpeg.decode_jpeg(file.read_bytes()), BLOCK)
    now = means(small, BLOCK)
    most = MOST_DIFFERENT[json.loads(about.read_text()) == fonts]
    if before.shape != now.shape:
        return 1.0, most
    return float((np.abs(before - now).max(axis=2) > DIFFERENT).mean()), most


def means(picture, size):
    """Return the means of the squares of ``size`` pixels; what is left over at the ends goes."""
    rows, columns, colours = picture.shape
    kept = picture[: rows - rows % size, : columns - columns % size]
    blocks = kept.reshape(rows // size, size, columns // size, size, colours)
    return blocks.astype(np.float32).mean(axis=(1, 3))
