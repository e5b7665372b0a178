# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Plain HTTP: the files of the page, compressed, the meshes of the robots, and one line for all else.

The headers of every response keep a browser from contacting any other server, from running inline
scripts, and from showing the page inside another one.
"""

import asyncio
from collections.abc import Callable, Sequence, Set as AbstractSet
from dataclasses import dataclass
from email.utils import formatdate
import gzip
import hashlib
from http import HTTPStatus
from pathlib import Path
import re
from urllib.parse import unquote

from websockets.asyncio.server import ServerConnection
from websockets.datastructures import Headers
from websockets.http11 import Request, Response

from amr_description.viewer.access import Access

SOCKET_PATH = '/ws'
MESH_PATH = '/mesh/'
CONTENT_TYPES = {
    '.html': 'text/html; charset=utf-8',
    '.js': 'text/javascript; charset=utf-8',
    '.css': 'text/css; charset=utf-8',
    '.json': 'application/json',
    '.map': 'application/json',
    '.webmanifest': 'application/manifest+json',
    '.txt': 'text/plain; charset=utf-8',
    '.svg': 'image/svg+xml',
    '.png': 'image/png',
    '.jpg': 'image/jpeg',
    '.jpeg': 'image/jpeg',
    '.ico': 'image/x-icon',
    '.woff2': 'font/woff2',
    '.stl': 'model/stl',
    '.obj': 'model/obj',
    '.dae': 'model/vnd.collada+xml',
}
"""By suffix; no other files are served."""
_INDEX = '/index.html'
_MOST_UNREAD = 64
"""Answers that nobody has read; when there are more, the connection of the oldest is closed."""
_MOST_UNREAD_BYTES = 256 * 1024 * 1024
"""Of those, as many as the largest mesh has."""
_SINGLE_HEADERS = ('Host', 'Origin', 'Cookie', 'If-None-Match')
"""Headers that may occur once: two parsers could use different ones."""

CONTENT_SECURITY_POLICY = '; '.join(
    (
        "default-src 'none'",
        "script-src 'self'",
        "style-src 'self'",
        "img-src 'self' blob: data:",
        "font-src 'self'",
        "connect-src 'self' blob: data:",
        "manifest-src 'self'",
        "worker-src 'self' blob:",
        "base-uri 'none'",
        "form-action 'none'",
    )
)
"""But for where the page may be a frame."""
NONE = "'none'"
_HEADERS = {
    'Cross-Origin-Opener-Policy': 'same-origin',
    'Cross-Origin-Resource-Policy': 'same-origin',
    'Referrer-Policy': 'no-referrer',
    'X-Content-Type-Options': 'nosniff',
    'Connection': 'close',
}
_NOT_BUILT = (
    'the page is not built: npm ci && npm run build, in the folder web of the sources, builds it'
)


@dataclass(frozen=True, slots=True)
class Content:
    """The data of a file, its content type, and an ETag that changes with the data."""

    data: bytes
    kind: str
    tag: str
    encoding: str | None = None
    """How the data is compressed: ``br``, ``gzip``; None: not at all."""


def digest(data: bytes) -> str:
    """Return a short hash: ETag of a file, URL of a mesh."""
    return hashlib.sha256(data).hexdigest()[:20]


class StaticFiles:
    """
    The files below a folder that have a known content type.

    A path is looked up among the files that exist, so no path leads out of the folder. Beside a
    file may be one that the build has compressed, of the same name and ``.br``; for a browser that
    does not take that, which is one that is not on this host and comes without TLS, texts are
    compressed by gzip, once.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._known: dict[tuple[Path, str | None], tuple[tuple[int, int], Content]] = {}

    def get(self, path: str, accepted: AbstractSet[str] = frozenset()) -> Content | None:
        """
        Return the file of a URL path such as ``/index.html``; None if there is none.

        Args:
            path: Of the URL.
            accepted: The content codings that the browser takes.
        """
        file = self._files().get(path)
        try:
            return self._read(file, accepted) if file else None
        except OSError:  # a build is replacing it
            return None

    def _read(self, file: Path, accepted: AbstractSet[str]) -> Content:
        is_text = CONTENT_TYPES[file.suffix.lower()].startswith('text/')
        compressed = file.with_name(f'{file.name}.br')
        if 'br' in accepted and compressed.is_file():
            return self._cached(file, compressed, 'br', bytes)
        if 'gzip' in accepted and is_text:
            return self._cached(file, file, 'gzip', lambda data: gzip.compress(data, mtime=0))
        return self._cached(file, file, None, bytes)

    def _cached(
        self, file: Path, source: Path, encoding: str | None, encode: Callable[[bytes], bytes]
    ) -> Content:
        status = source.stat()
        version = (status.st_mtime_ns, status.st_size)
        known = self._known.get((file, encoding))
        if known is None or known[0] != version:
            data = encode(source.read_bytes())
            kind = CONTENT_TYPES[file.suffix.lower()]
            known = (version, Content(data, kind, digest(data), encoding))
            self._known[file, encoding] = known
        return known[1]

    def _files(self) -> dict[str, Path]:
        return {
            f'/{file.relative_to(self._folder).as_posix()}': file
            for file in self._folder.rglob('*')
            if file.suffix.lower() in CONTENT_TYPES and file.is_file()
        }


