# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The server: one port for the page and its WebSocket, and an asyncio loop in a thread of its own.

:meth:`Server.start`, :meth:`Server.call` and :meth:`Server.stop` may be called on any thread;
everything else runs on the server's thread.
"""

import asyncio
from collections.abc import Callable
from dataclasses import dataclass
import errno
import logging
from pathlib import Path
import socket
import threading
from typing import Any

from websockets.asyncio.server import serve, ServerConnection
from websockets.exceptions import ConnectionClosed
from websockets.frames import CloseCode

from amr_description.errors import ProtocolError, ViewerError
from amr_description.viewer.access import Access, is_loopback, Proxies, TOKEN_PARAMETER
from amr_description.viewer.backend import Backend
from amr_description.viewer.drive_lock import DRIVE_TIMEOUT
from amr_description.viewer.http import HttpFiles, StaticFiles
from amr_description.viewer.pages import MOST_PAGES, Page, Pages
from amr_description.viewer.protocol import (
    Commanders,
    Hello,
    Layout,
    PROTOCOL,
    ServerMessage,
    SimulationStatus,
)
from amr_description.viewer.requests import decode
from amr_description.viewer.sessions import MessageRouter

STATIC = Path(__file__).parent / 'static'
DEFAULT_HOST = '127.0.0.1'
_PORTS = 20
"""How many more ports are tried if the first is taken."""
_LARGEST_FRAME = 1024 * 1024
"""Bytes of a frame from a page: descriptions of robots that people have are smaller."""
_OPEN_TIMEOUT = 20.0
"""s for a request and its response, which may be a large mesh."""
_MOST_IDLE = 64
"""Connections that have not sent a request yet; when there are more, the oldest is closed."""
_MOST_UNSENT = 8 * 1024
"""Bytes in the system's send buffer; the default, megabytes, would hold a minute of states."""
_PING = 10.0
_CLOSE_TIMEOUT = 1.0
_REASON_BYTES = 123
"""Largest reason of a close frame (RFC 6455)."""


@dataclass(frozen=True, slots=True)
class ServerSettings:
    """
    Where the server listens, and what it sends to every page.

    Attributes:
        host: address to listen on.
        port: port to listen on, or the next free one; 0: any free one.
        rate: most states per second.
        token: required from every page, unless ``host`` is the loopback.
        always_token: required there, too: of the users of this host, only who has it may drive.
        version: of this package.
        domain: ROS domain id.
        proxies: what may stand before it.
    """

    host: str = DEFAULT_HOST
    port: int = 8080
    rate: float = 60.0
    token: str = ''
    always_token: bool = False
    version: str = ''
    domain: int = 0
    proxies: Proxies = Proxies()

    def access(self, port: int) -> Access:
        """Return the rules for requests to a port."""
        is_needed = self.always_token or not is_loopback(self.host)
        return self.proxies.access(self.token if is_needed else None, port)


