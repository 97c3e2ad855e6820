"""Doing tasks: here on threads, or on the workers of a Dask client."""

from __future__ import annotations

import contextlib
import json
import os
import threading
import time
from collections.abc import Callable, Generator, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from typing import TYPE_CHECKING, Any

from palpate import fits, jobs
from palpate.errors import PalpateError
from palpate.study.folder import Folder
from palpate.study.task import Task, execute, unpacked

if TYPE_CHECKING:
    import distributed
    import pandas

#: A finished task: its place, its answer or why there is none, and what is to be said of the run.
Finished = tuple[int, "str | BaseException", dict[str, Any]]


class Study:
    """Tasks with their answers.

    Attributes
    ----------
    tasks : list of Task
    answers : list of dict or None
        In the order of the tasks; none where a task failed.
    failures : dict of int to str
        By the place of a task, the sentence that says why it has no answer.
    """

    def __init__(self, tasks: Sequence[Task], answers: Sequence[str | None], failures: dict[int, str]) -> None:
        self.tasks = list(tasks)
        self.answers: list[dict[str, Any] | None] = [
            None if answer is None else json.loads(answer) for answer in answers
        ]
        self.failures = failures

    def to_frame(self) -> pandas.DataFrame:
        """Return a row for each task: its labels, and every number and text of its answer under names with dots."""
        import pandas

        return pandas.DataFrame([_row(task, answer) for task, answer in zip(self.tasks, self.answers, strict=True)])


def run(
    tasks: Sequence[Task],
    folder: str | os.PathLike[str] | None = None,
    client: distributed.Client | None = None,
    *,
    retries: int = 3,
    progress: jobs.Progress = None,
) -> Study:
    """Do every task that ``folder`` does not hold yet.

    Answers are the same to the last bit wherever they are found. What is finished is kept at once: a study that was
    stopped, or whose machine went down, goes on when it is run again. One task that fails does not stop the others.

    Parameters
    ----------
    tasks : sequence of Task
    folder : path, optional
        Keeps the answers, and ``study.csv`` with a row for each task.
    client : distributed.Client, optional
        Whose workers do the tasks; by default threads of this process do, as many as there are cores.
    retries : int
        How often a task is given to other workers after the one that had it was lost.
    progress : callable, False or None
        Hears ``(part, words)``; ``False`` for silence.
    """
    kept = None if folder is None else Folder(folder)
    answers: list[str | None] = [None if kept is None else kept.read(task) for task in tasks]
    missing = [place for place, answer in enumerate(answers) if answer is None]
    failures: dict[int, str] = {}
    done = len(tasks) - len(missing)
    with _told(progress) as tell:
        tell(done / max(1, len(tasks)), f"{done} of {len(tasks)} tasks are kept")
        asked = [(place, tasks[place]) for place in missing]
        finished = _here(asked) if client is None else _distributed(asked, client, retries)
        with contextlib.closing(finished):
            for place, answer, of_the_run in finished:
                task = tasks[place]
                if isinstance(answer, BaseException):
                    failures[place] = str(answer) or type(answer).__name__
                else:
                    answers[place] = answer
                    if kept is not None:
                        kept.write(task, answer, of_the_run)
                done += 1
                tell(done / len(tasks), f"{task.name} ({done} of {len(tasks)})")
    study = Study(tasks, answers, failures)
    if kept is not None:
        kept.write_text("study.csv", _table(study))
    return study


def _here(asked: Sequence[tuple[int, Task]]) -> Generator[Finished, None, None]:
    """Do tasks on threads; the extension computes without the interpreter's lock."""
    stopped = threading.Event()

    def hear(_part: float, _words: str) -> None:
        if stopped.is_set():
            raise KeyboardInterrupt

    def work(task: Task) -> tuple[str, dict[str, Any]]:
        begin = time.perf_counter()
        answer = execute(task.document, hear)
        return answer, {"worker": "here", "seconds": time.perf_counter() - begin}

    with ThreadPoolExecutor(max_workers=_cores()) as pool:
        futures: dict[Future[tuple[str, dict[str, Any]]], int] = {
            pool.submit(work, task): place for place, task in asked
        }
        pending = set(futures)
        try:
            while pending:
                ended, pending = wait(pending, return_when=FIRST_COMPLETED)
                for future in ended:
                    error = future.exception()
                    if error is None:
                        yield (futures[future], *future.result())
                    else:
                        yield futures[future], error, {}
        finally:
            stopped.set()
            pool.shutdown(cancel_futures=True)


