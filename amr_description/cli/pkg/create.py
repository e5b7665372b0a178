# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Create a new ROS 2 package."""

from argparse import ArgumentParser, Namespace
import os
import sys
from typing import TYPE_CHECKING

from amr_description.errors import AmrError

if TYPE_CHECKING:
    from amr_description.cli.pkg.new_package import NewPackage


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the verb."""
    parser.add_argument('package_name', help='The package name')
    parser.add_argument(
        '--package-format',
        '--package_format',
        type=int,
        default=3,
        choices=[2, 3],
        help='The package.xml format.',
    )
    parser.add_argument(
        '--description',
        default='TODO: Package description',
        help='The description given in the package.xml',
    )
    parser.add_argument(
        '--license',
        default='TODO: License declaration',
        help='The license attached to this package; this can be an arbitrary string, but a '
        'LICENSE file will only be generated if it is one of the supported licenses '
        "(pass '?' to get a list)",
    )
    parser.add_argument(
        '--destination-directory',
        default=os.curdir,
        help='Directory where to create the package directory',
    )
    parser.add_argument(
        '--build-type',
        default='ament_cmake',
        choices=['cmake', 'ament_cmake', 'ament_python'],
        help='The build type to process the package with',
    )
    parser.add_argument('--dependencies', nargs='+', default=[], help='list of dependencies')
    parser.add_argument(
        '--maintainer-email', help='email address of the maintainer of this package'
    )
    parser.add_argument('--maintainer-name', help='name of the maintainer of this package')
    parser.add_argument('--node-name', help='name of the empty executable')
    parser.add_argument('--library-name', help='name of the empty library')


def main(args: Namespace) -> int:
    """Write the package, and print what it has; 0."""
    from datetime import date

    from amr_description.cli.pkg.licenses import LICENSES, text_of
    from amr_description.cli.pkg.new_package import NewPackage
    from amr_description.cli.pkg.package_files import PackageWriter

    if args.license == '?':
        print('Supported licenses:', *LICENSES, sep='\n')
        return 0
    maintainer = args.maintainer_name or _user()
    package = NewPackage(
        name=args.package_name,
        format=args.package_format,
        description=args.description,
        license=args.license,
        build_type=args.build_type,
        dependencies=tuple(dict.fromkeys(args.dependencies)),
        maintainer=maintainer,
        email=args.maintainer_email or _email_of(maintainer),
        node=_node_name(args),
        library=args.library_name or None,
    )
    package.check()
    path = os.path.join(args.destination_directory, package.name)
    if os.path.lexists(path):
        raise AmrError(
            f'\nAborted!\nThe directory already exists: {path}\nEither remove the directory or '
            'choose a different destination directory or package name'
        )
    _print_summary(package, args.destination_directory)
    writer = PackageWriter(package, args.destination_directory)
    writer.write()
    if package.has_license_text:
        writer.write_license(text_of(package.license, maintainer, date.today().year))
    else:
        print(
            f"\n[WARNING]: Unknown license '{package.license}'.  This has been set in the "
            'package.xml, but no LICENSE file has been created.\n'
            'It is recommended to use one of the ament license identifiers:',
            *LICENSES,
            sep='\n',
        )
    return 0


def _print_summary(package: 'NewPackage', destination: str) -> None:
    """Print what is about to be written."""
    print('going to create a new package')
    print('package name:', package.name)
    print('destination directory:', os.path.abspath(destination))
    print('package format:', package.format)
    print('version: 0.0.0')
    print('description:', package.description)
    print('maintainer:', [f'{package.maintainer} <{package.email}>'])
    print('licenses:', [package.license])
    print('build type:', package.build_type)
    print('dependencies:', list(package.dependencies))
    if package.node:
        print('node_name:', package.node)
    if package.library:
        print('library_name:', package.library)


def _node_name(args: Namespace) -> str | None:
    """Return the name of the node, which may not be that of the library."""
    name: str | None = args.node_name or None
    if name and name == args.library_name:
        name += '_node'
        print('[WARNING] node name can not be equal to the library name', file=sys.stderr)
        print(f'[WARNING] renaming node to {name}', file=sys.stderr)
    return name


def _user() -> str:
    """Return the name of the user; containers may have users without one."""
    import getpass

    try:
        return getpass.getuser()
    except (KeyError, OSError):
        return 'user'


def _email_of(maintainer: str) -> str:
    """Return the address that git has, or one that is there to be replaced."""
    import re
    import shutil
    import subprocess

    from amr_description.cli.pkg.new_package import is_email

    git = shutil.which('git')
    if git:
        command = [git, 'config', 'user.email']
        found = subprocess.run(
            command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, errors='replace'
        ).stdout.strip()
        if is_email(found):
            return found
    name = re.sub(r'[^-a-zA-Z0-9_%+]+', '.', maintainer).strip('.')
    return f'{name or "user"}@todo.todo'
