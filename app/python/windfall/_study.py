# SPDX-FileCopyrightText: The Windfall authors
# SPDX-License-Identifier: MIT OR Apache-2.0
"""Studies: leaves dropped under many settings of a scene, as tables."""

from __future__ import annotations

import csv
import os
import tempfile
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _windfall
from ._command import run, scene_file

Table = dict[str, npt.NDArray[Any]]


@dataclass(frozen=True)
class Study:
    """Tables of a study: columns by name, as polars, pandas and pyarrow take them. What there is none of is NaN."""

    summary: Table
    """A row for each point: its settings, and means and deviations over its drops."""
    landings: Table
    """A row for each drop: its point and settings, where it was let go and where it landed."""


def study(
    scene: _windfall.Scene | str | os.PathLike[str],
    vary: Mapping[str, str | Iterable[Any]],
    *,
    drops: int | None = None,
    over_s: float = 60.0,
    seconds: float = 120.0,
    seed: int | None = None,
    backend: str | None = None,
    threads: int | None = None,
    out: str | os.PathLike[str] | None = None,
    progress: bool = False,
) -> Study:
    """Drops leaves under every combination of settings, as `windfall study` does: `vary` has paths of fields and their values, a list
    or a text such as "0..12/5". With `out` the folder stays, and an interrupted study goes on where it was."""
    if not isinstance(scene, _windfall.Scene):
        scene = _windfall.Scene.load(os.fspath(scene))
    options = ["--over", str(over_s), "--seconds", str(seconds), "--tracks", "0"]
    for path, values in vary.items():
        options += ["--vary", f"{path}={values if isinstance(values, str) else ','.join(map(str, values))}"]
    for name, value in (("drops", drops), ("seed", seed), ("backend", backend), ("threads", threads)):
        options += [f"--{name}", str(value)] if value is not None else []
    with scene_file(scene) as file, tempfile.TemporaryDirectory() as folder:
        kept = Path(folder, "study") if out is None else Path(out)
        run(["study", file, "--allow-outside", *options, "--out", kept], progress)
        return _read(kept, list(vary))


def _read(folder: Path, paths: list[str]) -> Study:
    summary = _rows(folder / "summary.csv")
    landings: list[dict[str, str]] = []
    for number, point in enumerate(summary, 1):
        settings = {name: text for name, text in list(point.items())[: 1 + len(paths)]}
        for row in _rows(folder / f"point_{number:04}" / "landings.csv"):
            landings.append({**settings, **row})
    return Study(_table(summary), _table(landings))


def _rows(path: Path) -> list[dict[str, str]]:
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def _table(rows: list[dict[str, str]]) -> Table:
    return {name: _column([row[name] for row in rows]) for name in (rows[0] if rows else ())}


def _column(texts: list[str]) -> npt.NDArray[Any]:
    """Whole numbers if all are, else numbers, else texts."""
    for parse, kind in ((int, np.int64), (lambda text: float(text or "nan"), np.float64)):
        try:
            return np.array([parse(text) for text in texts], kind)
        except (ValueError, OverflowError):
            continue
    return np.array(texts)
