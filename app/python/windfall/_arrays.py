# SPDX-FileCopyrightText: The Windfall authors
# SPDX-License-Identifier: MIT OR Apache-2.0
"""Columns of worlds as arrays."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _windfall

# Names of the numbers of decoded columns in flat tables: those of the tables that the command writes.
_FLAT = {
    "position": ("x_m", "y_m", "z_m"),
    "velocity": ("vx_m_s", "vy_m_s", "vz_m_s"),
    "quaternion": ("qx", "qy", "qz", "qw"),
}


def view(world: _windfall.World, name: str) -> npt.NDArray[Any]:
    """A column without a copy: a structured array, or a plain one where records have no fields."""
    column = world.column(name)
    fields = column.fields
    if len(fields) == 1 and not fields[0][0]:
        _, kind, words = fields[0]
        plain = np.frombuffer(memoryview(column), kind)
        return plain if words == 1 else plain.reshape(-1, words)
    record = [(field, kind, (words,) if words > 1 else ()) for field, kind, words in fields]
    return np.frombuffer(memoryview(column), np.dtype(record))


class Columns(Mapping[str, npt.NDArray[Any]]):
    """Columns by name, each copied when it is asked for."""

    def __init__(self, world: _windfall.World) -> None:
        self._world = world

    def __getitem__(self, name: str) -> npt.NDArray[Any]:
        return view(self._world, name).copy()

    def __iter__(self) -> Iterator[str]:
        return iter(self._world.column_names)

    def __len__(self) -> int:
        return len(self._world.column_names)

    def __repr__(self) -> str:
        return f"<columns {', '.join(self)}>"


def leaves(world: _windfall.World) -> dict[str, npt.NDArray[Any]]:
    """Leaves decoded, a row for each slot."""
    decoded = {}
    for name, kind, words, memory in world._decoded():
        plain = np.frombuffer(memoryview(memory), kind)
        decoded[name] = plain if words == 1 else plain.reshape(-1, words)
    return decoded


def leaves_flat(world: _windfall.World) -> dict[str, npt.NDArray[Any]]:
    """The same with a contiguous column for every number."""
    flat = {}
    for name, column in leaves(world).items():
        if name in _FLAT:
            flat.update({one: np.ascontiguousarray(column[:, at]) for at, one in enumerate(_FLAT[name])})
        else:
            flat[name] = column
    return flat
