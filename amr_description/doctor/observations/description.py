# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What was seen of robot descriptions."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import lru_cache

from amr_description.errors import DescriptionError
from amr_description.model.checks import Examination, examine
from amr_description.model.robot import Robot
from amr_description.model.urdf import parse


@dataclass(frozen=True, slots=True, kw_only=True)
class DescriptionTopic:
    """A topic of robot descriptions."""

    topic: str = '/robot_description'
    publishers: tuple[str, ...] = ()
    """Full names of nodes; a node may be there twice."""
    volatile: tuple[str, ...] = ()
    """Those of them that do not keep the message for whoever comes later."""
    subscribers: tuple[str, ...] = ()
    texts: tuple[str, ...] = ()
    """The different ones that came, in their order."""

    @property
    def namespace(self) -> str:
        """Of the robot; empty: the root."""
        return self.topic.rpartition('/')[0]


@dataclass(frozen=True, slots=True, kw_only=True)
class Description:
    """All topics of robot descriptions, and who has which description."""

    topics: tuple[DescriptionTopic, ...] = ()
    of_state_publishers: Mapping[str, str] = field(default_factory=dict)
    """What each robot_state_publisher has as its parameter, by its full name."""

    def text_in(self, namespace: str) -> str:
        """Return the only description in a namespace; empty: there is none, or several."""
        found = {
            text for each in self.topics if each.namespace == namespace for text in each.texts
        }
        return found.pop() if len(found) == 1 else ''

    def robot_in(self, namespace: str) -> Robot | None:
        """Return the only robot that is described in a namespace, if it can be read."""
        text = self.text_in(namespace)
        return robot_of(text) if text else None


@lru_cache(8)  # the page asks every few seconds
def robot_of(text: str) -> Robot | None:
    """Return the robot of a description; None: it cannot be read."""
    try:
        return parse(text)
    except DescriptionError:
        return None


@lru_cache(8)
def examined(text: str) -> Examination:
    """Return what ``check_urdf`` says of a description."""
    return examine(text, 'robot_description')
