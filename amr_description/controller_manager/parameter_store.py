# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The parameters of one node, wherever they are kept: in a node of ROS, or in a plain table."""

from collections.abc import Collection, Mapping
from typing import Any, Protocol, TypeVar

from amr_description.parameters import Value

NO_VALUES: Mapping[str, Any] = {}
Table = TypeVar('Table')


class ParameterStore(Protocol):
    """
    What a node was given, on its command line and in files, and what it has declared of it.

    Names are dotted. A value is what was given, else what was set, else the default.
    """

    @property
    def node(self) -> str:
        """The full name of the node."""

    def adopt(
        self, *tables: type, joints: Collection[str] = (), others: Collection[str] = ()
    ) -> list[str]:
        """
        Have what was given taken as it is meant, before the tables are declared; return remarks.

        See :func:`amr_description.former_parameters.understand`.
        """

    def declare(
        self, table: type, *, prefix: str = '', defaults: Mapping[str, Value] = NO_VALUES
    ) -> None:
        """
        Declare the rows of a table that are not yet.

        Args:
            table: its rows.
            prefix: of every name, with its dot.
            defaults: in place of the table's, by name.

        Raises:
            ParameterError: a value has another type.
        """

    def declare_added(self, table: type) -> None:
        """Declare the rows of keyed groups that are new, as a list has got more elements since."""

    def declare_given(self) -> None:
        """Declare what was given beyond the tables."""

    def values(
        self, table: type[Table], changed: Mapping[str, Any] = NO_VALUES, *, prefix: str = ''
    ) -> Table:
        """
        Return the present values of a table, with those of ``changed`` in their place.

        Raises ParameterError: one has another type, or is out of its bounds.
        """

    def check_sets(self, *tables: type) -> None:
        """Refuse from now on to set what these tables do not allow."""

    def value(self, name: str) -> Any:
        """Return a declared value, or None."""

    def names(self) -> Collection[str]:
        """Return the names of all that are declared."""

    def set(self, name: str, value: Any) -> None:
        """Set a value, as ``ros2 param set`` does. Raises ParameterError: it is refused."""
