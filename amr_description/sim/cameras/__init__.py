# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Pictures of the simulated world, in colour and depth, as cameras see it.

=========================== =======================================================================
``simulated_camera.py``     a camera on a robot: pictures with noise, points
``renderer.py``             what a renderer is asked for, and what it gives
``ray_renderer.py``         one that casts a ray for each pixel, on the processor
``gl_renderer.py``          one that draws by OpenGL
``choice.py``               which of the two
``ray_caster.py``           where the rays of a camera end
``screen.py``               … these rays, as a grid
``shading.py``              the colours of what rays hit: light
``pictures.py``             what messages are made of them: noise, JPEGs, clouds of points
``lens.py``                 where a point is in the picture, and where a pixel looks: K, distortion
=========================== =======================================================================
"""

CHOICES = ('auto', 'gl', 'rays')
"""Which renderer may be asked for; the first one: whichever works."""
