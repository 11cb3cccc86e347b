# SPDX-FileCopyrightText: The Windfall authors
# SPDX-License-Identifier: MIT OR Apache-2.0
"""Presets have the state hashes that every other way to use the engine gives."""

import csv
from pathlib import Path

import pytest

import windfall as wf

TABLE = Path(__file__).parents[3] / "tests" / "state_hashes.csv"
ROWS = list(csv.DictReader(TABLE.open(encoding="utf-8")))


@pytest.mark.parametrize("row", ROWS, ids=[row["scene"] for row in ROWS])
def test_presets_have_the_same_hashes_in_python(row):
    world = wf.World(row["scene"], backend="cpu").step(int(row["steps"]))
    assert world.state_hash() == row["state_hash"]
