"""The workbench: a page for the browser in which a case is made, checked, run and judged (``solidus open``).

Everything that it does is done by verbs of the program and is kept in files next to the part: a case folder that an editor
changes as well.
"""
