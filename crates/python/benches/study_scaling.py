"""Strong and weak scaling of a study on Dask workers of this machine, and what it costs to ship data.

    python crates/python/benches/study_scaling.py [--workers 1 2 4] [--picture scaling.png]

Every task is a punch on a block by finite elements, some seconds on one core. Strong: the same tasks on more workers.
Weak: as many tasks for each worker. The limit is the number of cores, which is told. Shipping: the time of a task that
does nothing but unpack what it was sent, beside one that is sent nothing, for recordings of growing length.
"""

from __future__ import annotations

import argparse
import os
import time
from typing import Any

from distributed import Client, LocalCluster
from palpate import study
from palpate.study.task import Task, unpacked

PUNCH: dict[str, Any] = {
    "kind": "indentation",
    "block": {"radius_m": 0.05, "height_m": 0.05},
    "indenter": {"radius_m": 0.002, "face": "stick", "side": "stick"},
    "depths_m": [0.0005, 0.001],
    "accuracy": 0.01,
    "tissue": {"law": "neo_hookean", "c10_pa": 500.0},
}


def punches(count: int) -> list[Task]:
    """Tasks that are all different."""
    return study.solves(PUNCH, {"tissue.c10_pa": [500.0 + 10.0 * place for place in range(count)]})


def timed(workers: int, tasks: list[Task]) -> float:
    """How long `tasks` take on so many workers that are ready [s]."""
    with (
        LocalCluster(n_workers=workers, threads_per_worker=1, dashboard_address=None) as cluster,
        Client(cluster) as client,
    ):
        # Every worker has imported the package.
        client.run(study.run, [], progress=False)
        begin = time.perf_counter()
        found = study.run(tasks, client=client, progress=False)
        assert not found.failures, found.failures
        return time.perf_counter() - begin


def shipping(client: Client) -> list[tuple[int, int, float]]:
    """Samples of a recording, bytes that travel, and the median time there and back [s]."""
    rows = []
    for samples in (0, 1_000, 10_000, 100_000):
        text = "".join(f"{0.001 * place:.3f},{1e-6 * place:.6f},{1e-5 * place:.6f}\n" for place in range(samples))
        times = []
        for turn in range(15):
            packed = Task("ship", "none", {"text": text, "turn": turn}).packed
            begin = time.perf_counter()
            client.submit(len_of, packed, pure=False).result()
            times.append(time.perf_counter() - begin)
        rows.append((samples, len(packed), sorted(times)[len(times) // 2]))
    return rows


def len_of(packed: bytes) -> int:
    """What a worker does that does nothing."""
    return len(unpacked(packed))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--workers", type=int, nargs="+", default=[1, 2, 4])
    parser.add_argument("--tasks", type=int, default=12, help="for each worker in weak scaling, for all in strong")
    parser.add_argument("--picture", help="a PNG with both curves")
    asked = parser.parse_args()
    cores = len(os.sched_getaffinity(0))
    strong = {workers: timed(workers, punches(asked.tasks)) for workers in asked.workers}
    weak = {workers: timed(workers, punches(asked.tasks * workers)) for workers in asked.workers}
    one = asked.workers[0]
    print(f"{cores} cores; {asked.tasks} tasks")
    for workers in asked.workers:
        speed_up = strong[one] / strong[workers]
        print(
            f"{workers} workers: strong {strong[workers]:.1f} s, {speed_up:.2f} times as fast; "
            f"weak {weak[workers]:.1f} s, {weak[one] / weak[workers]:.0%} efficient"
        )
    with LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
        for samples, sent, took in shipping(client):
            print(f"shipping {samples} samples: {1e-3 * sent:.1f} kB, {1e3 * took:.1f} ms there and back")
    if asked.picture:
        draw(asked.picture, cores, strong, weak)


def draw(file: str, cores: int, strong: dict[int, float], weak: dict[int, float]) -> None:
    """Both curves beside what the cores allow."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    workers = list(strong)
    one = workers[0]
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
    left.plot(workers, [min(count, cores) / one for count in workers], "k--", label=f"limit of {cores} cores")
    left.plot(workers, [strong[one] / strong[count] for count in workers], "o-", label="measured")
    left.set(title="Strong scaling", xlabel="Workers", ylabel="Speed over one worker", xticks=workers, ylim=(0, None))
    right.plot(workers, [min(1.0, cores / count) for count in workers], "k--", label=f"limit of {cores} cores")
    right.plot(workers, [weak[one] / weak[count] for count in workers], "o-", label="measured")
    right.set(title="Weak scaling", xlabel="Workers", ylabel="Efficiency", xticks=workers, ylim=(0, 1.1))
    for axes in (left, right):
        axes.legend(frameon=False)
        axes.grid(alpha=0.3)
    figure.savefig(file, dpi=150)


if __name__ == "__main__":
    main()
