/// The reader of meshes, `solidus-reader`: the program starts it, nothing else uses it
/// (mesh/making/reader_process.hpp).
#include <unistd.h>

#include <cstdio>
#include <exception>

#include "app/built_version.hpp"
#include "mesh/gmsh/serve.hpp"
#include "system/version.hpp"

int main() {
  int code = 3;
  try {
    solidus::set_program_version(solidus::app::built_version());
    solidus::mesh::serve_request();
    code = 0;
  } catch (const std::exception&) {
    std::fputs("solidus-reader: it reads meshes for the program solidus, which starts it\n", stderr);
  }
  _exit(code);  // what libraries do at the end of a process must not spoil an answer that is given
}
