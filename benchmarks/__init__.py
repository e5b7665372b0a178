# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What scripts/bench runs; not installed."""
