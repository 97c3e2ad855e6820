"""How far long work is: a bar in a terminal and in a notebook, nothing anywhere else.

A bar is shown for work that takes longer than a second, where nobody gave a callable of their own. With tqdm
(``pip install palpate[progress]``) it is tqdm's.
"""

from __future__ import annotations

import importlib.util
import sys
from typing import Any, TextIO


def in_notebook() -> bool:
    """Whether a notebook shows what is printed."""
    shell = sys.modules.get("IPython")
    if shell is None:
        return False
    running = shell.get_ipython()
    return running is not None and running.__class__.__name__ == "ZMQInteractiveShell"


class Bar:
    """A bar over one long work; call it with the part that is done, from 0 to 1 [-], and words.

    Parameters
    ----------
    stream : file-like, optional
        Where it is drawn; standard error without.
    """

    def __init__(self, stream: TextIO | None = None) -> None:
        self._stream = sys.stderr if stream is None else stream
        self._drawn: Any = None
        self._length = 0
        self._notebook = in_notebook()
        self._shown = self._notebook or self._stream.isatty()
        if self._shown:
            self._drawn = self._tqdm()

    def _tqdm(self) -> Any:
        """A bar of tqdm, if there is tqdm: a widget where a notebook has widgets, a line of text elsewhere."""
        has_widgets = self._notebook and importlib.util.find_spec("ipywidgets") is not None
        try:
            tqdm = importlib.import_module("tqdm.notebook" if has_widgets else "tqdm").tqdm
        except ImportError:
            return None
        form = "{desc} {percentage:3.0f} %|{bar}| {elapsed}<{remaining}"
        where = {} if has_widgets else {"file": self._stream}
        return tqdm(total=1.0, bar_format=form, leave=False, disable=False, **where)

    def __call__(self, part: float, doing: str) -> None:
        """Shows how far it is."""
        if not self._shown:
            return
        if self._drawn is not None:
            self._drawn.set_description_str(doing, refresh=False)
            self._drawn.n = part
            self._drawn.refresh()
            return
        full = round(30 * part)
        line = f"[{'#' * full}{'.' * (30 - full)}] {100 * part:3.0f} % {doing}"
        self._write(f"\r{line}{' ' * (self._length - len(line))}")
        self._length = len(line)

    def close(self) -> None:
        """Takes it away."""
        if self._drawn is not None:
            self._drawn.close()
        elif self._shown and self._length:
            self._write(f"\r{' ' * self._length}\r")

    def _write(self, text: str) -> None:
        self._stream.write(text)
        self._stream.flush()
