# SPDX-FileCopyrightText: The Windfall authors
# SPDX-License-Identifier: MIT OR Apache-2.0
"""Work that the command does in a process of its own: Ctrl-C ends it there, and it tidies up."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from . import _windfall

_ERROR = "error: "


def run(arguments: Sequence[str | os.PathLike[str]], progress: bool = False) -> str:
    """Output of the command; its line of an error as a ValueError. With `progress` its standard error is ours, bar and all."""
    command = [sys.executable, "-m", "windfall", *(os.fspath(argument) for argument in arguments)]
    caught = None if progress else subprocess.PIPE
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=caught, text=True, check=False)
    if done.returncode != 0:
        lines = (done.stderr or "").strip().splitlines()
        last = lines[-1] if lines else f"the command ended with code {done.returncode}"
        raise ValueError(last.removeprefix(_ERROR))
    return done.stdout


@contextmanager
def scene_file(scene: _windfall.Scene) -> Iterator[str]:
    """A file that says the scene, as long as it is needed."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "scene.ron")
        path.write_text(scene._to_ron_for_any_folder(), encoding="utf-8")
        try:
            yield str(path)
        except ValueError as error:
            # Nobody but us knows that file.
            raise ValueError(str(error).replace(str(path), scene.file)) from None


def export(
    scene: _windfall.Scene,
    path: str | os.PathLike[str],
    frames: range | tuple[int, int],
    fps: float,
    backend: str | None,
) -> Path:
    """Writes a stretch of a scene."""
    if isinstance(frames, range):
        if not frames or frames.step != 1:
            raise ValueError(f"frames is {frames}; allowed: frames that follow one another")
        first, last = frames[0], frames[-1]
    else:
        first, last = frames
    with scene_file(scene) as file:
        chosen = ["--backend", backend] if backend else []
        run(["export", file, "--allow-outside", "--frames", f"{first}..{last}", "--fps", str(fps), "--out", path, *chosen])
    return Path(path)


def write_whole(path: str | os.PathLike[str], data: bytes) -> None:
    """Writes a file that appears when it is whole."""
    path = Path(path)
    handle, partial = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(data)
        # Temporary files are their owner's alone; this one is to be as others here are.
        mask = os.umask(0)
        os.umask(mask)
        os.chmod(partial, 0o666 & ~mask)
        os.replace(partial, path)
    except BaseException:
        os.unlink(partial)
        raise


def save(world: _windfall.World, path: str | os.PathLike[str]) -> None:
    """Writes a checkpoint."""
    write_whole(path, world.to_bytes())