def _distributed(
    asked: Sequence[tuple[int, Task]], client: distributed.Client, retries: int
) -> Generator[Finished, None, None]:
    """Do tasks on the workers of ``client``; a task whose worker is lost is done by another."""
    from distributed import KilledWorker, as_completed

    places: dict[str, list[int]] = {}
    by_key: dict[str, Task] = {}
    for place, task in asked:
        places.setdefault(task.key, []).append(place)
        by_key[task.key] = task
    lost = dict.fromkeys(by_key, 0)

    def submit(task: Task) -> distributed.Future[Any]:
        return client.submit(_on_worker, task.packed, key=f"palpate-{task.key}", pure=True)

    keys = {}
    waited = as_completed()
    for task in by_key.values():
        future = submit(task)
        keys[future.key] = task.key
        waited.add(future)
    try:
        for future in waited:
            task = by_key[keys[future.key]]
            error = future.exception() if future.status != "finished" else None
            if isinstance(error, KilledWorker) and lost[task.key] < retries:
                # The scheduler gave up: several workers were lost with this task, perhaps none by it.
                lost[task.key] += 1
                client.retry([future])
                waited.add(future)
                continue
            for place in places[task.key]:
                if error is None:
                    answer, of_the_run = future.result()
                    yield place, answer, of_the_run
                elif isinstance(error, Exception):
                    yield place, error, {}
                else:
                    yield (
                        place,
                        PalpateError("the workers were closed before the task was done; run the study again"),
                        {},
                    )
            # The scheduler may forget it; the answer is here.
            future.release()
    finally:
        client.cancel([future for future in waited.futures])


def _on_worker(packed: bytes) -> tuple[str, dict[str, Any]]:
    from distributed import get_worker

    begin = time.perf_counter()
    answer = execute(unpacked(packed))
    return answer, {"worker": str(get_worker().address), "seconds": time.perf_counter() - begin}


@contextlib.contextmanager
def _told(progress: jobs.Progress) -> Iterator[Callable[[float, str], object]]:
    if callable(progress):
        yield progress
    elif progress is None:
        from palpate.progress import Bar

        bar = Bar()
        try:
            yield bar
        finally:
            bar.close()
    else:
        yield lambda _part, _words: None


def _cores() -> int:
    affinity = getattr(os, "sched_getaffinity", None)
    return len(affinity(0)) if affinity else os.cpu_count() or 1


def _row(task: Task, answer: dict[str, Any] | None) -> dict[str, Any]:
    row: dict[str, Any] = {"task": task.name, "key": task.key, **task.labels}
    if answer is None:
        return row
    if task.job == "characterize":
        for specimen in answer["specimens"]:
            row.update(fits.row(specimen))
        return row
    for key, value in fits.flat(answer).items():
        row.setdefault(key, value)
    for key, value in answer.items():
        if isinstance(value, list) and value and all(isinstance(one, (int, float)) for one in value):
            row.update({f"{key}[{place}]": one for place, one in enumerate(value)})
    return row


def _table(study: Study) -> str:
    import csv
    import io

    rows = [_row(task, answer) for task, answer in zip(study.tasks, study.answers, strict=True)]
    for place, row in enumerate(rows):
        row["failure"] = study.failures.get(place)
    names = list(dict.fromkeys(name for row in rows for name in row))
    text = io.StringIO()
    text.write("# format = 1\n")
    writer = csv.DictWriter(text, names, lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return text.getvalue()
