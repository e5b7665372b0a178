# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The page behind proxies: at a path, as JupyterHub has it, behind TLS, and both; real sockets.

The certificate is of this test alone; its key is no secret (``test/fixtures/viewer/``).
"""

from contextlib import contextmanager
import http.client
import socket
import ssl
import threading
from urllib.parse import urlsplit

import pytest
from support import scripted_robots
from support.paths import ROOT
from support.running_programs import PATIENCE
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect

from amr_description.viewer.access import Proxies
from amr_description.viewer.protocol import PROTOCOL

CERTIFICATE = ROOT / 'test' / 'fixtures' / 'viewer' / 'localhost.pem'
PATH = '/user/me/proxy/8000'
HEAD_END = b'\r\n\r\n'


class Proxy:
    """Takes a path off requests and TLS off connections, and passes on the rest as it comes."""

    def __init__(self, *, path, tls, host):
        """``host``: what it sends as Host; None: what has come."""
        self.path, self.host, self.upstream = path, host, None
        self._listener = socket.create_server(('127.0.0.1', 0))
        self._context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER) if tls else None
        if self._context is not None:
            self._context.load_cert_chain(CERTIFICATE)
        port = self._listener.getsockname()[1]
        self.origin = f'{"https" if tls else "http"}://localhost:{port}'
        threading.Thread(target=self._accept, daemon=True).start()

    def close(self):
        """Accept nothing more."""
        self._listener.shutdown(socket.SHUT_RDWR)
        self._listener.close()

    def _accept(self):
        while True:
            try:
                client, _ = self._listener.accept()
            except OSError:
                return  # closed
            threading.Thread(target=self._serve, args=(client,), daemon=True).start()

    def _serve(self, client):
        try:
            if self._context is not None:
                client = self._context.wrap_socket(client, server_side=True)
            with client, socket.create_connection(self.upstream, PATIENCE) as server:
                server.sendall(self._passed_on(self._head(client)))
                back = threading.Thread(target=self._pass, args=(server, client), daemon=True)
                back.start()
                self._pass(client, server)
                back.join()
        except OSError:
            pass  # who has asked has gone

    def _head(self, client):
        read = b''
        while HEAD_END not in read and (more := client.recv(65536)):
            read += more
        return read

    def _passed_on(self, request):
        head, _, rest = request.partition(HEAD_END)
        first, *lines = head.decode().split('\r\n')
        method, target, version = first.split(' ')
        assert target.startswith(self.path)
        if self.host is not None:
            lines = [each for each in lines if not each.lower().startswith('host:')]
            lines.append(f'Host: {self.host}')
        first = f'{method} {target.removeprefix(self.path)} {version}'
        return '\r\n'.join([first, *lines]).encode() + HEAD_END + rest

    def _pass(self, source, sink):
        try:
            while data := source.recv(65536):
                sink.sendall(data)
            sink.shutdown(socket.SHUT_WR)
        except OSError:
            pass  # one of the two has gone


KINDS = {
    'path': {'path': PATH, 'tls': False, 'host': None},
    'tls': {'path': '', 'tls': True, 'host': None},
    'hub': {'path': PATH, 'tls': True, 'host': 'viewer.internal'},
}


@contextmanager
def proxied(kind, *, ancestors=()):
    """Yield the proxy before a page that knows it."""
    proxy = Proxy(**KINDS[kind])
    hosts = () if proxy.host is None else (proxy.host,)
    proxies = Proxies(hosts, (proxy.origin,), ancestors)
    try:
        with scripted_robots.serving(scripted_robots.simulation(), proxies=proxies) as (_, url):
            proxy.upstream = urlsplit(url).hostname, urlsplit(url).port
            yield proxy
    finally:
        proxy.close()


def get(proxy, path='/', **headers):
    """Status, headers and body of what a browser would get."""
    parts = urlsplit(proxy.origin)
    if parts.scheme == 'https':
        trust = ssl.create_default_context(cafile=CERTIFICATE)
        client = http.client.HTTPSConnection(parts.netloc, timeout=PATIENCE, context=trust)
    else:
        client = http.client.HTTPConnection(parts.netloc, timeout=PATIENCE)
    client.request('GET', proxy.path + path, headers=headers)
    answer = client.getresponse()
    return answer.status, dict(answer.getheaders()), answer.read().decode()


def socket_of(proxy, origin):
    """The page's WebSocket, as a page of that origin would open it."""
    address = proxy.origin.replace('http', 'ws', 1)
    trust = ssl.create_default_context(cafile=CERTIFICATE) if address[:3] == 'wss' else None
    return connect(
        f'{address}{proxy.path}/ws', subprotocols=[PROTOCOL], origin=origin, ssl=trust,
        open_timeout=PATIENCE,
    )  # fmt: skip


@pytest.mark.parametrize('kind', KINDS)
def test_behind_a_proxy_its_page_alone_is_served(kind):
    with proxied(kind) as proxy:
        status, headers, body = get(proxy)
        assert (status, 'main.js' in body) == (200, True)
        assert "frame-ancestors 'none'" in headers['Content-Security-Policy']
        for path in ('/main.js', '/style.css', '/icon.svg'):
            assert get(proxy, path, Origin=proxy.origin)[0] == 200
        with socket_of(proxy, proxy.origin) as page:
            assert '"hello"' in page.recv(PATIENCE)
        for origin in ('https://evil.example', 'null', proxy.origin.replace('localhost', 'evil')):
            assert get(proxy, '/main.js', Origin=origin)[0] == 403
            with pytest.raises(InvalidStatus, match='403'), socket_of(proxy, origin):
                pass


@pytest.mark.parametrize('kind', ['tls', 'hub'])
def test_one_that_nobody_has_named_is_refused(kind):
    proxy = Proxy(**KINDS[kind])
    try:
        with scripted_robots.serving(scripted_robots.simulation()) as (_, url):
            proxy.upstream = urlsplit(url).hostname, urlsplit(url).port
            assert get(proxy, Origin=proxy.origin)[0] == (403 if kind == 'tls' else 421)
            with pytest.raises(InvalidStatus, match='403|421'), socket_of(proxy, proxy.origin):
                pass
    finally:
        proxy.close()


def test_it_may_be_a_frame_where_that_is_said():
    with proxied('hub', ancestors=("'self'", 'https://hub.example')) as proxy:
        policy = get(proxy)[1]['Content-Security-Policy']
        assert policy.endswith("frame-ancestors 'self' https://hub.example")


def test_a_browser_has_all_of_the_page_at_a_path(browser):
    with proxied('path') as proxy:
        page = browser.open(f'{proxy.origin}{PATH}/', webgl=False)
        page.wait_until("window.amr?.now.link === 'open' && amr.now.states > 3")
        assert page.evaluate("document.querySelector('img.mark').naturalWidth") > 0
        assert page.evaluate('getComputedStyle(document.body).display') == 'grid'
        assert page.errors == []
        page.close()
