# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Which requests the server answers: those of its own page on this host, or with its token.

A browser lets every web site send requests to 127.0.0.1, so listening there only is not enough:

- ``Host`` must name the loopback. Otherwise a web site whose name resolves to 127.0.0.1 (DNS
  rebinding) could read states and drive.
- ``Origin``, if present, must be the server's own page. Programs other than browsers send none;
  they could publish on the robot's topics just as well.

A server that listens on another address has a random token: in the URL of the first request, then
in a cookie. With it, any name of the host is accepted.

A proxy before it (of TLS, of JupyterHub, of Codespaces) has a name of its own. Who starts the
server names the origins of pages behind it, and further values of ``Host`` that it passes on;
nothing else is accepted, and what is named is compared as a whole.

Pure: the caller generates the token, and passes the environment.
"""

from collections.abc import Mapping
from dataclasses import dataclass
import hmac
from http import HTTPStatus
from http.cookies import CookieError, SimpleCookie
import ipaddress
import re
from urllib.parse import parse_qs, urlsplit

from amr_description.errors import ViewerError

_HOST = re.compile(r'(?P<name>[A-Za-z0-9._-]+|\[[0-9A-Fa-f:.]+\])(:(?P<port>[0-9]{1,5}))?')
"""A Host header: a name, or an address, and its port; nothing else."""
_ORIGIN = re.compile(r'https?://[A-Za-z0-9.-]+(:[0-9]{1,5})?')
_ANCESTOR = re.compile(r"'self'|https?://(\*\.)?[A-Za-z0-9.-]+(:([0-9]{1,5}|\*))?")
TOKEN_PARAMETER = 'token'
"""The query parameter of the URL that holds the token."""


@dataclass(frozen=True, slots=True)
class Refusal:
    """Why a request is refused; ``reason`` is one line."""

    status: HTTPStatus
    reason: str


@dataclass(frozen=True, slots=True)
class Access:
    """
    The rules of a server.

    Attributes:
        token: None if it listens on the loopback only.
        hosts: what ``Host`` may be besides, with a port or for all ports.
        origins: of pages behind a proxy; their hosts are accepted, too.
    """

    token: str | None = None
    hosts: tuple[str, ...] = ()
    origins: tuple[str, ...] = ()

    def refusal(self, target: str, headers: Mapping[str, str]) -> Refusal | None:
        """
        Check a request.

        Args:
            target: ``/path?query``.
            headers: of the request, by name.

        Returns:
            Why it is refused; None: it is accepted.
        """
        host = headers.get('Host', '')
        is_own = self.token is not None or is_loopback(host_name(host)) or self._is_named(host)
        if not is_own and host.lower() not in {urlsplit(each).netloc for each in self.origins}:
            return Refusal(
                HTTPStatus.MISDIRECTED_REQUEST,
                f'this server is for its own host: the address must begin with localhost or '
                f'127.0.0.1, not {host!a}',
            )
        if not host_name(host):
            return Refusal(HTTPStatus.BAD_REQUEST, f'{host!a} is no name of a host')
        origin = headers.get('Origin')
        if not self._is_origin(origin, host.lower(), is_own=is_own):
            return Refusal(
                HTTPStatus.FORBIDDEN, f'a page of {origin!a} may not use the server at {host!a}'
            )
        if self.token is not None and not self._knows_token(target, headers):
            return Refusal(
                HTTPStatus.FORBIDDEN,
                'the address lacks its token: use the one that the viewer printed',
            )
        return None

    def _is_named(self, host: str) -> bool:
        return host.lower() in self.hosts or host_name(host) in self.hosts

    def _is_origin(self, origin: str | None, host: str, *, is_own: bool) -> bool:
        """Return whether a request may come from there; behind a proxy, from those named."""
        if origin is None or origin.lower() in self.origins:
            return True
        return is_own and origin.lower() == f'http://{host}'

    def new_cookie(self, target: str, headers: Mapping[str, str]) -> str | None:
        """Return the Set-Cookie header, if the URL of the request has the token; else None."""
        if self.token is None or not self._has_token_in_url(target):
            return None
        name = cookie_name(headers.get('Host', ''))
        return f'{name}={self.token}; Path=/; HttpOnly; SameSite=Strict'

    def _knows_token(self, target: str, headers: Mapping[str, str]) -> bool:
        try:
            cookies = SimpleCookie(headers.get('Cookie', ''))
        except CookieError:
            cookies = SimpleCookie()
        morsel = cookies.get(cookie_name(headers.get('Host', '')))
        return self._has_token_in_url(target) or (
            morsel is not None and self._is_token(morsel.value)
        )

    def _has_token_in_url(self, target: str) -> bool:
        values = parse_qs(target.partition('?')[2]).get(TOKEN_PARAMETER, [])
        return any(self._is_token(value) for value in values)

    def _is_token(self, value: str) -> bool:
        return hmac.compare_digest(value.encode(errors='replace'), (self.token or '').encode())


@dataclass(frozen=True, slots=True)
class Proxies:
    """
    What stands before the server; nothing, by default.

    Attributes:
        hosts: see :class:`Access`.
        origins: likewise; ``{port}`` in one is the port that the server listens on.
        ancestors: where the page may be a frame, as Content-Security-Policy names such pages.
    """

    hosts: tuple[str, ...] = ()
    origins: tuple[str, ...] = ()
    ancestors: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        """Raise ViewerError if one is none."""
        origins = [each.replace('{port}', '0') for each in self.origins]
        for what, texts, pattern in (
            ('host', self.hosts, _HOST),
            ('origin, such as https://hub.example', origins, _ORIGIN),
            ('ancestor, such as https://hub.example', self.ancestors, _ANCESTOR),
        ):
            for text in texts:
                if not pattern.fullmatch(text):
                    raise ViewerError(f'{text!a} is no {what}')

    def access(self, token: str | None, port: int) -> Access:
        """Return the rules of a server behind them."""
        origins = tuple(each.replace('{port}', str(port)).lower() for each in self.origins)
        return Access(token, tuple(each.lower() for each in self.hosts), origins)

    def and_those_of(self, environment: Mapping[str, str]) -> 'Proxies':
        """Return these and GitHub's, in a codespace; it rewrites the origin of some requests."""
        name = environment.get('CODESPACE_NAME', '')
        domain = environment.get('GITHUB_CODESPACES_PORT_FORWARDING_DOMAIN', 'app.github.dev')
        if environment.get('CODESPACES') != 'true' or not name:
            return self
        origins = (f'https://{name}-{{port}}.{domain}', 'https://localhost:{port}')
        ancestors = ("'self'", f'https://{name}.github.dev')
        return Proxies(self.hosts, (*self.origins, *origins), (*self.ancestors, *ancestors))


def cookie_name(host: str) -> str:
    """
    Return the name of the cookie that holds the token; ``host`` is the Host header.

    Browsers send a cookie to all ports of a host, so the name includes the port.
    """
    match = _HOST.fullmatch(host)
    return f'amr_viewer_token_{(match and match["port"]) or 80}'


def host_name(host: str) -> str:
    """Return a Host header without its port, in small letters; '' if it is malformed."""
    match = _HOST.fullmatch(host)
    return match['name'].strip('[]').lower() if match else ''


def is_loopback(host: str) -> bool:
    """Return whether a name or address can only mean this host."""
    if host == 'localhost':
        return True
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return False
