# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The kinds of interfaces, and the flags that choose among them."""

from argparse import ArgumentParser, Namespace

KINDS = {'msg': 'message', 'srv': 'service', 'action': 'action'}
"""The second part of an interface's name -> its kind in words."""


def add_kind_arguments(parser: ArgumentParser) -> None:
    """Add a flag for each kind."""
    for kind, word in KINDS.items():
        parser.add_argument(
            f'-{kind[0]}',
            f'--only-{kind}s',
            action='store_true',
            help=f'Print out only the {word} types',
        )


def wanted_kinds(args: Namespace) -> list[str]:
    """Return the kinds that the flags select; without flags all of them."""
    chosen = [kind for kind in KINDS if getattr(args, f'only_{kind}s')]
    return chosen or list(KINDS)


def kind_of(name: str) -> str:
    """Return the kind of ``msg/Name``."""
    return name.partition('/')[0]
