# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
OpenGL without a window: a context from the libraries of the machine, EGL's or OSMesa's.

No Python package has these libraries, and none is needed to call them. EGL reaches the drivers of
graphics cards and, by Mesa's llvmpipe, the processor; OSMesa is an older way to the latter.
"""

from abc import ABC, abstractmethod
import ctypes
from ctypes import byref, c_char_p, c_int, c_uint, c_void_p
import os

from amr_description.errors import RenderingError

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
