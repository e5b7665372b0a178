# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The page's side of the protocol is what web/protocol.py writes from the node's."""

from collections.abc import Mapping
from dataclasses import dataclass
import importlib.util
import inspect
import sys
import types
from typing import Any, ClassVar, Literal, TypeAlias

import pytest
from support.paths import ROOT

SPEC = importlib.util.spec_from_file_location('web_protocol', ROOT / 'web' / 'protocol.py')
generator = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(generator)


def test_the_side_of_the_page_is_up_to_date():
    written = (ROOT / 'web' / 'src' / 'protocol.ts').read_text(encoding='utf-8')
    assert written == generator.generate(), 'run `python web/protocol.py` and commit protocol.ts'


def test_a_check_refuses_what_is_not_up_to_date(tmp_path, monkeypatch, capsys):
    target = tmp_path / 'protocol.ts'
    monkeypatch.setattr(generator, 'TARGET', target)
    monkeypatch.setattr(sys, 'argv', ['protocol.py'])
    assert generator.main() == 0
    monkeypatch.setattr(sys, 'argv', ['protocol.py', '--check'])
    assert generator.main() == 0
    target.write_text(target.read_text() + '\n')
    assert generator.main() == 1
    assert 'run python web/protocol.py' in capsys.readouterr().err


SOURCE = '''
"""About all."""
Plain: TypeAlias = float
Place: TypeAlias = tuple[float, float]
"""Where ``it`` is."""
LIMIT = 2**4
"""Not more; ``None`` of them."""
_PRIVATE = 3

@dataclass
class Inner:
    """What is inside."""
    names: tuple[Literal['a', 'b'], ...]  #: beside

@dataclass
class Outer:
    type: ClassVar[str] = 'outer'
    inner: Inner | None
    #: above,
    #: in two lines
    by_name: Mapping[str, tuple[Plain, ...]]
    place: Place = (0.0, 0.0)
    anything: Any = None
'''
WRITTEN = """\
/** About all. */

/** Where `it` is. */
export type Place = [number, number];

/** Not more; null of them. */
export const LIMIT = 16;

/** What is inside. */
export interface Inner {
  /** beside */
  names: ('a' | 'b')[];
}

export interface Outer {
  type: 'outer';
  inner: Inner | null;
  /**
   * above,
   * in two lines
   */
  by_name: Record<string, number[]>;
  place: [number, number];
  anything: unknown;
}
"""


@pytest.fixture
def read(monkeypatch):
    """Yield a function that generates the declarations of a source."""

    def declarations(source, *, from_pages=False):
        module = types.ModuleType('source')
        module.__dict__.update(
            dataclass=dataclass,
            ClassVar=ClassVar,
            Literal=Literal,
            Mapping=Mapping,
            Any=Any,
            TypeAlias=TypeAlias,
        )
        monkeypatch.setitem(sys.modules, 'source', module)
        monkeypatch.setattr(inspect, 'getsource', lambda _: source)
        monkeypatch.setattr(generator, 'MESSAGES', (module,))
        if from_pages:
            monkeypatch.setattr(generator, 'requests', module)
        exec(source, module.__dict__)
        return '\n'.join(filter(None, generator._Module(module).declarations()))

    return declarations


def test_declarations_are_written_with_their_documentation(read):
    assert read(SOURCE) == WRITTEN.replace('place: [number, number]', 'place: Place')


def test_only_what_a_page_sends_may_be_left_out(read):
    assert '\n  place?: Place;\n' in read(SOURCE, from_pages=True)


def test_what_typescript_cannot_say_is_refused(read):
    with pytest.raises(TypeError, match='complex has no type in TypeScript'):
        read('@dataclass\nclass Bad:\n    value: complex\n')
