# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What is drawn: the shapes of a world, and of what others draw the parts of a head."""

from dataclasses import dataclass
from typing import Literal, TypeAlias

from amr_description.model.frames import Quaternion, Vector

Colour: TypeAlias = tuple[float, float, float, float]
"""Red, green, blue, alpha in 0..1."""


@dataclass(frozen=True, slots=True)
class Shape:
    """A static shape of the world."""

    name: str
    kind: Literal['box', 'sphere', 'cylinder', 'capsule', 'plane', 'triangles']
    size: Vector  #: whole extents along x, y, z; a plane's are 0 where it has no end
    position: Vector
    orientation: Quaternion
    colour: Colour
    points: tuple[float, ...] = ()  #: of 'triangles' only: x, y, z of three corners a triangle


@dataclass(frozen=True, slots=True)
class MarkBatch:
    """
    Marks of one kind in one frame, f32, m.

    Of shapes and meshes: x, y, z, quaternion, scale along x, y, z, r, g, b. Of lines: two ends,
    then r, g, b of each. Of points and corners of triangles: x, y, z, r, g, b. Colours are sRGB.
    """

    #: 'cone': of height 1 from its base up, diameter 1; all others about their middle
    kind: Literal['box', 'sphere', 'cylinder', 'cone', 'mesh', 'lines', 'points', 'triangles']
    frame: str  #: of TF
    stamp: float | None  #: s, when it was where it is; ``None``: it goes with its frame
    count: int  #: of shapes, lines, points, corners
    opacity: float  #: 0..1
    size: float  #: m, the width of lines and points; 0: two pixels
    resource: str  #: of a mesh: its name
    address: str  #: … where the page fetches it: "/mesh/3f2a….stl"
    is_tinted: bool  #: … whether its own colours do not count


@dataclass(frozen=True, slots=True)
class MarkText:
    """A text that faces the viewer."""

    text: str
    frame: str
    stamp: float | None
    position: Vector
    height: float  #: m, of a letter
    colour: Colour
