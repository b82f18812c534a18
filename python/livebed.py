"""Reads what `livebed run` leaves in its folder.  Needs Python 3.11 and numpy, nothing else.

    import livebed
    run = livebed.Run("runs/first")
    run.series["S_over_D"]            # a column of series.csv, with run.series["time_s"]
    run.bed.y                         # bed lines, one row a time
    run.flow(1.0).velocity            # the water nearest to t = 1 s, shape (ny, nx, 2)
    run.grains(-1).diameter           # the last grains, in the order of their id

Everything is in SI units; time 0 is the release of the grains.  A run that is still going on can be read: files are read
when they are asked for, and only `refresh()` forgets what has been read.  What cannot be read raises `RunError`, which
names the file and what to do.  The columns and files are described in docs/run-folder.md, checkpoints (HDF5, read them
with h5py) in docs/checkpoints.md.
"""
from __future__ import annotations

import base64
import json
import struct
import tomllib
import xml.etree.ElementTree as ElementTree
import zlib
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

__all__ = ["Bed", "Flow", "Grains", "Run", "RunError", "read_table", "read_vtk"]

Array = NDArray[np.float64]


class RunError(Exception):
    """A file of the run is missing, damaged or does not hold what was asked for."""


@dataclass(frozen=True)
class Bed:
    """The bed line in time (bed.csv)."""

    t: Array  #: times [s], shape (nt,)
    x: Array  #: places along the current [m], shape (nx,)
    y: Array  #: height above the floor [m], shape (nt, nx)

    def at(self, time: float) -> Array:
        """The line nearest to a time [s], shape (nx,)."""
        return self.y[_nearest(self.t, time)]


@dataclass(frozen=True)
class Flow:
    """The water at one time, on a rectilinear grid.  Rows go up, columns along the current."""

    time: float  #: [s]
    x: Array  #: faces of the cells along the current [m], shape (nx + 1,)
    y: Array  #: faces of the cells above the floor [m], shape (ny + 1,)
    velocity: Array  #: mean velocity [m/s], shape (ny, nx, 2)
    p: Array  #: dynamic pressure [Pa], shape (ny, nx), as all below
    k: Array  #: turbulent kinetic energy [m2/s2]
    epsilon: Array  #: its dissipation [m2/s3]
    nut: Array  #: eddy viscosity [m2/s]
    open: Array  #: share of the cell that lies outside the pipe [-]
    solid: Array  #: volume fraction of grains [-]; zero in a run without grains

    @property
    def x_centre(self) -> Array:
        """Centres of the cells along the current [m], shape (nx,)."""
        return (self.x[1:] + self.x[:-1]) / 2

    @property
    def y_centre(self) -> Array:
        """Centres of the cells above the floor [m], shape (ny,)."""
        return (self.y[1:] + self.y[:-1]) / 2

    @property
    def speed(self) -> Array:
        """Magnitude of the velocity [m/s], shape (ny, nx)."""
        return np.hypot(self.velocity[..., 0], self.velocity[..., 1])

    @property
    def vorticity(self) -> Array:
        """dV/dx - dU/dy [1/s] by central differences, shape (ny, nx); next to the pipe it mixes water and pipe."""
        u, v = self.velocity[..., 0], self.velocity[..., 1]
        return np.gradient(v, self.x_centre, axis=1) - np.gradient(u, self.y_centre, axis=0)


@dataclass(frozen=True)
class Grains:
    """All grains at one time, in the order of their id, which names a grain for life."""

    time: float  #: [s]
    id: NDArray[np.int64]  #: shape (n,)
    x: Array  #: centre along the current [m], shape (n,)
    y: Array  #: centre above the floor [m], shape (n,)
    diameter: Array  #: [m], shape (n,)
    velocity: Array  #: [m/s], shape (n, 2)
    omega: Array  #: spin, counter-clockwise positive [1/s], shape (n,)
    drag: Array  #: drag of the water on the grain [N], shape (n, 2)

    @property
    def speed(self) -> Array:
        """Magnitude of the velocity [m/s], shape (n,)."""
        return np.hypot(self.velocity[:, 0], self.velocity[:, 1])

    def __len__(self) -> int:
        return len(self.x)


