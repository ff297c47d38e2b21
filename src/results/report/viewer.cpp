#include "results/report/viewer.hpp"

#include "numbers/index_casts.hpp"

// The assembler takes the file in as it is: no array of a million numbers for the compiler.
asm(".section .rodata\n"
    ".global solidus_viewer_begin\n"
    ".global solidus_viewer_end\n"
    "solidus_viewer_begin:\n"
    ".incbin \"" SOLIDUS_VIEWER_FILE
    "\"\n"
    "solidus_viewer_end:\n"
    ".byte 0\n"
    ".previous\n");
extern "C" const char solidus_viewer_begin[];  // NOLINT
extern "C" const char solidus_viewer_end[];    // NOLINT

namespace solidus::results {

std::string_view viewer() {
  return {solidus_viewer_begin, as_size(solidus_viewer_end - solidus_viewer_begin)};
}

}  // namespace solidus::results
