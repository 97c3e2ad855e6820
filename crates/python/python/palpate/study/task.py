"""One job with everything that it is given."""

from __future__ import annotations

import hashlib
import json
import zlib
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

from palpate import jobs
from palpate._palpate import __version__

#: What an answer says about the run and not about the question.
OF_THE_RUN = ("seconds", "was_kept", "file")


@dataclass(frozen=True)
class Task:
    """One job with everything that it is given.

    Attributes
    ----------
    name : str
        For people.
    job : {"solve", "characterize", "precompute"}
        What is done.
    given : mapping
        With what: texts, numbers, lists and mappings alone.
    labels : mapping
        What a table says of it beside its answer, such as the values of a sweep.
    """

    name: str
    job: str
    given: Mapping[str, Any] = field(repr=False)
    labels: Mapping[str, Any] = field(default_factory=dict)

    @cached_property
    def document(self) -> str:
        """What is sent: job and what it is given, as JSON that does not depend on the order of keys."""
        asked = {"palpate": __version__, "job": self.job, "given": self.given}
        return json.dumps(asked, sort_keys=True, default=jobs.plain)

    @property
    def packed(self) -> bytes:
        """`document` as it travels: recordings are a quarter as long then."""
        return zlib.compress(self.document.encode(), level=1)

    @cached_property
    def key(self) -> str:
        """SHA-256 of `document`: tasks with the same key have the same answer."""
        return hashlib.sha256(self.document.encode()).hexdigest()


def unpacked(packed: bytes) -> str:
    """Return the `Task.document` of a `Task.packed`."""
    return zlib.decompress(packed).decode()


def execute(document: str, progress: jobs.Progress = False) -> str:
    """Do the task of a `Task.document`; return its answer as JSON, without what is of the run alone."""
    task = json.loads(document)
    given = task["given"]
    answer: dict[str, Any]
    if task["job"] == "solve":
        answer = jobs.solve(given["problem"], progress=progress)
    elif task["job"] == "characterize":
        found = jobs.characterize([], progress=progress, **given)
        answer = {**found, "tissues": found.tissues}
    else:
        answer = jobs.precompute(given["scene"], memory=given["memory"], progress=progress)
        if answer["file"] is not None:
            answer["sha256"] = hashlib.sha256(Path(answer["file"]).read_bytes()).hexdigest()
    return json.dumps({key: value for key, value in answer.items() if key not in OF_THE_RUN})
