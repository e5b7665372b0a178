# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The order of a build: descriptions one after the other, all else side by side."""

from collections.abc import Callable, Iterable
from concurrent.futures import ProcessPoolExecutor
import os
from pathlib import Path
import shutil
import sys
import time

from interface_build import generators, libraries, packages, stage, toolchain


def build(source: Path, target: Path, work: Path, log: Callable[[str], None] = print) -> list[str]:
    """
    Build every package below ``source`` into the staged tree ``target``; return their names.

    ``work`` takes the intermediate files. Both are emptied first. Needs a process in which the
    ROS of PyPI is installed and its libraries are found (any Python start there sees to it).
    """
    prefix = Path(sys.prefix)
    for folder in (target, work):
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
    compilers = toolchain.find_toolchain()
    found = packages.find_packages(source)
    generated = [generators.GeneratedPackage(one, work / one.name, prefix) for one in found]
    includes = libraries.include_flags(generated, prefix)

    start = time.monotonic()
    workers = len(os.sched_getaffinity(0))
    with ProcessPoolExecutor(workers, initializer=_begin_work) as pool:
        _finish(pool.submit(generators.write_idl, package) for package in generated)
        for number, package in enumerate(generated):
            _finish([pool.submit(generators.write_type_descriptions, package, generated[:number])])
        _finish(
            pool.submit(generators.write_code, package, generator)
            for generator in generators.CODE_GENERATORS
            for package in generated
        )
        log(
            f'generated {sum(len(one.interfaces) for one in found)} interfaces'
            f' of {len(found)} packages in {time.monotonic() - start:.0f} s'
        )
        start = time.monotonic()
        jobs = [job for package in generated for job in libraries.compile_jobs(package)]
        _finish(pool.submit(libraries.compile_object, job, compilers, includes) for job in jobs)
    for package in generated:
        dependencies = packages.interface_dependencies(package.source, found, prefix)
        for job in libraries.link_jobs(package, dependencies, target):
            libraries.link(job, compilers, (target / 'lib', prefix / 'lib'))
        stage.stage_package(package, target)
    log(f'compiled and linked them in {time.monotonic() - start:.0f} s ({compilers.c[-1]})')
    return [package.name for package in found]


def _begin_work() -> None:
    """
    Prepare a worker; its output goes nowhere, as the generators tell every file they read.

    By descriptor, as EmPy 3 does not stand ``sys.stdout`` being replaced. Errors still show.
    """
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
    generators.parse_each_file_once()
    generators.scan_templates_quickly()


def _finish(futures: Iterable) -> None:
    """Wait for all; raise the first failure and drop what has not begun."""
    futures = list(futures)
    try:
        for future in futures:
            future.result()
    finally:
        for future in futures:
            future.cancel()
