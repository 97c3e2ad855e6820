"""Recordings for robot learning, in the dataset format of LeRobot, version 3.0.

`LeRobotWriter` writes episodes frame by frame, and `export_session` a recorded session as a demonstration. Both write
Parquet by ``pyarrow`` (``pip install palpate[lerobot]``) and need no LeRobot; its ``LeRobotDataset`` reads the folder::

    LeRobotDataset("me/palpation", root="palpation")

Forces are a feature of their own, ``observation.force`` [N], and torques ``observation.torque`` [N m]. Images are PNG in
the Parquet files; there are no videos.
"""

from __future__ import annotations

import importlib
import json
import struct
import zlib
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

import palpate
from palpate.errors import InputError

if TYPE_CHECKING:
    from typing_extensions import Self

#: Of the format.
VERSION = "v3.0"
CHUNK, FILE = 0, 0
DATA = "data/chunk-{chunk_index:03d}/file-{file_index:03d}.parquet"
VIDEO = "videos/{video_key}/chunk-{chunk_index:03d}/file-{file_index:03d}.mp4"
#: What LeRobot counts itself.
COUNTED = {
    "timestamp": "float32",
    "frame_index": "int64",
    "episode_index": "int64",
    "index": "int64",
    "task_index": "int64",
}


class LeRobotWriter:
    """Writes episodes into a folder; a `with` block closes it.

    Parameters
    ----------
    folder : path-like
        The new folder.
    fps : float
        Frames per second [1/s]; LeRobot wants a whole number.
    task : str
        What is done, in a sentence.
    names : mapping of str to list of str, optional
        Names of the numbers of a feature, with their units.
    robot : str
        What LeRobot calls the type of the robot.

    Raises
    ------
    InputError
        When the folder is there already or `fps` is no whole number above zero.
    """

    def __init__(
        self,
        folder: str | Path,
        fps: float,
        task: str,
        *,
        names: Mapping[str, Sequence[str]] | None = None,
        robot: str = "palpate",
    ) -> None:
        _pyarrow()
        self.folder = Path(folder)
        if self.folder.exists():
            raise InputError(f"{self.folder}: the folder is there already; name a new one")
        if not (fps >= 1 and abs(fps - round(fps)) < 1e-6):
            raise InputError(f"there are {fps:g} frames per second; LeRobot takes a whole number from 1 on")
        self.fps, self.task, self.robot = round(fps), task, robot
        self.names = dict(names or {})
        self.features: dict[str, dict[str, Any]] = {}
        self._frames: list[dict[str, Any]] = []
        self._columns: dict[str, list[Any]] = {}
        self._episodes: list[dict[str, Any]] = []
        self._numbers: dict[str, list[NDArray[np.float64]]] = {}

    def add_frame(self, frame: Mapping[str, ArrayLike]) -> None:
        """A frame of the episode: arrays by the names of LeRobot, such as ``observation.state`` and ``action``. An array
        of uint8 with three dimensions, height, width and 3, is an image.

        Raises
        ------
        InputError
            When a frame has other features than the first one had.
        """
        arrays = {name: np.atleast_1d(np.asarray(value)) for name, value in frame.items()}
        if not self.features:
            self.features = {name: self._feature(name, value) for name, value in arrays.items()}
        shapes = {name: list(value.shape) for name, value in arrays.items()}
        wanted = {name: feature["shape"] for name, feature in self.features.items()}
        if shapes != wanted:
            raise InputError(f"a frame has the features {shapes}, the first one had {wanted}; give the same to each")
        self._frames.append(arrays)

    def end_episode(self) -> None:
        """Ends the episode whose frames were added.

        Raises
        ------
        InputError
            When it has no frame.
        """
        if not self._frames:
            raise InputError("an episode without a frame cannot be recorded; add one first")
        count, begin = len(self._frames), self._total
        columns: dict[str, NDArray[Any]] = {
            name: np.stack([frame[name] for frame in self._frames]) for name in self.features
        }
        for name, rows in columns.items():
            is_image = self.features[name]["dtype"] == "image"
            stored = [{"bytes": png(row), "path": None} for row in rows] if is_image else _rows(rows)
            self._columns.setdefault(name, []).extend(stored)
        counted = {
            "timestamp": np.arange(count) / self.fps,
            "frame_index": np.arange(count),
            "episode_index": np.full(count, len(self._episodes)),
            "index": begin + np.arange(count),
            "task_index": np.zeros(count, dtype=np.int64),
        }
        for name, values in counted.items():
            self._columns.setdefault(name, []).extend(values.tolist())
        stats: dict[str, Any] = {}
        for name, rows in {**columns, **counted}.items():
            numbers = _for_statistics(rows, self._is_image(name))
            self._numbers.setdefault(name, []).append(numbers)
            stats |= {f"stats/{name}/{word}": value for word, value in self._statistics(name, numbers).items()}
        self._episodes.append(
            {
                "episode_index": len(self._episodes),
                "tasks": [self.task],
                "length": count,
                "data/chunk_index": CHUNK,
                "data/file_index": FILE,
                "dataset_from_index": begin,
                "dataset_to_index": begin + count,
                "meta/episodes/chunk_index": CHUNK,
                "meta/episodes/file_index": FILE,
                **stats,
            }
        )
        self._frames = []

    def close(self) -> None:
        """Writes the files; a begun episode is ended. Without an episode there is no folder."""
        if self._frames:
            self.end_episode()
        if not self._episodes or self.folder.exists():
            return
        arrow, parquet = _pyarrow()
        path = DATA.format(chunk_index=CHUNK, file_index=FILE)
        for own in (path, "meta/episodes/" + path.removeprefix("data/")):
            (self.folder / own).parent.mkdir(parents=True)
        features = {
            **self.features,
            **{name: {"dtype": kind, "shape": [1], "names": None} for name, kind in COUNTED.items()},
        }
        fields = [(name, _type(arrow, feature)) for name, feature in features.items()]
        schema = arrow.schema(fields).with_metadata({"huggingface": json.dumps({"info": {"features": _hub(features)}})})
        table = arrow.Table.from_pydict(self._columns, schema=schema)
        with parquet.ParquetWriter(self.folder / path, schema) as writer:
            for episode in self._episodes:
                # One row group for each, as LeRobot's own recordings have it.
                writer.write_table(table.slice(episode["dataset_from_index"], episode["length"]))
        episodes = {name: [episode[name] for episode in self._episodes] for name in self._episodes[0]}
        parquet.write_table(
            arrow.Table.from_pydict(episodes), self.folder / "meta/episodes" / path.removeprefix("data/")
        )
        # As pandas writes an index.
        index = {"index_columns": ["task"], "column_indexes": [], "columns": [_PANDAS_INDEX, _PANDAS_COLUMN]}
        tasks = arrow.Table.from_pydict({"task_index": [0], "task": [self.task]})
        tasks = tasks.replace_schema_metadata({"pandas": json.dumps({**index, "pandas_version": "2.0.0"})})
        parquet.write_table(tasks, self.folder / "meta/tasks.parquet")
        stats = {name: self._statistics(name, np.concatenate(own)) for name, own in self._numbers.items()}
        _write(self.folder / "meta/stats.json", stats)
        _write(
            self.folder / "meta/info.json",
            {
                "codebase_version": VERSION,
                "robot_type": self.robot,
                "total_episodes": len(self._episodes),
                "total_frames": self._total,
                "total_tasks": 1,
                "chunks_size": 1000,
                "data_files_size_in_mb": 100,
                "video_files_size_in_mb": 200,
                "fps": self.fps,
                "splits": {"train": f"0:{len(self._episodes)}"},
                "data_path": DATA,
                "video_path": None,
                "features": features,
            },
        )

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if kind is None:
            self.close()

    @property
    def _total(self) -> int:
        return self._episodes[-1]["dataset_to_index"] if self._episodes else 0

    def _is_image(self, name: str) -> bool:
        return name in self.features and self.features[name]["dtype"] == "image"

    def _feature(self, name: str, value: NDArray[Any]) -> dict[str, Any]:
        shape = list(value.shape)
        if value.dtype == np.uint8 and value.ndim == 3 and shape[2] == 3:
            return {"dtype": "image", "shape": shape, "names": ["height", "width", "channels"]}
        if value.dtype.kind not in "fiub":
            raise InputError(f"`{name}` is no array of numbers; give numbers, truths or an image")
        kind = {"f": "float32", "i": "int64", "u": "int64", "b": "bool"}[value.dtype.kind]
        names = list(self.names[name]) if name in self.names else None
        return {"dtype": kind, "shape": shape, "names": names}

    def _statistics(self, name: str, numbers: NDArray[np.float64]) -> dict[str, Any]:
        """Over the frames; of images over their pixels too, for each colour from 0 to 1."""
        found = {
            "min": numbers.min(axis=0),
            "max": numbers.max(axis=0),
            "mean": numbers.mean(axis=0),
            "std": numbers.std(axis=0),
        }
        shape = (3, 1, 1) if self._is_image(name) else numbers.shape[1:]
        return {**{word: own.reshape(shape).tolist() for word, own in found.items()}, "count": [len(numbers)]}


