/// Defaults are set only where the user has not given the option.
#include "parallel/petsc_options.hpp"

#include <petscsys.h>

#include <set>
#include <sstream>

#include "parallel/petsc_handles.hpp"

namespace solidus::petsc {

namespace {

/// Names that were given here, with the dash.
std::set<std::string>& defaults() {
  static std::set<std::string> names;
  return names;
}

}  // namespace

std::string version() {
  char text[128] = "";
  PetscGetVersion(text, sizeof text);
  return text;
}

void set_default_option(const std::string& name, const std::string& value) {
  const std::string key = "-" + name;
  PetscBool given = PETSC_FALSE;
  check(PetscOptionsHasName(nullptr, nullptr, key.c_str(), &given), "PetscOptionsHasName");
  if (given) return;
  check(PetscOptionsSetValue(nullptr, key.c_str(), value.c_str()), "PetscOptionsSetValue");
  defaults().insert(key);
}

void make_scalar_products_reproducible() {
#if PETSC_VERSION_GE(3, 20, 0)
  set_default_option("vec_mdot_use_gemv", "0");
  set_default_option("vec_maxpy_use_gemv", "0");
#endif
}

bool user_gave_option(const std::string& beginning) {
  char* text = nullptr;
  check(PetscOptionsGetAll(nullptr, &text), "PetscOptionsGetAll");
  std::istringstream words(text);
  check(PetscFree(text), "PetscFree");
  bool gave = false;
  for (std::string word; words >> word && !gave;)
    gave = word.starts_with("-" + beginning) && defaults().count(word) == 0;
  return gave;
}

}  // namespace solidus::petsc
