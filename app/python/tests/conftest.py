# SPDX-FileCopyrightText: The Windfall authors
# SPDX-License-Identifier: MIT OR Apache-2.0
"""What tests share: a small scene, and runs of the command."""

import json
import subprocess
import sys

import pytest

import windfall as wf


@pytest.fixture
def storm() -> wf.Scene:
    return wf.Scene.load("storm").with_(leaves=2000)


@pytest.fixture
def simulated():
    """The JSON of `windfall simulate` with these arguments."""

    def run(*arguments: str) -> dict:
        command = [sys.executable, "-m", "windfall", "simulate", "--json", "--backend", "cpu", *arguments]
        return json.loads(subprocess.run(command, capture_output=True, check=True).stdout)

    return run


@pytest.fixture
def refused(tmp_path):
    """The line that the command says when it refuses these arguments."""

    def run(*arguments: str) -> str:
        command = [sys.executable, "-m", "windfall", *arguments]
        done = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path)
        assert done.returncode == 2, done
        return done.stderr.strip().removeprefix("error: ")

    return run
