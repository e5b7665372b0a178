# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The page's server with a backend without ROS: slow pages, failures, latched messages."""

import asyncio
from contextlib import contextmanager
from functools import partial
import gc
from queue import SimpleQueue
import re
import socket
import threading
from urllib.error import HTTPError
from urllib.parse import urlsplit
from urllib.request import urlopen

import pytest
from support.page import deaf, Page
from support.running_programs import PATIENCE

from amr_description.errors import ViewerError
from amr_description.viewer.backend import Answer
from amr_description.viewer.protocol import Driver, Graph, Notice, TimeReset
from amr_description.viewer.samples import Sample
from amr_description.viewer.server import Server, ServerSettings, STATIC

LARGE = bytes(500_000)


class Backend:
    """One robot; records the calls."""

    def __init__(self):
        self.handlers = self
        self.calls = []
        self.joints_are_moved = False
        self.new = ()
        self.frame = None
        self.samples = []
        self.wanted = []

    def open(self):
        self.calls.append('open')

    def close(self):
        self.calls.append('close')

    def watch(self, watched):
        self.calls.append([*sorted(watched.parts), *sorted(watched.sensors)])

    def take_samples(self, wanted):
        self.wanted.append(wanted)
        new, self.samples = self.samples, []
        return [each for each in new if (each.channel, each.topic) in wanted]

    def take_state(self):
        new, self.new = self.new, ()
        if isinstance(new, Exception):
            raise new
        return new, self.frame

    def robots(self):
        return ['/']

    def drive(self, robot, linear, angular, sideways=0.0):
        if robot != '/':
            raise ViewerError(f'there is no robot {robot}')
        self.calls.append((linear, angular, sideways) if sideways else (linear, angular))

    def push(self, simulator, entity, link, force, torque):
        if simulator != '/sim':
            raise ViewerError(f'there is no simulator {simulator}')
        self.calls.append(('push', entity, link, force))

    def hold_joints(self, robot):
        if self.joints_are_moved:
            self.calls.append(f'hold {robot}')

    def set_joints(self, robot, positions):
        self.calls.append(positions)

    async def carry_out(self, request, page):
        if request.simulator == 'broken':
            raise ZeroDivisionError('oh')
        return Answer(f'{request.type} is done')

    def forget(self, page):
        pass

    def latest(self, part):
        return None

    def mesh(self, name):
        return None


@contextmanager
def serving(backend, static=STATIC, **settings):
    """A server on any port; ``logged`` has the errors that it logs."""
    logged = SimpleQueue()
    server = Server(ServerSettings(**{'port': 0} | settings), backend, logged.put, static)
    server.start()
    server.logged = logged
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
    assert server.logged.empty()


def test_what_is_called_while_the_server_ends_starts_nothing(backend):
    """ROS calls until it has ended, too: a task that is left over is an error in the log."""
    with serving(backend) as server:
        loop = server._loop
        shut_down = loop.shutdown_default_executor

        async def late():
            server.call(lambda: loop.create_task(asyncio.sleep(PATIENCE)))
            await asyncio.sleep(0)
            await shut_down()

        loop.shutdown_default_executor = late
    gc.collect()
    assert server.logged.empty(), server.logged.get()


def test_a_port_that_is_in_use_is_skipped(backend):
    with socket.create_server(('127.0.0.1', 0)) as taken:
        port = taken.getsockname()[1]
        with serving(backend, port=port) as server, Page(server.url) as page:
            assert port < urlsplit(server.url).port <= port + 20
            page.wait(lambda: page.last('hello'))


@pytest.mark.parametrize('host', ['192.0.2.1', 'no such host'])
def test_an_address_that_cannot_be_bound_is_named(backend, host):
    message = f'cannot listen on {re.escape(host)}:8080: .* -p host:='
    with pytest.raises(ViewerError, match=message):
        Server(ServerSettings(host=host), backend, print)


def test_a_page_that_does_not_read_gets_no_states_and_others_get_all(backend, server):
    with deaf(server.url), Page(server.url) as page:
        backend.frame = LARGE
        page.wait(lambda: len(page.states) > 60)  # 30 MB: far more than sockets hold
        buffered = {each.name: each.buffered for each in server.pages._pages.values()}
        assert buffered.keys() == {'page 1', 'page 2'}
        assert 0 < buffered['page 1'] <= len(LARGE) + 32 * 1024


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


