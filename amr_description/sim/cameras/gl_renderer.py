# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Pictures by MuJoCo's own renderer, in OpenGL: a graphics card, or Mesa on the processor.

The projection is exactly the matrix K of the camera. A lens is applied to the picture of a pinhole
that sees all that the lens shows. As in Gazebo, what is nearer than the near plane is cut away.
"""

from abc import ABC, abstractmethod
import copy
import ctypes
from ctypes import byref, c_char_p, c_int, c_uint, c_void_p
from dataclasses import dataclass
import os
import re

import mujoco
import numpy as np

from amr_description.errors import RenderingError
from amr_description.model.frames import matrix_from_quaternion
from amr_description.model.sensors import Camera, Intrinsics
from amr_description.sim.cameras.lens import intrinsics_of, pixel_directions
from amr_description.sim.cameras.renderer import BACKGROUND, RenderedPicture, Renderer, Shot
from amr_description.sim.rays import RayScene
from amr_description.sim.state_copy import CopiedPoses

# --- OpenGL without a window ---------------------------------------------------------------------
#
# No Python package has these libraries, and none is needed to call them. EGL reaches the drivers
# of graphics cards and, by Mesa's llvmpipe, the processor; OSMesa is an older way to the latter.

_EGL_LIBRARIES = ('libEGL.so.1',)
_OSMESA_LIBRARIES = ('libOSMesa.so.8', 'libOSMesa.so.6')
_MOST_DEVICES = 16
_GL_RENDERER = 0x1F01

# Of EGL/egl.h and EGL/eglext.h.
_PLATFORM_DEVICE = 0x313F
_PLATFORM_SURFACELESS = 0x31DD
_OPENGL_API = 0x30A2
_OPENGL_BIT = 0x0008
_ATTRIBUTES = (
    0x3024, 8,  # EGL_RED_SIZE
    0x3023, 8,  # EGL_GREEN_SIZE
    0x3022, 8,  # EGL_BLUE_SIZE
    0x3021, 8,  # EGL_ALPHA_SIZE
    0x3025, 24,  # EGL_DEPTH_SIZE
    0x3026, 8,  # EGL_STENCIL_SIZE
    0x3033, 1,  # EGL_SURFACE_TYPE: EGL_PBUFFER_BIT
    0x3040, _OPENGL_BIT,  # EGL_RENDERABLE_TYPE
    0x3038,  # EGL_NONE
)  # fmt: skip
# Of GL/osmesa.h.
_OSMESA_RGBA = 0x1908
_UNSIGNED_BYTE = 0x1401


class GlContext(ABC):
    """An OpenGL context of the thread that makes it."""

    library: str
    """``EGL`` or ``OSMesa``."""

    @abstractmethod
    def function(self, name: str) -> int:
        """Return the address of a function of OpenGL; 0: there is none."""

    @abstractmethod
    def close(self) -> None:
        """Let go of it; on the thread that made it."""

    def renderer(self) -> str:
        """Return what draws, in the words of the driver, such as ``llvmpipe (LLVM 15.0.6)``."""
        address = self.function('glGetString')
        if not address:
            raise RenderingError('OpenGL has no glGetString')
        text: bytes | None = ctypes.CFUNCTYPE(c_char_p, c_uint)(address)(_GL_RENDERER)
        if text is None:
            raise RenderingError('OpenGL does not say what draws')
        return text.decode(errors='replace')


def create_context() -> GlContext:
    """
    Make a context, of EGL or else of OSMesa, current on this thread.

    Raises:
        RenderingError: There is neither; it says what is lacking.
    """
    reasons = []
    for kind in (_EglContext, _OsMesaContext):
        try:
            return kind()
        except RenderingError as error:
            reasons.append(str(error))
    raise RenderingError('; '.join(reasons))


class _EglContext(GlContext):
    library = 'EGL'

    def __init__(self) -> None:
        self._egl = _load(_EGL_LIBRARIES)
        self._declare()
        failures = []
        for display in self._displays():
            try:
                self._display, self._context = display, self._create(display)
            except RenderingError as error:
                failures.append(str(error))
            else:
                return
        raise RenderingError(failures[0] if failures else 'EGL has no device and no display')

    def function(self, name: str) -> int:
        return self._egl.eglGetProcAddress(name.encode()) or 0

    def close(self) -> None:
        self._egl.eglMakeCurrent(self._display, None, None, None)
        self._egl.eglDestroyContext(self._display, self._context)
        self._egl.eglReleaseThread()

    def _declare(self) -> None:
        for name, result, arguments in (
            ('eglGetProcAddress', c_void_p, (c_char_p,)),
            ('eglGetDisplay', c_void_p, (c_void_p,)),
            ('eglInitialize', c_uint, (c_void_p, c_void_p, c_void_p)),
            ('eglChooseConfig', c_uint, (c_void_p, c_void_p, c_void_p, c_int, c_void_p)),
            ('eglBindAPI', c_uint, (c_uint,)),
            ('eglCreateContext', c_void_p, (c_void_p, c_void_p, c_void_p, c_void_p)),
            ('eglDestroyContext', c_uint, (c_void_p, c_void_p)),
            ('eglMakeCurrent', c_uint, (c_void_p, c_void_p, c_void_p, c_void_p)),
            ('eglReleaseThread', c_uint, ()),
        ):
            function = getattr(self._egl, name)
            function.restype, function.argtypes = result, arguments

    def _displays(self) -> list[int]:
        """Return the displays of all devices, in EGL's order, and those without one."""
        found = []
        query, of_platform = (
            self.function(name) for name in ('eglQueryDevicesEXT', 'eglGetPlatformDisplayEXT')
        )
        if of_platform:
            get = ctypes.CFUNCTYPE(c_void_p, c_uint, c_void_p, c_void_p)(of_platform)
            if query:
                devices, count = (c_void_p * _MOST_DEVICES)(), c_int()
                ask = ctypes.CFUNCTYPE(c_uint, c_int, c_void_p, c_void_p)(query)
                if ask(_MOST_DEVICES, devices, byref(count)):
                    chosen = os.environ.get('MUJOCO_EGL_DEVICE_ID', '')
                    at = [int(chosen)] if chosen.isdecimal() else range(count.value)
                    found += [
                        get(_PLATFORM_DEVICE, devices[i], None) for i in at if i < count.value
                    ]
            found.append(get(_PLATFORM_SURFACELESS, None, None))
        found.append(self._egl.eglGetDisplay(None))
        return [display for display in found if display]

    def _create(self, display: int) -> int:
        """Return a context that is current on this thread."""
        egl = self._egl
        if not egl.eglInitialize(display, None, None):
            raise RenderingError('EGL cannot be initialized')
        config, count = c_void_p(), c_int()
        wanted = (c_int * len(_ATTRIBUTES))(*_ATTRIBUTES)
        egl.eglChooseConfig(display, wanted, byref(config), 1, byref(count))
        if count.value < 1 or not egl.eglBindAPI(_OPENGL_API):
            raise RenderingError('EGL has no desktop OpenGL')
        context: int | None = egl.eglCreateContext(display, config, None, None)
        if not context:
            raise RenderingError('EGL makes no OpenGL context')
        if not egl.eglMakeCurrent(display, None, None, context):
            egl.eglDestroyContext(display, context)
            raise RenderingError('EGL cannot draw without a surface')
        return context


