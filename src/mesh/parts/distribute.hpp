/// The parts of a mesh that the processes hold, balanced by their work.
#pragma once

#include <string>
#include <vector>

#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {

/// Phases that a body takes part in. The phases differ in their cost, and so in the load of a process.
enum class BodyWork {
  all,  ///< mechanics, with or without heat
  heat  ///< heat alone
};

/// As distribute() of raw_mesh.hpp, with what each body is computed for. Process 0 works through the whole
/// mesh once and sends each process its part; the others never hold more than theirs. Collective.
/// @param work  of each body; empty: all of them everything
Mesh distribute(const RawMesh& raw, const std::vector<std::string>& bodies,
                const std::vector<std::string>& replicated, const std::vector<BodyWork>& work);
/// The same, and the whole mesh is given up before this process unpacks its part: less memory at a time.
Mesh distribute(RawMesh&& raw, const std::vector<std::string>& bodies,
                const std::vector<std::string>& replicated, const std::vector<BodyWork>& work);

}  // namespace solidus::mesh
