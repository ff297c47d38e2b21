/// A bar of one element as a case, for tests of keys.
#pragma once

#include <string>

#include "cases/case_keys.hpp"
#include "setup/case_file.hpp"
#include "system/errors.hpp"

namespace solidus::test {

/// @param more further sections of the file
inline cases::CaseSpec bar_case(const std::string& more = "") {
  return cases::case_keys().read(parse_document(R"(title = "A bar"
[analysis]
kind = "plane_strain"
[mesh]
shape = "block"
element = "quad4"
[mesh.block]
size = ["10 mm", "10 mm"]
divisions = [1, 1]
[time]
end = "10 s"
step = "1 s"
[[body]]
name = "bar"
material = "a"
initial_temperature = "600 K"
)" + more,
                                                "case.toml"));
}

/// Returns the error of the check of the whole case; empty: none.
inline std::string refusal(const cases::CaseSpec& spec) {
  try {
    setup::check_case(spec);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

}  // namespace solidus::test
