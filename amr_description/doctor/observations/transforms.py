# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What was seen on ``/tf`` and ``/tf_static``. Times are integer ns."""

from dataclasses import dataclass

from amr_description.model.frames import IDENTITY_QUATERNION, Quaternion


@dataclass(frozen=True, slots=True, kw_only=True)
class Edge:
    """What one publisher says of one frame."""

    parent: str
    """Without a leading slash, which tf2 drops; ``child`` too."""
    child: str
    publisher: str = ''
    """The full name of its node; empty: not known."""
    is_static: bool = False
    has_slash: bool = False
    """Whether a name is published with a leading slash."""
    youngest: int | None = None
    """The least age of its transforms when they were received; below 0: stamped later than that.
    None: static, or it is not known what time it was."""
    oldest: int | None = None
    """The greatest one."""
    rotation: Quaternion = IDENTITY_QUATERNION
    """The last one; or the last that is none."""
    translation: tuple[float, float, float] = (0.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class Tree:
    """The transforms of one namespace."""

    namespace: str = ''
    """Of ``/tf`` empty, of ``/r1/tf`` ``/r1``."""
    edges: tuple[Edge, ...] = ()
    is_complete: bool = True
    """Whether static transforms have come from all who publish some."""

    @property
    def topic(self) -> str:
        """The topic of the transforms that move."""
        return f'{self.namespace}/tf'

    @property
    def frames(self) -> frozenset[str]:
        """All frames, roots too."""
        return frozenset(name for each in self.edges for name in (each.parent, each.child))


@dataclass(frozen=True, slots=True, kw_only=True)
class ObservedTransforms:
    """The transforms of all namespaces."""

    trees: tuple[Tree, ...] = ()
    is_simulated: bool = False
    """Whether somebody publishes ``/clock``, by which ages are then."""

    def tree_of(self, name: str) -> Tree | None:
        """Return the tree of the namespace that a topic or a node is in."""
        inside = [each for each in self.trees if name.startswith(f'{each.namespace}/')]
        return max(inside, key=lambda each: len(each.namespace), default=None)
