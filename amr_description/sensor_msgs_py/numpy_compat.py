# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Structured arrays as plain ones, and back: as NumPy has them since 1.17."""

from numpy.lib.recfunctions import structured_to_unstructured, unstructured_to_structured

__all__ = ['structured_to_unstructured', 'unstructured_to_structured']
