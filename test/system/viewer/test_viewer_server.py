# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The node viewer against foreign clients and malformed input; real sockets, no robots."""

from contextlib import ExitStack, suppress
import http.client
from pathlib import Path
import re
import signal
import socket
import sys
from urllib.parse import urlsplit

import pytest
from rcl_interfaces.msg import Log
import rclpy
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from support.page import deaf, kept_port, open_socket, Page
from support.running_programs import PATIENCE, Program
from websockets.exceptions import InvalidHandshake, InvalidStatus

from amr_description.ros.service_calls import wait_until
from amr_description.viewer.pages import MOST_PAGES

URL = re.compile(r'The page is at (http://\S+)')
ROSOUT = QoSProfile(depth=1000, durability=DurabilityPolicy.TRANSIENT_LOCAL)
MOST_HELD = 110 if sys.version_info >= (3, 12) else 290
"""Answers in memory of 300 unread ones; before 3.12 asyncio copies each, and holes are left."""
DRIVE = '{"type": "drive", "robot": "/", "linear": 0.1, "angular": 0}'


def viewer(*parameters):
    """The node, by default on any port."""
    words = [word for each in parameters or ('port:=0',) for word in ('-p', each)]
    return Program.module('viewer', '--ros-args', *words)


def url_of(program):
    return program.expect(URL)[1]


@pytest.fixture(scope='module')
def program():
    with viewer() as program:
        url_of(program)
        yield program
        assert program.end(signal.SIGINT) == 0
        assert len(program.lines) == 1, program.output  # where the page is, and nothing else


@pytest.fixture(scope='module')
def url(program):
    return url_of(program)


@pytest.fixture
def page(url):
    """A page that is open all the time; it must come to no harm."""
    with Page(url) as page:
        page.wait(lambda: page.last('graph'))
        yield page
        reply = page.ask('pause', 999, simulator='/nobody')
        assert not reply['ok']


def ask(url, method='GET', path='/', **headers):
    """Status, headers and body of the answer."""
    parts = urlsplit(url)
    connection = http.client.HTTPConnection(parts.hostname, parts.port, timeout=PATIENCE)
    connection.putrequest(method, path, skip_host='Host' in headers)
    for name, value in headers.items():
        connection.putheader(name.replace('_', '-'), value)
    connection.endheaders()
    answer = connection.getresponse()
    body = answer.read()
    connection.close()
    is_text = answer.headers['Content-Encoding'] is None and path != '/main.js'
    return answer.status, answer.headers, body.decode() if is_text else body


def address(url):
    parts = urlsplit(url)
    return parts.hostname, parts.port


def test_a_page_is_greeted_and_told_that_nothing_is_there(page):
    hello, graph = page.messages[0], page.last('graph')
    assert (hello['type'], hello['drive_timeout']) == ('hello', 0.4)
    assert graph['robots'] == []
    assert graph['hint'].startswith('nothing publishes /robot_description')
    assert 'start' in graph['hint']


def test_the_page_lets_a_browser_ask_nobody_else(url):
    status, headers, _ = ask(url)
    assert status == 200
    policy = dict(each.split(' ', 1) for each in headers['Content-Security-Policy'].split('; '))
    assert policy['default-src'] == policy['frame-ancestors'] == "'none'"
    assert policy['script-src'] == "'self'"
    assert not any('http' in each or '*' in each or 'unsafe' in each for each in policy.values())
    assert headers['X-Content-Type-Options'] == 'nosniff'
    assert headers['Cross-Origin-Resource-Policy'] == 'same-origin'


def test_what_the_browser_has_is_not_sent_again(url):
    _, headers, body = ask(url)
    assert headers['Content-Type'] == 'text/html; charset=utf-8'
    status, _, again = ask(url, If_None_Match=headers['ETag'])
    assert (status, again) == (304, '')
    assert ask(url, If_None_Match='"old"')[2] == body