def export_session(
    session: palpate.Session | str | Path, folder: str | Path, *, fps: float = 20.0, tool: str | None = None
) -> int:
    """Writes a recorded session as a demonstration of one episode.

    Its state is the tip's place [m], the shaft's quaternion, the grip [-] and whether the tool cuts; the action is the next
    frame's state; the force is that on the tool [N].

    Parameters
    ----------
    session : Session or path-like
        The session, or its file.
    folder : path-like
        The new folder.
    fps : float
        Frames per second [1/s]: the last row before each frame's time is taken.
    tool : str, optional
        Which tool; without, the first.

    Returns
    -------
    int
        The number of frames.

    Raises
    ------
    InputError
        When the tool has no rows in the session, or for what `LeRobotWriter` refuses.
    """
    found = session if isinstance(session, palpate.Session) else palpate.Session.read(session)
    columns = {name: np.asarray(own) for name, own in found.columns.items()}
    name = found.tools[0] if tool is None else tool
    is_own = columns["tool"].astype(str) == name
    if not is_own.any():
        raise InputError(f"the session has no tool {name!r}; there are {', '.join(found.tools)}")
    time = columns["time_s"][is_own].astype(float)
    frames = np.arange(time[0], time[-1] + 0.5e-6, 1.0 / fps)
    rows = np.searchsorted(time, frames + 1e-9, side="right") - 1
    state = np.stack([columns[own][is_own].astype(float) for own in STATE], axis=1)[rows]
    force = np.stack([columns[own][is_own].astype(float) for own in FORCE], axis=1)[rows]
    depth = columns["depth_m"][is_own].astype(float)[rows]
    scene = found.scene
    told = {} if scene is None else scene.to_dict().get("task", {})
    task = told.get("instructions", told.get("title", "touch the organ"))
    names = {"observation.state": STATE, "action": STATE, "observation.force": FORCE, "observation.depth": ["depth_m"]}
    with LeRobotWriter(folder, fps, task, names=names) as writer:
        for number in range(len(frames)):
            writer.add_frame(
                {
                    "observation.state": state[number],
                    "observation.force": force[number],
                    "observation.depth": depth[number],
                    "action": state[min(number + 1, len(frames) - 1)],
                }
            )
    return len(frames)