def test_a_page_with_too_large_a_write_buffer_is_disconnected(server):
    with deaf(server.url), Page(server.url) as page:
        for count in range(30):  # 120 MB
            notice = Notice('info', str(count) + 'x' * 4_000_000)
            server.call(partial(server.pages.send_message, notice))
            page.wait(lambda count=count: len(page.of('notice')) > count)
        page.ask('play', 1, simulator='/s')
        assert [*server.pages._pages] == ['page 2']


def test_a_page_that_reads_late_gets_the_newest_of_what_is_and_all_that_has_happened(server):
    """30 graphs of 4 MB are more than a buffer may hold; who was stopped has to be said."""
    with deaf(server.url) as late, Page(server.url) as page:
        for count in range(30):
            graph = Graph((), (), str(count) + 'x' * 4_000_000)
            server.call(partial(server.pages.publish, '', graph))
            server.call(partial(server.pages.publish, '/', Driver('/', f'page {count}')))
            page.wait(lambda count=count: len(page.of('driver')) > count)
        late.settimeout(PATIENCE)
        read = bytearray()
        while b'"hint":"29x' not in read[-5_000_000:]:
            read += late.recv(1 << 20)
    assert len(re.findall(rb'"hint":"\d+x', read)) < 10
    assert len(re.findall(rb'"type":"driver"', read)) == 30


def test_the_backend_is_open_while_there_are_pages(backend, server):
    assert backend.calls == []
    with Page(server.url) as first, Page(server.url) as second:
        for page in (first, second):
            page.wait(lambda page=page: page.last('hello'))
        assert backend.calls == ['open']
    with Page(server.url) as page:
        page.wait(lambda: page.last('hello'))
        assert backend.calls == ['open', 'close', 'open']


def test_the_backend_watches_what_any_page_shows(backend, server):
    with Page(server.url) as first, Page(server.url) as second:
        for number, (page, parts) in enumerate(
            [(first, ['wheels']), (second, ['wheels']), (first, [])]
        ):
            page.say('watch', parts=parts)
            page.ask('play', number, simulator='/s')
        assert backend.calls == ['open', ['wheels']]
    with Page(server.url) as page:  # a new one shows nothing yet
        page.ask('play', 1, simulator='/s')
        assert backend.calls == ['open', ['wheels'], [], 'close', 'open']


def test_sensors_that_two_pages_show_are_heard_until_neither_does(backend, server):
    with Page(server.url) as first, Page(server.url) as second:
        for number, (page, topics) in enumerate(
            [(first, ['/scan']), (second, ['/scan', '/image']), (second, ['/scan']), (first, [])]
        ):
            page.say('watch', parts=[], topics=topics)
            page.ask('play', number, simulator='/s')
        assert backend.calls == ['open', ['/scan'], ['/image', '/scan'], ['/scan']]
        second.close()
        first.ask('play', 9, simulator='/s')
        assert backend.calls[-1] == []


def test_a_sample_goes_to_the_pages_that_show_it_and_to_one_that_comes_to(backend, server):
    with Page(server.url) as first, Page(server.url) as second:
        first.say('watch', parts=[], topics=['/scan'])
        first.ask('play', 1, simulator='/s')
        backend.samples = [Sample('/scan', b'a scan')]
        first.wait(lambda: first.states == [b'a scan'])
        second.say('watch', parts=[], topics=['/image', '/scan'])
        second.wait(lambda: second.states == [b'a scan'])
        second.say('watch', parts=[], topics=['/image'])
        second.ask('play', 2, simulator='/s')
        backend.samples = [Sample('/scan', b'two'), Sample('/image', b'one')]
        second.wait(lambda: second.states == [b'a scan', b'one'])
        first.wait(lambda: first.states == [b'a scan', b'two'])


def test_without_pages_that_show_sensors_nobody_is_asked_for_samples(backend, server):
    with Page(server.url) as page:
        page.say('watch', parts=['wheels'])
        backend.frame = bytes(16)
        page.wait(lambda: len(page.states) > 10)
    assert backend.wanted == []


