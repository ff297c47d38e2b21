/// Reader process: foreign meshes are read, and geometries meshed, in a process of their own, so that a
/// crash, an endless loop or a lack of memory there does not end the program.
///
/// The reader is a program of its own, `solidus-reader` (mesh/making/serve.hpp), and alone is linked with
/// Gmsh, whose libraries take longer to load than all others together: a program may have a copy of itself
/// read what needs none of them. The reader takes a request, hands the mesh back through a pipe and ends. It
/// may start no program, write no file and open no connection, unless the script is trusted.
#pragma once

#include "mesh/making/casting_geometry.hpp"
#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {

/// Reads a mesh, or with `casting` makes one in the way that its `attempt` says. Throws InputError.
using ReadMesh = RawMesh(const MeshSource& source, const CastingGeometry* casting);

/// From now on meshes are read in this process, whatever happens: for programs that link what reads them,
/// read_in_this_process(&read_mesh_here) with mesh/gmsh/import.hpp. Null: readers read them again.
void read_in_this_process(ReadMesh* read);

/// From now on a copy of this process (fork) reads the formats that need none of the reader's libraries,
/// under the same restrictions: for a program none of whose threads holds a lock while it reads meshes.
void read_in_copies_of_this_process();

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
/// @param meshes  what the file holds is meshed again, whatever it is
ReaderLimits reader_limits(const MeshSource& source, bool meshes = false);

/// The processor time that a reader may use for one way of meshing, in addition to the limits above.
struct TimeOfWay {
  std::string what = {};        ///< the way, for messages
  double processor = 0;         ///< [s] of the processor; 0: no such limit
  double processor_a_node = 0;  ///< more for each node that is expected [s]
};

/// A way of meshing that took longer than it may.
class MeshingTooLong : public InputError {
  using InputError::InputError;
};

/// Reads a mesh, or with `casting` makes one in the way that its `attempt` says, in a reader
/// but for read_in_this_process(). Throws InputError, also where there is no reader next to the program, and
/// MeshingTooLong.
/// @param time   not for read_in_this_process()
/// @param spent  takes the reader's processor time [s]; may be null
RawMesh read_in_one_way(const MeshSource& source, const CastingGeometry* casting, const TimeOfWay& time = {},
                        double* spent = nullptr);

}  // namespace solidus::mesh