class _OsMesaContext(GlContext):
    library = 'OSMesa'

    def __init__(self) -> None:
        self._osmesa = osmesa = _load(_OSMESA_LIBRARIES)
        osmesa.OSMesaCreateContextExt.restype = c_void_p
        osmesa.OSMesaCreateContextExt.argtypes = (c_uint, c_int, c_int, c_int, c_void_p)
        osmesa.OSMesaMakeCurrent.restype = ctypes.c_ubyte
        osmesa.OSMesaMakeCurrent.argtypes = (c_void_p, c_void_p, c_uint, c_int, c_int)
        osmesa.OSMesaDestroyContext.argtypes = (c_void_p,)
        osmesa.OSMesaDestroyContext.restype = None
        osmesa.OSMesaGetProcAddress.restype = c_void_p
        osmesa.OSMesaGetProcAddress.argtypes = (c_char_p,)
        self._context = osmesa.OSMesaCreateContextExt(_OSMESA_RGBA, 24, 8, 0, None)
        if not self._context:
            raise RenderingError('OSMesa makes no OpenGL context')
        # It wants a picture to draw into; ours are drawn into framebuffer objects.
        self._picture = (ctypes.c_ubyte * 4)()
        if not osmesa.OSMesaMakeCurrent(self._context, self._picture, _UNSIGNED_BYTE, 1, 1):
            osmesa.OSMesaDestroyContext(self._context)
            raise RenderingError('OSMesa cannot draw into memory')

    def function(self, name: str) -> int:
        return self._osmesa.OSMesaGetProcAddress(name.encode()) or 0

    def close(self) -> None:
        self._osmesa.OSMesaDestroyContext(self._context)


