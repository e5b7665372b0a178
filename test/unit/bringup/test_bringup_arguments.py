# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Arguments of a stack: what a signature declares, and what a user types."""

from typing import Annotated, Literal

import pytest

from amr_description.bringup.arguments import (
    Argument,
    declared,
    parse,
    resolve,
    show,
    with_arguments_of,
)
from amr_description.errors import BringupError, UsageError


def stack(
    needed: Annotated[str, 'no way without'],
    rtf: float = 1.0,
    count: int = 3,
    gui: bool = True,
    world: Annotated[Literal['empty', 'maze'], 'where'] = 'empty',
    plain='x',  # noqa: ANN001
):
    """A function with every kind of parameter."""


def values(*words):
    return resolve(declared(stack), parse(words))


def test_a_signature_declares():
    assert declared(stack) == [
        Argument('needed', str, None, (), 'no way without'),
        Argument('rtf', float, '1.0'),
        Argument('count', int, '3'),
        Argument('gui', bool, 'true'),
        Argument('world', str, 'empty', ('empty', 'maze'), 'where'),
        Argument('plain', str, 'x'),
    ]


def test_defaults_are_those_of_the_signature():
    assert values('needed:=a') == {
        'needed': 'a', 'rtf': 1.0, 'count': 3, 'gui': True, 'world': 'empty', 'plain': 'x',
    }  # fmt: skip


def test_values_get_the_type_of_their_annotation():
    typed = ['needed:=a:=b', 'rtf:=0', 'count:=-2', 'gui:=FALSE', 'world:=maze', 'plain:=']
    assert values(*typed) == {
        'needed': 'a:=b', 'rtf': 0.0, 'count': -2, 'gui': False, 'world': 'maze', 'plain': '',
    }  # fmt: skip


def test_the_last_of_a_name_wins():
    assert parse(['a:=1', 'b:=2', 'a:=3']) == {'a': '3', 'b': '2'}


@pytest.mark.parametrize('word', ['gui', ':=x', 'gui=1', ''])
def test_a_malformed_word_is_refused_in_the_words_of_launch(word):
    with pytest.raises(BringupError, match=f"malformed launch argument '{word}', expected format"):
        parse([word])


@pytest.mark.parametrize(
    ('word', 'text'),
    [
        ('rtf:=fast', "rtf:=fast: 'fast' is not a number"),
        ('count:=1.5', "'1.5' is not an integer"),
        ('gui:=maybe', "'maybe' is not true or false"),
        ('wrld:=maze', "unknown argument 'wrld'; did you mean 'world'\\? known: needed, rtf"),
    ],
)
def test_a_wrong_value_or_name_is_a_usage_error(word, text):
    with pytest.raises(UsageError, match=text):
        values('needed:=a', word)


def test_a_bad_choice_is_refused_in_the_words_of_launch():
    text = 'Argument "world" provided value "sea" is not valid. Valid options are: \\[\'empty\', '
    with pytest.raises(BringupError, match=text):
        values('needed:=a', 'world:=sea')


def test_a_missing_argument_is_named_with_its_description():
    with pytest.raises(BringupError, match="'needed' \\(description: 'no way without'\\)"):
        values('rtf:=2')


def test_an_unsupported_type_is_refused():
    def strange(when: list[int] = ()):  # noqa: ANN202
        pass

    with pytest.raises(BringupError, match="argument 'when' of the stack is annotated list"):
        declared(strange)


def test_an_unsupported_signature_is_refused():
    def none(name: str = None):  # noqa: ANN202, RUF013
        pass

    def number(size: Literal[1, 2] = 1):  # noqa: ANN202
        pass

    def unknown(size: 'Size'):  # noqa: ANN202, F821
        pass

    def positional(size: int, /):  # noqa: ANN202
        pass

    def several(*sizes: int):  # noqa: ANN202
        pass

    for function, text in (
        (none, "argument 'name' of the stack is None by default, which is no str"),
        (number, r'annotated typing.Literal\[1, 2\]; it can be str'),
        (unknown, "the annotations of 'unknown': name 'Size' is not defined"),
        (positional, "argument 'size: int' of the stack can not be given by its name"),
        (several, r"argument '\*sizes: int' of the stack can not be given by its name"),
    ):
        with pytest.raises(BringupError, match=text):
            declared(function)


def test_show_args_reads_as_launch_prints_it():
    assert show(declared(stack)[:1] + declared(stack)[4:5]) == (
        "Arguments (pass arguments as '<name>:=<value>'):\n"
        '\n'
        "    'needed':\n"
        '        no way without\n'
        '\n'
        "    'world':\n"
        "        where. Valid choices are: ['empty', 'maze']\n"
        "        (default: 'empty')\n"
    )
    assert show([]) == "Arguments (pass arguments as '<name>:=<value>'):\n\n  No arguments.\n"


def test_a_stack_may_take_the_arguments_of_another_one():
    @with_arguments_of(stack)
    def around(rtf: float = 0.5, rounds: Annotated[int, 'how often'] = 2, **others):
        return rtf, rounds, others

    own = {argument.name: argument for argument in declared(around)}
    inner = {argument.name: argument for argument in declared(stack)}
    assert own == {
        **inner,
        'rtf': Argument('rtf', float, '0.5'),
        'rounds': Argument('rounds', int, '2', (), 'how often'),
    }
    values = resolve(declared(around), parse(['needed:=a', 'rounds:=5']))
    others = {'needed': 'a', 'count': 3, 'gui': True, 'world': 'empty', 'plain': 'x'}
    assert around(**values) == (0.5, 5, others)