class Run:
    """A run folder.

    Raises RunError when the folder does not hold a run.  Tables and the case are read once (see `refresh`), snapshots
    each time they are asked for.
    """

    folder: Path

    def __init__(self, folder: str | Path):
        self.folder = Path(folder)
        if not (self.folder / "case.resolved.toml").is_file():
            what = "is no folder" if not self.folder.is_dir() else "holds no case.resolved.toml"
            raise RunError(f"{self.folder} {what}: name a folder that `livebed run` was given with --out")

    def __repr__(self) -> str:
        return f"Run({str(self.folder)!r})"

    def refresh(self) -> None:
        """Forgets what has been read, so that a run that goes on is read anew."""
        for name in ("case", "summary", "series", "bed", "flow_times", "grain_times", "_flow_files", "_grain_files",
                     "pipe"):
            self.__dict__.pop(name, None)

    @cached_property
    def case(self) -> dict:
        """The resolved case: every key with its value in SI units, by table, and what follows from them (`derived`)."""
        path = self.folder / "case.resolved.toml"
        try:
            return tomllib.loads(path.read_text())
        except (OSError, ValueError) as error:
            raise RunError(f"{path}: {error}") from error

    @cached_property
    def summary(self) -> dict:
        """The numbers of the finished run (summary.json); RunError while it is going on."""
        path = self.folder / "summary.json"
        try:
            return json.loads(path.read_text())
        except FileNotFoundError as error:
            raise RunError(f"{path} is not there: the run has not ended; `livebed resume` goes on with it") from error
        except (OSError, ValueError) as error:
            raise RunError(f"{path}: {error}") from error

    def table(self, name: str) -> dict[str, Array]:
        """Columns of a table of the folder by name, for instance of "packing.csv"; all of one length."""
        return read_table(self.folder / name)

    @cached_property
    def series(self) -> dict[str, Array]:
        """Columns of series.csv by name (docs/run-folder.md lists them), one value a row, shape (nt,)."""
        return self.table("series.csv")

    @cached_property
    def bed(self) -> Bed:
        """The bed line in time; RunError in a run without grains."""
        columns = self.table("bed.csv")
        t = columns.pop("time_s")
        if not t.size:
            raise RunError(f"{self.folder / 'bed.csv'} has no rows: the run has no grains or has not released them yet")
        x = np.array([float(name.removeprefix("y_at_").removesuffix("_m")) for name in columns])
        return Bed(t, x, np.array(list(columns.values())).T)

    @cached_property
    def _flow_files(self) -> list[tuple[float, str]]:
        return _read_pvd(self.folder / "flow.pvd")

    @cached_property
    def _grain_files(self) -> list[tuple[float, str]]:
        return _read_pvd(self.folder / "grains.pvd")

    @cached_property
    def flow_times(self) -> Array:
        """Times [s] at which there is a snapshot of the water, shape (n,)."""
        return np.array([time for time, _ in self._flow_files])

    @cached_property
    def grain_times(self) -> Array:
        """Times [s] at which there is a snapshot of the grains, shape (n,)."""
        return np.array([time for time, _ in self._grain_files])

    def flow(self, time: float) -> Flow:
        """The snapshot of the water nearest to a time [s]; a negative time means the last."""
        attributes, arrays = read_vtk(self.folder / _pick(self._flow_files, time, self.folder / "flow.pvd"))
        cells = arrays["CellData"]
        x, y = arrays["Coordinates"]["x"], arrays["Coordinates"]["y"]
        shape = (y.size - 1, x.size - 1)
        plane = {name: values.reshape(shape) for name, values in cells.items() if values.ndim == 1}
        plane.setdefault("solid", np.zeros(shape))
        return Flow(attributes["time"], x, y, cells["velocity"].reshape(*shape, 3)[..., :2],
                    **{name: plane[name] for name in ("p", "k", "epsilon", "nut", "open", "solid")})

    def grains(self, time: float) -> Grains:
        """The snapshot of the grains nearest to a time [s]; a negative time means the last."""
        attributes, arrays = read_vtk(self.folder / _pick(self._grain_files, time, self.folder / "grains.pvd"))
        points, data = arrays["Points"]["points"], arrays["PointData"]
        drag = data.get("drag", np.zeros_like(points))
        return Grains(attributes["time"], data["id"].astype(np.int64), points[:, 0], points[:, 1], data["diameter"],
                      data["velocity"][:, :2], data["omega"], drag[:, :2])

    @cached_property
    def pipe(self) -> tuple[float, float, float] | None:
        """Centre x, y and diameter of the pipe [m], or None in a run without one."""
        if not self.case.get("pipe", {}).get("present", True):
            return None
        path = self.folder / "pipe.vtp"
        if not path.is_file():
            raise RunError(f"{path} is not there: the run has not begun to dig yet")
        points = read_vtk(path)[1]["Points"]["points"]
        low, high = points.min(axis=0), points.max(axis=0)
        return float((low[0] + high[0]) / 2), float((low[1] + high[1]) / 2), float(high[0] - low[0])

    @property
    def checkpoints(self) -> list[Path]:
        """The checkpoint files, oldest first (HDF5; docs/checkpoints.md)."""
        return sorted((self.folder / "checkpoints").glob("step_*.h5"))


