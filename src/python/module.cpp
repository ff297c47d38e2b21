/// The module: start and end of MPI and PETSc, messages, failures as exceptions.
#include <csignal>
#include <memory>
#include <utility>

#include "app/built_version.hpp"
#include "linear/interruption.hpp"
#include "parallel/petsc_session.hpp"
#include "python/bindings.hpp"
#include "setup/case_file.hpp"
#include "system/errors.hpp"
#include "system/log.hpp"
#include "system/processes.hpp"
#include "system/program_path.hpp"
#include "system/version.hpp"

namespace solidus::python {

namespace {

/// Starts PETSc, and MPI where it does not run yet; does nothing a second time.
/// @param communicator  Fortran's number of an MPI communicator; absent: MPI_COMM_WORLD
/// @param options       of PETSc
void initialize(std::optional<int> communicator, const std::vector<std::string>& options) {
  const bool running = petsc::running();
  if (communicator && !running) petsc::use_communicator(*communicator);
  struct sigaction python {};
  sigaction(SIGINT, nullptr, &python);
  if (!petsc::start(options))
    throw InputError({}, "PETSc cannot start; its message is above", "options that PETSc knows");
  if (running) return;
  sigaction(SIGINT, &python, nullptr);  // MPI may have put its own in place
  linear::interrupt_when(interrupted);
}

void finalize() {
  logging::set_sink({});  // which holds a function of Python
  petsc::end();
}

const char* name_of(logging::Level level) {
  return level == logging::Level::warn ? "warning" : level == logging::Level::info ? "info" : "debug";
}

/// Hands messages to a function of Python, called with the level and the text.
void set_sink(py::object function) {
  // Nothing may be freed without Python's lock.
  const auto shared =
      std::shared_ptr<py::object>(new py::object(std::move(function)), [](py::object* object) {
        const py::gil_scoped_acquire lock;
        delete object;
      });
  logging::set_sink([shared](logging::Level level, std::string_view text) {
    const py::gil_scoped_acquire lock;
    try {
      (*shared)(name_of(level), std::string(text));
    } catch (py::error_already_set& error) {  // a message that cannot be handed over ends no run
      error.discard_as_unraisable("solidus_casting: message");
    }
  });
}

/// The exception of a signal.
std::optional<py::error_already_set>& signalled() {
  static std::optional<py::error_already_set> exception;
  return exception;
}

/// Raises an exception of the package.
void raise(const char* type, const char* factory, const std::string& text) {
  const py::object made = py::module_::import("solidus_casting.errors").attr(type);
  const py::object exception = factory == nullptr ? made(text) : made.attr(factory)(text);
  PyErr_SetObject(made.ptr(), exception.ptr());
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const InputError& error) {
    raise("InputError", "from_text", error.what());
  } catch (const StepRejected& error) {
    raise("RunStopped", nullptr, error.what());
  } catch (const linear::Interrupted& error) {
    // Python's own exception, such as that of Ctrl-C, goes before the program's.
    try {
      raise_if_interrupted(error.what());
    } catch (py::error_already_set& exception) {
      exception.restore();
      return;
    }
    raise("RunInterrupted", nullptr, error.what());
  }
}

std::string resolved(const std::string& path, const std::vector<std::string>& assignments) {
  return setup::load_case(path, assignments).toml();
}

void use_program(const std::string& program) {
  set_program_path(program);
}

std::pair<int, int> rank_and_size() {
  return {processes::rank(), processes::count()};
}

}  // namespace

bool interrupted() {
  const py::gil_scoped_acquire lock;
  if (!signalled() && PyErr_CheckSignals() != 0) signalled().emplace();
  return signalled().has_value();
}

void raise_if_interrupted(const std::string& reason) {
  if (!signalled()) return;
  py::error_already_set exception = std::move(*signalled());
  signalled().reset();
  if (!exception.matches(PyExc_KeyboardInterrupt)) throw exception;
  raise("RunInterrupted", nullptr, reason);
  throw py::error_already_set();
}

py::array_t<double> array_of(std::vector<double> values, std::vector<py::ssize_t> shape) {
  auto* const owned = new std::vector<double>(std::move(values));
  const py::capsule owner(owned, [](void* data) { delete static_cast<std::vector<double>*>(data); });
  return py::array_t<double>(std::move(shape), owned->data(), owner);
}

}  // namespace solidus::python

PYBIND11_MODULE(_core, core) {
  using namespace solidus::python;
  core.doc() = "The compiled part of solidus_casting. Use the package's own functions and classes.";
  // The package has the version of the program that it was built with.
  solidus::set_program_version(solidus::app::built_version());
  core.attr("version") = solidus::app::built_version();
  core.def("initialize", &initialize, py::arg("communicator") = py::none(),
           py::arg("options") = std::vector<std::string>());
  core.def("finalize", &finalize);
  core.def("set_sink", &set_sink);
  core.def("use_program", &use_program);
  core.def("resolved", &resolved);
  core.def("rank_and_size", &rank_and_size);
  py::register_exception_translator(&translate);
  bind_materials(core);
  bind_sessions(core);
}
