# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Run the rosidl generators as CMake would, through their arguments files.

Everything of a package lands in ``<build>/<package>/``: ``idl/`` and, one folder per generator,
``<generator>/<package>/``. The order matters only for the type descriptions: they read those of
the packages they refer to. The code generators are independent of each other.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
import functools
import importlib.util
import json
from pathlib import Path
import pickle
import sys
from typing import Any

from amr_description.errors import InterfaceBuildError
from amr_description.interface_build import records
from amr_description.interface_build.packages import InterfacePackage, Underlay

TYPESUPPORTS = ('rosidl_typesupport_fastrtps_c', 'rosidl_typesupport_introspection_c')
PARSER = 'lark-parser==0.12.0'
TYPE_DESCRIPTION = 'rosidl_generator_type_description'
# Slowest first: they run side by side.
CODE_GENERATORS = (
    'rosidl_generator_py',
    'rosidl_generator_c',
    *TYPESUPPORTS,
    'rosidl_typesupport_c',
)


@dataclass(frozen=True)
class GeneratedPackage:
    """A package on its way: its sources, where its generated files go, and the ROS prefix."""

    source: InterfacePackage
    build: Path
    prefix: Path

    @property
    def name(self) -> str:
        """The package's name."""
        return self.source.name

    @property
    def idl(self) -> Path:
        """Where the ``.idl`` files are, below ``msg/``, ``srv/``, ``action/``."""
        return self.build / 'idl'

    def generated(self, generator: str) -> Path:
        """Return the folder that holds what ``generator`` made for this package."""
        return self.build / generator / self.name

    def write_arguments(self, generator: str, **more: object) -> str:
        """Write the arguments file of ``generator`` and return its path."""
        output = self.generated(generator)
        for kind in {path.parent.name for path in self.source.interfaces}:
            (output / kind).mkdir(parents=True, exist_ok=True)
        arguments = {
            'package_name': self.name,
            'output_dir': str(output),
            'template_dir': str(self.prefix / 'share' / generator / 'resource'),
            'idl_tuples': [
                f'{self.idl}:{path.with_suffix(".idl").as_posix()}'
                for path in self.source.interfaces
            ],
            'ros_interface_dependencies': [],
            'target_dependencies': [],
            **more,
        }
        file = self.build / f'{generator}__arguments.json'
        file.write_text(json.dumps(arguments, indent=1))
        return str(file)


def find_parser() -> None:
    """
    Make lark importable, by which ``.idl`` files are parsed.

    It is kept apart: each node that uses a message imports rosidl_generator_py, which imports the
    whole generator when it finds lark (else it goes without, by design): 45 of 170 ms of processor
    time, for each node that starts.

    Raises:
        InterfaceBuildError: it is not installed.
    """
    folder = Path(sys.prefix, 'lib', 'interface_build')
    if importlib.util.find_spec('lark') is None:
        sys.path.append(str(folder))
    if importlib.util.find_spec('lark') is None:
        raise InterfaceBuildError(
            f'{PARSER} is not installed, which reads interface files; install it with: '
            f'{sys.executable} -m pip install --target {folder} {PARSER}'
        )


def parse_each_file_once(folder: Path) -> None:
    """
    Remember what was parsed, in this process and in ``folder``: generators read the same files.

    The grammar of ``.idl`` files is slow: 50 ms each.
    """
    from rosidl_parser import parser

    parse = parser.get_ast_from_idl_string
    if hasattr(parse, 'cache_info'):  # in a worker, forked from a process that has done it
        return

    @functools.cache
    def parse_once(text: str) -> Any:
        file = folder / f'{records.digest(text)}.parsed'
        try:
            return pickle.loads(file.read_bytes())
        except (OSError, EOFError, pickle.UnpicklingError):
            tree = parse(text)
        folder.mkdir(parents=True, exist_ok=True)
        file.write_bytes(pickle.dumps(tree))
        return tree

    parser.get_ast_from_idl_string = parse_once


def read_templates_once() -> None:
    """
    Have EmPy read a template, and compile the code in it, once a process.

    EmPy 3 reads a template anew for each interface, character by character, and its code, too: so
    five sixths of all processor time of the generators went.
    """
    import em

    run_from_text = em.Interpreter.string
    tokens_of = functools.cache(functools.partial(_tokens_of, em))

    def string(
        interpreter: Any,
        data: str,
        name: object = '<string>',
        locals: dict[str, Any] | None = None,  # noqa: A002 - the names are those of EmPy
    ) -> None:
        tokens = tokens_of(interpreter.prefix, data)
        if tokens is None:
            run_from_text(interpreter, data, name, locals)
            return
        context = em.Context(name)
        interpreter.contexts.push(context)
        context.bump()
        for token in tokens:
            token.run(interpreter, locals)
        interpreter.contexts.pop()

    em.Interpreter.string = string
    compiled = functools.cache(compile)
    em._exec = lambda code, *names: exec(compiled(code, '<string>', 'exec'), *names)
    em.eval = lambda code, *names: eval(compiled(code.lstrip(' \t'), '<string>', 'eval'), *names)


def _tokens_of(em: Any, prefix: str, text: str) -> list[Any] | None:
    """Return the tokens of a template; None: EmPy has to say what is wrong with it, or mend it."""
    scanner, tokens = em.Scanner(prefix, text), []
    try:
        while (token := scanner.one()) is not None:
            tokens.append(token)
    except em.ParseError:
        return None
    return tokens