class UnreadAnswers:
    """
    The connections whose answers nobody has read yet, which memory holds.

    Who asks 300 times for the largest file and reads nothing is to cost no more than who reads.
    """

    def __init__(self) -> None:
        self._connections: dict[ServerConnection, None] = {}

    def make_room(self, connection: ServerConnection) -> None:
        """Let the oldest go while there are too many; this one is answered next."""
        waiting = {each: each.transport.get_write_buffer_size() for each in self._connections}
        self._connections = {each: None for each, size in waiting.items() if size}
        for each in list(self._connections):
            size = sum(waiting[each] for each in self._connections)
            if len(self._connections) < _MOST_UNREAD and size < _MOST_UNREAD_BYTES:
                break
            each.transport.abort()
            del self._connections[each]
        self._connections[connection] = None


class HttpFiles:
    """Responds to requests for files; passes those for the WebSocket on."""

    def __init__(
        self,
        static: StaticFiles,
        mesh: Callable[[str], Path | bytes | None],
        access: Access,
        ancestors: Sequence[str] = (),
    ) -> None:
        """``ancestors``: the pages in which this one may be a frame; none, if there are none."""
        self._policy = f'{CONTENT_SECURITY_POLICY}; frame-ancestors {" ".join(ancestors) or NONE}'
        self._static = static
        self._mesh = mesh
        self._access = access
        self._unread = UnreadAnswers()
        self._reading = asyncio.Lock()

    async def respond(self, connection: ServerConnection, request: Request) -> Response | None:
        """Return the response; None: the request continues as a WebSocket handshake."""
        response = await self._respond(connection, request)
        if response is not None:
            response.headers['Content-Security-Policy'] = self._policy
        return response

    async def _respond(self, connection: ServerConnection, request: Request) -> Response | None:
        for name in _SINGLE_HEADERS:
            if len(request.headers.get_all(name)) > 1:
                return _text(HTTPStatus.BAD_REQUEST, f'the request has more than one {name}')
        refusal = self._access.refusal(request.path, request.headers)
        if refusal is not None:
            return _text(refusal.status, refusal.reason)
        if request.method != 'GET':
            return _text(HTTPStatus.METHOD_NOT_ALLOWED, f'{request.method} is not served, GET is')
        path = unquote(request.path.partition('?')[0])
        if path == SOCKET_PATH:
            return None
        content = await self._content(path, _accepted(request))
        if content is None:
            if path == '/':
                return _text(HTTPStatus.SERVICE_UNAVAILABLE, _NOT_BUILT)
            return _text(HTTPStatus.NOT_FOUND, f'there is no {path!a} here')
        self._unread.make_room(connection)
        response = _file(content, request, is_immutable=path.startswith(MESH_PATH))
        cookie = self._access.new_cookie(request.path, request.headers)
        if cookie is not None:
            response.headers['Set-Cookie'] = cookie
        return response

    async def _content(self, path: str, accepted: AbstractSet[str]) -> Content | None:
        if not path.startswith(MESH_PATH):
            file = _INDEX if path == '/' else path
            return await asyncio.to_thread(self._static.get, file, accepted)
        name = path.removeprefix(MESH_PATH)
        found = self._mesh(name)
        if not found:
            return None
        async with self._reading:  # one in memory, beside those that are sent
            return await asyncio.to_thread(_read_mesh, name, found)


def _accepted(request: Request) -> set[str]:
    """Return the content codings that a browser takes (RFC 9110, 12.5.3); ``q=0`` refuses one."""
    accepted = set()
    for value in request.headers.get_all('Accept-Encoding'):
        for item in value.split(','):
            coding, _, quality = item.partition(';')
            if not re.fullmatch(r'\s*q=0(\.0*)?\s*', quality):
                accepted.add(coding.strip().lower())
    return accepted


def _read_mesh(name: str, found: Path | bytes) -> Content | None:
    try:
        data = found if isinstance(found, bytes) else found.read_bytes()
    except OSError:
        return None
    return Content(data, CONTENT_TYPES[Path(name).suffix], digest(data))


def _file(content: Content, request: Request, *, is_immutable: bool) -> Response:
    tag = f'"{content.tag}"'
    is_known = request.headers.get('If-None-Match') == tag
    response = _response(
        HTTPStatus.NOT_MODIFIED if is_known else HTTPStatus.OK,
        content.kind,
        b'' if is_known else content.data,
    )
    response.headers['ETag'] = tag
    response.headers['Vary'] = 'Accept-Encoding'
    if content.encoding is not None:
        response.headers['Content-Encoding'] = content.encoding
    response.headers['Cache-Control'] = (
        'private, max-age=31536000, immutable' if is_immutable else 'private, no-cache'
    )
    return response


def _text(status: HTTPStatus, line: str) -> Response:
    response = _response(status, 'text/plain; charset=utf-8', f'{line}\n'.encode())
    response.headers['Cache-Control'] = 'no-store'
    return response


def _response(status: HTTPStatus, kind: str, body: bytes) -> Response:
    headers = Headers(_HEADERS)
    headers['Date'] = formatdate(usegmt=True)
    headers['Content-Type'] = kind
    headers['Content-Length'] = str(len(body))
    return Response(status.value, status.phrase, headers, body)
