# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
An extension of colcon: a package that cannot be built does not stop those that do not need it.

colcon stops at the first failure unless told ``--continue-on-error``. Here a workspace of others
often has a package that needs a C++ library which PyPI lacks; the descriptions and messages beside
it are what the user wants. colcon ends with 1 all the same, and names what failed.
"""

from typing import Any

from colcon_core.package_selection import PackageSelectionExtensionPoint
from colcon_core.plugin_system import satisfies_version


class ContinueOnError(PackageSelectionExtensionPoint):
    """Makes ``--continue-on-error`` the default; it selects nothing."""

    def __init__(self) -> None:
        """Check that colcon is one that this is made for."""
        super().__init__()
        satisfies_version(PackageSelectionExtensionPoint.EXTENSION_POINT_VERSION, '^1.0')

    def add_arguments(self, *, parser: Any) -> None:
        """Change the default: the verb has added the flag before."""
        parser.set_defaults(continue_on_error=True)

    def select_packages(self, *, args: Any, decorators: Any) -> None:
        """Leave the selection as it is."""
