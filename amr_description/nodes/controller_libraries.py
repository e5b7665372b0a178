# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What controllers are made of, imported anew: an edited controller without a restart."""

from collections.abc import Iterable
import importlib
import sys

from amr_description.errors import ControllerError


def reload_modules(names: Iterable[str]) -> None:
    """
    Execute modules again, so that the next load finds their classes as the files are now.

    Only the modules named, not what they import. Raises ControllerError: one has a mistake in it;
    those before it are new, it and those behind it are as they were.
    """
    importlib.invalidate_caches()
    for name in sorted(names):
        try:
            if name in sys.modules:
                importlib.reload(sys.modules[name])
        except Exception as error:  # a stranger's module may raise anything
            raise ControllerError(
                f"Cannot reload controller library '{name}': {type(error).__name__}: {error}"
            ) from error
