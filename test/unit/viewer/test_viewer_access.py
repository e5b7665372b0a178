# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Who may talk to the page's server."""

import pytest

from amr_description.errors import ViewerError
from amr_description.viewer.access import Access, cookie_name, is_loopback, Proxies

HOSTS = [
    '127.0.0.1:8080',
    'localhost:8080',
    'LOCALHOST:9000',
    '[::1]:8080',
    '127.8.9.1',
    'localhost',
]
FOREIGN_HOSTS = [
    '', 'evil.example:8080', 'localhost.evil.example', '192.168.1.5:8080', '0.0.0.0:8080',
    '[::1', 'localhost@evil.example', '127.0.0.1.evil.example:8080',
]  # fmt: skip
TOKEN = 'r4nd0m'


def refused(access, target='/', **headers):
    refusal = access.refusal(target, headers)
    return refusal and (refusal.status, refusal.reason)


@pytest.mark.parametrize('host', HOSTS)
def test_this_host_may_by_any_of_its_names(host):
    assert refused(Access(), Host=host) is None
    assert refused(Access(), Host=host, Origin=f'http://{host}') is None


@pytest.mark.parametrize('host', FOREIGN_HOSTS)
def test_another_name_may_not_as_it_can_be_made_to_lead_here(host):
    status, reason = refused(Access(), Host=host, Origin=f'http://{host}')
    assert status == 421
    assert 'must begin with localhost' in reason
    assert '\n' not in reason


@pytest.mark.parametrize(
    'origin',
    ['http://evil.example', 'null', 'https://localhost:8080', 'http://localhost:3000', ''],
)
def test_a_page_of_somebody_else_may_not(origin):
    status, reason = refused(Access(), Host='localhost:8080', Origin=origin)
    assert status == 403
    assert repr(origin) in reason


def test_elsewhere_the_token_is_asked():
    access = Access(TOKEN)
    status, reason = refused(access, Host='robot.lan:8080')
    assert status == 403
    assert 'lacks its token' in reason
    assert TOKEN not in reason
    assert refused(access, f'/?token={TOKEN}', Host='robot.lan:8080') is None
    name = cookie_name('robot.lan:8080')
    assert refused(access, '/ws', Host='robot.lan:8080', Cookie=f'{name}={TOKEN}') is None
    for wrong in ('', 'x', f'{TOKEN}x', TOKEN[:-1], 'ü', '\udcff', '"\udcff"'):
        assert refused(access, f'/?token={wrong}', Host='robot.lan') is not None
        cookie = f'{cookie_name("robot.lan")}={wrong}'
        assert refused(access, '/', Host='robot.lan', Cookie=cookie) is not None


def test_a_foreign_page_may_not_even_with_the_token():
    access = Access(TOKEN)
    headers = {'Host': 'robot.lan', 'Origin': 'http://evil.example'}
    assert access.refusal(f'/ws?token={TOKEN}', headers).status == 403


def test_who_comes_with_the_token_gets_a_cookie_that_scripts_cannot_read():
    access = Access(TOKEN)
    headers = {'Host': 'robot.lan:8080'}
    cookie = access.new_cookie(f'/?token={TOKEN}', headers)
    assert cookie.startswith(f'{cookie_name("robot.lan:8080")}={TOKEN};')
    assert {'HttpOnly', 'SameSite=Strict'} <= {part.strip() for part in cookie.split(';')}
    assert access.new_cookie('/?token=wrong', headers) is None
    assert Access().new_cookie('/', headers) is None


def test_two_viewers_of_a_host_do_not_take_each_others_cookies():
    names = [cookie_name(host) for host in ('robot:8080', 'robot:8081', 'robot', '[::1')]
    assert len({*names[:3]}) == 3
    assert names[2] == names[3]


def test_loopbacks_are_told_from_other_addresses():
    assert [is_loopback(each) for each in ('127.0.0.1', '::1', 'localhost')] == [True] * 3
    assert [is_loopback(each) for each in ('0.0.0.0', '::', '10.0.0.1', 'robot')] == [False] * 4


