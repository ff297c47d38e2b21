/// Reader process: foreign meshes are read, and geometries meshed, in a process of their own, so that a
/// crash, an endless loop or a lack of memory there does not end the program.
///
/// The reader is the program itself, started with a verb that no user types. It reads a request, hands the
/// mesh back through a pipe and ends. It may start no program, write no file and open no connection, unless
/// the script is trusted. Programs that do not serve as a reader (tests) read meshes in their own process.
#pragma once

#include <optional>

#include "mesh/casting_geometry.hpp"
#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {

/// Call this first in main(), before MPI starts: where the program was started as the reader it does the
/// reader's work and returns the exit code; else read_mesh() starts readers from now on.
std::optional<int> serve_as_reader(int argc, char** argv);

/// From now on read_mesh() starts readers: for a process that is not the program, but knows where it is
/// (system/program_path.hpp).
void read_in_processes();

/// Tells read_mesh() when to give up waiting for a reader: it ends it then and throws StepRejected.
/// @param asked  called about ten times a second; nullptr: wait on
void give_up_reading_when(bool (*asked)());

/// Memory and time that a reader process may use. The environment sets both: SOLIDUS_MESH_MEMORY="8 GB",
/// SOLIDUS_MESH_TIME="2 h".
struct ReaderLimits {
  double memory = 0;  ///< [byte]
  double time = 0;    ///< [s]
};
/// Without a word of the environment: geometries half of the machine's memory and half an hour, meshes what
/// their size makes likely. Throws InputError for a limit that cannot be read.
/// @param meshes  what the file holds is meshed anew, whatever it is
ReaderLimits reader_limits(const MeshSource& source, bool meshes = false);

/// Reads in this process, whatever happens.
RawMesh read_mesh_here(const MeshSource& source, const CastingGeometry* casting = nullptr);

/// Reads a mesh, or with `casting` makes one in the way that its `attempt` says, in a reader where there are
/// readers. Throws InputError.
RawMesh read_in_one_way(const MeshSource& source, const CastingGeometry* casting);

}  // namespace solidus::mesh
