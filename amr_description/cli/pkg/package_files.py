# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The files that ``ros2 pkg create`` writes, in the order of the original."""

from collections.abc import Iterator
import os
from pathlib import Path

from amr_description.cli.pkg.new_package import NewPackage
from amr_description.cli.pkg.templates import cmake, cpp, manifest, python
from amr_description.errors import AmrError


class PackageWriter:
    """Writes the files of a package, and prints what it does as the original does."""

    def __init__(self, package: NewPackage, destination: str) -> None:
        """``destination``: the folder that gets the package, as it was typed."""
        self._package = package
        self._root = os.path.join(destination, package.name)

    def write(self) -> None:
        """Write all but LICENSE. Raises AmrError."""
        try:
            self._folder('')
            for path, text in self._files():
                if text is None:
                    self._folder(path)
                else:
                    self._file(path, text)
        except OSError as error:
            raise AmrError(
                f'unable to create {error.filename or self._root}: {error.strerror}'
            ) from error

    def write_license(self, text: str) -> None:
        """Write LICENSE. Raises AmrError."""
        path = Path(self._root, 'LICENSE')
        try:
            path.write_text(text, encoding='utf-8')
        except OSError as error:
            raise AmrError(f'unable to create {path}: {error.strerror}') from error

    def _folder(self, path: str) -> None:
        folder = os.path.join(self._root, path) if path else self._root
        print('creating folder', folder)
        Path(folder).mkdir(parents=True, exist_ok=True)

    def _file(self, path: str, text: str) -> None:
        file = os.path.join(self._root, path)
        print('creating', file)
        Path(file).write_text(text, encoding='utf-8')

    def _files(self) -> Iterator[tuple[str, str | None]]:
        """Yield path and text of each file, None for a folder, in the order of the original."""
        yield 'package.xml', manifest.package_xml(self._package)
        if self._package.build_type == 'ament_python':
            print('creating source folder')
            yield from _python_files(self._package)
        else:
            print('creating source and include folder')
            yield from _cmake_files(self._package)


def _python_files(package: NewPackage) -> Iterator[tuple[str, str | None]]:
    name = package.name
    yield name, None
    yield 'setup.py', python.setup_py(package)
    yield 'setup.cfg', python.SETUP_CFG.format(name=name)
    yield 'resource', None
    yield f'resource/{name}', ''
    yield f'{name}/__init__.py', ''
    yield 'test', None
    for file, text in python.TESTS.items():
        yield f'test/{file}', text
    if package.node:
        yield f'{name}/{package.node}.py', python.NODE.format(name=name)
    if package.library:
        yield f'{name}/{package.library}', None
        yield f'{name}/{package.library}/__init__.py', ''


def _cmake_files(package: NewPackage) -> Iterator[tuple[str, str | None]]:
    name, library = package.name, package.library
    yield 'src', None
    yield f'include/{name}', None
    if package.build_type == 'cmake':
        yield 'CMakeLists.txt', cmake.cmake_lists(package)
        yield f'{name}Config.cmake.in', cmake.config(package)
        yield f'{name}ConfigVersion.cmake.in', cmake.CONFIG_VERSION
    else:
        yield 'CMakeLists.txt', cmake.ament_cmake_lists(package)
    if package.node:
        yield f'src/{package.node}.cpp', cpp.NODE.format(name=name)
    if library:
        words = {
            'name': name,
            'NAME': name.upper(),
            'library': library,
            'LIBRARY': library.upper(),
            'class_name': cpp.class_name(library),
        }
        yield f'include/{name}/{library}.hpp', cpp.HEADER.format_map(words)
        yield f'src/{library}.cpp', cpp.LIBRARY.format_map(words)
        yield f'include/{name}/visibility_control.h', cpp.VISIBILITY.format_map(words)
