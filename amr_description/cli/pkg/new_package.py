# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What ``ros2 pkg create`` is asked for; package_files.py writes it."""

from dataclasses import dataclass
import keyword
import re

from amr_description.cli.pkg.licenses import LICENSES
from amr_description.errors import AmrError

_NAME = re.compile(r'[a-zA-Z0-9][a-zA-Z0-9_-]*')
_TARGET = re.compile(r'[a-zA-Z_][a-zA-Z0-9_]*')
_WORD = r'[-a-zA-Z0-9_%+]+'
_EMAIL = re.compile(rf'{_WORD}(\.{_WORD})*@[-a-zA-Z0-9%]+(\.[-a-zA-Z0-9%]+)*\.[a-zA-Z]{{2,}}')


@dataclass(frozen=True)
class NewPackage:
    """A package that is not there yet; ``check`` it before it is written."""

    name: str
    format: int
    description: str
    license: str
    build_type: str
    dependencies: tuple[str, ...]
    maintainer: str
    email: str
    node: str | None
    library: str | None

    def check(self) -> None:
        """Raise AmrError for what colcon or a compiler would refuse later."""
        if not _NAME.fullmatch(self.name):
            raise AmrError(
                f'a package cannot be called {self.name!r}: want letters, digits and underscores,'
                ' as in my_robot'
            )
        if self.build_type == 'ament_python':
            self._check_python()
        elif self.library and not _is_importable(self.name):
            raise AmrError(
                f'a package with a library of C++ cannot be called {self.name!r}, which is no '
                f'namespace: {_importable(self.name)!r} may do'
            )
        for what, name in (('node', self.node), ('library', self.library)):
            if name and not (_TARGET.fullmatch(name) and _is_importable(name)):
                raise AmrError(
                    f'a {what} cannot be called {name!r}: want letters, digits and underscores,'
                    f' as in my_{what}'
                )
        if not is_email(self.email):
            raise AmrError(
                f'{self.email!r} is no email address of a maintainer, as colcon wants one:'
                ' NAME@HOST.DOMAIN'
            )

    def _check_python(self) -> None:
        """Raise AmrError for what cannot be a package of Python."""
        if self.name == 'test':  # text of the original
            raise AmrError(
                "Aborted since 'ament_python' packages can't be named 'test'. Please choose a"
                ' different package name.'
            )
        if not _is_importable(self.name):
            raise AmrError(
                f"an 'ament_python' package cannot be called {self.name!r}, which Python cannot"
                f' import: {_importable(self.name)!r} may do'
            )

    @property
    def has_license_text(self) -> bool:
        """Whether a file LICENSE is written."""
        return self.license in LICENSES


def is_email(text: str) -> bool:
    """Return whether ``package.xml`` may name this as the address of a maintainer."""
    return _EMAIL.fullmatch(text) is not None


def _importable(name: str) -> str:
    """Return a similar name that can be imported."""
    better = re.sub(r'[^a-zA-Z0-9_]', '_', name)
    return better if _is_importable(better) else f'my_{better}'


def _is_importable(name: str) -> bool:
    return name.isidentifier() and not keyword.iskeyword(name)
