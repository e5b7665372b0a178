# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Use `wtf` as alias to `doctor`."""

from amr_description.cli.doctor import add_arguments, main, VERBS

__all__ = ['VERBS', 'add_arguments', 'main']
