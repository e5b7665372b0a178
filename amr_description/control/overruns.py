# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What is said of a cycle that takes longer than there is time for it."""

_MICROSECOND = 1000
"""ns."""


def overrun_text(expected: float, read: int, update: int, write: int) -> str:
    """Say how long the parts of a cycle took, ns, where ``expected`` µs are to be had."""
    total = (read + update + write) / _MICROSECOND
    return (
        f'Overrun might occur, Total time : {total:.3f} us (Expected < {expected:.3f} us) --> '
        f'Read time : {read / _MICROSECOND:.3f} us, Update time : {update / _MICROSECOND:.3f} us, '
        f'Write time : {write / _MICROSECOND:.3f} us'
    )
