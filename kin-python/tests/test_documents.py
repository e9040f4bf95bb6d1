"""The programs of the guide, the examples and the notebooks run as they stand."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

HERE = Path(__file__).resolve().parents[1]
GUIDE = HERE.parent / "docs" / "guide"
PAGES = {path.stem: path.read_text(encoding="utf-8") for path in sorted(GUIDE.glob("*.md"))}
NAMED = [(name, one) for name, page in PAGES.items() for one in re.findall(r"^```python\n(.*?)^```", page, re.M | re.S)]
PROGRAMS = [one for _, one in NAMED]


def run(program, folder):
    """Runs a program as a file, in a folder of its own."""
    path = folder / "program.py"
    path.write_text(program, encoding="utf-8")
    done = subprocess.run([sys.executable, str(path)], cwd=folder, capture_output=True, text=True, env=dict(os.environ))
    assert done.returncode == 0, done.stderr
    return done.stdout


ENGINES = ("scipy", "torch", "jax", "ray", "dask", "pyspark")
IDS = [" ".join([page, str(k), *(name for name in ENGINES if f"import {name}" in one)]) for k, (page, one) in enumerate(NAMED)]


@pytest.mark.parametrize("k", range(len(PROGRAMS)), ids=IDS)
def test_the_guides_programs_run(k, tmp_path):
    missing = [name for name in ENGINES if f"import {name}" in PROGRAMS[k]]
    for name in missing:
        pytest.importorskip(name, reason=f"NOT RUN: {name} is not installed")
    run(PROGRAMS[k], tmp_path)


@pytest.mark.parametrize("path", sorted((HERE / "examples").glob("*.py")), ids=lambda path: path.stem)
def test_examples_run(path, tmp_path):
    assert run(path.read_text(encoding="utf-8"), tmp_path)


@pytest.mark.parametrize("path", sorted((HERE / "notebooks").glob("*.ipynb")), ids=lambda path: path.stem)
def test_notebooks_run(path, tmp_path):
    """Every cell, in order, in IPython's kernel where it is installed; else as one program."""
    try:
        import nbclient
        import nbformat

        notebook = nbformat.read(path, as_version=4)
        nbclient.NotebookClient(notebook, timeout=300, kernel_name="python3", resources={"metadata": {"path": tmp_path}}).execute()
        shown = [one for cell in notebook.cells for one in cell.get("outputs", []) if "data" in one]
        kinds = {kind for one in shown for kind in one["data"]}
        assert {"image/svg+xml", "text/html"} <= kinds
    except ImportError:
        cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
        run("\n".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "code"), tmp_path)


def test_figures_of_the_guide_are_plausible():
    """The table of times is there, with a figure in each row."""
    rows = [line for line in PAGES["python"].splitlines() if line.startswith("| ") and " × " in line]
    assert len(rows) >= 2
