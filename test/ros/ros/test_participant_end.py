# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Fast DDS waits for a callback of discovery without holding the mutex that it needs."""

import ctypes
import time

from amr_description.ros import participant_end
from amr_description.ros.participant_end import TIMEOUT
from amr_description.ros.runtime import ros


def test_the_wait_has_a_time_out_that_does_not_overflow():
    """Another Fast DDS that fails here either has mended it, which is issue 6513, or has moved."""
    with ros([]):
        library = ctypes.CDLL(participant_end._LIBRARY)
    code = ctypes.string_at(library[participant_end._SET_LISTENER], 10)
    assert code == participant_end._LOAD + TIMEOUT.to_bytes(8, 'little')
    assert (time.time() + TIMEOUT) * 1e9 < 2**63  # ns, as Fast DDS has it
