# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``package.xml``."""

from collections.abc import Iterable
from xml.sax.saxutils import escape, quoteattr

from amr_description.cli.pkg.new_package import NewPackage

_MANIFEST = """\
<?xml version="1.0"?>
<?xml-model href="http://download.ros.org/schema/package_format{format}.xsd" \
schematypens="http://www.w3.org/2001/XMLSchema"?>
<package format="{format}">
  <name>{name}</name>
  <version>0.0.0</version>
  <description>{description}</description>
  <maintainer email={email}>{maintainer}</maintainer>
  <license>{license}</license>

{dependencies}\
  <export>
    <build_type>{build_type}</build_type>
  </export>
</package>
"""
_LINTERS = {
    'ament_cmake': ('ament_lint_auto', 'ament_lint_common'),
    'ament_python': ('ament_copyright', 'ament_flake8', 'ament_pep257', 'python3-pytest'),
}


def package_xml(package: NewPackage) -> str:
    """Return the text of the manifest."""
    tools = []
    if package.build_type == 'ament_cmake':
        tools = ['ament_cmake_ros' if package.library else 'ament_cmake']
    return _MANIFEST.format(
        format=package.format,
        name=package.name,
        description=escape(package.description),
        email=quoteattr(package.email),
        maintainer=escape(package.maintainer),
        license=escape(package.license),
        dependencies=_block('buildtool_depend', tools)
        + _block('depend', package.dependencies)
        + _block('test_depend', _LINTERS.get(package.build_type, ())),
        build_type=package.build_type,
    )


def _block(tag: str, names: Iterable[str]) -> str:
    """Return a line for each name and an empty one; nothing where there is none."""
    lines = ''.join(f'  <{tag}>{escape(name)}</{tag}>\n' for name in names)
    return f'{lines}\n' if lines else ''
