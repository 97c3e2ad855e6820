"""Fits several laws to every specimen of a folder of recordings, on the workers of a Dask cluster.

    pip install palpate[study,pandas]
    python examples/python/study_on_a_cluster.py recordings/
    python examples/python/study_on_a_cluster.py recordings/ --scheduler tcp://10.0.0.5:8786

Run it again with the same --study to continue after an interruption.
"""

import argparse
import contextlib

import palpate.study
from distributed import Client, LocalCluster

LAWS = ["neo_hookean", "mooney_rivlin", "exponential"]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("recordings", help="a folder of recordings")
    parser.add_argument("--scheduler", metavar="ADDRESS", help="of a Dask cluster; without, workers on this machine")
    parser.add_argument("--workers", type=int, default=2, help="how many on this machine")
    parser.add_argument("--study", default="study", help="the folder that keeps the answers")
    parser.add_argument("--laws", nargs="+", default=LAWS, choices=LAWS)
    parser.add_argument("--draws", type=int, default=100, help="how often each fit is made again")
    asked = parser.parse_args()

    tasks = palpate.study.characterizations(asked.recordings, laws=asked.laws, draws=asked.draws)
    with contextlib.ExitStack() as stack:
        cluster = asked.scheduler
        if cluster is None:
            # Processes of one thread each: a task computes on one core.
            cluster = LocalCluster(n_workers=asked.workers, threads_per_worker=1, dashboard_address=None)
            stack.enter_context(cluster)
        client = stack.enter_context(Client(cluster))
        study = palpate.study.run(tasks, asked.study, client)

    table = study.to_frame()
    numbers = [
        name for name in table if name.startswith("laws.") and name.endswith((".misfit", "_pa.value", ".alpha.value"))
    ]
    shown = ["specimen", "law", *numbers]
    print(table[shown].to_string(index=False))
    for place, why in study.failures.items():
        print(f"{tasks[place].name}: {why}")
    if study.failures:
        raise SystemExit(1)


if __name__ == "__main__":
    main()
