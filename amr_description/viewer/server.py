# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The server: one port for the page and its WebSocket, one asyncio loop in a thread of its own.

Whoever owns it calls :meth:`Server.start`, :meth:`Server.show`, :meth:`Server.forget`,
:meth:`Server.call` and :meth:`Server.stop` on any thread; all else runs on the server's.
"""

import asyncio
from collections.abc import Callable
from dataclasses import dataclass
import errno
import logging
from pathlib import Path
import socket
import threading

from websockets.asyncio.server import serve, ServerConnection
from websockets.exceptions import ConnectionClosed
from websockets.frames import CloseCode

from amr_description.errors import ProtocolError, ViewerError
from amr_description.viewer.access import Access, is_loopback, TOKEN_PARAMETER
from amr_description.viewer.backend import Backend
from amr_description.viewer.drive_lock import DRIVE_TIMEOUT
from amr_description.viewer.http import StaticFiles, Web
from amr_description.viewer.protocol import (
    Hello,
    Layout,
    ServerMessage,
    SimulationStatus,
    SUBPROTOCOL,
)
from amr_description.viewer.requests import decode
from amr_description.viewer.sessions import MessageRouter, MOST_PAGES, Page, Pages

STATIC = Path(__file__).parent / 'static'
DEFAULT_HOST = '127.0.0.1'
_PORTS = 20
"""How many are tried where the first is taken."""
_LARGEST_FRAME = 64 * 1024
"""Bytes, of what a page may send; 1000 sliders need half of it."""
_OPEN_TIMEOUT = 20.0
"""s for a request and its answer, as large as a mesh may be."""
_MOST_UNDECIDED = 64
"""Sockets that have not asked for anything yet; of more, the oldest goes."""
_MOST_UNSENT = 8 * 1024
"""Bytes that the system takes ahead of sending; by default megabytes, a minute of states."""
_PING = 10.0
_CLOSE_TIMEOUT = 1.0
_REASON_BYTES = 123
"""Of the reason of a close, by RFC 6455."""


@dataclass(frozen=True, slots=True)
class Settings:
    """
    Where the server listens and what it is.

    ``rate``: states per second, at most. ``token``: asked of every page where ``host`` is not the
    loopback.
    """

    host: str = DEFAULT_HOST
    port: int = 8080
    rate: float = 60.0
    token: str = ''
    version: str = ''
    domain: int = 0

    @property
    def access(self) -> Access:
        """The rules for who may talk to it."""
        return Access(None if is_loopback(self.host) else self.token)


class Server:
    """The page's server; ``backend`` knows the robots, ``say`` logs a line that is a fault."""

    def __init__(
        self,
        settings: Settings,
        backend: Backend,
        say: Callable[[str], object],
        static: Path = STATIC,
    ) -> None:
        """Bind the port, or the next one that is free. Raises ViewerError."""
        self._settings = settings
        self._backend = backend
        self._say = say
        self._socket = _bind(settings.host, settings.port)
        self._web = Web(StaticFiles(static), backend.mesh, settings.access)
        self._pages = Pages()
        self._loop = asyncio.new_event_loop()
        self._loop.set_exception_handler(self._on_fault)
        self._ended = asyncio.Event()
        self._somebody_looks = asyncio.Event()
        self._undecided: dict[ServerConnection, None] = {}
        self._talk = MessageRouter(backend, self._pages, say)
        self._thread = threading.Thread(target=self._run, name='viewer')

    @property
    def url(self) -> str:
        """Where the page is."""
        host, port, *_ = self._socket.getsockname()
        place = f'[{host}]' if ':' in host else host
        token = self._settings.access.token
        return f'http://{place}:{port}/' + (f'?{TOKEN_PARAMETER}={token}' if token else '')

    def start(self) -> None:
        """Begin to serve."""
        self._thread.start()

    def stop(self) -> None:
        """Stop the robots that are driven, part from all pages, and end the thread."""
        if self._thread.is_alive():
            self._loop.call_soon_threadsafe(self._ended.set)
            self._thread.join()
        self._socket.close()

    def show(self, subject: str, message: ServerMessage) -> None:
        """As :meth:`Pages.show`."""
        self._call(lambda: self._pages.show(subject, message))

    def show_now(self, subject: str, message: ServerMessage) -> None:
        """As :meth:`show`, on the server's thread."""
        self._pages.show(subject, message)

    def forget(self, keep: list[str]) -> None:
        """As :meth:`Pages.forget`."""
        self._call(lambda: self._pages.forget(keep))

    def call(self, callback: Callable[[], object]) -> None:
        """Have something called on the server's thread."""
        self._call(callback)

    def _call(self, callback: Callable[[], object]) -> None:
        if not self._loop.is_closed():
            self._loop.call_soon_threadsafe(callback)

    # --- on the server's thread ------------------------------------------------------------------

    def _run(self) -> None:
        try:
            self._loop.run_until_complete(self._serve())
        finally:
            self._loop.run_until_complete(self._loop.shutdown_default_executor())
            self._loop.close()

    async def _serve(self) -> None:
        quiet = logging.getLogger('amr_description.viewer.websockets')
        quiet.addHandler(logging.NullHandler())  # what strangers send is no fault of ours
        quiet.propagate = False
        states = asyncio.create_task(self._send_states())
        states.add_done_callback(self._on_end_of_states)
        server = await serve(
            self._attend,
            sock=self._socket,
            subprotocols=[SUBPROTOCOL],  # type: ignore[list-item]
            compression=None,
            process_request=self._web.answer,
            server_header=None,
            open_timeout=_OPEN_TIMEOUT,
            ping_interval=_PING,
            ping_timeout=_PING,
            close_timeout=_CLOSE_TIMEOUT,
            max_size=_LARGEST_FRAME,
            logger=quiet,
            create_connection=self._connection,
        )
        await self._ended.wait()
        states.cancel()
        self._talk.stop_all()
        server.close(code=CloseCode.SERVICE_RESTART, reason='the viewer has ended')
        for connection in [*self._undecided]:
            connection.transport.abort()
        await server.wait_closed()

    def _connection(self, *args: object, **options: object) -> ServerConnection:
        return _Connection(self._undecided, *args, **options)

    async def _attend(self, connection: ServerConnection) -> None:
        """Talk with a page from its first word to its last."""
        if self._pages.is_full:
            reason = f'{MOST_PAGES} pages are open already; close one of them first'
            await connection.close(CloseCode.TRY_AGAIN_LATER, reason)
            return
        page = Page(self._pages.name(), connection)
        self._enter(page)
        try:
            async for frame in connection:
                if isinstance(frame, bytes):
                    raise ProtocolError('binary frames are not understood')
                self._talk.hear(page, decode(frame))
        except ProtocolError as error:
            await connection.close(CloseCode.POLICY_VIOLATION, _reason(error))
        except ConnectionClosed:
            pass  # without a goodbye
        finally:
            self._leave(page)

    def _enter(self, page: Page) -> None:
        settings = self._settings
        if not len(self._pages):
            self._backend.opened()
            self._somebody_looks.set()
        hello = Hello(page.name, settings.version, settings.domain, settings.rate, DRIVE_TIMEOUT)
        self._pages.add(page, hello)

    def _leave(self, page: Page) -> None:
        self._pages.remove(page)
        self._talk.leave(page)
        if not len(self._pages):
            self._somebody_looks.clear()
            self._backend.closed()
            self._pages.clear()

    async def _send_states(self) -> None:
        """Look for what has moved, at a steady rate, while somebody looks."""
        period, due = 1.0 / self._settings.rate, self._loop.time()
        while True:
            await self._somebody_looks.wait()
            messages, state = self._backend.state()
            for message in messages:
                self._tell(message)
            if state is not None:
                self._pages.send_state(state)
            due = max(due + period, self._loop.time())
            await asyncio.sleep(due - self._loop.time())

    def _on_end_of_states(self, task: asyncio.Task[None]) -> None:
        if not task.cancelled() and (error := task.exception()) is not None:
            self._say(f'no more states are sent: {type(error).__name__}: {error}')

    def _tell(self, message: ServerMessage) -> None:
        match message:
            case Layout():
                self._pages.show('', message)
            case SimulationStatus():
                self._pages.show(message.simulator, message)
            case _:
                self._pages.tell(message)

    def _on_fault(self, _: asyncio.AbstractEventLoop, context: dict[str, object]) -> None:
        error = context.get('exception')
        self._say(f'{context.get("message")}: {type(error).__name__}: {error}')


