# SPDX-FileCopyrightText: The Windfall authors
# SPDX-License-Identifier: MIT OR Apache-2.0
"""Pictures: those of the command, frame by frame."""

import os
import subprocess
import sys

import numpy as np
import pytest

import windfall as wf

PIL_Image = pytest.importorskip("PIL.Image")
SIZE = (160, 90)


def drawn_by_the_command(folder, *arguments: str) -> np.ndarray:
    command = [sys.executable, "-m", "windfall", "render", *arguments, "--size", "160x90", "--out", "a.png"]
    subprocess.run([*command, "--backend", "cpu"], cwd=folder, check=True, capture_output=True)
    return np.asarray(PIL_Image.open(folder / "a.png").convert("RGBA"))


def test_a_picture_is_the_one_of_the_command(tmp_path):
    world = wf.World("storm", backend="cpu")
    expected = drawn_by_the_command(tmp_path, "storm", "--frames", "1")
    picture = world.render(SIZE)
    assert picture.array.shape == (90, 160, 4) and picture.array.dtype == np.uint8
    assert (picture.array == expected).all()
    assert world.step_index == 0, "drawing steps nothing"
    picture.save(tmp_path / "b.png")
    assert (np.asarray(PIL_Image.open(tmp_path / "b.png")) == expected).all()
    assert (np.asarray(picture.to_pil()) == expected).all()
    assert world._repr_png_()[:4] == picture._repr_png_()[:4] == b"\x89PNG"


def test_frames_step_the_world_and_are_pictures_of_it():
    world = wf.World("six-motions", backend="cpu")
    frames = world.frames(seconds=0.5, fps=6, size=SIZE)
    assert len(frames) == 3
    taken = list(frames)
    assert [frame.number for frame in taken] == [0, 1, 2]
    assert [round(frame.time_s * 60) for frame in taken] == [0, 10, 20]
    assert world.step_index == 20
    assert (taken[0].array != taken[2].array).any()
    alone = wf.World("six-motions", backend="cpu").step(20).render(SIZE)
    assert np.abs(alone.array.astype(int) - taken[2].array).mean() < 2, "but for trails and blur the same"


DRAFT = """
import windfall as wf

world = wf.World("six-motions", backend="cpu")
[frame] = world.frames(seconds=0.1, fps=10, size=(160, 90), draft=True)
assert (frame.array == world.render((160, 90), draft=True).array).all()
assert len({tuple(pixel) for pixel in frame.array.reshape(-1, 4).tolist()}) > 500
assert world._repr_png_()[:4] == b"\\x89PNG"
"""


def test_a_draft_makes_no_leaves(tmp_path):
    home = {**os.environ, "XDG_CACHE_HOME": str(tmp_path), "HOME": str(tmp_path)}
    subprocess.run([sys.executable, "-c", DRAFT], env=home, check=True)
    assert list(tmp_path.rglob("*.ron")) == list(tmp_path.rglob("*.png")) == [], "nothing was made and kept"


def test_sizes_and_rates_that_make_no_sense():
    world = wf.World("six-motions", backend="cpu")
    for size in [(0, 90), (100_000, 90)]:
        with pytest.raises(ValueError):
            world.render(size)
    for arguments in [(0,), (1, 0), (float("nan"),), (1, float("inf"))]:
        with pytest.raises(ValueError, match="allowed"):
            world.frames(*arguments)