def _load(names: tuple[str, ...]) -> ctypes.CDLL:
    """Load a library, so that MuJoCo finds its functions too. Raises RenderingError."""
    for name in names:
        try:
            return ctypes.CDLL(name, mode=ctypes.RTLD_GLOBAL)
        except OSError:
            continue
    raise RenderingError(f'{names[0]} is not on this machine')


_SKYBOX = int(mujoco.mjtTexture.mjTEXTURE_SKYBOX)
_SPARE_GEOMS = 100
_LARGEST = 4096
"""Pixels, of a side of the pinhole's picture for a lens; beyond that it is coarser."""
_BY_PROCESSOR = re.compile('llvmpipe|softpipe|swrast')
_SHADOWS_BY_PROCESSOR = 1024
"""Pixels of a side of its map of shadows: MuJoCo's 4096 take 60 ms of the processor, this 17."""
_NEAREST, _FARTHEST = 1e-3, 1e5
"""m."""
_SEEN, _UNSEEN = 0, 5
"""Geom groups."""
_FLAGS = mujoco.mjtRndFlag
_OF_COLOR = (_FLAGS.mjRND_SHADOW, _FLAGS.mjRND_SKYBOX, _FLAGS.mjRND_REFLECTION)
_NEVER = (_FLAGS.mjRND_FOG, _FLAGS.mjRND_HAZE)
_AS_IDS = (_FLAGS.mjRND_SEGMENT, _FLAGS.mjRND_IDCOLOR)
"""Without light and textures: for depth alone."""


@dataclass(frozen=True, slots=True)
class _View:
    """
    The pinhole whose picture is rendered for a camera.

    ``source``: (height, width) of the camera, the flat index of the pixel there that each one
    shows, -1: none; None: the pictures are the same.
    """

    width: int
    height: int
    k: Intrinsics
    source: np.ndarray | None


