# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A share of the mutations that ``scripts/fuzz_urdf`` judges by the ten thousands."""

import pytest
from support.fuzz_urdf import bounded, judge, LONGEST, mutation


@pytest.mark.parametrize('block', range(8))
def test_no_mutation_ends_otherwise_than_in_findings(block):
    """Nothing but findings comes out, in bounded time, and what has no error can be used."""
    for seed in range(block * 50, block * 50 + 50):
        with bounded(LONGEST):
            assert judge(mutation(seed), drop=seed % 25 == 0) in (0, 1, 255), seed


@pytest.mark.long
@pytest.mark.parametrize('block', range(20))
def test_nor_does_one_of_twenty_thousand(block):
    for seed in range(block * 1_000 + 400, block * 1_000 + 1_400):
        with bounded(LONGEST):
            assert judge(mutation(seed), drop=seed % 25 == 0) in (0, 1, 255), seed


def test_a_seed_gives_the_same_mutation():
    assert [mutation(seed) for seed in range(20)] == [mutation(seed) for seed in range(20)]
    assert len({mutation(seed) for seed in range(20)}) == 20


def test_mutations_are_of_all_kinds():
    codes = {judge(mutation(seed)) for seed in range(100)}
    assert codes == {0, 1, 255}
