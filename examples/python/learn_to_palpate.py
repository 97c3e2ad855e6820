"""Trains a policy that finds the lump in the Palpation environment, by PPO, and tests it on seeds that it has not seen.

pip install "palpate[gym]" torch matplotlib
python examples/python/learn_to_palpate.py train --seed 0 --out run-force-0.json
python examples/python/learn_to_palpate.py train --seed 0 --out run-blind-0.json --no-force
python examples/python/learn_to_palpate.py plot curves.png run-*.json

An action of the environment is a press (`action="press"`). What the policy gets is a map of the presses so far: for each
of 12 x 12 cells whether it was pressed, with which force, whether it was the last one, and the time; without force
(`--no-force`) the force is zero. It chooses the next cell, or says "here" at the last one. The network is convolutional,
so that what it learns holds for all cells.
"""

import argparse
import json
import time

import gymnasium
import numpy as np
import palpate
import palpate.gym  # noqa: F401
import torch
from gymnasium.vector import AutoresetMode
from torch import nn

CELLS = 12
DEPTH = 0.0  # third number of an action: 4 mm
FORCE, SPREAD = 0.19, 0.03  # [N] that are zero and one in the map: the healthy organ, and how it varies
PRESSES = 80  # that the time limit allows
COUNT = 32
HORIZON = 32
GAMMA, LAMBDA, CLIP, ENTROPY, EPOCHS, MINIBATCHES, RATE = 0.99, 0.95, 0.2, 0.005, 4, 4, 1.5e-3
UNSEEN = 1_000_000  # seeds from here on are for the test


class Maps:
    """The environments with cells as actions and maps as observations."""

    def __init__(self, count, has_force, simulation=None):
        if simulation is None:
            content = palpate.Scene.builtin("palpation").to_dict()
            content["model"] = {"kind": "local", "step_s": 0.02}  # a press takes 25 steps
            content["task"]["time_limit_s"] = 0.5 * PRESSES
            simulation = palpate.Simulation(palpate.Scene(content), show_every=1e9)
        self.simulation, self.count, self.has_force = simulation, count, has_force
        self.environments = gymnasium.make_vec(
            "palpate/Palpation-v0",
            num_envs=count,
            vectorization_mode="vector_entry_point",
            simulation=simulation,
            action="press",
            autoreset_mode=AutoresetMode.SAME_STEP,
        )
        self.maps = np.zeros((count, 4, CELLS, CELLS), dtype=np.float32)

    def reset(self, seed):
        self.environments.reset(seed=seed)
        self.maps[:] = 0.0
        return self.maps.copy()

    def step(self, choice):
        here = choice == CELLS**2
        row, column = np.divmod(choice % CELLS**2, CELLS)
        place = (np.stack([column, row], axis=1) + 0.5) / CELLS * 2 - 1
        actions = np.column_stack([place, np.full(self.count, DEPTH), np.where(here, 1.0, -1.0)])
        seen, reward, terminated, truncated, told = self.environments.step(actions.astype(np.float32))
        number = np.flatnonzero(~here)
        row, column = row[number], column[number]
        self.maps[number, 0, row, column] = 1.0
        if self.has_force:
            self.maps[number, 1, row, column] = (np.linalg.norm(seen[number, 3:6], axis=1) - FORCE) / SPREAD
        self.maps[number, 2] = 0.0
        self.maps[number, 2, row, column] = 1.0
        self.maps[:, 3] = seen[:, 7, None, None]
        ended = terminated | truncated
        self.maps[ended] = 0.0
        found = np.zeros(self.count, dtype=bool)
        for number in np.flatnonzero(ended):
            found[number] = told["final_info"]["passed"][number]
        return self.maps.copy(), reward, ended, found


class Policy(nn.Module):
    """A logit for each cell, one for "here", and the value."""

    def __init__(self, width=16):
        super().__init__()
        self.body = nn.Sequential(
            nn.Conv2d(4, width, 3, padding=1), nn.ReLU(),
            nn.Conv2d(width, width, 3, padding=1), nn.ReLU(),
        )  # fmt: skip
        self.cells = nn.Conv2d(width, 1, 1)
        self.whole = nn.Sequential(nn.Linear(3 * width, 64), nn.Tanh(), nn.Linear(64, 2))
        self.felt = nn.Linear(1, 1)
        for layer in (self.cells, self.whole[2], self.felt):
            nn.init.zeros_(layer.weight)
        # At first it says "here" in one action of ten.
        nn.init.constant_(self.felt.bias, np.log(CELLS**2 / 10.0))

    def forward(self, maps):
        seen = self.body(maps)
        last = maps[:, 2:3]
        parts = [seen.amax((2, 3)), seen.mean((2, 3)), (seen * last).sum((2, 3))]
        here, worth = self.whole(torch.cat(parts, 1)).T
        here = here[:, None] + self.felt((maps[:, 1:2] * last).sum((2, 3)))
        logits = torch.cat([self.cells(seen).flatten(1), here], 1)
        return torch.distributions.Categorical(logits=logits), worth


