"""notebooks.py FILE.ipynb ...: executes notebooks, each in its folder, by nbconvert if it is installed. Without it, executes
the code of the cells in order."""

import ast
import importlib.util
import json
import os
import sys


def execute(path):
    """Returns the HTML or the picture that each cell shows."""
    import nbformat
    from nbconvert.preprocessors import ExecutePreprocessor
    notebook = nbformat.read(path, as_version=4)
    ExecutePreprocessor(timeout=100, kernel_name="python3").preprocess(
        notebook, {"metadata": {"path": os.path.dirname(os.path.abspath(path))}})
    shown = [output["data"] for cell in notebook.cells for output in cell.get("outputs", ()) if "data" in output]
    return [data.get("image/png") or data.get("text/html") for data in shown]


def execute_code(path):
    """Like execute, without nbconvert."""
    with open(path, encoding="utf-8") as file:
        cells = [cell for cell in json.load(file)["cells"] if cell["cell_type"] == "code"]
    os.chdir(os.path.dirname(os.path.abspath(path)))
    names: dict = {}
    for number, cell in enumerate(cells):
        tree = ast.parse("".join(cell["source"]), f"{os.path.basename(path)}, cell {number}")
        last = ast.Expression(tree.body.pop().value) if isinstance(tree.body[-1], ast.Expr) else None
        exec(compile(tree, f"cell {number}", "exec"), names)
        value = eval(compile(last, f"cell {number}", "eval"), names) if last else None
        if value is not None:  # notebooks show the value of the last line
            yield value._repr_html_() if hasattr(value, "_repr_html_") else value._repr_png_()


os.environ.setdefault("PYDEVD_DISABLE_FILE_VALIDATION", "1")  # a warning of the kernel that concerns debuggers
jupyter = all(importlib.util.find_spec(name) for name in ("ipykernel", "nbconvert"))
if not jupyter:
    print("nbconvert and ipykernel are not installed: executing only the code of the notebooks")
for path in map(os.path.abspath, sys.argv[1:]):
    shown = list(execute(path) if jupyter else execute_code(path))
    assert shown and all(output and len(output) > 1000 for output in shown), f"{path}: a cell shows nothing"
    print(f"{path}: {len(shown)} cells show a picture")