def write_idl(package: GeneratedPackage) -> None:
    """Translate ``.msg``, ``.srv`` and ``.action`` to ``.idl``, and parse what came of it."""
    from lark.exceptions import LarkError
    from rosidl_adapter.action import convert_action_to_idl
    from rosidl_adapter.msg import convert_msg_to_idl
    from rosidl_adapter.srv import convert_srv_to_idl
    from rosidl_parser import parser

    convert = {
        '.msg': convert_msg_to_idl,
        '.srv': convert_srv_to_idl,
        '.action': convert_action_to_idl,
    }
    for path in package.source.interfaces:
        if path.suffix == '.idl':
            records.copy_if_different(package.source.folder / path, package.idl / path)
        else:
            folder = package.idl / path.parent
            convert[path.suffix](package.source.folder, package.name, path, folder)
        text = (package.idl / path).with_suffix('.idl').read_text(encoding='utf-8')
        with suppress(LarkError):  # what is wrong is said by the generator that asks next
            parser.get_ast_from_idl_string(text)


def write_type_descriptions(
    package: GeneratedPackage, earlier: list[GeneratedPackage], underlay: Underlay
) -> None:
    """Write the type descriptions with their RIHS01 hashes, ``<Name>.json``."""
    from rosidl_generator_type_description import generate_type_hash

    folders = {name: underlay.share(name) for name in underlay.prefixes}
    folders.pop(package.name, None)
    folders |= {other.name: other.generated(TYPE_DESCRIPTION) for other in earlier}
    include_paths = [f'{name}:{folder}' for name, folder in folders.items()]
    generate_type_hash(package.write_arguments(TYPE_DESCRIPTION, include_paths=include_paths))


class ExpandedTemplates:
    """What templates were expanded from, so that this is done again only for other contents."""

    def __init__(self, package: GeneratedPackage, generator: str) -> None:
        """Read what is known of the last time."""
        self._idl = package.idl
        self._file = package.build / f'{generator}__expanded.json'
        self._made_of = json.loads(self._file.read_text()) if self._file.exists() else {}

    @contextmanager
    def used(self) -> Iterator[None]:
        """Have rosidl expand only what has changed; write it down at the end."""
        import rosidl_pycommon

        expand = rosidl_pycommon.expand_template
        rosidl_pycommon.expand_template = functools.partial(self.expand, expand)
        try:
            yield
        finally:
            rosidl_pycommon.expand_template = expand
            self._file.write_text(json.dumps(self._made_of))

    def expand(
        self,
        expand: Callable[..., None],
        template: str,
        data: dict[str, Any],
        output: str,
        *,
        template_basepath: Path | None = None,
        **more: Any,
    ) -> None:
        """As ``rosidl_pycommon.expand_template``."""
        if template_basepath is None or 'interface_path' not in data:  # for the whole package
            expand(template, data, output, template_basepath=template_basepath, **more)
            return
        status = (template_basepath / template).stat()
        others = {name: data[name] for name in data.keys() - {'content', 'type_source_file'}}
        key = records.digest(
            f'{template_basepath} {template} {status.st_size} {status.st_mtime_ns}',
            Path(self._idl, data['interface_path']).read_bytes(),
            Path(data['type_source_file']).read_bytes(),
            repr(sorted(others.items())),
        )
        if self._made_of.get(output) != key or not Path(output).exists():
            self._made_of.pop(output, None)
            expand(template, data, output, template_basepath=template_basepath, **more)
            self._made_of[output] = key


def write_code(package: GeneratedPackage, generator: str) -> None:
    """Run one of :data:`CODE_GENERATORS`."""
    with ExpandedTemplates(package, generator).used():
        _write_code(package, generator)


def _write_code(package: GeneratedPackage, generator: str) -> None:
    if generator == 'rosidl_generator_py':
        from rosidl_generator_py import generate_py

        generate_py(package.write_arguments(generator), ['rosidl_typesupport_c', *TYPESUPPORTS])
        (package.generated(generator) / '__init__.py').touch()
    elif generator == 'rosidl_generator_c':
        from rosidl_generator_c import generate_c

        generate_c(_description_arguments(package))
    elif generator == 'rosidl_typesupport_c':
        from rosidl_typesupport_c import generate_c

        generate_c(package.write_arguments(generator), list(TYPESUPPORTS))
    elif generator == 'rosidl_typesupport_fastrtps_c':
        from rosidl_typesupport_fastrtps_c import generate_typesupport_fastrtps_c

        generate_typesupport_fastrtps_c(package.write_arguments(generator))
    else:
        from rosidl_typesupport_introspection_c import generate_c

        generate_c(package.write_arguments(generator))
    _write_visibility_header(package, generator)


def _description_arguments(package: GeneratedPackage) -> str:
    """Write the arguments of the C generator, which embeds descriptions and original texts."""
    descriptions = package.generated(TYPE_DESCRIPTION)
    idl_files = [path.with_suffix('.idl').as_posix() for path in package.source.interfaces]
    return package.write_arguments(
        'rosidl_generator_c',
        type_description_tuples=[
            f'{file}:{(descriptions / file).with_suffix(".json")}' for file in idl_files
        ],
        ros_interface_files=[
            str(package.source.folder / path) for path in package.source.interfaces
        ],
    )


def _write_visibility_header(package: GeneratedPackage, generator: str) -> None:
    """Expand the header with the export macros, which CMake's ``configure_file`` would do."""
    name = f'{generator}__visibility_control.h'
    template = package.prefix / 'share' / generator / 'resource' / f'{name}.in'
    if not template.exists():  # rosidl_typesupport_c and rosidl_generator_py have none
        return
    text = template.read_text().replace('@PROJECT_NAME_UPPER@', package.name.upper())
    header = package.generated(generator) / 'msg' / name
    records.write_if_different(header, text.replace('@PROJECT_NAME@', package.name))