class Camera(Backend):
    """Has a new picture whenever a page can take one."""

    def __init__(self):
        super().__init__()
        self.count = 0

    def take_samples(self, wanted):
        self.wanted.append(wanted)
        if ('sensor', '/image') not in wanted:
            return []
        self.count += 1
        return [Sample('/image', self.count.to_bytes(4) + LARGE)]


def test_a_page_that_does_not_read_makes_no_queue_of_pictures():
    """One picture is on its way to it, one waits, the newest; others get all."""
    camera = Camera()
    with serving(camera) as server, deaf(server.url) as late, Page(server.url) as page:
        late.sendall(masked(b'{"type":"watch","parts":[],"topics":["/image"]}'))
        page.wait(lambda: len(camera.calls) > 1)
        page.say('watch', parts=[], topics=['/image'])
        page.wait(lambda: len(page.states) > 40)  # 20 MB
        pages = {each.name: each for each in server.pages._pages.values()}
        behind = pages['page 1']
        assert 0 < behind.buffered <= len(LARGE) + 32 * 1024
        assert len(behind.waiting) == 1
        assert int.from_bytes(behind.waiting['sensor', '/image'][:4]) > 30
        assert len(server.pages._samples) == 1
    assert server.logged.empty()


def test_nothing_is_made_for_pages_that_are_all_slow():
    camera = Camera()
    with serving(camera) as server, deaf(server.url) as late, Page(server.url) as page:
        late.sendall(masked(b'{"type":"watch","parts":[],"topics":["/image"]}'))
        page.wait(lambda: len(camera.wanted) > 20)
        made = camera.count
        page.wait(lambda: len(camera.wanted) > 60)
        assert camera.count == made
        assert camera.wanted[-1] == frozenset()


def masked(text):
    """A text frame of a page, of at most 125 bytes, masked by zeros."""
    return bytes([0x81, 0x80 | len(text), 0, 0, 0, 0]) + text


def test_a_page_that_watches_what_there_is_not_is_refused_in_one_line(backend, server):
    with Page(server.url) as page:
        page.say('watch', parts=['wheels', 'sky'])
        assert page.wait_closed() == (1008, "'parts' of 'watch' cannot be ['wheels', 'sky']")
    assert ['wheels'] not in backend.calls


def test_a_late_page_gets_the_latched_message_of_each_subject(server):
    with Page(server.url) as first:
        first.wait(lambda: first.last('hello'))  # else it would be a late one, too
        for subject, client in (('/a', 'x'), ('/b', 'y'), ('/a', None), ('/c', 'z')):
            server.call(partial(server.pages.publish, subject, Driver(subject, client)))
        server.call(partial(server.pages.retain, ['/a', '/b']))
        first.wait(lambda: len(first.of('driver')) == 4)
        with Page(server.url) as late:
            late.ask('play', 1, simulator='/s')
            assert [(d['robot'], d['client']) for d in late.of('driver')] == [
                ('/a', None), ('/b', 'y')
            ]  # fmt: skip


def test_an_equal_message_is_not_published_again(server):
    with Page(server.url) as page:
        page.wait(lambda: page.last('hello'))  # a later one is sent the latest alone
        for client in ('x', 'x', 'y', 'y', 'x'):
            server.call(partial(server.pages.publish, '/', Driver('/', client)))
        page.wait(lambda: len(page.of('driver')) == 3)
        page.ask('play', 1, simulator='/s')
        assert [each['client'] for each in page.of('driver')] == ['x', 'y', 'x']


def test_a_reset_is_not_latched(backend, server):
    with Page(server.url) as first:
        first.wait(lambda: first.last('hello'))
        backend.new = (TimeReset(0.0),)
        first.wait(lambda: first.last('reset'))
        with Page(server.url) as late:
            late.ask('play', 1, simulator='/s')
            assert late.last('reset') is None


def test_a_bug_is_a_reply_and_a_line_of_the_log(backend):
    with serving(backend) as server:
        with Page(server.url) as page:
            reply = page.ask('play', 1, simulator='broken')
            assert (reply['ok'], reply['message']) == (
                False, 'the viewer failed: ZeroDivisionError: oh'
            )  # fmt: skip
            assert page.ask('play', 2, simulator='/s')['ok']
            backend.new = KeyError('gone')
            lines = [server.logged.get(timeout=PATIENCE) for _ in range(2)]
        assert 'ZeroDivisionError: oh' in lines[0]
        assert lines[1] == "no more states are sent: KeyError: 'gone'"


