# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Rules of the checker on names."""

from collections.abc import Iterator
import re

from amr_description.model.element_reader import line_of
from amr_description.model.findings import Finding, quote, quote_all
from amr_description.model.nearest import nearest
from amr_description.model.subject import Subject

_ODD = re.compile(r'\A/|\s')


def names_are_usable(subject: Subject) -> Iterator[Finding]:
    """Names hold no blanks and begin with no slash: tf2 refuses such frames."""
    robot = subject.robot
    parts = [('link', each.name, each.line) for each in robot.links]
    parts += [('joint', each.name, each.line) for each in robot.joints]
    for kind, name, line in parts:
        if _ODD.search(name):
            yield subject.warning(
                line,
                f'the {kind} has a name that ROS tools trip over',
                found=quote(name),
                expected='letters, digits and _, such as '
                + quote(re.sub(r'\W+', '_', name.strip('/ '))),
            )


def gazebo_refers_to_something(subject: Subject) -> Iterator[Finding]:
    """What a ``<gazebo reference="…">`` names is a link or a joint."""
    robot = subject.robot
    known = [link.name for link in robot.links] + [joint.name for joint in robot.joints]
    for element in subject.xml.iterchildren('gazebo'):
        name = element.get('reference')
        if name is None or robot.has_link(name) or robot.has_joint(name):
            continue
        meant = nearest(name, known)
        yield subject.warning(
            line_of(element),
            '<gazebo> refers to what is not there, and is ignored',
            found=quote(name),
            expected=f'a link or a joint: {quote_all(known)}',
            fix=f'write reference="{meant}"' if meant else '',
        )
