# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The page's server over a backend that knows no ROS: slow pages, failures, who hears what."""

from contextlib import contextmanager
from queue import SimpleQueue
import re
import socket
from urllib.error import HTTPError
from urllib.parse import urlsplit
from urllib.request import urlopen

import pytest
from support.page import deaf, Page
from support.running_programs import PATIENCE

from amr_description.errors import ViewerError
from amr_description.viewer.protocol import Driver, Notice, TimeReset
from amr_description.viewer.server import Server, Settings, STATIC

LARGE = bytes(500_000)


class Backend:
    """Robots that are written down."""

    def __init__(self):
        self.calls = []
        self.new = ()
        self.frame = None

    def opened(self):
        self.calls.append('opened')

    def closed(self):
        self.calls.append('closed')

    def state(self):
        new, self.new = self.new, ()
        if isinstance(new, Exception):
            raise new
        return new, self.frame

    def robots(self):
        return ['/']

    def drive(self, robot, linear, angular):
        if robot != '/':
            raise ViewerError(f'there is no robot {robot}')
        self.calls.append((linear, angular))

    def set_joints(self, robot, positions):
        self.calls.append(positions)

    async def answer(self, request):
        if request.simulator == 'broken':
            raise ZeroDivisionError('oh')
        return f'{request.type} is done'

    def mesh(self, name):
        return None


@contextmanager
def serving(backend, static=STATIC, **settings):
    """A server on any port, and what it has to complain of."""
    said = SimpleQueue()
    server = Server(Settings(**{'port': 0} | settings), backend, said.put, static)
    server.start()
    server.said = said
    try:
        yield server
    finally:
        server.stop()


@pytest.fixture
def backend():
    return Backend()


@pytest.fixture
def server(backend):
    with serving(backend) as server:
        yield server
    assert server.said.empty()


def test_a_port_that_is_taken_is_passed_over(backend):
    with socket.create_server(('127.0.0.1', 0)) as taken:
        port = taken.getsockname()[1]
        with serving(backend, port=port) as server, Page(server.url) as page:
            assert port < urlsplit(server.url).port <= port + 20
            page.wait(lambda: page.last('hello'))


@pytest.mark.parametrize('host', ['192.0.2.1', 'no such host'])
def test_where_it_cannot_listen_is_told(backend, host):
    told = f'cannot listen on {re.escape(host)}:8080: .* -p host:='
    with pytest.raises(ViewerError, match=told):
        Server(Settings(host=host), backend, print)


def test_a_page_that_does_not_read_is_spared_states_and_others_get_them_all(backend, server):
    with deaf(server.url), Page(server.url) as page:
        backend.frame = LARGE
        page.wait(lambda: len(page.states) > 60)  # 30 MB: far more than sockets hold
        waiting = {each.name: each.waiting for each in server._pages._pages.values()}
        assert waiting.keys() == {'page 1', 'page 2'}
        assert 0 < waiting['page 1'] <= len(LARGE) + 32 * 1024


def test_no_old_states_wait_for_a_page_that_reads_late(backend):
    """Neither here nor in the system, which would take 4 MB."""
    with serving(backend, rate=240.0) as server, deaf(server.url) as late:
        late.settimeout(PATIENCE)
        with Page(server.url) as page:
            backend.frame = bytes(10_000)
            page.wait(lambda: len(page.states) > 200)  # 2 MB
            backend.frame = None
        late.shutdown(socket.SHUT_WR)
        read = sum(map(len, iter(lambda: late.recv(65536), b'')))
        assert read < 500_000


def test_a_page_that_lets_too_much_else_wait_is_dropped(server):
    with deaf(server.url), Page(server.url) as page:
        for count in range(30):  # 120 MB
            server.show('all', Notice('info', str(count) + 'x' * 4_000_000))
            page.wait(lambda count=count: len(page.of('notice')) > count)
        page.ask('play', 1, simulator='/s')
        assert [*server._pages._pages] == ['page 2']


