// Compiled for any x86-64 (CMakeLists.txt), and run before anything else of the program: nothing that other
// files compile too may be called here, for theirs may be the copy that is linked.
#include "app/instructions.hpp"

#include <unistd.h>

namespace solidus::app {

namespace {

constexpr const char* k_names[] = {"sse4.2",   "popcnt",   "avx",        "avx2",       "fma",
                                   "bmi",      "bmi2",     "avx512f",    "avx512cd",   "avx512bw",
                                   "avx512dq", "avx512vl", "avx512vbmi", "avx512vnni", nullptr};

void say(const char* text) {
  unsigned long length = 0;
  while (text[length] != '\0') ++length;
  [[maybe_unused]] const long written = write(STDERR_FILENO, text, length);
}

// Before the constructors of other files, which may use those instructions.
[[gnu::constructor(101)]] void check_instructions() {
  const Instructions missing = k_built_for & ~instructions_here();
  if (missing == 0) return;
  say("solidus: this program was built for another processor: this one has no");
  for (unsigned i = 0; k_names[i] != nullptr; ++i) {
    if ((missing >> i & 1U) == 0) continue;
    say(" ");
    say(k_names[i]);
  }
  say("\n  build it on this machine: ./dev build; what ./dev build portable makes, as for the packages and "
      "the\n"
      "  archive, runs on every processor of 2013 or later with AVX2\n");
  _exit(1);
}

}  // namespace

Instructions instructions_here() {
#if defined(__x86_64__)
  __builtin_cpu_init();
  Instructions set = 0;
  // Bits in the order in which the other file sets those of the build.
  const auto has = [&set](unsigned bit, int answer) { set |= answer != 0 ? 1U << bit : 0U; };
  has(0, __builtin_cpu_supports("sse4.2"));
  has(1, __builtin_cpu_supports("popcnt"));
  has(2, __builtin_cpu_supports("avx"));
  has(3, __builtin_cpu_supports("avx2"));
  has(4, __builtin_cpu_supports("fma"));
  has(5, __builtin_cpu_supports("bmi"));
  has(6, __builtin_cpu_supports("bmi2"));
  has(7, __builtin_cpu_supports("avx512f"));
  has(8, __builtin_cpu_supports("avx512cd"));
  has(9, __builtin_cpu_supports("avx512bw"));
  has(10, __builtin_cpu_supports("avx512dq"));
  has(11, __builtin_cpu_supports("avx512vl"));
  has(12, __builtin_cpu_supports("avx512vbmi"));
  has(13, __builtin_cpu_supports("avx512vnni"));
  return set;
#else
  return k_built_for;  // no build is for processors of another family
#endif
}

const char* const* instruction_names() {
  return k_names;
}

}  // namespace solidus::app
