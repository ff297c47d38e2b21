#include "app/built_version.hpp"

#include "app/program_version.hpp"

namespace solidus::app {

const char* built_version() {
  return SOLIDUS_PROGRAM_VERSION;
}

}  // namespace solidus::app