def tested(policy, maps, episodes=200):
    """The part of unseen seeds in which the lump is found, and the mean number of presses. Actions are drawn as in
    training: the likeliest one alone may repeat itself for ever."""
    found, presses = [], []
    for first in range(0, episodes, maps.count):
        seen = maps.reset(UNSEEN + first)
        waits = np.ones(maps.count, dtype=bool)
        waits[episodes - first :] = False
        number = 0
        while waits.any():
            with torch.no_grad():
                choice = policy(torch.from_numpy(seen))[0].sample().numpy()
            seen, _, ended, passed = maps.step(choice)
            number += 1
            found += passed[ended & waits].tolist()
            presses += [number] * int((ended & waits).sum())
            waits &= ~ended
    return float(np.mean(found)), float(np.mean(presses))


def train(seed, has_force, presses, limit):
    torch.manual_seed(seed)
    torch.set_num_threads(1)
    began = time.perf_counter()
    maps = Maps(COUNT, has_force)
    policy = Policy()
    optimizer = torch.optim.Adam(policy.parameters(), lr=RATE, eps=1e-5)
    seen, curve, recent = maps.reset(1000 * seed), [], []
    updates = presses // (COUNT * HORIZON)
    for update in range(updates):
        optimizer.param_groups[0]["lr"] = RATE * (1 - update / updates)
        store = [[] for _ in range(6)]
        for _ in range(HORIZON):
            with torch.no_grad():
                choices, value = policy(torch.from_numpy(seen))
                choice = choices.sample()
            after, reward, ended, passed = maps.step(choice.numpy())
            row = (seen, choice, choices.log_prob(choice), value, reward, ended)
            for part, own in zip(store, row, strict=True):
                part.append(torch.as_tensor(own))
            recent += passed[ended].tolist()
            seen = after
        states, choice, chance, value, reward, ended = [torch.stack(part) for part in store]
        with torch.no_grad():
            next_value, advantage = policy(torch.from_numpy(seen))[1], torch.zeros(COUNT)
            advantages = torch.zeros(HORIZON, COUNT)
            for t in reversed(range(HORIZON)):
                goes_on = 1.0 - ended[t].float()
                error = reward[t].float() + GAMMA * next_value * goes_on - value[t]
                advantage = error + GAMMA * LAMBDA * goes_on * advantage
                advantages[t], next_value = advantage, value[t]
        goal = (advantages + value).flatten()
        states, choice, chance, advantages = [part.flatten(0, 1) for part in (states, choice, chance, advantages)]
        for _ in range(EPOCHS):
            for part in torch.randperm(len(choice)).chunk(MINIBATCHES):
                choices, value = policy(states[part])
                ratio = (choices.log_prob(choice[part]) - chance[part]).exp()
                own = advantages[part]
                own = (own - own.mean()) / (own.std() + 1e-8)
                gain = torch.min(ratio * own, ratio.clamp(1 - CLIP, 1 + CLIP) * own).mean()
                loss = 0.5 * (value - goal[part]).square().mean() - gain - ENTROPY * choices.entropy().mean()
                optimizer.zero_grad()
                loss.backward()
                nn.utils.clip_grad_norm_(policy.parameters(), 0.5)
                optimizer.step()
        if recent and (update % 10 == 9 or update == updates - 1):
            done, seconds = (update + 1) * COUNT * HORIZON, time.perf_counter() - began
            curve.append([done, seconds, float(np.mean(recent)), len(recent)])
            print(f"{done} presses, {seconds:.0f} s: found in {100 * np.mean(recent):.0f} % of {len(recent)} episodes", flush=True)
            recent = []
            if seconds > limit:
                break
    seconds = time.perf_counter() - began
    rate, needed = tested(policy, Maps(COUNT, has_force, maps.simulation))
    print(f"seed {seed}, {'with' if has_force else 'without'} force: finds {100 * rate:.1f} % of 200 unseen, {needed:.1f} presses each, after {seconds:.0f} s")
    return policy, {"seed": seed, "force": has_force, "curve": curve, "seconds": seconds, "found": rate, "presses": needed}


def plot(path, runs):
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(figsize=(6, 3.6))
    for own in map(lambda run: json.load(open(run)), runs):
        done, _, found, _ = np.array(own["curve"]).T
        name = ("with" if own["force"] else "without") + " force"
        axes.plot(done / 1000, 100 * found, "C0" if own["force"] else "C1", label=name if own["seed"] == 0 else None, lw=1)
    axes.set(xlabel="presses in training [thousands]", ylabel="lump found [% of episodes]", ylim=(0, 100))
    axes.grid(alpha=0.3)
    axes.legend()
    figure.tight_layout()
    figure.savefig(path, dpi=120)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parts = parser.add_subparsers(dest="part", required=True)
    training = parts.add_parser("train")
    training.add_argument("--seed", type=int, default=0)
    training.add_argument("--no-force", action="store_true")
    training.add_argument("--presses", type=int, default=80_000)
    training.add_argument("--limit", type=float, default=1800.0, help="seconds")
    training.add_argument("--out", required=True)
    picture = parts.add_parser("plot")
    picture.add_argument("picture")
    picture.add_argument("runs", nargs="+")
    chosen = parser.parse_args()
    if chosen.part == "plot":
        plot(chosen.picture, chosen.runs)
        return
    policy, result = train(chosen.seed, not chosen.no_force, chosen.presses, chosen.limit)
    with open(chosen.out, "w") as file:
        json.dump(result, file)
    torch.save(policy.state_dict(), chosen.out.removesuffix(".json") + ".pt")


if __name__ == "__main__":
    main()