class GlRenderer(Renderer):
    """See the module."""

    name: str = 'gl'

    def __init__(self) -> None:
        """
        Make a context on this thread.

        Raises:
            RenderingError: There is no OpenGL that works.
        """
        self._context: GlContext | None = create_context()
        self.description = f'{self._context.renderer()}, by {self._context.library}'
        """What draws."""
        self._poses = CopiedPoses()
        self._views: dict[Camera, _View] = {}
        self._size = (0, 0)
        self._bound: mujoco.MjModel | None = None
        self._model: mujoco.MjModel | None = None
        self._mjr: mujoco.MjrContext | None = None

    def render(self, shot: Shot) -> RenderedPicture:
        """Make one picture. Raises RenderingError."""
        view = self._view_of(shot.camera)
        data = self._poses.data(shot.state)
        try:
            scene = self._bind(shot, view, data)
            camera = shot.camera
            color = depth = None
            clip = _ends(camera.near, camera.far)
            if shot.with_color:
                color, depth = self._draw(scene, shot, view, *clip)
            if shot.with_depth:
                ends = _ends(camera.depth_near, camera.depth_far)
                if depth is None or ends != clip:
                    _, depth = self._draw(scene, shot, view, *ends, with_color=False)
                depth[depth >= ends[1]] = np.inf
        except mujoco.FatalError as error:
            raise RenderingError(f'OpenGL fails: {error}') from error
        return RenderedPicture(
            None if color is None else _through_lens(color, view, 0),
            _through_lens(depth, view, np.nan) if shot.with_depth and depth is not None else None,
        )

    def close(self) -> None:
        """Let go of the context; on the thread that made it."""
        if self._mjr is not None:
            self._mjr.free()
            self._mjr = None
        if self._context is not None:
            self._context.close()
            self._context = None

    def _view_of(self, camera: Camera) -> _View:
        view = self._views.get(camera)
        if view is None:
            view = self._views[camera] = _view_of(camera)
        return view

    def _bind(self, shot: Shot, view: _View, data: mujoco.MjData) -> mujoco.MjvScene:
        """Return the scene as it is now."""
        width, height = max(self._size[0], view.width), max(self._size[1], view.height)
        if self._bound is not shot.state.model or self._size != (width, height):
            self._load(shot, data, (width, height))
        model = self._model
        assert model is not None
        # An infinite plane is drawn as far as the model's own far plane.
        _, far = _ends(0.0, max(shot.camera.far, shot.camera.depth_far))
        model.vis.map.zfar = max(model.vis.map.zfar, 2.0 * far / model.stat.extent)
        camera = mujoco.MjvCamera()
        mujoco.mjv_updateScene(model, data, self._option, None, camera, self._shown, self._scene)
        return self._scene

    def _load(self, shot: Shot, data: mujoco.MjData, size: tuple[int, int]) -> None:
        """Load the meshes and textures of a model."""
        # One of our own: others measure by that of the copy.
        model = copy.copy(shot.state.model)
        seen = RayScene(model, data, sorted(shot.state.robots)).all_seen
        model.geom_group[:] = np.where(seen == 0, _SEEN, _UNSEEN)
        model.vis.global_.offwidth, model.vis.global_.offheight = size
        # Edges between two depths have neither of them if they are smoothed.
        model.vis.quality.offsamples = 0
        if _BY_PROCESSOR.search(self.description):
            quality = model.vis.quality
            quality.shadowsize = min(quality.shadowsize, _SHADOWS_BY_PROCESSOR)
        if self._mjr is not None:
            self._mjr.free()
        self._mjr = mujoco.MjrContext(model, mujoco.mjtFontScale.mjFONTSCALE_50)
        if not self._mjr.offFBO:
            raise RenderingError('OpenGL has no framebuffer objects')
        mujoco.mjr_setBuffer(mujoco.mjtFramebuffer.mjFB_OFFSCREEN, self._mjr)
        self._mjr.readDepthMap = mujoco.mjtDepthMap.mjDEPTH_ZEROFAR
        self._scene = mujoco.MjvScene(model, model.ngeom + _SPARE_GEOMS)
        self._option = mujoco.MjvOption()
        self._option.geomgroup[:] = 0
        self._option.geomgroup[_SEEN] = 1
        self._option.sitegroup[:] = 0
        self._shown = int(mujoco.mjtCatBit.mjCAT_STATIC | mujoco.mjtCatBit.mjCAT_DYNAMIC)
        self._has_sky = bool((model.tex_type == _SKYBOX).any())
        self._bound, self._model, self._size = shot.state.model, model, size

    def _draw(
        self,
        scene: mujoco.MjvScene,
        shot: Shot,
        view: _View,
        near: float,
        far: float,
        *,
        with_color: bool = True,
    ) -> tuple[np.ndarray | None, np.ndarray]:
        """Return colours and depth, (height, width, …), of a view; from the far plane on: far."""
        _place(scene, shot, view, near, far)
        for flag in _OF_COLOR:
            scene.flags[flag] = with_color
        for flag in _AS_IDS:
            scene.flags[flag] = not with_color
        for flag in _NEVER:
            scene.flags[flag] = False
        rectangle = mujoco.MjrRect(0, 0, view.width, view.height)
        mujoco.mjr_render(rectangle, scene, self._mjr)
        color = np.empty((view.height, view.width, 3), np.uint8) if with_color else None
        z = np.empty((view.height, view.width), np.float32)
        mujoco.mjr_readPixels(color, z, rectangle, self._mjr)
        # 1 at the near plane, 0 at the far one: z = near (far - depth) / (depth (far - near)).
        wide = np.flipud(z).astype(np.float64)
        depth = (near * far / (wide * (far - near) + near)).astype(np.float32)
        depth[wide <= 0.0] = far
        if color is not None:
            color = np.ascontiguousarray(np.flipud(color))
            if not self._has_sky:
                color[depth >= far] = BACKGROUND
        return color, depth


