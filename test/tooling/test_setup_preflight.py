# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What keeps a set-up from its end is found before it begins, or said by its first cause."""

import os
import runpy
import shutil
import socket
import sys
import zipfile

from environment import causes, debian, interface_wheel, preflight, SetupError, virtual_environment
from environment.checkout import Checkout
from environment.commands import run
from environment.locks import Pin
import pytest


@pytest.fixture
def listening(monkeypatch):
    """The URL of a host that takes connections; no proxy is on the way."""
    for name in ('http_proxy', 'HTTP_PROXY', 'no_proxy', 'NO_PROXY'):
        monkeypatch.delenv(name, raising=False)
    with socket.create_server(('127.0.0.1', 0)) as server:
        yield f'http://127.0.0.1:{server.getsockname()[1]}'


@pytest.fixture
def closed():
    """The URL of a port that nobody listens to."""
    with socket.socket() as bound:  # taken, so that nobody else takes it; not listening
        bound.bind(('127.0.0.1', 0))
        yield f'http://127.0.0.1:{bound.getsockname()[1]}'


def test_the_host_of_the_index_is_named_and_reached(listening, capsys):
    preflight.check_hosts({'PIP_INDEX_URL': f'{listening}/simple'})
    assert capsys.readouterr().err.endswith('asks 127.0.0.1 for packages\n')


def test_a_host_that_cannot_be_reached_is_named(listening, closed):
    with pytest.raises(SetupError, match=r'^cannot reach 127.0.0.1: Connection refused; PIP_INDE'):
        preflight.check_hosts({'PIP_INDEX_URL': f'{closed}/simple'})


def test_on_the_way_is_the_proxy(listening, closed, monkeypatch):
    index = {'PIP_INDEX_URL': 'http://index.invalid/simple'}
    monkeypatch.setenv('http_proxy', listening)
    preflight.check_hosts(index)
    monkeypatch.setenv('http_proxy', closed)
    with pytest.raises(SetupError, match='^cannot reach the proxy 127.0.0.1: Connection refused'):
        preflight.check_hosts(index)


def test_a_proxy_without_a_scheme_is_one_and_a_port_that_is_none_is_said(listening, monkeypatch):
    index = {'PIP_INDEX_URL': 'http://index.invalid/simple', 'PIP_NO_INDEX': '0'}
    preflight.check_hosts(index | {'PIP_PROXY': listening.removeprefix('http://')})
    with pytest.raises(SetupError, match='^cannot reach the proxy host: Port'):
        preflight.check_hosts(index | {'PIP_PROXY': 'host:99999'})


def test_what_pip_is_configured_to_do_is_done(listening, tmp_path, capsys):
    (tmp_path / 'pip.conf').write_text(
        f'[global]\nproxy = {listening}\n[install]\nindex-url = http://index.invalid/simple\n'
    )
    pip = {'PIP_CONFIG_FILE': str(tmp_path / 'pip.conf'), 'HOME': str(tmp_path)}
    preflight.check_hosts(pip)
    assert capsys.readouterr().err.endswith('asks index.invalid for packages\n')
    preflight.check_hosts(pip | {'PIP_NO_INDEX': '1'})
    assert capsys.readouterr().err == ''


def test_where_no_pip_says_its_index_none_is_asked(monkeypatch, tmp_path, capsys):
    monkeypatch.setattr(sys, 'executable', '/bin/false')
    preflight.check_hosts({'HOME': str(tmp_path)})
    assert capsys.readouterr().err == ''


def test_an_index_of_files_needs_no_host(tmp_path, capsys):
    preflight.check_hosts({'PIP_INDEX_URL': tmp_path.as_uri()})
    assert capsys.readouterr().err == ''


def test_a_disk_that_is_too_full_is_said(tmp_path, monkeypatch):
    usage = shutil._ntuple_diskusage(10**12, 10**12, 699 * 10**6)
    monkeypatch.setattr(shutil, 'disk_usage', lambda _: usage)
    with pytest.raises(SetupError, match=f'^{tmp_path}: 699 MB are free, and 700 MB are needed$'):
        preflight.check_space(tmp_path)


