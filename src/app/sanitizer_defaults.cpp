/// The program under the sanitizers, and built with them only. Leaks are not looked for where it is started
/// on its own: MPI's modules are unloaded before LeakSanitizer can name them. The second option saves a third
/// of the time where MUMPS takes and gives back megabytes in every solution.
extern "C" const char* __asan_default_options();  // NOLINT: the sanitizer's name

extern "C" const char* __asan_default_options() {  // NOLINT
  return "detect_leaks=0:clear_shadow_mmap_threshold=33554432";
}
