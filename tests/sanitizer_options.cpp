/// Options of AddressSanitizer in tests that are built with it; ASAN_OPTIONS adds to them.
extern "C" const char* __asan_default_options();  // NOLINT: the sanitizer's name

extern "C" const char* __asan_default_options() {  // NOLINT
  // Each solution with MUMPS takes 2.4 MB and gives them back. Where their shadow is overwritten instead of
  // mapped again, that takes two thirds of the time.
  return "clear_shadow_mmap_threshold=33554432";
}
