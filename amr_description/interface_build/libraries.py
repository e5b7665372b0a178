# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Compile and link the libraries of a package.

Five shared libraries go to ``lib/`` (``rosidl_typesupport_c`` opens the others by their bare
name, so they must lie where the loader looks), three Python extensions into the Python package.
All that is compiled together shares its headers, and these take most of the time: sources are
gathered into a few big translation units (38 Fast CDR sources: 22 s apart, 5 s together).
"""

from collections.abc import Sequence
from dataclasses import dataclass
import os
from pathlib import Path
import subprocess
import sysconfig

from amr_description.errors import InterfaceBuildError
from amr_description.interface_build import records
from amr_description.interface_build.generators import GeneratedPackage, TYPESUPPORTS
from amr_description.interface_build.packages import Underlay
from amr_description.interface_build.toolchain import FLAGS, python_headers, Toolchain

SOURCES_PER_UNIT = 20


@dataclass(frozen=True)
class Library:
    """A shared library ``lib<package>__<name>.so``, made of what that generator wrote."""

    name: str
    calls: tuple[str, ...]
    """The libraries of the wheels that it calls."""
    calls_ours: tuple[str, ...] = ()
    """The libraries that it calls of its own package and of those the package depends on."""
    link_as_cpp: bool = False


# In the order of linking: what is called comes first.
LIBRARIES = (
    Library('rosidl_generator_c', ('rosidl_runtime_c', 'rcutils')),
    Library(
        'rosidl_typesupport_fastrtps_c',
        (
            'rosidl_typesupport_fastrtps_c',
            'rosidl_typesupport_fastrtps_cpp',
            'fastcdr',
            'rmw',
            'rosidl_runtime_c',
            'rcutils',
        ),
        ('rosidl_generator_c',),
        link_as_cpp=True,
    ),
    Library(
        'rosidl_typesupport_introspection_c',
        ('rosidl_typesupport_introspection_c', 'rosidl_runtime_c'),
        ('rosidl_generator_c',),
    ),
    Library(
        'rosidl_typesupport_c',
        ('rosidl_typesupport_c', 'rosidl_runtime_c'),
        ('rosidl_generator_c',),
        link_as_cpp=True,
    ),
    Library(
        'rosidl_generator_py',
        ('rosidl_runtime_c',),
        ('rosidl_typesupport_c', 'rosidl_generator_c'),
    ),
)
# One Python extension for each: rclpy asks for the first, which dispatches to the others.
EXTENSIONS = ('rosidl_typesupport_c', *TYPESUPPORTS)
EXTENSION_CALLS = ('rosidl_typesupport_c', 'rosidl_runtime_c')


@dataclass(frozen=True)
class CompileJob:
    """One object file to make."""

    source: Path
    object: Path


@dataclass(frozen=True)
class LinkJob:
    """One shared object to make."""

    output: Path
    objects: list[Path]
    calls: tuple[str, ...]
    """The libraries that it calls, without ``lib`` and ``.so``."""
    run_path: str
    """Where it looks for them once installed."""
    as_cpp: bool = False
    loads: tuple[str, ...] = ()
    """Libraries that are loaded with it, though it does not call them."""
    comes_first: bool = False
    """Whether the run path comes before ``LD_LIBRARY_PATH``."""


def extension_source(package: GeneratedPackage, typesupport: str) -> Path:
    """Return the C source of the Python extension that brings in ``typesupport``."""
    name = f'_{package.name}_s.ep.{typesupport}.c'
    return package.generated('rosidl_generator_py') / name


def extension_object(package: GeneratedPackage, typesupport: str) -> Path:
    """Return the object file of :func:`extension_source`."""
    return package.build / 'objects' / f'extension_{typesupport}.o'


def object_folder(package: GeneratedPackage, library: str) -> Path:
    """Return where the object files of ``library`` go."""
    return package.build / 'objects' / library


def compile_jobs(package: GeneratedPackage) -> list[CompileJob]:
    """Write the translation units of ``package`` and return what there is to compile."""
    jobs = []
    for library in LIBRARIES:
        folder = object_folder(package, library.name)
        folder.mkdir(parents=True, exist_ok=True)
        present = set(folder.iterdir())
        sources = sorted(
            path
            for path in package.generated(library.name).rglob('*.c*')
            if '.ep.' not in path.name
        )
        for number, unit in enumerate(translation_units(sources)):
            source = folder / f'unit_{number}{unit[0].suffix}'
            records.write_if_different(source, ''.join(f'#include "{path}"\n' for path in unit))
            jobs.append(CompileJob(source, source.with_suffix('.o')))
            present -= {source, *(source.with_suffix(suffix) for suffix in ('.o', '.made', '.d'))}
        for path in present:  # of an earlier build
            if path.suffix != '.linked':
                path.unlink()
    for extension in EXTENSIONS:
        source = extension_source(package, extension)
        jobs.append(CompileJob(source, extension_object(package, extension)))
    return jobs


def translation_units(sources: list[Path]) -> list[list[Path]]:
    """
    Gather sources that can be compiled as one.

    The type descriptions cannot: each defines statics of the same names.
    """
    apart = [[path] for path in sources if path.stem.endswith('__description')]
    together = [path for path in sources if not path.stem.endswith('__description')]
    return [
        together[start : start + SOURCES_PER_UNIT]
        for start in range(0, len(together), SOURCES_PER_UNIT)
    ] + apart


def include_flags(packages: list[GeneratedPackage], underlay: Underlay) -> list[str]:
    """Return the ``-I`` flags: our generated headers, those installed, Python's, numpy's."""
    import numpy

    ours = [
        package.generated(generator).parent
        for package in packages
        for generator in ('rosidl_generator_c', *TYPESUPPORTS)
    ]
    installed = [
        folder
        for prefix in (*underlay.overlays, underlay.wheels)
        for folder in sorted(prefix.glob('include/*'))
        if (folder / folder.name).is_dir()
    ]
    others = [underlay.wheels / 'include', python_headers(), Path(numpy.get_include())]
    return [f'-I{folder}' for folder in (*ours, *installed, *others)]


def compile_object(job: CompileJob, toolchain: Toolchain, includes: list[str]) -> None:
    """Make one object file; raise :class:`InterfaceBuildError` with what the compiler said."""
    read, record = (job.object.with_suffix(suffix) for suffix in ('.d', '.made'))
    files = ['-c', str(job.source), '-o', str(job.object), '-MMD', '-MF', str(read)]
    command = [*toolchain.compiler_for(job.source), *FLAGS, *includes, *files]
    if not records.is_current(job.object, record, command):
        _run(command)
        records.write(record, command, records.dependencies(read))


def link_jobs(
    package: GeneratedPackage,
    dependencies: list[str],
    stage: Path,
    others_at: Sequence[str] | None = None,
) -> list[LinkJob]:
    """
    Return what there is to link into ``stage``, in an order in which each finds its callees.

    Args:
        package: it is compiled.
        dependencies: the interface packages that it reaches.
        stage: where the libraries go.
        others_at: for a package in a workspace, where libraries of others are, relative to its own
            ``lib/``. These and its own are then found before those on ``LD_LIBRARY_PATH``, where
            the underlay may have packages of the same names.
    """
    jobs = []
    in_workspace = others_at is not None
    for library in LIBRARIES:
        own = [f'{package.name}__{other}' for other in library.calls_ours]
        called = (library.name, *library.calls_ours)
        others = [f'{name}__{other}' for name in dependencies for other in called]
        output = stage / 'lib' / f'lib{package.name}__{library.name}.so'
        objects = sorted(object_folder(package, library.name).glob('*.o'))
        calls = (*own, *others, *library.calls)
        run_path = _run_path('$ORIGIN', others_at)
        # Opened by its bare name, unless it is loaded already.
        opens = in_workspace and library.name == 'rosidl_typesupport_c'
        loads = (f'{package.name}__rosidl_typesupport_fastrtps_c',) if opens else ()
        jobs.append(
            LinkJob(output, objects, calls, run_path, library.link_as_cpp, loads, in_workspace)
        )
    suffix = sysconfig.get_config_var('EXT_SUFFIX')
    to_lib = '$ORIGIN/../../..'  # from lib/python3.x/site-packages/<package>
    for extension in EXTENSIONS:
        parts = {'rosidl_generator_py', 'rosidl_generator_c', 'rosidl_typesupport_c', extension}
        calls = (*(f'{package.name}__{other}' for other in sorted(parts)), *EXTENSION_CALLS)
        output = stage / 'python' / package.name / f'{package.name}_s__{extension}{suffix}'
        objects = [extension_object(package, extension)]
        run_path = _run_path(to_lib, others_at)
        jobs.append(LinkJob(output, objects, calls, run_path, comes_first=in_workspace))
    return jobs


def _run_path(lib: str, others: Sequence[str] | None) -> str:
    """Return the folders to look in for libraries: ``lib``, and others relative to it."""
    return ':'.join([lib, *(f'{lib}/{other}' for other in others or ())])


def link(job: LinkJob, toolchain: Toolchain, folders: tuple[Path, ...]) -> None:
    """Make one shared object; the libraries that it calls are looked for in ``folders``."""
    job.output.parent.mkdir(parents=True, exist_ok=True)
    compiler = toolchain.cpp if job.as_cpp else toolchain.c
    run_path = [f'-Wl,-soname,{job.output.name}', f'-Wl,-rpath,{job.run_path}']
    if job.comes_first:
        run_path.append('-Wl,--disable-new-dtags')
    loaded = [str(find_library(name, folders)) for name in job.loads]
    called = [str(find_library(name, folders)) for name in job.calls]
    command = [*compiler, '-shared', '-s', '-o', str(job.output), *map(str, job.objects)]
    command += run_path
    command += ['-Wl,--no-as-needed', *loaded] if loaded else []
    command += ['-Wl,--as-needed', *called]
    record = job.objects[0].parent / f'{job.output.name}.linked'
    if not records.is_current(job.output, record, command):
        _run(command)
        records.write(record, command, job.objects)


def find_library(name: str, folders: tuple[Path, ...]) -> Path:
    """
    Return the path of a shared library; raise InterfaceBuildError when it is in no folder.

    Found here and not by ``-L``: zig would write those folders into the run path.
    """
    for folder in folders:
        if (path := folder / f'lib{name}.so').exists():
            return path
    raise InterfaceBuildError(f'lib{name}.so is not in {" nor in ".join(map(str, folders))}')


def _run(command: list[str]) -> None:
    """Run a compiler or linker; raise :class:`InterfaceBuildError` with what it said."""
    environment = {**os.environ, 'LC_ALL': 'C'}
    done = subprocess.run(command, capture_output=True, text=True, env=environment)
    if done.returncode != 0:
        raise InterfaceBuildError(f'{" ".join(command)}\n{done.stderr}')
