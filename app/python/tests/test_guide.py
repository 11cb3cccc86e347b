# SPDX-FileCopyrightText: The Windfall authors
# SPDX-License-Identifier: MIT OR Apache-2.0
"""The examples of docs/guide/python.md run one after another, as a reader types them in, and so does that of the README."""

import re
from pathlib import Path

import windfall

ROOT = Path(__file__).parents[3]
PAGE = ROOT / "docs" / "guide" / "python.md"


def test_examples_of_the_guide_run(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    examples = re.findall(r"^```python\n(.*?)^```$", PAGE.read_text(encoding="utf-8"), re.M | re.S)
    assert len(examples) >= 6
    names: dict = {}
    for number, example in enumerate(examples, 1):
        exec(compile(example, f"{PAGE.name}, example {number}", "exec"), names)


def test_the_example_of_the_readme_runs():
    [example] = re.findall(r"# Python: (.*)$", (ROOT / "README.md").read_text(encoding="utf-8"), re.M)
    assert re.fullmatch("[0-9a-f]{16}", eval(example, {"windfall": windfall}))
