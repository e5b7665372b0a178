# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What is typed as YAML, right and wrong."""

import pytest

from amr_description.cli.yaml_input import read_mapping, read_value
from amr_description.errors import AmrError


def test_a_mapping_is_read():
    assert read_mapping('{x: 1, y: [a, "b"]}') == {'x': 1, 'y': ['a', 'b']}
    assert read_mapping('data: 5') == {'data': 5}
    assert read_mapping('{}') == {}


@pytest.mark.parametrize(
    ('text', 'found'),
    [('hi', "the str 'hi'"), ('5', "the int '5'"), ('[1, 2]', 'a list'), ('', 'empty')],
)
def test_something_else_is_named(text, found):
    with pytest.raises(AmrError, match='needs to be a dictionary in YAML format') as error:
        read_mapping(text)
    assert str(error.value).endswith(f'this is {found}')


@pytest.mark.parametrize(
    ('text', 'place'),
    [
        ('{data: hi', "line 1, column 10: expected ',' or '}'"),
        ('data: @x', "line 1, column 7: found character '@'"),
        ('a: 1\n b: 2', 'line 2, column 3: mapping values are not allowed here'),
        ('{a: *b}', "line 1, column 5: found undefined alias 'b'"),
        ('!!python/object:os.system {}', 'line 1, column 1: could not determine a constructor'),
        ('data: \x07', 'character 7 is U+0007'),
        ('data: \udcff', 'character 7 is U+DCFF'),
        ('{\n' * 5000, 'nested too deeply'),
        ('2026-99-99', 'month must be in 1..12'),
    ],
)
def test_what_is_wrong_is_told_in_one_line_with_its_place(text, place):
    with pytest.raises(AmrError, match='^The passed value is not ') as error:
        read_value(text)
    assert place in str(error.value)
    assert '\n' not in str(error.value)
