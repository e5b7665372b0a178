# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Rules on the content of mesh files that are found.

That a file is there is a rule on files (:mod:`amr_description.model.checks.markup`).
"""

from collections.abc import Iterator
import math

from amr_description.model.checks.context import CheckContext
from amr_description.model.checks.markup import TOUCHES_NOTHING
from amr_description.model.findings import Finding
from amr_description.model.mesh_uses import MeshUse
from amr_description.model.robot import Collision, Mesh, Visual
from amr_description.model.shapes import half_sizes
from amr_description.text import quote

# m; links of vehicles and arms are shorter, and few meshes in mm are below 10.
_LARGEST = 10.0
# How much longer than the other shapes of its link a mesh in mm is: 1000, give or take.
_FACTORS = (300.0, 3000.0)
# Convex parts that are put together by a designer stay below; beyond it the shape is another.
_LARGEST_HULL = 2.0


def meshes_can_be_read(context: CheckContext) -> Iterator[Finding]:
    """No mesh is empty or broken."""
    for use in context.meshes:
        if use.error:
            yield context.warning(
                use.part.line,
                f'{_name(use)} cannot be used',
                found=use.error,
                taken=TOUCHES_NOTHING if use.touches else '',
            )


def meshes_are_in_metres(context: CheckContext) -> Iterator[Finding]:
    """
    No mesh is a thousand times too large: its numbers are m, and CAD programs write mm.

    Too large is what is longer than 10 m, or 1000 times the other shapes of its link.
    """
    for use in context.meshes:
        if use.triangles is None:
            continue
        longest, other = max(use.triangles.size), _longest_of_others(use, context)
        times = longest / other if other else 0.0
        is_far_off = _FACTORS[0] <= times <= _FACTORS[1]
        if longest > _LARGEST or is_far_off:
            than = f', {times:.0f} times the other shapes of the link' if is_far_off else ''
            size = ' x '.join(f'{each:.3g}' for each in use.triangles.size)
            scale = ' '.join(f'{each * 0.001:g}' for each in use.mesh.scale)
            yield context.warning(
                use.part.line,
                f'{_name(use)} is very large',
                found=f'{size} m{than}',
                expected='the size in m',
                fix=f'if the file is in mm, write scale="{scale}"',
            )


def meshes_have_z_up(context: CheckContext) -> Iterator[Finding]:
    """No COLLADA file says that another axis than Z is up: RViz and Gazebo do not turn it."""
    for use in context.meshes:
        # Not at the top, in all three: what has no mesh need not wait for what reads them.
        from amr_description.model.meshes import declared_up_axis

        axis = declared_up_axis(use.path) if use.triangles is not None else None
        if axis is not None and axis != 'Z_UP':
            yield context.warning(
                use.part.line,
                f'{_name(use)} says that another axis than Z is up, which RViz and Gazebo ignore',
                found=f'<up_axis>{axis}</up_axis>',
                expected='Z_UP; the vertices are taken as they are',
                fix='export it with Z up; if it stands right in RViz, write Z_UP into the file',
            )


def collision_meshes_are_closed(context: CheckContext) -> Iterator[Finding]:
    """
    The mesh of a collision encloses a volume, of which mass and inertia can be had.

    It has no open edge.
    """
    for use in context.meshes:
        if not use.touches or use.triangles is None:
            continue
        from amr_description.model.mesh_solids import count_edges

        edges = count_edges(use.triangles)
        if edges.open:
            yield context.warning(
                use.part.line,
                f'{_name(use)} is not closed, so it has no volume, mass or inertia',
                found=f'{edges.open} of {edges.total} edges without two triangles that face the '
                'same way',
                expected='none',
                fix='close its holes, or use primitive shapes',
            )


def collision_meshes_fill_their_hull(context: CheckContext) -> Iterator[Finding]:
    """
    The mesh of a collision is about convex: MuJoCo, as most, lets its convex hull touch.

    The hull holds at most twice its volume.
    """
    for use in context.meshes:
        if not use.touches or use.triangles is None:
            continue
        from amr_description.model.mesh_solids import count_edges, hull_ratio

        if count_edges(use.triangles).open:
            continue
        ratio = hull_ratio(use.triangles)
        if ratio > _LARGEST_HULL:
            volume = f'{ratio:.1f} times its volume' if math.isfinite(ratio) else 'all there is'
            yield context.warning(
                use.part.line,
                f'{_name(use)} is hollow or bent: its convex hull, which touches in the '
                'simulator, holds more',
                found=volume,
                expected=f'at most {_LARGEST_HULL:g} times',
                fix='use several convex collisions, or primitive shapes',
            )


def _name(use: MeshUse) -> str:
    kind = 'collision' if use.touches else 'visual'
    return f'the mesh of a {kind} of link {quote(use.link.name)} ({quote(use.mesh.filename)})'


def _longest_of_others(use: MeshUse, context: CheckContext) -> float:
    """Return the longest edge of the boxes around the other shapes of the link, m; 0: none."""
    longest = [
        max(other.triangles.size)
        for other in context.meshes
        if other.link is use.link and other.mesh != use.mesh and other.triangles is not None
    ]
    parts: tuple[Visual | Collision, ...] = (*use.link.visuals, *use.link.collisions)
    for part in parts:
        if not isinstance(part.geometry, Mesh):
            longest.append(2.0 * max(half_sizes(part.geometry)))
    return max(longest, default=0.0)
