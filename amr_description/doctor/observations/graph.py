# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Nodes, topics, services and their types and QoS."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Graph:
    """Nodes, topics, services and their types and QoS."""