def test_a_checkout_of_somebody_else_is_said(tmp_path, monkeypatch):
    preflight.check_writable(Checkout(tmp_path))
    monkeypatch.setattr(os, 'access', lambda *_: False)
    with pytest.raises(SetupError, match=f'cannot write into {tmp_path}: it is read-only; make a'):
        preflight.check_writable(Checkout(tmp_path))
    monkeypatch.setattr(os, 'getuid', lambda: 4_000_000)
    with pytest.raises(SetupError, match="it is .*'s, and you are user 4000000; make a clone"):
        preflight.check_writable(Checkout(tmp_path))


def test_a_home_that_cannot_be_used_is_said(tmp_path, capsys):
    preflight.check_home({'HOME': str(tmp_path)})
    assert capsys.readouterr().err == ''
    preflight.check_home({})
    assert 'HOME is not set: ' in capsys.readouterr().err
    preflight.check_home({'HOME': '/proc/nowhere', 'ROS_LOG_DIR': '/tmp'})
    said = capsys.readouterr().err
    assert 'HOME=/proc/nowhere cannot be written to' in said
    assert 'ROS_LOG_DIR' not in said


@pytest.mark.parametrize(
    ('lines', 'cause'),
    [
        (
            ['Collecting a', 'ERROR: Could not install packages due to an OSError: [Errno 28] No '
             'space left on device: /x/y', 'more'],
            '[Errno 28] No space left on device: /x/y; 700 MB are needed',
        ),
        (
            ["WARNING: Retrying after connection broken by 'NewConnectionError(\"Failed: [Errno "
             "-3] Temporary failure in name resolution\")': /simple/a/",
             "ERROR: HTTPSConnectionPool(host='pypi.org', port=443): Max retries exceeded",
             'ERROR: Could not find a version that satisfies the requirement a==1 (from none)'],
            'cannot reach pypi.org: Temporary failure in name resolution; PIP_INDEX_URL names',
        ),
        (
            ["HTTPSConnectionPool(host='pypi.org', port=443): SSLError: [SSL: "
             'CERTIFICATE_VERIFY_FAILED] certificate verify failed'],
            'the certificate of pypi.org is not trusted here (CERTIFICATE_VERIFY_FAILED)',
        ),
        (
            ['ERROR: THESE PACKAGES DO NOT MATCH THE HASHES FROM THE REQUIREMENTS FILE.'],
            'a file of the index is not the one that the lock file has the hash of',
        ),
        (
            ['ERROR: Could not find a version that satisfies the requirement a==1 (from: 2)'],
            'the index has no a==1 for this Python and platform',
        ),
        (['x', 'no hint at all'], ''),
    ],
)  # fmt: skip
def test_the_first_cause_is_found(lines, cause):
    found = causes.first_cause(lines)
    assert found.startswith(cause)
    assert bool(found) == bool(cause)
    assert '\n' not in found


def test_a_command_that_fails_says_its_first_cause_alone():
    code = 'print("OSError: [Errno 28] No space left on device"); print("much more"); exit(1)'
    with pytest.raises(SetupError) as caught:
        run([sys.executable, '-c', code], os.environ, 'filling')
    assert str(caught.value).startswith('filling failed: [Errno 28] No space left on device; ')
    assert 'much more' not in str(caught.value)


def test_progress_counts(tmp_path):
    pins = [Pin('a', '1'), Pin('b', '1')]
    lines = ['Looking in indexes', 'Collecting a==1']
    assert virtual_environment._count(lines[:1], pins) == ''
    assert virtual_environment._count(lines, pins) == '1 of 2 packages fetched'
    lines += ['Collecting b==1', 'Installing collected packages: a, b']
    assert virtual_environment._count(lines, pins) == 'unpacking 2 packages'
    for name in ('a/unit_0.c', 'a/unit_1.cpp', 'a/unit_0.o', '_a_s.ep.x.c', 'a/other.c'):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).touch()
    assert interface_wheel._compiled(tmp_path) == '1 of 3 files compiled'
    for name in ('a/unit_1.o', '_a_s.ep.x.o'):
        (tmp_path / name).touch()
    assert interface_wheel._compiled(tmp_path) == 'linking'
    assert interface_wheel._compiled(tmp_path / 'a/nowhere') == ''