def read_table(path: str | Path) -> dict[str, Array]:
    """Columns of a CSV table by the names of its header, each of shape (rows,).

    A last row that is still being written is left out.  RunError when a value is no number.
    """
    path = Path(path)
    try:
        text = path.read_text()
    except OSError as error:
        raise RunError(f"{path}: {error.strerror}") from error
    lines = text[: text.rfind("\n") + 1].splitlines()
    if not lines:
        raise RunError(f"{path} is empty")
    names = lines[0].split(",")
    values = np.empty((len(lines) - 1, len(names)))
    for row, line in enumerate(lines[1:]):
        words = line.split(",")
        try:
            values[row] = [float(word) for word in words]
        except ValueError as error:
            raise RunError(f"{path}, line {row + 2}: {len(words)} values for {len(names)} columns, or one is no number: "
                           f"{error}") from error
    return {name: values[:, column] for column, name in enumerate(names)}


_TYPES = {"Float32": "<f4", "Float64": "<f8", "Int32": "<i4", "Int64": "<i8", "UInt8": "<u1"}


def read_vtk(path: str | Path) -> tuple[dict, dict[str, dict[str, Array]]]:
    """A .vtr or .vtp file as `livebed` writes it (zlib in base64, or in one raw block as early versions did): its attributes
    (`time` [s], `type`) and its arrays by section (CellData, PointData, Points, Coordinates, Lines, ...) and name.

    Scalars have the shape (n,), vectors (n, 3).  RunError when the file is another kind of VTK file or is damaged.
    """
    path = Path(path)
    try:
        data = path.read_bytes()
    except OSError as error:
        raise RunError(f"{path}: {error.strerror}") from error
    mark = b'<AppendedData encoding="raw">\n_'
    start = data.find(mark)
    block = data[start + len(mark):] if start >= 0 else b""
    try:
        root = ElementTree.fromstring(data[:start] + b"</VTKFile>" if start >= 0 else data)
    except ElementTree.ParseError as error:
        raise RunError(f"{path} is damaged or is no VTK file: {error}") from error
    if root.get("compressor") != "vtkZLibDataCompressor" or root.get("header_type") != "UInt64":
        raise RunError(f"{path} is no VTK file written by livebed: its data are not compressed by zlib with 64-bit heads")
    sections: dict[str, dict[str, Array]] = {}
    for parent in root.iter():
        found = {}
        for element in parent.findall("DataArray"):
            try:
                values = np.frombuffer(_inflated(element, block), _TYPES[element.get("type")]).astype(np.float64)
            except (struct.error, zlib.error, ValueError) as error:
                raise RunError(f"{path} is damaged in the array {element.get('Name')}: {error}") from error
            components = int(element.get("NumberOfComponents", "1"))
            found[element.get("Name")] = values.reshape(-1, components) if components > 1 else values
        if found:
            sections[parent.tag] = found
    time = sections.pop("FieldData", {}).get("TimeValue", np.array([np.nan]))
    return {"time": float(time[0]), "type": root.get("type")}, sections


def _inflated(element: ElementTree.Element, block: bytes) -> bytes:
    """The bytes of an array: number of blocks, their size, size of a partial last one, compressed sizes, blocks."""
    if element.get("format") == "appended":
        packed = memoryview(block)[int(element.get("offset")):]
    else:  # a text for the head and one for the blocks
        text = (element.text or "").strip()
        blocks, = struct.unpack_from("<Q", base64.b64decode(text[:32], validate=True))
        head = (24 + 8 * blocks + 2) // 3 * 4
        packed = memoryview(base64.b64decode(text[:head], validate=True) + base64.b64decode(text[head:], validate=True))
    blocks, = struct.unpack_from("<Q", packed)
    sizes = struct.unpack_from(f"<{blocks}Q", packed, 24)
    at, parts = 24 + 8 * blocks, []
    for size in sizes:
        parts.append(zlib.decompress(packed[at:at + size]))
        at += size
    return b"".join(parts)


def _read_pvd(path: Path) -> list[tuple[float, str]]:
    try:
        entries = ElementTree.fromstring(path.read_text()).iter("DataSet")
    except FileNotFoundError as error:
        raise RunError(f"{path} is not there: the run has written no snapshot yet, or has no grains") from error
    except (OSError, ElementTree.ParseError) as error:
        raise RunError(f"{path}: {error}") from error
    return [(float(entry.get("timestep")), entry.get("file")) for entry in entries]


def _nearest(times: Array, time: float) -> int:
    return len(times) - 1 if time < 0 else int(np.argmin(np.abs(times - time)))


def _pick(files: list[tuple[float, str]], time: float, series: Path) -> str:
    if not files:
        raise RunError(f"{series} lists no snapshots yet")
    return files[_nearest(np.array([t for t, _ in files]), time)][1]