@pytest.mark.parametrize(
    ('accepted', 'encoding'),
    [
        ('gzip, deflate, br, zstd', 'br'),
        ('gzip, deflate', 'gzip'),
        ('br;q=0, gzip;q=0.5', 'gzip'),
        ('identity', None),
    ],
)
def test_the_page_is_compressed_as_the_browser_takes_it(url, accepted, encoding):
    _, headers, body = ask(url, path='/main.js', Accept_Encoding=accepted)
    assert headers['Content-Encoding'] == encoding
    assert headers['Vary'] == 'Accept-Encoding'
    assert int(headers['Content-Length']) == len(body)
    status, _, again = ask(
        url, path='/main.js', Accept_Encoding=accepted, If_None_Match=headers['ETag']
    )
    assert (status, again) == (304, b'')


@pytest.mark.parametrize(
    'path',
    [
        '/nothing', '/index.htm', '/../server.py', '/static/../server.py', '/..%2fserver.py',
        '/%2e%2e/server.py', '/%2e%2e%2f%2e%2e%2ferrors.py', '//etc/passwd', '/mesh/',
        '/mesh/x.stl',
        '/mesh/../server.py', '/mesh/%2fetc%2fpasswd', '/ws/', '/server.py', '/%00', '/%ff',
        'http://127.0.0.1/nothing', '*',
    ],
)  # fmt: skip
def test_what_is_not_there_is_404(url, path):
    status, _, body = ask(url, path=path)
    assert status == 404
    assert 'there is no' in body


@pytest.mark.parametrize('method', ['POST', 'PUT', 'DELETE', 'OPTIONS', 'HEAD'])
def test_only_get_is_served(url, method):
    assert ask(url, method)[0] in (400, 405)


@pytest.mark.parametrize('path', ['/', '/ws', '/mesh/x.stl'])
@pytest.mark.parametrize(
    ('headers', 'status', 'text'),
    [
        ({'Host': 'evil.example'}, 421, "not 'evil.example'"),
        ({'Origin': 'http://evil.example'}, 403, "page of 'http://evil.example'"),
        ({'Origin': 'null'}, 403, "page of 'null'"),
    ],
)
def test_strangers_are_refused_everywhere(url, path, headers, status, text):
    found, _, body = ask(url, path=path, **headers)
    assert (found, text in body) == (status, True)


@pytest.mark.parametrize('name', ['Host', 'Origin', 'Cookie'])
def test_of_two_headers_none_is_believed(url, name):
    host = urlsplit(url).netloc
    own = {'Host': host, 'Origin': f'http://{host}', 'Cookie': 'a=b'}[name]
    lines = ['GET / HTTP/1.1', *[f'Host: {host}'] * (name != 'Host'), *[f'{name}: {own}'] * 2]
    with socket.create_connection(address(url), PATIENCE) as client:
        client.sendall('\r\n'.join([*lines, '', '']).encode())
        answer = b''.join(iter(lambda: client.recv(65536), b'')).decode()
    assert answer.startswith('HTTP/1.1 400 ')
    assert answer.endswith(f'the request has more than one {name}\n')


@pytest.mark.parametrize('origin', ['http://evil.example', 'null', 'http://localhost:1'])
def test_a_foreign_page_gets_no_socket(url, page, origin):
    with pytest.raises(InvalidStatus, match='403'):
        Page(url, origin=origin)


def test_the_own_page_gets_one(url):
    with Page(url, origin=url.rstrip('/')) as page:
        assert page.wait(lambda: page.last('hello'))


@pytest.mark.parametrize('subprotocols', [None, ['amr.v0'], ['chat']])
def test_a_page_of_another_version_is_refused(url, page, subprotocols):
    with pytest.raises(InvalidHandshake, match='400'), open_socket(url, subprotocols):
        pass


@pytest.mark.parametrize(
    ('frame', 'code', 'text'),
    [
        ('{', 1008, 'no JSON'),
        ('{"type": "fly"}', 1008, 'is not known'),
        ('[' * 60_000, 1008, 'no JSON'),
        (DRIVE.replace('0.1', 'NaN'), 1008, 'linear'),
        (b'\xff\x00', 1008, 'binary'),
        ('x' * 1_100_000, 1009, ''),
        ('{"a": "' + 'é' * 10_000_000 + '"}', 1009, ''),
    ],
)
def test_who_sends_rubbish_is_shown_the_door(url, page, frame, code, text):
    with Page(url) as client:
        with ExitStack() as stack:
            if code == 1009:  # it may be shut while we still send
                stack.enter_context(pytest.raises(Exception, match='1009|reset|pipe'))
                client.socket.send(frame)
                client.wait_closed()
                client.socket.send(frame)
            else:
                client.socket.send(frame)
        found, reason = client.wait_closed()
        assert (found, text in reason) == (code, True)