@pytest.mark.parametrize(
    'host',
    ['evil@127.0.0.1', '127.0.0.1#evil', '127.0.0.1:abc', '127.0.0.1/..', '127.0.0.1:80:80', '',
     '127.0.0.1?a', '[::1', '::1', '127.0.0.1:', ' 127.0.0.1', '127.0.0.1\n', 'localhost:123456'],
)  # fmt: skip
@pytest.mark.parametrize('access', [Access(), Access(TOKEN)])
def test_a_host_is_a_name_and_a_port_and_nothing_else(access, host):
    assert refused(access, f'/?token={TOKEN}', Host=host) is not None


HUB = 'https://hub.example'


def behind(*, token=None, port=8080, **proxies):
    return Proxies(**proxies).access(token, port)


@pytest.mark.parametrize('host', ['hub.example', 'HUB.example', 'localhost:8080'])
def test_a_page_behind_a_proxy_may_where_its_origin_is_named(host):
    access = behind(origins=(HUB,))
    assert refused(access, Host=host, Origin=HUB) is None
    assert refused(access, Host=host) is None


@pytest.mark.parametrize(
    'origin',
    ['http://hub.example', 'https://hub.example:444', 'https://hub.example.evil.example', 'null',
     'https://evil.example', 'https://a.hub.example', '', 'http://hub.example:8080'],
)  # fmt: skip
def test_no_other_one_may_behind_it(origin):
    for host in ('hub.example', 'localhost:8080'):
        assert refused(behind(origins=(HUB,)), Host=host, Origin=origin)[0] == 403


@pytest.mark.parametrize('host', ['hub.example:1', 'evil.example', 'hub.example.evil.example', ''])
def test_nor_does_another_name_become_this_host_by_it(host):
    assert refused(behind(origins=(HUB,)), Host=host, Origin=HUB)[0] == 421


def test_what_a_proxy_sends_as_host_can_be_named():
    access = behind(origins=(HUB,), hosts=('Viewer.internal', 'pod:9000'))
    for host in ('viewer.internal', 'viewer.internal:80', 'pod:9000'):
        assert refused(access, Host=host, Origin=HUB) is None
    assert refused(access, Host='pod:9001')[0] == 421
    assert refused(access, Host='viewer.internal', Origin='http://evil.example')[0] == 403


def test_behind_a_proxy_the_token_is_asked_as_elsewhere():
    access = behind(origins=(HUB,), token=TOKEN)
    assert refused(access, Host='hub.example', Origin=HUB)[0] == 403
    assert refused(access, f'/?token={TOKEN}', Host='hub.example', Origin=HUB) is None


@pytest.mark.parametrize(
    'wrong',
    [{'origins': ('*',)}, {'origins': ('hub.example',)}, {'origins': ('https://hub.example/',)},
     {'origins': ('https://*.example',)}, {'hosts': ('*',)}, {'hosts': ('a b',)},
     {'ancestors': ('*',)}, {'ancestors': ("https://a; script-src 'none'",)},
     {'ancestors': ('https://a,https://b',)}, {'ancestors': ('',)}],
)  # fmt: skip
def test_what_would_let_in_anybody_is_refused(wrong):
    with pytest.raises(ViewerError, match=r'^[^\n]+ is no (host|origin|ancestor)'):
        Proxies(**wrong)


def test_a_codespace_is_known_by_its_environment():
    known = {'CODESPACES': 'true', 'CODESPACE_NAME': 'fluffy-cat'}
    access = Proxies().and_those_of(known).access(None, 8081)
    page = 'https://fluffy-cat-8081.app.github.dev'
    for host in ('fluffy-cat-8081.app.github.dev', 'localhost:8081'):
        assert refused(access, Host=host, Origin=page) is None
        for other in ('https://fluffy-cat-9000.app.github.dev', 'https://x-8081.app.github.dev'):
            assert refused(access, Host=host, Origin=other)[0] == 403
    for nothing in ({}, {'CODESPACES': 'true'}, {'CODESPACE_NAME': 'fluffy-cat'}):
        assert Proxies().and_those_of(nothing) == Proxies()
