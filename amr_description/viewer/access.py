# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Who may talk to the server: this host's own page, and who knows the token.

A browser lets every web site send requests to 127.0.0.1, so listening there only is not enough:

- ``Host`` must name the loopback, or another site, whose name was made to lead here (DNS
  rebinding), could read and drive.
- ``Origin``, if there is one, must be this server's own page. A program that is no browser sends
  none, and may as well publish on the robot's topics.

A server that listens elsewhere has a random token: in the URL of the first page, then in a cookie.
Whoever has it may use any name of the host.

Pure, but for the token, which the caller makes.
"""

from collections.abc import Mapping
from dataclasses import dataclass
import hmac
from http import HTTPStatus
from http.cookies import CookieError, SimpleCookie
import ipaddress
from urllib.parse import parse_qs, urlsplit

TOKEN_PARAMETER = 'token'
"""Of the URL."""


@dataclass(frozen=True, slots=True)
class Refusal:
    """Why a request is not answered; ``reason`` is one line."""

    status: HTTPStatus
    reason: str


@dataclass(frozen=True, slots=True)
class Access:
    """The rules of a server; ``token``: None for one that listens on the loopback only."""

    token: str | None = None

    def refusal(self, target: str, headers: Mapping[str, str]) -> Refusal | None:
        """Judge a request by its target (``/path?query``) and headers; None: it may."""
        host = headers.get('Host', '')
        if self.token is None and not is_loopback(host_name(host)):
            return Refusal(
                HTTPStatus.MISDIRECTED_REQUEST,
                f'this server is for its own host: the address must begin with localhost or '
                f'127.0.0.1, not {host!a}',
            )
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
        """Return the Set-Cookie header for who comes with the token in the URL."""
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
    Return the name of the cookie that holds the token of the server at a Host header.

    A browser gives a cookie to all ports of a host, so that two viewers need two names.
    """
    try:
        port = urlsplit(f'//{host}').port
    except ValueError:
        port = None
    return f'amr_viewer_token_{port or 80}'


def host_name(host: str) -> str:
    """Return a Host header without its port; nothing for one that is malformed."""
    try:
        return urlsplit(f'//{host}').hostname or ''
    except ValueError:
        return ''


def is_loopback(host: str) -> bool:
    """Tell whether a name or address can only mean this host."""
    if host == 'localhost':
        return True
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return False