def _ends(near: float, far: float) -> tuple[float, float]:
    """Return the ends of what is seen as OpenGL can have them, m."""
    near = max(near, _NEAREST)
    return near, min(max(far, 2.0 * near), _FARTHEST)


def _place(scene: mujoco.MjvScene, shot: Shot, view: _View, near: float, far: float) -> None:
    """Set pose and projection; of stereo's two cameras both, as MuJoCo draws their mean."""
    turn = np.array(matrix_from_quaternion(shot.pose.rotation))
    k = view.k
    # The edges of the picture are half a pixel beyond the centres of its outermost pixels.
    left, right = (-0.5 - k.cx) / k.fx * near, (view.width - 0.5 - k.cx) / k.fx * near
    top, bottom = (0.5 + k.cy) / k.fy * near, -(view.height - 0.5 - k.cy) / k.fy * near
    for camera in scene.camera:
        camera.pos, camera.forward, camera.up = shot.pose.translation, turn[:, 0], turn[:, 2]
        camera.frustum_center = (left + right) / 2.0
        camera.frustum_width = (right - left) / 2.0
        camera.frustum_top, camera.frustum_bottom = top, bottom
        camera.frustum_near, camera.frustum_far = near, far
        camera.orthographic = 0
    for number in range(scene.nlight):
        light = scene.lights[number]
        if light.headlight:
            light.pos, light.dir = shot.pose.translation, turn[:, 0]


def _view_of(camera: Camera) -> _View:
    """Return the pinhole for a camera: itself, or one that sees all that the lens shows."""
    k = intrinsics_of(camera)
    if camera.distortion.is_none:
        return _View(camera.width, camera.height, k, None)
    seen = pixel_directions(camera)
    is_seen = np.isfinite(seen[..., 0])
    (left, top), (right, bottom) = seen[is_seen].min(axis=0), seen[is_seen].max(axis=0)
    fx = min(k.fx, (_LARGEST - 1) / max(right - left, 1e-9))
    fy = min(k.fy, (_LARGEST - 1) / max(bottom - top, 1e-9))
    width, height = int((right - left) * fx) + 2, int((bottom - top) * fy) + 2
    source = np.full(is_seen.shape, -1)
    columns = np.rint((seen[is_seen, 0] - left) * fx).astype(int)
    rows = np.rint((seen[is_seen, 1] - top) * fy).astype(int)
    source[is_seen] = rows * width + columns
    return _View(width, height, Intrinsics(fx, fy, -left * fx, -top * fy), source)


def _through_lens(pixels: np.ndarray, view: _View, nothing: float) -> np.ndarray:
    """Return the camera's picture of the pinhole's."""
    if view.source is None:
        return pixels
    flat = pixels.reshape(view.height * view.width, *pixels.shape[2:])
    shown = flat[np.maximum(view.source, 0)]
    shown[view.source < 0] = nothing
    return shown
