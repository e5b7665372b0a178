# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Who may talk to the page's server."""

import pytest

from amr_description.viewer.access import Access, cookie_name, is_loopback

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