@pytest.mark.parametrize(
    'bytes_sent',
    [
        b'\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03' + bytes(range(256)),
        b'GET / HTTP/1.1\r\nHost: ' + b'x' * 20_000 + b'\r\n\r\n',
        b'GET / HTTP/1.1\r\n' + b'A: b\r\n' * 1000 + b'\r\n',
        b'GET /' + b'a' * 100_000 + b' HTTP/1.1\r\n\r\n',
        b'\r\n\r\n\r\n',
        b'GET / HTTP/0.9\r\n\r\n',
        'GET /é HTTP/1.1\r\nHost: localhost\r\n\r\n'.encode(),
    ],
)
def test_bytes_that_are_no_request_end_the_connection(url, page, bytes_sent):
    with socket.create_connection(address(url), PATIENCE) as client:
        try:
            client.sendall(bytes_sent)
            while client.recv(65536):
                pass
        except ConnectionError:
            pass


def test_frames_that_are_none_end_the_connection(url, page):
    with Page(url) as client:
        client.socket.socket.sendall(bytes(range(200, 256)) * 50)
        assert client.wait_closed()[0] in (1002, 1006)


def test_two_hundred_idle_sockets_keep_nobody_out(url, page):
    with ExitStack() as stack:
        idle = [
            stack.enter_context(socket.create_connection(address(url), PATIENCE))
            for _ in range(200)
        ]
        assert ask(url, path='/nothing')[0] == 404
        with Page(url) as another:
            another.wait(lambda: another.last('hello'))
        idle[0].settimeout(PATIENCE)
        with suppress(ConnectionError):
            assert idle[0].recv(1) == b''  # the oldest had to go


def resident(program):
    """MB of memory."""
    status = Path(f'/proc/{program.process.pid}/status').read_text()
    return int(re.search(r'VmRSS:\s+(\d+)', status)[1]) / 1024


def test_who_reads_no_answer_costs_no_more_than_some_that_do(program, url, page):
    size = len(ask(url, path='/main.js', Accept_Encoding='identity')[2]) / 2**20
    before = peak = resident(program)
    with ExitStack() as stack:
        unread = []
        for _ in range(300):
            each = stack.enter_context(socket.socket())
            each.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
            each.settimeout(PATIENCE)
            each.connect(address(url))
            each.sendall(b'GET /main.js HTTP/1.1\r\nHost: localhost\r\n\r\n')
            each.recv(1)  # it is being answered
            unread.append(each)
            peak = max(peak, resident(program))
        assert ask(url, path='/main.js')[0] == 200
        assert peak - before < MOST_HELD * size, 'of 300 answers'
        assert complete(unread[-1])
        assert not complete(unread[0]), 'the oldest had to go'


def complete(client):
    """Whether the rest of an answer comes."""
    try:
        with client.makefile('rb') as stream:
            return len(stream.read()) > 100_000
    except ConnectionError:
        return False


def test_too_many_pages_are_told_why(url, page):
    with ExitStack() as stack:
        for _ in range(MOST_PAGES - 1):
            stack.enter_context(Page(url))
        refused = stack.enter_context(Page(url))
        assert refused.wait_closed() == (
            1013, f'{MOST_PAGES} pages are open already; close one of them first'
        )  # fmt: skip


def test_who_never_reads_is_no_burden(url, page):
    """Neither his states nor his answers keep another page waiting."""
    with deaf(url):
        for number in range(200):
            assert page.ask('pause', number, simulator='/nobody')['id'] == number


def test_requests_to_what_is_not_there_are_answered(page):
    requests = [
        ('play', {'simulator': '/sim'}, "there is no simulator '/sim'; there are: none"),
        ('switch', {'robot': '/r', 'activate': [], 'deactivate': []}, "there is no robot '/r'"),
        (
            'spawn',
            {'simulator': '/s', 'name': 'a', 'namespace': '/a', 'position': [0, 0, 0], 'yaw': 0,
             'like': '/'},
            "there is no simulator '/s'",
        ),
    ]  # fmt: skip
    for number, (kind, fields, text) in enumerate(requests):
        reply = page.ask(kind, number, **fields)
        assert (reply['ok'], text in reply['message']) == (False, True)


