# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The verbs of ``ros2 pkg`` that read the ament index: an object each, see ``lazy_parser``."""

from argparse import ArgumentParser, Namespace
from pathlib import Path
from xml.etree import ElementTree

from amr_description.errors import AmrError


class ListVerb:
    """Output a list of available packages."""

    @staticmethod
    def add_arguments(parser: ArgumentParser) -> None:
        """Add the arguments of the verb: none."""

    @staticmethod
    def main(_args: Namespace) -> int:
        """Print the names; 0."""
        from amr_description.ament_index import packages

        for name in packages():
            print(name)
        return 0


class PrefixVerb:
    """Output the prefix path of a package."""

    @staticmethod
    def add_arguments(parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        parser.add_argument('package_name', help='The package name')
        parser.add_argument(
            '--share', action='store_true', help='Show share directory for the package'
        )

    @staticmethod
    def main(args: Namespace) -> int:
        """Print the prefix; 0."""
        from amr_description.ament_index import packages

        prefix = packages().get(args.package_name)
        if prefix is None:
            raise AmrError('Package not found')
        print(prefix / 'share' / args.package_name if args.share else prefix)
        return 0


class ExecutablesVerb:
    """Output a list of package specific executables."""

    @staticmethod
    def add_arguments(parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        parser.add_argument('package_name', nargs='?', help='The package name')
        parser.add_argument(
            '--full-path', action='store_true', help='Show full path of executables'
        )

    @staticmethod
    def main(args: Namespace) -> int:
        """Print one executable per line, of one package or of all; 0."""
        from amr_description.ament_index import executables_of, packages

        for package in [args.package_name] if args.package_name else packages():
            for path in executables_of(package):
                print(path if args.full_path else f'{package} {path.name}')
        return 0


class XmlVerb:
    """Output the XML of the package manifest or a specific tag."""

    @staticmethod
    def add_arguments(parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        parser.add_argument('package_name', help='The package name')
        parser.add_argument('-t', '--tag', help='The XML tag to output')

    @staticmethod
    def main(args: Namespace) -> int:
        """Print the manifest, or the text of each element with the tag; 0."""
        from amr_description.ament_index import packages

        prefix = packages().get(args.package_name)
        if prefix is None:
            raise AmrError('Package not found')
        root = _read(prefix / 'share' / args.package_name / 'package.xml')
        if args.tag is None:
            print(ElementTree.tostring(root, encoding='unicode'))
            return 0
        for element in _find(root, args.tag):
            print(element.text or '')
        return 0


def _read(path: Path) -> ElementTree.Element:
    """Return the root of the manifest. Raises AmrError."""
    try:
        return ElementTree.parse(path).getroot()
    except FileNotFoundError as error:
        raise AmrError(f'Package XML manifest not found: there is no {path}') from error
    except OSError as error:
        raise AmrError(f'{path} cannot be read: {error.strerror}') from error
    except ElementTree.ParseError as error:
        raise AmrError(f'{path} is not XML: {error}') from error


def _find(root: ElementTree.Element, tag: str) -> list[ElementTree.Element]:
    """Return the elements of a tag, or of a path of tags: export/build_type. Raises AmrError."""
    found = [root]
    for name in tag.split('/'):
        found = [child for element in found for child in element if child.tag == name]
    if not found:
        raise AmrError(
            f'XML tag not found; there are {", ".join(sorted({element.tag for element in root}))}'
        )
    return found
