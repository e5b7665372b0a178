# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``check_urdf --footprint``: the polygon of a robot on the ground, for costmaps of Nav2."""

from dataclasses import asdict
import json

from amr_description.model.footprint import Footprint


def footprint_yaml(found: Footprint) -> str:
    """Return the line of a parameter file of Nav2, and what is to be known of it as a comment."""
    warning = (
        ''
        if found.holds_origin
        else f'# {found.frame} is outside of the robot: costmaps turn it about there\n'
    )
    return (
        f'# in {found.frame}: inscribed radius {found.inscribed_radius:.3f} m, '
        f'circumscribed radius {found.circumscribed_radius:.3f} m\n'
        f'{warning}footprint: "{found.text}"'
    )


def footprint_json(found: Footprint) -> str:
    """Return the same as one JSON object; m."""
    values = asdict(found) | {
        'inscribed_radius': found.inscribed_radius,
        'circumscribed_radius': found.circumscribed_radius,
        'holds_origin': found.holds_origin,
    }
    return json.dumps(values, indent=2)
