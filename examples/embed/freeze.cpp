// Runs the first two seconds of a case from a program of one's own, and says how it ended.
//   freeze CASE FOLDER
#include <mesh/gmsh/import.hpp>
#include <mesh/making/reader_process.hpp>
#include <parallel/petsc_session.hpp>
#include <run/session.hpp>

#include <cstdio>
#include <exception>

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs("usage: freeze CASE FOLDER\n", stderr);
    return 1;
  }
  if (!solidus::petsc::start({})) return 3;
  // A program that links the reader of meshes needs none next to it.
  solidus::mesh::read_in_this_process(&solidus::mesh::read_mesh_here);
  int code = 0;
  try {
    solidus::setup::Case c = solidus::setup::load_case(argv[1], {"time.end=\"2 s\""});
    const solidus::run::RunResult result = solidus::run::run_case(c, {.folder = argv[2]});
    std::printf("%s: %s\n", c.spec.title.c_str(), result.finished ? "finished" : result.reason.c_str());
  } catch (const std::exception& error) {  // a place in the user's files, what was found and what is allowed
    std::fprintf(stderr, "%s\n", error.what());
    code = 1;
  }
  solidus::petsc::end();
  return code;
}