def test_driving_what_is_not_there_is_told_once_in_a_while(page):
    for _ in range(50):
        page.socket.send(DRIVE)
    page.ask('pause', 1, simulator='/nobody')
    notices = [each['text'] for each in page.of('notice')]
    assert set(notices) == {"there is no robot '/'; there are: none"}
    assert len(notices) < 50
    page.say('stop', robot=None)
    page.say('stop', robot='/')


def test_too_many_questions_at_once_are_refused(page):
    for number in range(1000):
        page.say('pause', id=number, simulator='/nobody')
    page.wait(lambda: len(page.of('reply')) == 1000)


@pytest.mark.parametrize(
    ('parameter', 'text'),
    [
        ("allowed_origins:=['*']", r"'\*' is no origin, such as https://hub\.example"),
        ('host:=192.0.2.1', r'cannot listen on 192\.0\.2\.1:'),
        ('port:=-1', 'port'),
    ],
)
def test_what_cannot_be_served_is_one_line(parameter, text):
    with viewer(parameter) as program:
        assert program.end() == 1
        (line,) = program.lines
        assert re.search(text, line)


@pytest.mark.parametrize('parameter', ['host:=0.0.0.0', 'token:=true'])
def test_elsewhere_or_if_asked_only_who_has_the_address_may(parameter):
    with viewer(parameter, 'port:=0') as program:
        parts = urlsplit(url_of(program))
        assert parts.query.startswith('token=')
        here = f'http://127.0.0.1:{parts.port}/'
        status, _, body = ask(here)
        assert (status, 'lacks its token' in body) == (403, True)
        with pytest.raises(InvalidStatus, match='403'):
            Page(here)
        status, headers, _ = ask(here, path='/nothing?' + parts.query)
        assert status == 404
        status, headers, _ = ask(here, path='/?' + parts.query)
        cookie = headers['Set-Cookie'].partition(';')[0]
        with Page(here, additional_headers={'Cookie': cookie}) as page:
            page.wait(lambda: page.last('hello'))
        assert program.end(signal.SIGINT) == 0


def test_the_secret_of_the_address_is_on_the_terminal_alone(tmp_path):
    variables = {'ROS_LOG_DIR': str(tmp_path)}
    words = ('--ros-args', '-p', 'host:=0.0.0.0', '-p', 'port:=0')
    rclpy.init(args=[])
    try:
        node, said = Node('reader'), []
        node.create_subscription(Log, '/rosout', lambda message: said.append(message.msg), ROSOUT)
        with Program.module('viewer', *words, env=variables) as program:
            parts = urlsplit(url_of(program))
            secret = parts.query.partition('=')[2]
            (line,) = wait_until(
                node,
                lambda: [each for each in said if f':{parts.port}/' in each] or None,
                timeout=PATIENCE,
            )
            assert program.end(signal.SIGINT) == 0
        node.destroy_node()
    finally:
        rclpy.try_shutdown()
    assert line.endswith('/, for those who have its secret, which stdout has')
    assert len(secret) == 24
    logs = ''.join(path.read_text() for path in tmp_path.rglob('*') if path.is_file())
    assert 'The page is at' in logs
    assert secret not in logs + ''.join(said)


def test_it_ends_with_pages_and_strangers_connected_and_pages_come_back_to_the_next():
    with kept_port() as port:
        with viewer(f'port:={port}') as program:
            url = url_of(program)
            with Page(url) as page, socket.create_connection(address(url)):
                page.wait(lambda: page.last('graph'))
                assert program.end(signal.SIGTERM) == 0
                assert page.wait_closed() == (1012, 'the viewer has ended')
            assert len(program.lines) == 1, program.output
        with viewer(f'port:={port}') as program:
            assert url_of(program) == url
            with Page(url) as page:
                assert page.wait(lambda: page.last('hello'))['client'] == 'page 1'
                assert program.end(signal.SIGHUP) == 0
