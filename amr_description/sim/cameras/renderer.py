# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What a renderer is: pictures of the state of a world, from the pose of a camera."""

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np

from amr_description.model.frames import Transform
from amr_description.model.sensors import Camera
from amr_description.sim.state_copy import StateCopy

BACKGROUND = (178, 178, 178)
"""The colour of nothing in a world without a sky: Gazebo's."""


@dataclass(frozen=True, slots=True)
class Shot:
    """One picture that is to be made."""

    camera: Camera
    pose: Transform
    """From the sensor's axes (x forward, y to the left, z up) to the world."""
    body: str
    """The body of the model that carries the camera."""
    state: StateCopy
    with_color: bool
    with_depth: bool


@dataclass(frozen=True, slots=True)
class RenderedPicture:
    """
    What a camera sees.

    Attributes:
        color: (height, width, 3), uint8, red, green, blue; None: it was not asked for.
        depth: (height, width), float32, m along the optical axis; +inf: nothing, or too far,
            -inf: too near; NaN: the lens shows nothing there.
    """

    color: np.ndarray | None
    depth: np.ndarray | None


class Renderer(ABC):
    """Makes pictures; all calls on one thread."""

    @property
    @abstractmethod
    def name(self) -> str:
        """``rays`` or ``gl``."""

    @abstractmethod
    def render(self, shot: Shot) -> RenderedPicture:
        """Make one picture. Raises RenderingError: this renderer cannot."""

    def close(self) -> None:
        """Release contexts and buffers."""
