# SPDX-FileCopyrightText: The Windfall authors
# SPDX-License-Identifier: MIT OR Apache-2.0
"""The notebook of the guide runs, and comes to what it shows."""

from pathlib import Path

import pytest

nbclient = pytest.importorskip("nbclient")
nbformat = pytest.importorskip("nbformat")
pytest.importorskip("matplotlib")

NOTEBOOK = Path(__file__).parents[3] / "docs" / "guide" / "leaves-in-the-wind.ipynb"


def outputs(notebook, kind: str) -> list:
    """Results of one kind, in the order of cells."""
    results = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    return [output.data[kind] for output in results if kind in output.get("data", {})]


def printed(notebook) -> list[str]:
    results = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    return [output.text for output in results if output.output_type == "stream" and output.name == "stdout"]


def test_the_notebook_comes_to_what_it_shows(tmp_path):
    shown = nbformat.read(NOTEBOOK, as_version=4)
    run = nbformat.from_dict(shown.copy())
    for cell in run.cells:
        if cell.cell_type == "code":
            cell.outputs, cell.execution_count = [], None
    client = nbclient.NotebookClient(run, timeout=600, resources={"metadata": {"path": str(tmp_path)}})
    client.execute()
    assert len(outputs(run, "image/png")) == 3, "the storm and two plots"
    assert len(outputs(shown, "image/png")) == 3, "they are kept with it"
    assert printed(run) == printed(shown)
    hashes = outputs(run, "text/plain")[-1]
    assert hashes == outputs(shown, "text/plain")[-1] and len(hashes) > 12, "the same state"
