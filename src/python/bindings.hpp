/// The compiled part of the Python package: solidus_casting._core. What it offers is what the package's own
/// files wrap; users meet those (python/solidus_casting).
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <vector>

namespace solidus::python {

namespace py = pybind11;

/// Arrays of doubles, row by row; others are converted.
using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// Materials, constitutive updates and material points.
void bind_materials(py::module_& core);
/// Runs that are driven step by step.
void bind_sessions(py::module_& core);

/// Whether Python has had a signal to deal with (Ctrl-C) since raise_if_interrupted(). Its exception is kept,
/// so that messages can still be handed to Python while the run comes to its end.
bool interrupted();
/// Throws the exception of the signal, where there was one: Ctrl-C as RunInterrupted with this reason. Needs
/// Python's lock.
void raise_if_interrupted(const std::string& reason);

/// A numpy array that owns the values, of this shape.
py::array_t<double> array_of(std::vector<double> values, std::vector<py::ssize_t> shape);

}  // namespace solidus::python
