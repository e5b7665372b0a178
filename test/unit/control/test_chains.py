# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Chains: orders of updates and activations for any links, and circular chains."""

from hypothesis import given, strategies as st
import pytest
from support.examples import examples

from amr_description.control.chains import ChainInterfaces, Chains
from amr_description.errors import ControllerError

NAMES = 'abcdef'


def chains(**links):
    """``a='b ^c'``: a commands b and reads a state of c; every one offers both."""
    return Chains(
        {
            name: ChainInterfaces(
                commands=tuple(f'{n}/reference' for n in text.split() if n[0] != '^'),
                states=tuple(f'{n[1:]}/state' for n in text.split() if n[0] == '^'),
                references=(f'{name}/reference',),
                exported_states=(f'{name}/state',),
            )
            for name, text in links.items()
        }
    )


links = st.dictionaries(
    st.sampled_from(NAMES),
    st.lists(st.tuples(st.sampled_from(NAMES), st.sampled_from(('', '^'))), max_size=3),
    min_size=1,
)


@given(links)
@examples(100)
def test_orders_hold_for_every_link_or_the_chain_is_circular(drawn):
    texts = {name: ' '.join(f'{mark}{to}' for to, mark in drawn[name]) for name in sorted(drawn)}
    try:
        found = chains(**texts)
    except ControllerError as error:
        circle = str(error).removeprefix('circular chain of controllers: ').split(' -> ')
        assert circle[0] == circle[-1]
        for user, needed in zip(circle, circle[1:], strict=False):
            assert needed in {to for to, _ in drawn[user]}
        return
    updated, activated = found.update_order, found.activation_order
    assert sorted(updated) == sorted(activated) == sorted(drawn)
    for name in drawn:
        for needed in found.needs(name):
            assert activated.index(needed) < activated.index(name)
            assert name in found.needed_by(needed)
            assert name in found.affected_by([needed])
        for following in found.commands(name):
            assert updated.index(name) < updated.index(following)
            assert name in found.commanded_by(following)
            assert following in found.affected_by([name])


def test_unlinked_controllers_are_in_alphabetical_order():
    assert chains(c='', a='', b='').update_order == ('a', 'b', 'c')


def test_a_chain_is_updated_from_its_head_and_activated_from_its_tail():
    found = chains(a='', tail='', middle='tail', head='middle')
    assert found.update_order == ('a', 'head', 'middle', 'tail')
    assert found.activation_order == ('a', 'tail', 'middle', 'head')
    assert found.commands('head') == {'middle': ('middle/reference',)}
    assert found.commands('tail') == {}


def test_a_reader_is_updated_after_the_exporter():
    found = chains(a='^z', z='')
    assert found.update_order == found.activation_order == ('z', 'a')


def test_feedback_is_read_one_tick_later():
    assert chains(outer='inner ^inner', inner='').update_order == ('outer', 'inner')
    found = chains(outer='middle ^inner', middle='inner', inner='')
    assert found.update_order == ('outer', 'middle', 'inner')


def test_a_controller_affects_those_it_commands_and_its_readers_but_not_those_it_reads():
    found = chains(a='c', b='c', c='', estimator='', reader='^estimator', other='')
    assert found.affected_by(['a']) == {'a', 'b', 'c'}
    assert found.affected_by(['estimator']) == {'estimator', 'reader'}
    assert found.affected_by(['reader']) == {'reader'}
    assert found.affected_by(['other', 'unknown']) == {'other', 'unknown'}


@pytest.mark.parametrize(
    ('circle', 'message'),
    [
        ({'a': 'a'}, 'a -> a'),
        ({'a': 'b', 'b': 'a'}, '(a -> b -> a|b -> a -> b)'),
        ({'a': '^b', 'b': '^a'}, '(a -> b -> a|b -> a -> b)'),
        ({'a': 'b', 'b': '^c', 'c': 'a'}, '-> (a|b|c) ->'),
    ],
)
def test_circular_chains(circle, message):
    with pytest.raises(ControllerError, match=f'circular chain of controllers: .*{message}'):
        chains(**circle)


def test_interfaces_that_no_controller_exports_make_no_link():
    found = Chains(
        {'a': ChainInterfaces(commands=('wheel/velocity',), states=('wheel/position',))}
    )
    assert (found.needs('a'), found.update_order) == (set(), ('a',))
