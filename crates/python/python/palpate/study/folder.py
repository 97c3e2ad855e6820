"""Where answers are kept, each in a file of its own."""

from __future__ import annotations

import json
import os
import re
import tempfile
from pathlib import Path
from typing import Any

from palpate._palpate import __version__
from palpate.errors import InputError
from palpate.study.task import Task


class Folder:
    """The folder of a study: a file for each finished task, which names what it was found from."""

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = Path(path)
        try:
            self.path.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise InputError(f"the folder {self.path} cannot be made ({error.strerror}); give another") from error

    def read(self, task: Task) -> str | None:
        """Return the answer to ``task``; none when it is not there, not whole, or another's."""
        try:
            kept = json.loads(self._file(task).read_text(encoding="utf-8"))
        except (OSError, ValueError):
            return None
        fits = isinstance(kept, dict) and kept.get("palpate") == __version__ and kept.get("key") == task.key
        return json.dumps(kept["answer"]) if fits and "answer" in kept else None

    def write(self, task: Task, answer: str, of_the_run: dict[str, Any]) -> None:
        """Keep the answer to ``task``, written beside and then renamed."""
        document = {
            "palpate": __version__,
            "key": task.key,
            "name": task.name,
            "job": task.job,
            "labels": dict(task.labels),
            "run": of_the_run,
            "answer": json.loads(answer),
        }
        self.write_text(self._file(task).name, json.dumps(document, indent=1) + "\n")

    def write_text(self, name: str, text: str) -> None:
        """Write a file whole or not at all."""
        with tempfile.NamedTemporaryFile("w", dir=self.path, delete=False, encoding="utf-8") as beside:
            try:
                beside.write(text)
                beside.flush()
                os.fsync(beside.fileno())
            except BaseException:
                os.unlink(beside.name)
                raise
        os.replace(beside.name, self.path / name)

    def _file(self, task: Task) -> Path:
        words = re.sub(r"[^\w.=-]+", "-", task.name).strip("-.")[:80]
        return self.path / f"{words}-{task.key[:16]}.json"
