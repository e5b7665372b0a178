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

Pure: the caller generates the token.
"""

from collections.abc import Mapping
from dataclasses import dataclass
import hmac
from http import HTTPStatus
from http.cookies import CookieError, SimpleCookie
import ipaddress
import re
from urllib.parse import parse_qs

_HOST = re.compile(r'(?P<name>[A-Za-z0-9._-]+|\[[0-9A-Fa-f:.]+\])(:(?P<port>[0-9]{1,5}))?')
"""A Host header: a name, or an address, and its port; nothing else."""
TOKEN_PARAMETER = 'token'
"""The query parameter of the URL that holds the token."""


@dataclass(frozen=True, slots=True)
class Refusal:
    """Why a request is refused; ``reason`` is one line."""

    status: HTTPStatus
    reason: str


@dataclass(frozen=True, slots=True)
class Access:
    """The rules of a server; ``token`` is None if it listens on the loopback only."""

    token: str | None = None

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
        if self.token is None and not is_loopback(host_name(host)):
            return Refusal(
                HTTPStatus.MISDIRECTED_REQUEST,
                f'this server is for its own host: the address must begin with localhost or '
                f'127.0.0.1, not {host!a}',
            )
        if not host_name(host):
            return Refusal(HTTPStatus.BAD_REQUEST, f'{host!a} is no name of a host')
        origin = headers.get('Origin')
        if origin is not None and origin.lower() != f'http://{host.lower()}':
            return Refusal(
                HTTPStatus.FORBIDDEN, f'a page of {origin!a} may not use the server at {host!a}'
            )
        if self.token is not None and not self._knows_token(target, headers):
            return Refusal(
                HTTPStatus.FORBIDDEN,
                'the address lacks its token: use the one that the viewer printed',
            )
        return None

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
