# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The order of a build: descriptions one after the other, all else side by side."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import Future, ProcessPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass
import os
from pathlib import Path
import shutil
import sys
import time
from typing import Any

from amr_description.interface_build import generators, libraries, packages, stage, toolchain
from amr_description.interface_build.packages import InterfacePackage, Underlay


@dataclass(frozen=True)
class Target:
    """Where a build goes."""

    stage: Path
    """The tree to lay over a prefix."""
    work: Path
    """Intermediate files: what is there and up to date is not made again."""
    run_path: Sequence[str] | None = None
    """Of a package in a workspace: see :func:`.libraries.link_jobs`."""


def build(source: Path, target: Path, work: Path, log: Callable[[str], None] = print) -> list[str]:
    """
    Build every package below ``source`` into the staged tree ``target``; return their names.

    ``work`` takes the intermediate files. Both are emptied first. Needs a process in which the
    ROS of PyPI is installed and its libraries are found (any Python start there sees to it).
    """
    for folder in (target, work):
        shutil.rmtree(folder, ignore_errors=True)
    found = packages.find_packages(source)
    build_packages(found, packages.find_underlay(Path(sys.prefix)), Target(target, work), log)
    return [package.name for package in found]


def build_packages(
    found: Sequence[InterfacePackage],
    underlay: Underlay,
    target: Target,
    log: Callable[[str], None],
) -> None:
    """
    Build packages into a staged tree.

    Args:
        found: dependencies first.
        underlay: what is installed.
        target: where to.
        log: is told how long it took.

    Raises:
        InterfaceBuildError: there is no compiler, or it has found a fault.
    """
    for folder in (target.stage, target.work):
        folder.mkdir(parents=True, exist_ok=True)
    generators.find_parser()
    compilers = toolchain.find_toolchain()
    generated = [
        generators.GeneratedPackage(one, target.work / one.name, underlay.wheels) for one in found
    ]
    start = time.monotonic()
    _generate(generated, underlay, target.work)
    count = sum(len(one.interfaces) for one in found)
    took = time.monotonic() - start
    log(f'generated {count} interfaces of {len(found)} packages in {took:.0f} s')
    start = time.monotonic()
    includes = libraries.include_flags(generated, underlay)
    jobs = [job for package in generated for job in libraries.compile_jobs(package)]
    with _workers(_begin_work) as pool:
        _finish(pool.submit(libraries.compile_object, job, compilers, includes) for job in jobs)
    folders = (target.stage / 'lib', *underlay.library_folders)
    for package in generated:
        dependencies = packages.interface_dependencies(package.source, found, underlay)
        for link in libraries.link_jobs(package, dependencies, target.stage, target.run_path):
            libraries.link(link, compilers, folders)
        stage.stage_package(package, target.stage)
    took = time.monotonic() - start
    log(f'compiled and linked them in {took:.0f} s ({compilers.c[-1]})')


def _generate(
    generated: list[generators.GeneratedPackage], underlay: Underlay, work: Path
) -> None:
    """
    Write the sources of all packages.

    The definitions are parsed once: the workers that write code are forked after that.
    """
    generators.parse_each_file_once(work / 'parsed')
    with _workers(_begin_to_generate) as pool:
        _finish(pool.submit(generators.write_idl, package) for package in generated)
    with _quiet():
        for number, package in enumerate(generated):
            generators.write_type_descriptions(package, generated[:number], underlay)
    with _workers(_begin_to_generate) as pool:
        _finish(
            pool.submit(generators.write_code, package, generator)
            for generator in generators.CODE_GENERATORS
            for package in generated
        )


def _workers(begin: Callable[[], None]) -> ProcessPoolExecutor:
    return ProcessPoolExecutor(len(os.sched_getaffinity(0)), initializer=begin)


def _begin_work() -> None:
    """
    Prepare a worker; its output goes nowhere, as the generators tell every file they read.

    By descriptor, as EmPy 3 does not stand ``sys.stdout`` being replaced. Errors still show.
    """
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)


def _begin_to_generate() -> None:
    _begin_work()
    generators.read_templates_once()


@contextmanager
def _quiet() -> Iterator[None]:
    """Let standard output of this process go nowhere for a while."""
    sys.stdout.flush()
    kept = os.dup(1)
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    try:
        yield
    finally:
        sys.stdout.flush()
        os.dup2(kept, 1)
        os.close(kept)
        os.close(nowhere)


def _finish(futures: Iterable[Future[Any]]) -> None:
    """Wait for all; raise the first failure and drop what has not begun."""
    futures = list(futures)
    try:
        for future in futures:
            future.result()
    finally:
        for future in futures:
            future.cancel()
