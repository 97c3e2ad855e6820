"""Tasks, from recordings, problems and scenes."""

from __future__ import annotations

import copy
import itertools
import json
import os
import sys
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from palpate import _palpate, jobs
from palpate.errors import InputError
from palpate.study.task import Task

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

#: Keys of documents that name files.
FILES = ("mesh", "tissue")


def characterizations(
    recordings: jobs.Recordings,
    *,
    laws: Sequence[str | None] = (None,),
    terms: Sequence[int | None] = (None,),
    seeds: Sequence[int] = (1,),
    draws: int = 100,
    **columns: Any,
) -> list[Task]:
    """Return a task for each specimen, law, number of terms and seed of the bootstrap.

    Recordings travel with their tasks: workers need none of the files.

    Parameters
    ----------
    recordings : path or iterable of paths
        Files, or folders of them; a file that cannot be used is left out with a warning.
    laws : sequence of str or None
        Each is sought in a task of its own; ``None`` for all in one, with the one to be preferred.
    terms : sequence of int or None
        Terms of the relaxation; ``None`` for as many as the recordings can tell.
    seeds, draws
        Seeds of the bootstraps, and how often each fits anew: 0 for never, else 10 or more.
    **columns
        As of `palpate.characterize`.
    """
    import warnings

    specimens, unusable = _palpate._specimens(jobs.asked(recordings, **columns))
    for sentence in unusable:
        warnings.warn(sentence, stacklevel=2)
    tasks = []
    for (title, files), law, term, seed in itertools.product(specimens, laws, terms, seeds):
        labels = {"specimen": title, "law": law, "terms": term, "seed": seed}
        given = {
            "texts": [(os.fspath(file), _text(file)) for file in files],
            "law": law,
            "terms": term,
            "draws": draws,
            "seed": seed,
            **columns,
        }
        tasks.append(Task(_named(title, law, term, seed), "characterize", given, labels))
    return tasks


def solves(problem: jobs.Document, sweep: Mapping[str, Sequence[Any]] | None = None) -> list[Task]:
    """Return a task for every combination of the values in ``sweep``.

    Parameters
    ----------
    problem : path or mapping
        A problem; its mesh and tissue are named by files that workers must see as well, its built-in ones not.
    sweep : mapping of str to sequence
        Values by the key that they replace, with dots: ``{"tissue.c10_pa": [500.0, 1000.0]}``.
    """
    return [
        Task(name, "solve", {"problem": document}, labels)
        for name, document, labels in _swept(problem, "problem", sweep)
    ]


def precomputations(
    scene: jobs.Document,
    sweep: Mapping[str, Sequence[Any]] | None = None,
    *,
    memory: float | None = None,
) -> list[Task]:
    """Return a task for every combination of the values in ``sweep``, as of `solves`.

    What is made is kept on the worker, in the folder that ``PALPATE_CACHE`` names there; the answer holds its digest.
    """
    return [
        Task(name, "precompute", {"scene": document, "memory": memory}, labels)
        for name, document, labels in _swept(scene, "scene", sweep)
    ]


def _swept(
    document: jobs.Document, name: str, sweep: Mapping[str, Sequence[Any]] | None
) -> Iterator[tuple[str, dict[str, Any], dict[str, Any]]]:
    if isinstance(document, Mapping):
        read, folder = copy.deepcopy(dict(document)), Path.cwd()
    else:
        path = Path(document)
        name, folder = path.stem, path.absolute().parent
        try:
            read = tomllib.loads(path.read_text(encoding="utf-8"))
        except OSError as error:
            raise InputError(f"{path} cannot be read: {error.strerror}; check its name") from error
        except tomllib.TOMLDecodeError as error:
            raise InputError(f"{path}: {error}; correct it") from error
    _make_absolute(read, folder)
    keys = list(sweep or {})
    for values in itertools.product(*(sweep or {}).values()):
        own = copy.deepcopy(read)
        labels = dict(zip(keys, values, strict=True))
        for key, value in labels.items():
            _put(own, key, value)
        shown = ", ".join(f"{key}={value}" for key, value in labels.items())
        # What JSON and TOML have no words for is refused here and not on a worker.
        plain = json.loads(json.dumps(own, default=jobs.plain))
        yield f"{name}, {shown}" if shown else name, plain, labels


def _put(document: dict[str, Any], key: str, value: Any) -> None:
    *tables, last = key.split(".")
    table = document
    for name in tables:
        inner = table.setdefault(name, {})
        if not isinstance(inner, dict):
            raise InputError(f"sweep: `{key}` goes through `{name}`, which is no table; name a key of the document")
        table = inner
    table[last] = value


def _make_absolute(document: dict[str, Any], folder: Path) -> None:
    for key, value in document.items():
        if key in FILES and isinstance(value, str):
            document[key] = str(folder / value)
        elif isinstance(value, dict):
            _make_absolute(value, folder)
        elif isinstance(value, list):
            for one in value:
                if isinstance(one, dict):
                    _make_absolute(one, folder)


def _text(file: str | os.PathLike[str]) -> str:
    content = Path(file).read_bytes()
    try:
        return content.decode("utf-8")
    except UnicodeDecodeError:
        # As the command reads what other programs write.
        return content.decode("latin-1")


def _named(title: str, law: str | None, terms: int | None, seed: int) -> str:
    parts = [title, law or "all laws"]
    if terms is not None:
        parts.append(f"{terms} terms")
    if seed != 1:
        parts.append(f"seed {seed}")
    return ", ".join(parts)
