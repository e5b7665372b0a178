# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Which renderer makes the pictures: OpenGL where it works, else rays.

OpenGL is the first choice also where Mesa draws on the processor (llvmpipe). Processor time of a
picture of 320 x 240 in the world ``warehouse``, ms:

=====================  ======  =====
..                     OpenGL  rays
=====================  ======  =====
colours and depth      6       21
… with shadows         23      41
depth                  4       7
=====================  ======  =====

and meshes cost rays far more. What rays have instead is said there
(:mod:`amr_description.sim.cameras.ray_renderer`).
"""

from collections.abc import Callable

from amr_description.errors import RenderingError
from amr_description.log import Log, Severity
from amr_description.sim.cameras.gl_renderer import GlRenderer
from amr_description.sim.cameras.ray_renderer import RayRenderer
from amr_description.sim.cameras.renderer import RenderedPicture, Renderer, Shot


class ChosenRenderer(Renderer):
    """
    The renderer that was asked for, or rays.

    It is made with the first picture, on the thread that renders.
    """

    def __init__(
        self, choice: str, log: Log, make_gl: Callable[[], GlRenderer] = GlRenderer
    ) -> None:
        """
        Choose later.

        Args:
            choice: One of :data:`~amr_description.sim.cameras.CHOICES`.
            log: Gets a line when it is made, and one when OpenGL fails.
            make_gl: Raises RenderingError where there is no OpenGL.
        """
        self._choice, self._log, self._make_gl = choice, log, make_gl
        self._renderer: Renderer | None = None

    @property
    def name(self) -> str:
        """That of the renderer."""
        return self._choice if self._renderer is None else self._renderer.name

    def render(self, shot: Shot) -> RenderedPicture:
        """Make one picture; by rays from now on, if OpenGL fails."""
        if self._renderer is None:
            self._renderer = self._make()
        if self._renderer.name == RayRenderer.name:
            return self._renderer.render(shot)
        try:
            return self._renderer.render(shot)
        except RenderingError as error:
            self._log(Severity.WARN, f'{error}; pictures of cameras are made by rays from now on')
            self._renderer.close()
            self._renderer = RayRenderer()
            return self._renderer.render(shot)

    def close(self) -> None:
        """Let go of everything; on the thread that renders."""
        if self._renderer is not None:
            self._renderer.close()
            self._renderer = None

    def _make(self) -> Renderer:
        """Return the renderer that works here, and say which."""
        asked = f'camera_renderer:={self._choice}'
        if self._choice == RayRenderer.name:
            self._log(Severity.INFO, f'Pictures of cameras are made by rays: {asked}')
            return RayRenderer()
        try:
            renderer = self._make_gl()
        except RenderingError as error:
            is_wish = self._choice == GlRenderer.name
            self._log(
                Severity.WARN if is_wish else Severity.INFO,
                f'Pictures of cameras are made by rays: {asked}, but OpenGL does not work here: '
                f'{error}',
            )
            return RayRenderer()
        self._log(
            Severity.INFO,
            f'Pictures of cameras are made by OpenGL: {asked}, {renderer.description}',
        )
        return renderer