class _Connection(ServerConnection):
    """A socket; as long as it has asked for nothing, it is one of the undecided."""

    def __init__(
        self, undecided: dict[ServerConnection, None], *args: object, **options: object
    ) -> None:
        super().__init__(*args, **options)  # type: ignore[arg-type]
        self._undecided = undecided

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        super().connection_made(transport)
        self._undecided[self] = None
        self.request_rcvd.add_done_callback(lambda _: self._undecided.pop(self, None))
        if len(self._undecided) > _MOST_UNDECIDED:
            next(iter(self._undecided)).transport.abort()

    def connection_lost(self, exc: Exception | None) -> None:
        self._undecided.pop(self, None)
        super().connection_lost(exc)


def _bind(host: str, port: int) -> socket.socket:
    """Listen on ``port``, 0 for any, or the next one that is free. Raises ViewerError."""
    family = socket.AF_INET6 if ':' in host else socket.AF_INET
    last = min(port + _PORTS, 65535) if port else 0
    for each in range(port, last + 1):
        try:
            bound = socket.create_server((host, each), family=family, backlog=128)
        except OSError as error:
            if error.errno != errno.EADDRINUSE:
                raise ViewerError(
                    f'cannot listen on {host}:{each}: {error.strerror or error}; -p host:=… and '
                    '-p port:=… choose where'
                ) from error
        else:
            # What it accepts inherits this.
            bound.setsockopt(socket.IPPROTO_TCP, socket.TCP_NOTSENT_LOWAT, _MOST_UNSENT)
            return bound
    raise ViewerError(
        f'ports {port} to {last} of {host} are all taken; -p port:=… chooses another, 0 any that '
        'is free'
    )


def _reason(error: Exception) -> str:
    return str(error).encode()[:_REASON_BYTES].decode(errors='ignore')
