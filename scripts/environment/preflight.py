# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Whether a set-up can succeed here, found before anything is fetched or written."""

from collections.abc import Mapping
import os
from pathlib import Path

from . import say, SetupError
from .checkout import Checkout

NEEDED = 700
"""MB on the disk of the checkout: 560 of them stay at most."""
INDEX = 'https://pypi.org/simple'
FILES = 'files.pythonhosted.org'
"""Where the index of PyPI has its files."""
_PATIENCE = 5.0
"""s until a host that does not answer counts as not there."""


def check_writable(checkout: Checkout) -> None:
    """Raise :class:`SetupError` if we may not write into the checkout."""
    root = checkout.root
    for folder in (root, checkout.venv, root / 'build', root / 'install'):
        if folder.exists() and not os.access(folder, os.W_OK):
            owner, me = _name(folder.stat().st_uid), _name(os.getuid())
            whose = f"it is {owner}'s, and you are {me}" if owner != me else 'it is read-only'
            raise SetupError(f'cannot write into {folder}: {whose}; make a clone of your own')


def check_space(folder: Path) -> None:
    """Raise :class:`SetupError` if the disk of ``folder`` is too full for an environment."""
    import shutil

    free = shutil.disk_usage(folder).free // 1_000_000
    if free < NEEDED:
        raise SetupError(f'{folder}: {free} MB are free, and {NEEDED} MB are needed')


def check_home(environment: Mapping[str, str]) -> None:
    """Tell of a home that cannot be written to; what needs one goes elsewhere or is named."""
    home = environment.get('HOME', '')
    if home and os.access(home, os.W_OK):
        return
    found = f'HOME={home} cannot be written to' if home else 'HOME is not set'
    more = '' if 'ROS_LOG_DIR' in environment else '; for the logs of ROS set ROS_LOG_DIR or HOME'
    say(f'{found}: nothing will be kept for other checkouts{more}')


def index_of(environment: Mapping[str, str], configured: Mapping[str, str]) -> str:
    """Return the URL of the index that pip asks, its files being ``configured``."""
    return environment.get('PIP_INDEX_URL') or configured.get('index-url') or INDEX


def check_hosts(environment: Mapping[str, str]) -> None:
    """
    Say which hosts are asked for packages.

    Raises:
        SetupError: the one of the index, or the proxy on the way to it, cannot be reached.
    """
    import socket
    from urllib.parse import urlsplit
    from urllib.request import getproxies, proxy_bypass

    configured = _configured(environment)
    if configured is None:  # a mirror may be named where only the pip to come reads it
        return
    index = urlsplit(index_of(environment, configured))
    host = index.hostname
    no_index = environment.get('PIP_NO_INDEX') or configured.get('no-index', '')
    if not host or no_index.lower() in ('1', 'on', 'true', 'y', 'yes', 't'):
        return
    files = f' and {FILES}' if host == urlsplit(INDEX).hostname else ''
    say(f'asks {host}{files} for packages')
    named = environment.get('PIP_PROXY') or configured.get('proxy')
    proxy = named or getproxies().get(index.scheme)
    through = index
    if proxy and (named or not proxy_bypass(host)):
        through = urlsplit(proxy if '://' in proxy else f'http://{proxy}')
    way = host if through is index else f'the proxy {through.hostname}'
    try:
        port = through.port or (443 if through.scheme == 'https' else 80)
        socket.create_connection((through.hostname or host, port), _PATIENCE).close()
    except (OSError, ValueError) as error:  # the latter of a port that is none
        reason = getattr(error, 'strerror', None) or str(error)
        raise SetupError(
            f'cannot reach {way}: {reason}; PIP_INDEX_URL names another index, HTTPS_PROXY a proxy'
        ) from None


def _configured(environment: Mapping[str, str]) -> dict[str, str] | None:
    """
    Return what the files of pip say of all its commands, and of installing above that.

    None: this Python has no pip that could say it.
    """
    import subprocess
    import sys

    command = [sys.executable, '-m', 'pip', 'config', 'list']
    done = subprocess.run(command, env=environment, capture_output=True, text=True)
    if done.returncode:
        return None
    said: dict[str, dict[str, str]] = {'global': {}, 'install': {}}
    for line in done.stdout.splitlines():
        name, _, value = line.partition('=')
        section, _, option = name.partition('.')
        if section in said:
            said[section][option] = value.strip('\'"')
    return said['global'] | said['install']


def _name(user: int) -> str:
    import pwd

    try:
        return pwd.getpwuid(user).pw_name
    except KeyError:
        return f'user {user}'
