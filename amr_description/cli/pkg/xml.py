# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Output the XML of the package manifest or a specific tag."""

from argparse import ArgumentParser, Namespace
from pathlib import Path
from xml.etree import ElementTree

from amr_description.errors import AmrError


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    parser.add_argument('package_name', help='The package name')
    parser.add_argument('-t', '--tag', help='The XML tag to output')


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