STATE = ["x_m", "y_m", "z_m", "qx", "qy", "qz", "qw", "grip", "cut"]
FORCE = ["fx_n", "fy_n", "fz_n"]

_PANDAS_INDEX = {
    "name": "task",
    "field_name": "task",
    "pandas_type": "unicode",
    "numpy_type": "object",
    "metadata": None,
}
_PANDAS_COLUMN = {
    "name": "task_index",
    "field_name": "task_index",
    "pandas_type": "int64",
    "numpy_type": "int64",
    "metadata": None,
}


def png(image: NDArray[np.uint8]) -> bytes:
    """An image of uint8, shape (height, width, 3), as a PNG file."""
    height, width, _ = image.shape
    rows = np.concatenate([np.zeros((height, 1), np.uint8), image.reshape(height, 3 * width)], axis=1)

    def chunk(kind: bytes, content: bytes) -> bytes:
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    body = chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows.tobytes(), 6)) + chunk(b"IEND", b"")
    return b"\x89PNG\r\n\x1a\n" + body


def _pyarrow() -> tuple[Any, Any]:
    try:
        return importlib.import_module("pyarrow"), importlib.import_module("pyarrow.parquet")
    except ImportError:
        raise ImportError(
            "palpate.lerobot needs pyarrow, which is not installed; `pip install palpate[lerobot]`"
        ) from None


def _rows(rows: NDArray[Any]) -> list[Any]:
    """One number alone is no list."""
    own: list[Any] = (rows[:, 0] if rows.shape[1:] == (1,) else rows).tolist()
    return own


def _for_statistics(rows: NDArray[Any], is_image: bool) -> NDArray[np.float64]:
    numbers = rows.reshape(-1, 3) / 255.0 if is_image else rows.reshape(len(rows), -1)
    return numbers.astype(np.float64)


def _type(arrow: Any, feature: Mapping[str, Any]) -> Any:
    if feature["dtype"] == "image":
        return arrow.struct([("bytes", arrow.binary()), ("path", arrow.string())])
    own = {"float32": arrow.float32(), "int64": arrow.int64(), "bool": arrow.bool_()}[feature["dtype"]]
    for length in [] if feature["shape"] == [1] else reversed(feature["shape"]):
        own = arrow.list_(own, length)
    return own


def _hub(features: Mapping[str, Mapping[str, Any]]) -> dict[str, Any]:
    """The features as the library `datasets` notes them."""
    found: dict[str, Any] = {}
    for name, feature in features.items():
        if feature["dtype"] == "image":
            found[name] = {"_type": "Image"}
            continue
        own: dict[str, Any] = {"dtype": feature["dtype"], "_type": "Value"}
        for length in [] if feature["shape"] == [1] else reversed(feature["shape"]):
            own = {"feature": own, "length": length, "_type": "Sequence"}
        found[name] = own
    return found


def _write(path: Path, content: object) -> None:
    path.write_text(json.dumps(content, indent=4) + "\n", encoding="utf-8")
