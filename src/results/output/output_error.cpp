/// A failure of one process becomes a failure of all.
#include "results/output/output_error.hpp"

#include "system/common_failure.hpp"

namespace solidus::results {

OutputError::OutputError(const std::string& path, const std::string& what, const std::string& advice)
    : InputError(SourceLocation{path, 0, 0}, what, advice) {}

NotFiniteError::NotFiniteError(const std::string& field, const std::string& where)
    : std::runtime_error(field + " is not finite" + (where.empty() ? "" : " at " + where) +
                         "; it is not written to the results") {}

namespace {

void throw_output_error(const std::string& message) {
  throw OutputError({}, message);
}

}  // namespace

void run_collectively(const std::function<void()>& work) {
  solidus::run_collectively(work, throw_output_error);
}

void on_first_process(const std::function<void()>& work) {
  solidus::on_first_process(work, throw_output_error);
}

}  // namespace solidus::results