def test_a_drive_of_an_unknown_robot_takes_no_lock(backend, server):
    with Page(server.url) as page:
        page.say('drive', robot='/gone', linear=1.0, angular=0.0)
        assert page.wait(lambda: page.last('notice'))['text'] == 'there is no robot /gone'
        assert page.last('driver') is None


def test_a_stop_of_an_unknown_robot_is_reported_to_the_page_that_asked(backend, server):
    with Page(server.url) as asker, Page(server.url) as other:
        asker.say('stop', robot='/gone')
        assert asker.wait(lambda: asker.last('notice'))['text'] == 'there is no robot /gone'
        asker.say('stop', robot=None)
        asker.ask('play', 1, simulator='/s')  # the stop came before that
        other.ask('play', 1, simulator='/s')
        assert (other.last('notice'), other.of('driver')) == (None, [
            {'type': 'driver', 'robot': '/', 'client': None, 'stopped': None}
        ])  # fmt: skip


def test_a_page_that_is_late_with_its_key_must_let_go_after_the_stop_of_another(backend, server):
    """Where a busy browser stalls, the time-out stops the robot, and the button must hold too."""
    with Page(server.url) as driver, Page(server.url) as other:
        driver.say('drive', robot='/', linear=1.0, angular=0.0)
        driver.wait(lambda: driver.is_told_that_nobody_drives)
        # From the stop on the key is held, which is told by messages that come closely enough.
        server._router._lock._timeout = PATIENCE
        other.say('stop', robot=None)
        name = driver.last('hello')['client']
        driver.wait(lambda: driver.last('driver')['stopped'] == name)
        driver.say('drive', robot='/', linear=1.0, angular=0.0)
        notice = driver.wait(lambda: driver.last('notice'))
        assert notice['text'] == '/ was stopped by another page; let go, and drive again'
        assert backend.calls.count((1.0, 0.0)) == 1


def test_slider_positions_reach_the_backend(backend, server):
    with Page(server.url) as page:
        page.say('set_joints', robot='/', positions={'a': 1, 'b': -0.5})
        page.ask('play', 1, simulator='/s')
        assert backend.calls[-1] == {'a': 1.0, 'b': -0.5}


def test_a_stop_holds_joints_first_and_a_drive_may_go_sideways(backend, server):
    backend.joints_are_moved = True
    with Page(server.url) as page:
        page.say('drive', robot='/', linear=1.0, angular=0.5, sideways=-0.2)
        page.say('stop', robot=None)
        page.ask('play', 1, simulator='/s')
        assert backend.calls[-3:] == [(1.0, 0.5, -0.2), 'hold None', (0.0, 0.0)]


def test_a_server_that_ends_stops_the_robot_of_a_page(backend):
    with serving(backend) as server, Page(server.url) as page:
        page.say('drive', robot='/', linear=1.0, angular=0.5)
        page.wait(lambda: (1.0, 0.5) in backend.calls)
        server.stop()
        assert backend.calls[-2:] == [(0.0, 0.0), 'close']


def test_a_server_that_ends_waits_for_no_answer_and_leaves_no_task(backend, monkeypatch):
    asked, tasks = threading.Event(), []

    async def never_answer(*_):
        asked.set()
        try:
            await asyncio.get_running_loop().create_future()
        finally:  # as the real backend does
            tasks.append(asyncio.get_running_loop().create_task(asyncio.sleep(PATIENCE)))

    monkeypatch.setattr(backend, 'carry_out', never_answer)
    with serving(backend) as server, Page(server.url) as page:
        page.say('play', id=1, simulator='/s')
        assert asked.wait(PATIENCE)
        server.stop()
        gc.collect()  # which asyncio notices a pending task at
        assert server.logged.empty()
        assert [task.cancelled() for task in tasks] == [True]


def test_a_page_that_is_not_built_says_how_to_build_it(tmp_path):
    with serving(Backend(), static=tmp_path) as server:
        with pytest.raises(HTTPError, match='503') as refused:
            urlopen(server.url, timeout=PATIENCE)
        with refused.value as answer:
            assert 'npm ci && npm run build' in answer.read().decode()
