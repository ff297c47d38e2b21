"""A block that cools, the case of the tests of the Python package."""

import copy
import os
import unittest

import solidus_casting as sc

CASE = {
    "title": "A block cools",
    "analysis": {"kind": "plane_strain", "physics": "heat"},
    "mesh": {"shape": "block", "element": "quad8", "block": {"size": ["40 mm", "20 mm"], "divisions": [8, 4]}},
    "time": {"end": "60 s", "step": "6 s"},
    "body": [{"name": "block", "material": "aluminium_alsi7mg", "initial_temperature": "700 degC"}],
    "thermal_condition": [{"name": "air", "group": "x_max", "kind": "film", "coefficient": "3000 W/m2/K",
                           "ambient": "20 degC"}],
    "probe": [{"name": "T_inside", "field": "temperature", "point": ["21.7 mm", "3.1 mm"], "unit": "K"}],
    "output": {"every": "12 s"},
}
INSIDE = (0.0217, 0.0031)
# Where the build has made the compiled part, it must be found.
with_core = unittest.skipUnless(sc.has_core() or os.environ.get("SOLIDUS_EXPECT_CORE"),
                                "the compiled part of the package was not built")


def block(**changes):
    case = sc.Case(copy.deepcopy(CASE))
    for path, value in changes.items():
        case[path.replace("__", ".")] = value
    return case