APT = """\
#!/bin/sh
case "$*" in
    *Lists=*update) exit 0 ;;
    *Lists=*) : >one.deb ;;
    *) echo 'E: Unable to locate package'; exit 100 ;;
esac
"""
DPKG = """\
#!/bin/sh
include=$3/usr/include/python3.99
mkdir -p "$include" "$3/usr/include/x86_64-linux-gnu/python3.99"
echo all >"$include/pyconfig.h"
echo header >"$include/Python.h"
echo ours >"$3/usr/include/x86_64-linux-gnu/python3.99/pyconfig.h"
mkdir -p "$3/usr/share/python-wheels" "$3/usr/share/ca-certificates/mozilla"
cp "$PIP_WHEEL" "$3/usr/share/python-wheels/pip-1.whl"
echo one >"$3/usr/share/ca-certificates/mozilla/1.crt"
"""


@pytest.fixture
def debian_system(tmp_path, monkeypatch):
    """The variables of a Debian whose apt has no lists yet, and whose Python is bare."""
    programs = tmp_path / 'programs'
    programs.mkdir()
    for name, text in (('apt-get', APT), ('dpkg-deb', DPKG)):
        (programs / name).write_text(text)
        (programs / name).chmod(0o755)
    monkeypatch.setenv('PATH', f'{programs}:{os.environ["PATH"]}')
    monkeypatch.setattr(debian, 'VERSION', 'python3.99')
    monkeypatch.setattr(debian, 'CERTIFICATES', tmp_path / 'none')
    monkeypatch.setattr(debian.importlib.util, 'find_spec', lambda _: None)
    monkeypatch.setattr(debian.sysconfig, 'get_path', lambda _: f'{tmp_path}/include')
    with zipfile.ZipFile(tmp_path / 'pip.whl', 'w') as wheel:
        wheel.writestr('pip/__main__.py', '')
        wheel.writestr('pip/_vendor/certifi/core.py', f"WHERE = '{debian.CERTIFICATES}'\n")
    wheel = str(tmp_path / 'pip.whl')
    return {'PATH': os.environ['PATH'], 'HOME': str(tmp_path), 'PIP_WHEEL': wheel}


def test_what_a_bare_debian_lacks_is_fetched_without_root(debian_system, tmp_path):
    lacks = debian.lacking()
    assert lacks == ['pip', 'Python.h']
    extras = debian.Extras(tmp_path / 'cache')
    extras.fetch(lacks, debian_system)
    extras.copy_headers(tmp_path / 'headers')
    assert (tmp_path / 'headers/pyconfig.h').read_text() == 'ours\n'
    assert (tmp_path / 'headers/Python.h').is_file()
    kept = sorted(path.name for path in (tmp_path / 'cache/debian-python3.99').iterdir())
    assert kept == ['Python.h', 'pip']


def test_pip_finds_certificates_where_the_system_has_none(debian_system, tmp_path):
    venv, packages = tmp_path / 'venv', virtual_environment.site_packages(tmp_path / 'venv')
    packages.mkdir(parents=True)
    (venv / 'bin').mkdir()
    python = virtual_environment.python_of(venv)
    python.write_text('#!/bin/sh\n')  # pip, which would write bin/pip
    python.chmod(0o755)
    extras = debian.Extras(tmp_path / 'cache')
    extras.fetch(['pip'], debian_system)
    extras.install_pip(venv, debian_system)
    found = runpy.run_path(str(packages / 'pip/_vendor/certifi/core.py'))['WHERE']
    assert found == f'{sys.prefix}/share/none'
    assert (venv / 'share/none').read_text() == 'one\n'


def test_where_apt_has_nothing_the_line_for_root_is_said(debian_system, tmp_path, monkeypatch):
    (tmp_path / 'programs/apt-get').write_text('#!/bin/sh\necho "E: no network"; exit 100\n')
    with pytest.raises(
        SetupError,
        match=r'^this Python lacks pip and Python.h: apt install python3\.1[1-4]-venv '
        r'python3\.1[1-4]-dev\n.*',
    ):
        debian.Extras(tmp_path / 'cache').fetch(['pip', 'Python.h'], debian_system)


def test_elsewhere_than_on_debian_nothing_is_fetched(debian_system, monkeypatch):
    monkeypatch.setenv('PATH', '/nowhere')
    assert debian.lacking() == []
