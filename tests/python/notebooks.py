"""notebooks.py FILE.ipynb ...: executes the code cells of notebooks, each in the folder of its notebook."""

import ast
import json
import os
import sys

for path in sys.argv[1:]:
    with open(path, encoding="utf-8") as file:
        cells = [cell for cell in json.load(file)["cells"] if cell["cell_type"] == "code"]
    os.chdir(os.path.dirname(os.path.abspath(path)))
    names: dict = {}
    shown = 0
    for number, cell in enumerate(cells):
        tree = ast.parse("".join(cell["source"]), f"{os.path.basename(path)}, cell {number}")
        last = ast.Expression(tree.body.pop().value) if isinstance(tree.body[-1], ast.Expr) else None
        exec(compile(tree, f"cell {number}", "exec"), names)
        value = eval(compile(last, f"cell {number}", "eval"), names) if last else None
        if value is not None:  # notebooks show the value of the last line
            picture = value._repr_html_() if hasattr(value, "_repr_html_") else value._repr_png_()
            assert len(picture) > 1000, f"cell {number} shows {value!r}"
            shown += 1
    assert len(cells) > 3 and shown > 0, f"{path} shows nothing"
    print(f"{path}: {len(cells)} cells, {shown} with a picture")
