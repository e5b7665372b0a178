# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Find a C and C++ compiler that really works.

In this order: ``$CC`` and ``$CXX``; gcc and g++; clang and clang++; zig, which comes from PyPI
(``ziglang``) and so needs no root. A candidate counts when it compiles and links the probe below:
a g++ without libstdc++ headers is passed over, and the reason kept for the message.
"""

from collections.abc import Iterator
from dataclasses import dataclass
import importlib.util
import os
from pathlib import Path
import shlex
import shutil
import subprocess
import sys
import sysconfig
import tempfile

from amr_description.errors import CompilerError, InterfaceBuildError

# Those of CMake's release builds, but for its -O2: it takes 1.6 times as long to compile, and no
# message is serialised any faster.
FLAGS = ('-O1', '-DNDEBUG', '-fPIC')
PROBE = {
    'probe.c': '#include <stdint.h>\nint32_t one(void) { return 1; }\n',
    'probe.cpp': '#include <string>\nstd::string two() { return std::string("2"); }\n',
}


@dataclass(frozen=True)
class Toolchain:
    """Two commands, each the beginning of a command line."""

    c: tuple[str, ...]
    cpp: tuple[str, ...]

    def compiler_for(self, source: Path) -> tuple[str, ...]:
        """Return the command and the language standard for a ``.c`` or ``.cpp`` file."""
        if source.suffix == '.cpp':
            return (*self.cpp, '-std=c++17')
        return (*self.c, '-std=gnu11')


def python_headers() -> Path:
    """Return the folder of ``Python.h``; raise InterfaceBuildError when there is none."""
    of_system = Path(sysconfig.get_path('include'))
    # scripts/setup puts them there where the system has none.
    of_environment = Path(sys.prefix, 'include', of_system.name)
    for folder in (of_system, of_environment):
        if (folder / 'Python.h').is_file():
            return folder
    python = 'python{}.{}'.format(*sys.version_info)
    raise InterfaceBuildError(
        f'{of_system}/Python.h not found: this Python ({sys.executable}) came without its C'
        f' headers; install them (Debian, Ubuntu: {python}-dev; Fedora: {python}-devel) or use'
        ' another Python (uv python install 3.12)'
    )


def candidates(environment: dict[str, str]) -> Iterator[Toolchain]:
    """Yield the toolchains worth trying, the preferred one first."""
    if 'CC' in environment and 'CXX' in environment:
        yield Toolchain(
            tuple(shlex.split(environment['CC'])), tuple(shlex.split(environment['CXX']))
        )
    for c, cpp in (('gcc', 'g++'), ('clang', 'clang++')):
        if shutil.which(c) and shutil.which(cpp):
            yield Toolchain((c,), (cpp,))
    if importlib.util.find_spec('ziglang'):
        zig = (sys.executable, '-m', 'ziglang')
        yield Toolchain((*zig, 'cc'), (*zig, 'c++'))


def complaint(toolchain: Toolchain) -> str | None:
    """Return what keeps ``toolchain`` from building a shared library; None when it can."""
    with tempfile.TemporaryDirectory(prefix='interface_build-') as folder:
        for name, text in PROBE.items():
            source = Path(folder, name)
            source.write_text(text)
            # With the flags of the build: zig compiles its C++ library for each set of them.
            command = [*toolchain.compiler_for(source), *FLAGS, '-shared', str(source)]
            command += ['-o', f'{source}.so']
            try:
                subprocess.run(command, capture_output=True, text=True, check=True)
            except OSError as error:
                return f'{command[0]}: {error.strerror}'
            except subprocess.CalledProcessError as error:
                first_line = (error.stderr.strip() or 'no message').splitlines()[0]
                return f'{" ".join(command[:-3])}: {first_line}'
    return None


def find_toolchain(environment: dict[str, str] | None = None) -> Toolchain:
    """Return the first candidate that works; raise :class:`CompilerError` saying why none does."""
    faults = []
    for toolchain in candidates(dict(os.environ) if environment is None else environment):
        fault = complaint(toolchain)
        if fault is None:
            return toolchain
        faults.append(fault)
    raise CompilerError(
        f'no working C and C++ compiler ({"; ".join(faults) or "neither gcc nor clang on PATH"});'
        ' install one (Debian, Ubuntu: g++), or, without root: pip install ziglang'
    )
