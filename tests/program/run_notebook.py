"""Executes the code cells of a notebook in order, as a kernel does: `python3 run_notebook.py FILE`. What a cell's last line
is worth is printed. The first failure ends it with the cell's number and exit code 1."""

import ast
import json
import sys
import traceback


def execute(file):
    notebook = json.load(open(file, encoding="utf-8"))
    names = {"__name__": "__main__"}
    for number, cell in enumerate(notebook["cells"], 1):
        if cell["cell_type"] != "code":
            continue
        tree = ast.parse("".join(cell["source"]), f"cell {number}")
        shown = None
        if tree.body and isinstance(tree.body[-1], ast.Expr):
            shown = ast.Expression(tree.body.pop().value)
        try:
            exec(compile(tree, f"cell {number}", "exec"), names)
            value = eval(compile(shown, f"cell {number}", "eval"), names) if shown else None
            if value is not None:
                print(repr(value))
        except Exception:
            traceback.print_exc()
            print(f"cell {number} failed", file=sys.stderr)
            return 1
    return 0


if __name__ == "__main__":
    sys.exit(execute(sys.argv[1]))
