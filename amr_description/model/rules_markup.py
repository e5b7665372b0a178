# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Rules of the checker on markup that readers pass over in silence."""

from collections.abc import Collection, Iterator
import re

from lxml import etree

from amr_description.model.element_reader import line_of
from amr_description.model.findings import Finding, quote
from amr_description.model.nearest import nearest
from amr_description.model.subject import Subject
from amr_description.model.urdf_grammar import Element, ROBOT

_XACRO = ('http://www.ros.org/wiki/xacro', 'http://ros.org/wiki/xacro')
# What only sets values; of these some files keep a few, expanded or not.
_MAKES_NOTHING = ('arg', 'property')
_EXPRESSION = re.compile(r'=\s*["\'][^"\'<]*\$[{(]')
# Elements whose unknown children are refused where they are read.
_READ_STRICTLY = ('ros2_control', 'geometry')


def xacro_is_expanded(subject: Subject) -> Iterator[Finding]:
    """No element of xacro is left, and nothing that it would evaluate."""
    left = [element for uri in _XACRO for element in subject.xml.iter(f'{{{uri}}}*')]
    making = [each for each in left if etree.QName(each).localname not in _MAKES_NOTHING]
    if left and (making or _EXPRESSION.search(subject.robot.text)):
        yield subject.error(
            min(map(line_of, left)),
            'this is a xacro file, not yet a URDF',
            found=f'<xacro:{etree.QName((making or left)[0]).localname}>',
            fix='run  xacro FILE > robot.urdf  first, or call the file .urdf.xacro',
        )


def markup_is_known(subject: Subject) -> Iterator[Finding]:
    """
    No element and no attribute is unknown, and none is there twice where only one counts.

    What has a namespace of its own, and what stands in ``<gazebo>``, is left to others.
    """
    stack = [(subject.xml, ROBOT)]
    while stack:
        element, grammar = stack.pop()
        yield from _judge_attributes(subject, element, grammar)
        seen: set[str] = set()
        children = []
        for child in element.iterchildren(etree.Element):
            tag = child.tag
            known = grammar.children.get(tag)
            if known is None:
                yield from _judge_tag(subject, child, grammar)
                continue
            if tag in seen and tag in grammar.single:
                yield subject.warning(
                    line_of(child),
                    f'a second <{tag}> in <{element.tag}> is ignored',
                    fix='leave one',
                )
            seen.add(tag)
            if not known.open:
                children.append((child, known))
        stack.extend(reversed(children))


def one_shape_counts(subject: Subject) -> Iterator[Finding]:
    """A geometry holds one shape; all but the first are ignored."""
    for geometry in subject.xml.iterfind('link/*/geometry'):
        shapes = list(geometry.iterchildren(etree.Element))
        for shape in shapes[1:]:
            yield subject.warning(
                line_of(shape),
                f'a second shape, <{shape.tag}>, in one <geometry> is ignored',
                fix=f'give it a <{geometry.getparent().tag}> of its own',
            )


def _judge_attributes(
    subject: Subject, element: etree._Element, grammar: Element
) -> Iterator[Finding]:
    for name in element.attrib:
        if name not in grammar.attributes and not name.startswith('{'):
            yield subject.warning(
                line_of(element),
                f'<{element.tag}> has no attribute {quote(name)} in URDF: it is ignored',
                **_hint(name, grammar.attributes, '{}="…"'),
            )


def _judge_tag(subject: Subject, element: etree._Element, grammar: Element) -> Iterator[Finding]:
    parent = element.getparent()
    strict = next(element.iterancestors(*_READ_STRICTLY), None) is not None
    if parent is None or strict or element.tag.startswith('{'):
        return
    yield subject.warning(
        line_of(element),
        f'<{parent.tag}> has no element {quote(f"<{element.tag}>")} in URDF: it is ignored',
        **_hint(element.tag, grammar.children, '<{}>'),
    )


def _hint(name: str, known: Collection[str], form: str) -> dict[str, str]:
    """Return what is expected and the fix, where one of the known names is near."""
    if not known:
        return {'expected': 'none', 'fix': 'remove it'}
    meant = nearest(name, known)
    return {
        'expected': ', '.join(form.format(each) for each in known),
        'fix': f'write {form.format(meant)}' if meant else '',
    }
