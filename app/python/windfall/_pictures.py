# SPDX-FileCopyrightText: The Windfall authors
# SPDX-License-Identifier: MIT OR Apache-2.0
"""Pictures of worlds: arrays, PNG files, frames of a clip."""

from __future__ import annotations

import math
import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _windfall
from ._command import write_whole

_SMALL = (640, 360)


class Picture:
    """A picture with its place in a clip."""

    array: npt.NDArray[np.uint8]
    """Rows from above, columns from the left, then red, green, blue and opacity; not to be written."""
    number: int
    """Number of the frame, from 0."""
    time_s: float
    """Simulated seconds since the scene began."""

    def __init__(self, array: npt.NDArray[np.uint8], number: int, time_s: float) -> None:
        self.array, self.number, self.time_s = array, number, time_s

    def to_png(self) -> bytes:
        """The picture as a PNG file."""
        height, width, _ = self.array.shape
        return _windfall.encode_png(self.array.tobytes(), width, height)

    def to_pil(self) -> Any:
        """The picture as an image of Pillow, which has to be installed."""
        from PIL import Image

        return Image.fromarray(self.array)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes a PNG file, or with Pillow any other that the ending names. It appears when it is whole."""
        if Path(path).suffix.lower() == ".png":
            write_whole(path, self.to_png())
        else:
            self.to_pil().convert("RGB").save(path)

    def _repr_png_(self) -> bytes:
        return self.to_png()

    def __repr__(self) -> str:
        height, width, _ = self.array.shape
        return f"<windfall.Picture {width}x{height} at {self.time_s:.3f} s>"


class Frames:
    """Pictures of a world as it goes on, which it does as they are taken. The first shows it as it is."""

    def __init__(
        self, world: _windfall.World, seconds: float, fps: float, size: tuple[int, int], draft: bool
    ) -> None:
        if not (math.isfinite(seconds) and 0 < seconds <= 86_400):
            raise ValueError(f"seconds is {seconds}; allowed: above 0, to 86400")
        if not (math.isfinite(fps) and 1 <= fps <= 1000):
            raise ValueError(f"fps is {fps}; allowed: 1 to 1000")
        self._world, self._fps, self._size, self._draft = world, fps, size, draft
        self._steps = world._steps_before(fps, max(1, round(seconds * fps)))

    def __len__(self) -> int:
        return len(self._steps)

    def __iter__(self) -> Iterator[Picture]:
        done, since_s = 0, math.inf
        for number, steps in enumerate(self._steps):
            self._world.step(steps - done)
            done = steps
            yield draw(self._world, self._size, since_s, number, self._draft)
            since_s = 1.0 / self._fps


def draw(world: _windfall.World, size: tuple[int, int], since_s: float, number: int, draft: bool) -> Picture:
    """The world as it is, `since_s` seconds after the picture before."""
    width, height = size
    pixels = np.frombuffer(memoryview(world._draw(size, since_s, draft)), np.uint8)
    return Picture(pixels.reshape(height, width, 4), number, world.time_s)


def render(world: _windfall.World, size: tuple[int, int], draft: bool) -> Picture:
    """The world as it is."""
    return draw(world, size, math.inf, 0, draft)


def small_png(world: _windfall.World) -> bytes | None:
    """A small draft for notebooks; None where there is nothing to draw with."""
    try:
        return render(world, _SMALL, draft=True).to_png()
    except (ValueError, RuntimeError):
        return None
