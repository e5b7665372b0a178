#!/usr/bin/env bash
# Of a Gradescope autograder: what it wants, once. Choose an image with Python 3.11 or newer.
set -e
python3 -m pip install --break-system-packages 'amr-description[ros]' pytest
