# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The linter of copyright notices: what test/test_copyright.py of a package calls."""

import os

import pytest

from amr_description.ament_copyright.main import main

MIT = 'SPDX-License-Identifier: MIT\n'
APACHE = """\
# Copyright 2015 Open Source Robotics Foundation, Inc.
#
# Licensed under the Apache License, Version 2.0 (the "License");
"""


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def write(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)


@pytest.mark.parametrize(
    ('name', 'text', 'said'),
    [
        ('a.py', APACHE, 'copyright=Open Source Robotics Foundation, Inc. (2015)'),
        (
            'a.py',
            f'#!/usr/bin/env python3\n# Copyright (c) 2020-2024 Me\n# {MIT}',
            'copyright=Me (2020-2024)',
        ),
        (
            'a.cpp',
            '/*\n * Copyright 2020, Me\n * All rights reserved.\n */\nint x;\n',
            'copyright=Me (2020)',
        ),
        (
            'a.hpp',
            f'// Copyright 2020 Me\n// {MIT}',
            'copyright=Me (2020)',
        ),
        ('a.py', '\n', 'file empty'),
    ],
)
def test_files_with_a_notice_and_a_license_are_fine(folder, capsys, name, text, said):
    write(folder / name, text)
    assert main(argv=['.']) == 0
    assert capsys.readouterr().out == f'{name}: {said}\nNo problems found\n'


@pytest.mark.parametrize(
    ('text', 'said'),
    [
        ('import os\n', 'no copyright notice'),
        (f'import os\n{APACHE}', 'no copyright notice'),  # not at its beginning
        ('# Copyright 2020 Me\nimport os\n', 'a copyright notice, and no known license'),
        ('/* a comment */ int copyright;\n', 'no copyright notice'),
    ],
)
def test_what_is_wrong_is_told_by_file(folder, capsys, text, said):
    write(folder / 'right.py', APACHE)
    write(folder / 'wrong.py', text)
    assert main(argv=[]) == 1
    heard = capsys.readouterr()
    assert heard.err.startswith(f'wrong.py: {said}')
    assert heard.out.endswith('1 errors, checked 2 files\n')


def test_only_sources_that_are_not_left_out_are_looked_at(folder, capsys):
    left_out = ('b/README.md', '.hidden/d.py', '__pycache__/e.py', 'f/g.py', 'h.py')
    for name in ('a.py', 'b/c.py', *left_out):
        write(folder / name, 'nothing\n')
    write(folder / 'f/AMENT_IGNORE', '')
    assert main(argv=['.', 'b', '--exclude', 'h.py']) == 1
    listed = [line.partition(':')[0] for line in capsys.readouterr().err.splitlines()]
    assert listed == ['a.py', os.path.join('b', 'c.py')]
