# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What a simulation is given: a description and its arguments."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
import shlex
from typing import Any

from amr_description.errors import UsageError
from amr_description.model.description_file import description_at, mappings_of
from amr_description.model.fixing import fixed_to_world


@dataclass(frozen=True)
class GivenDescription:
    """A robot description as it is given: a file, a URI, or the text itself."""

    urdf: str
    xacro_args: str | Mapping[str, Any] = ''
    """Of a xacro file: as in a shell, or by name."""
    is_fixed: bool = False
    """Whether its root link is fixed to the world."""

    def text(self, warn: Callable[[str], object]) -> str:
        """
        Return the URDF.

        Args:
            warn: Called with one line for each probable mistake.

        Raises:
            UsageError: There are arguments for a text, or they cannot be split.
            AmrError: It cannot be read, expanded, or fixed.
        """
        mappings = self._mappings()
        found = self.urdf if self._is_text else description_at(self.urdf, mappings, warn=warn)
        return fixed_to_world(found) if self.is_fixed else found

    @property
    def _is_text(self) -> bool:
        return self.urdf.lstrip().startswith('<')

    def _mappings(self) -> Mapping[str, str]:
        given = self.xacro_args
        if not given:
            return {}
        if self._is_text:
            raise UsageError(f'xacro_args are {given!r}: they are for xacro files, not for a text')
        if not isinstance(given, str):
            return {name: _word(value) for name, value in given.items()}
        try:
            return mappings_of(shlex.split(given))
        except ValueError as error:
            raise UsageError(f'xacro_args are {given!r}: {error}') from None


def _word(value: Any) -> str:
    """Return a value as xacro reads it."""
    return str(value).lower() if isinstance(value, bool) else str(value)
