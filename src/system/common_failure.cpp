/// After each collective part all processes learn whether one has failed.
#include "system/common_failure.hpp"

#include <exception>
#include <new>
#include <stdexcept>

#include "system/errors.hpp"
#include "system/processes.hpp"

namespace solidus {

namespace {

enum Kind : int { k_input, k_memory, k_internal };

/// An exception of this process, and how it is told to the others.
struct CaughtError {
  std::exception_ptr error;
  int kind = k_internal;
  std::string message;
};

CaughtError caught_in(const std::function<void()>& work) {
  try {
    work();
  } catch (const InputError& error) {
    return {std::current_exception(), k_input, error.what()};
  } catch (const std::bad_alloc& error) {
    return {std::current_exception(), k_memory, error.what()};
  } catch (const std::exception& error) {
    return {std::current_exception(), k_internal, error.what()};
  } catch (...) {
    return {std::current_exception(), k_internal, "an exception of a library"};
  }
  return {};
}

}  // namespace

void run_collectively(const std::function<void()>& work, const ThrowInputError& throw_input_error) {
  // The first process that failed tells its kind and message; the others throw the same.
  CaughtError caught = caught_in(work);
  const int failing = processes::least(caught.error ? processes::rank() : processes::count());
  if (failing == processes::count()) return;

  // The lowest process that failed gives the kind and the words of the failure.
  int kind = caught.kind;
  processes::broadcast(std::span(&kind, 1), failing);
  std::string message = caught.message;
  processes::broadcast(message, failing);
  if (caught.error) std::rethrow_exception(caught.error);
  if (kind == k_memory) throw std::bad_alloc();
  if (kind == k_internal) throw std::runtime_error(message);
  if (throw_input_error) throw_input_error(message);
  throw InputError({}, message);
}

void on_first_process(const std::function<void()>& work, const ThrowInputError& throw_input_error) {
  run_collectively(
      [&] {
        if (processes::rank() == 0) work();
      },
      throw_input_error);
}

}  // namespace solidus
