# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Learn to drive to a goal on two cores, in a few minutes: ``python examples/learn_to_drive.py``.

The policy is a matrix: two actions of four observations. Cross-entropy search draws matrices about
a mean, drives with each, and takes the mean and spread of the best for the next generation.
"""

import argparse
from concurrent.futures import ProcessPoolExecutor
import multiprocessing
import os

import gymnasium
import numpy as np

import amr_description.gym  # registers what is learned here

ENVIRONMENT = f'{amr_description.gym.__name__}:amr_description/DriveToGoal-v0'
SHAPE = (2, 4)
DRIVES = 3
_own: list[gymnasium.Env] = []


def drive(policy: np.ndarray, seed: int) -> tuple[float, bool]:
    """Drive an episode with a policy; return the rewards, and whether it reached the goal."""
    if not _own:  # one for each process
        flat = gymnasium.wrappers.FlattenObservation(gymnasium.make(ENVIRONMENT))
        _own.append(gymnasium.wrappers.RescaleAction(flat, -1.0, 1.0))
    (env,) = _own
    observed, _ = env.reset(seed=seed)
    total = 0.0
    while True:
        observed, reward, is_there, is_over, _ = env.step(np.tanh(policy @ observed))
        total += reward
        if is_there or is_over:
            return total - 0.01 * env.unwrapped.sim.time, is_there  # the sooner, the better


def score(task: tuple[np.ndarray, list[int]]) -> float:
    """Return the mean of some drives."""
    policy, seeds = task
    return float(np.mean([drive(policy, seed)[0] for seed in seeds]))


def reached(task: tuple[np.ndarray, int]) -> bool:
    """Return whether a drive reaches its goal."""
    return drive(*task)[1]


def main() -> None:
    """Learn, then drive where it has never driven."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--generations', type=int, default=15)
    parser.add_argument('--population', type=int, default=24)
    parser.add_argument('--goals', type=int, default=50, help='to which it drives at the end')
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('-o', '--output', default='policy.npy')
    options = parser.parse_args()
    rng = np.random.default_rng(options.seed)
    mean, spread = np.zeros(SHAPE), np.ones(SHAPE)
    spawn = multiprocessing.get_context('spawn')
    with ProcessPoolExecutor(os.cpu_count(), mp_context=spawn) as processes:
        for generation in range(options.generations):
            drawn = [*rng.normal(mean, spread, (options.population, *SHAPE))]
            seeds = rng.integers(2**31, size=DRIVES).tolist()  # the same goals for all
            scores = np.array([*processes.map(score, [(each, seeds) for each in drawn])])
            best = [
                drawn[index] for index in np.argsort(scores)[-max(2, options.population // 4) :]
            ]
            mean, spread = np.mean(best, axis=0), np.std(best, axis=0) + 0.05
            said = f'{scores.mean():.2f}, best {scores.max():.2f}'
            print(f'generation {generation}: {said}', flush=True)
        unseen = [(mean, seed) for seed in range(options.goals)]
        print(f'{sum(processes.map(reached, unseen))} of {len(unseen)} goals reached')
    np.save(options.output, mean)


if __name__ == '__main__':
    main()