class Server:
    """The page's server; ``log_error`` logs a line about an exception that is a bug."""

    def __init__(
        self,
        settings: ServerSettings,
        backend: Backend,
        log_error: Callable[[str], object],
        static: Path = STATIC,
    ) -> None:
        """Bind the port, or the next free one. Raises ViewerError."""
        self._settings = settings
        self._backend = backend
        self._log_error = log_error
        self._socket = _bind(settings.host, settings.port)
        files = StaticFiles(static)
        self._access = settings.access(self._socket.getsockname()[1])
        self._http = HttpFiles(files, backend.mesh, self._access, settings.proxies.ancestors)
        self.pages = Pages()
        """Those that are open; for the server's thread."""
        self._loop = asyncio.new_event_loop()
        self._loop.set_exception_handler(self._on_exception)
        self._stopping = asyncio.Event()
        self._has_ended = False
        self._states: asyncio.TimerHandle | None = None
        """The next call of :meth:`_send_state`; None: there are no pages."""
        self._idle: dict[ServerConnection, None] = {}
        self._is_open = False
        """Whether the backend is connected with the graph."""
        self._router = MessageRouter(backend, self.pages, log_error, self._close_if_idle)
        self._thread = threading.Thread(target=self._run, name='viewer')

    @property
    def url(self) -> str:
        """The address of the page, with the token if it needs one."""
        host, port, *_ = self._socket.getsockname()
        host = f'[{host}]' if ':' in host else host
        token = self._access.token
        return f'http://{host}:{port}/' + (f'?{TOKEN_PARAMETER}={token}' if token else '')

    @property
    def origins(self) -> tuple[str, ...]:
        """The origins behind proxies whose pages may use it."""
        return self._access.origins

    def start(self, *, is_daemon: bool = False) -> None:
        """Start the thread; ``is_daemon``: the process may end without :meth:`stop`."""
        self._thread.daemon = is_daemon
        self._thread.start()

    def stop(self) -> None:
        """Stop the robots that pages drive, disconnect all pages, and join the thread."""
        if self._thread.is_alive():
            self._loop.call_soon_threadsafe(self._stopping.set)
            self._thread.join()
        self._socket.close()

    def call(self, callback: Callable[[], object]) -> None:
        """Call something on the server's thread soon, unless it has ended."""
        if not self._loop.is_closed():
            self._loop.call_soon_threadsafe(self._unless_ended, callback)

    # --- on the server's thread ------------------------------------------------------------------

    def _unless_ended(self, callback: Callable[[], object]) -> None:
        """Call something, unless a task that it might start would never be done."""
        if not self._has_ended:
            callback()

    def _run(self) -> None:
        try:
            self._loop.run_until_complete(self._serve())
        finally:
            self._has_ended = True
            self._loop.run_until_complete(_cancel_tasks())
            self._loop.run_until_complete(self._loop.shutdown_default_executor())
            self._loop.close()

    async def _serve(self) -> None:
        quiet = logging.getLogger('amr_description.viewer.websockets')
        quiet.addHandler(logging.NullHandler())  # malformed requests are not errors of ours
        quiet.propagate = False
        server = await serve(
            self._serve_page,
            sock=self._socket,
            subprotocols=[PROTOCOL],  # type: ignore[list-item]
            compression=None,
            process_request=self._http.respond,
            server_header=None,
            open_timeout=_OPEN_TIMEOUT,
            ping_interval=_PING,
            ping_timeout=_PING,
            close_timeout=_CLOSE_TIMEOUT,
            max_size=_LARGEST_FRAME,
            logger=quiet,
            create_connection=self._connection,  # type: ignore[arg-type]  # what makes one will do
        )
        await self._stopping.wait()
        self._stop_states()
        self._router.stops.end()
        self._router.stop_all()
        server.close(code=CloseCode.SERVICE_RESTART, reason='the viewer has ended')
        for connection in [*self._idle]:
            connection.transport.abort()
        await server.wait_closed()

    def _connection(self, *args: object, **options: object) -> ServerConnection:
        return _Connection(self._idle, *args, **options)

    async def _serve_page(self, connection: ServerConnection) -> None:
        """Serve a page from its connection to its end."""
        if self.pages.is_full:
            reason = f'{MOST_PAGES} pages are open already; close one of them first'
            await connection.close(CloseCode.TRY_AGAIN_LATER, reason)
            return
        page = Page(self.pages.next_name(), connection)
        self._connect(page)
        try:
            async for frame in connection:
                if isinstance(frame, bytes):
                    raise ProtocolError('binary frames are not understood')
                self._router.route(page, decode(frame))
        except ProtocolError as error:
            await connection.close(CloseCode.POLICY_VIOLATION, _close_reason(error))
        except ConnectionClosed:
            pass  # without a close frame
        finally:
            self._disconnect(page)

    def _connect(self, page: Page) -> None:
        settings = self._settings
        if not self._is_open:
            self._is_open = True
            self._backend.open()
        if not len(self.pages):
            self._start_states()
        hello = Hello(page.name, settings.version, settings.domain, settings.rate, DRIVE_TIMEOUT)
        self.pages.add(page, hello)

    def _disconnect(self, page: Page) -> None:
        self.pages.remove(page)
        self._router.disconnect(page)
        if not len(self.pages):
            self._stop_states()
            self._close_if_idle()

    def _close_if_idle(self) -> None:
        """Disconnect from the graph, unless there are pages or robots that STOP holds."""
        if self._is_open and not len(self.pages) and not self._router.stops.is_engaged:
            self._is_open = False
            self._backend.close()
            self.pages.clear_latched()

    def _start_states(self) -> None:
        """Send what is new, at a steady rate, from now on."""
        now = self._loop.time()
        self._states = self._loop.call_at(now, self._send_state, now)

    def _stop_states(self) -> None:
        if self._states is not None:
            self._states.cancel()
            self._states = None

    def _send_state(self, due: float) -> None:
        """Send what is new, and have that done again; a task that sleeps takes 50 µs more."""
        try:
            messages, state = self._backend.take_state()
            for message in messages:
                self._publish_message(message)
            self.pages.send_messages()
            if state is not None:
                self.pages.send_state(state)
            if self._router.shows_topics:
                self.pages.send_samples(self._backend.take_samples(self.pages.wanted))
        except Exception as error:
            self._log_error(f'no more states are sent: {type(error).__name__}: {error}')
            return
        due = max(due + 1.0 / self._settings.rate, self._loop.time())
        self._states = self._loop.call_at(due, self._send_state, due)

    def _publish_message(self, message: ServerMessage) -> None:
        match message:
            case Layout():
                self.pages.publish('', message)
            case SimulationStatus():
                self.pages.publish(message.simulator, message)
            case Commanders():
                self.pages.publish(message.robot, message)
            case _:
                self.pages.send_message(message)

    def _on_exception(self, _: asyncio.AbstractEventLoop, context: dict[str, object]) -> None:
        error = context.get('exception')
        self._log_error(f'{context.get("message")}: {type(error).__name__}: {error}')


class _Connection(ServerConnection):
    """A connection; it is in ``idle`` until it has sent a request."""

    def __init__(self, idle: dict[ServerConnection, None], *args: Any, **options: Any) -> None:
        super().__init__(*args, **options)
        self._idle = idle

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        super().connection_made(transport)
        self._idle[self] = None
        self.request_rcvd.add_done_callback(lambda _: self._idle.pop(self, None))
        if len(self._idle) > _MOST_IDLE:
            next(iter(self._idle)).transport.abort()

    def connection_lost(self, exc: Exception | None) -> None:
        self._idle.pop(self, None)
        super().connection_lost(exc)


async def _cancel_tasks() -> None:
    """Cancel what still waits, such as for a service, and what that starts in turn."""
    while tasks := asyncio.all_tasks() - {asyncio.current_task()}:
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)


def _bind(host: str, port: int) -> socket.socket:
    """Listen on ``port``, or on the next free one; 0: on any free one. Raises ViewerError."""
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
            # Accepted sockets inherit this option.
            bound.setsockopt(socket.IPPROTO_TCP, socket.TCP_NOTSENT_LOWAT, _MOST_UNSENT)
            return bound
    raise ViewerError(
        f'ports {port} to {last} of {host} are all taken; -p port:=… chooses another, 0 any that '
        'is free'
    )


def _close_reason(error: Exception) -> str:
    return str(error).encode()[:_REASON_BYTES].decode(errors='ignore')