def test_the_backend_is_told_when_somebody_looks(backend, server):
    assert backend.calls == []
    with Page(server.url) as first, Page(server.url) as second:
        for page in (first, second):
            page.wait(lambda page=page: page.last('hello'))
        assert backend.calls == ['opened']
    with Page(server.url) as page:
        page.wait(lambda: page.last('hello'))
        assert backend.calls == ['opened', 'closed', 'opened']


def test_who_comes_late_hears_the_last_word_of_each_subject(server):
    with Page(server.url) as first:
        for subject, client in (('/a', 'x'), ('/b', 'y'), ('/a', None), ('/c', 'z')):
            server.show(subject, Driver(subject, client))
        server.forget(['/a', '/b'])
        first.wait(lambda: len(first.of('driver')) == 4)
        with Page(server.url) as late:
            late.ask('play', 1, simulator='/s')
            assert [(d['robot'], d['client']) for d in late.of('driver')] == [
                ('/a', None), ('/b', 'y')
            ]  # fmt: skip


def test_the_same_word_is_not_said_twice(server):
    with Page(server.url) as page:
        for client in ('x', 'x', 'y', 'y', 'x'):
            server.show('/', Driver('/', client))
        page.wait(lambda: len(page.of('driver')) == 3)
        page.ask('play', 1, simulator='/s')
        assert [each['client'] for each in page.of('driver')] == ['x', 'y', 'x']


def test_a_reset_is_news_and_nothing_to_be_remembered(backend, server):
    with Page(server.url) as first:
        first.wait(lambda: first.last('hello'))
        backend.new = (TimeReset(0.0),)
        first.wait(lambda: first.last('reset'))
        with Page(server.url) as late:
            late.ask('play', 1, simulator='/s')
            assert late.last('reset') is None


def test_a_fault_of_ours_is_an_answer_and_a_line_of_the_log(backend):
    with serving(backend) as server:
        with Page(server.url) as page:
            reply = page.ask('play', 1, simulator='broken')
            assert (reply['ok'], reply['message']) == (
                False, 'the viewer failed: ZeroDivisionError: oh'
            )  # fmt: skip
            assert page.ask('play', 2, simulator='/s')['ok']
            backend.new = KeyError('gone')
            lines = [server.said.get(timeout=PATIENCE) for _ in range(2)]
        assert 'ZeroDivisionError: oh' in lines[0]
        assert lines[1] == "no more states are sent: KeyError: 'gone'"


def test_a_drive_that_cannot_be_takes_no_wheel(backend, server):
    with Page(server.url) as page:
        page.say('drive', robot='/gone', linear=1.0, angular=0.0)
        assert page.wait(lambda: page.last('notice'))['text'] == 'there is no robot /gone'
        assert page.last('driver') is None


def test_a_stop_of_what_is_not_there_is_told_to_who_asked(backend, server):
    with Page(server.url) as asker, Page(server.url) as other:
        asker.say('stop', robot='/gone')
        assert asker.wait(lambda: asker.last('notice'))['text'] == 'there is no robot /gone'
        asker.say('stop', robot=None)
        other.ask('play', 1, simulator='/s')
        assert (other.last('notice'), other.of('driver')) == (None, [
            {'type': 'driver', 'robot': '/', 'client': None, 'stopped': None}
        ])  # fmt: skip


def test_sliders_go_through(backend, server):
    with Page(server.url) as page:
        page.say('set_joints', robot='/', positions={'a': 1, 'b': -0.5})
        page.ask('play', 1, simulator='/s')
        assert backend.calls[-1] == {'a': 1.0, 'b': -0.5}


def test_a_driver_of_a_server_that_ends_is_stopped(backend):
    with serving(backend) as server, Page(server.url) as page:
        page.say('drive', robot='/', linear=1.0, angular=0.5)
        page.wait(lambda: (1.0, 0.5) in backend.calls)
        server.stop()
        assert backend.calls[-2:] == [(0.0, 0.0), 'closed']


def test_a_page_that_is_not_built_says_how_to_build_it(tmp_path):
    with serving(Backend(), static=tmp_path) as server:
        with pytest.raises(HTTPError, match='503') as refused:
            urlopen(server.url, timeout=PATIENCE)
        with refused.value as answer:
            assert 'npm ci && npm run build' in answer.read().decode()
