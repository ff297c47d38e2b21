"""Reads the collection that run_folder_test.cpp wrote and checks it against the formulas there."""

import sys

import numpy as np

from solidus_plots.vtu import read_collection, read_fields

times, files = read_collection(sys.argv[1])
assert list(times) == [0.0, 2.5], times
grid = read_fields(files[1])
assert grid.time == 2.5, grid.time
# 7 × 5 corners, 6 × 5 + 7 × 4 mid nodes: those the processes share are joined.
assert len(grid.points) == 35 + 58, len(grid.points)
assert len(grid.cell_types) == 24 and set(grid.cell_types) == {23}, grid.cell_types
x, y = grid.points[:, 0], grid.points[:, 1]
assert np.array_equal(grid.point_data["temperature"], 300 + 10 * x + y)
assert np.array_equal(grid.cell_data["number"], grid.cell_data["element"])
assert grid.units["temperature"] == "K", grid.units
triangles, cells = grid.triangles()
corners = grid.points[triangles]
edges = corners[:, 1:, :2] - corners[:, :1, :2]
areas = (edges[:, 0, 0] * edges[:, 1, 1] - edges[:, 0, 1] * edges[:, 1, 0]) / 2
assert (areas > 0).all() and abs(areas.sum() - 6) < 1e-12, areas.sum()  # the block is 3 × 2
boundary = grid.edges()[1] == 1
assert boundary.sum() == 2 * (6 + 4), boundary.sum()
