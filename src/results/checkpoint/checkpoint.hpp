/// Checkpoints: the committed state of a run in one file, from which it goes on with the same bits.
///
/// Values go by the numbers of nodes and elements in the input, so any number of processes can read what
/// another number wrote. Process 0 writes and reads for all, one process's share at a time.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "coupling/observer.hpp"
#include "coupling/state.hpp"
#include "mesh/mesh.hpp"

namespace solidus::results {

/// Properties in which a checkpoint must agree with the case that reads it: name and text, compared one by
/// one.
using Fingerprint = std::vector<std::pair<std::string, std::string>>;

struct Checkpoint {
  coupling::State state;
  coupling::RestartData continuation;
  coupling::EnergyAudit energy;             ///< summed over the steps so far
  int rejected = 0, shortened = 0;          ///< tries so far
  coupling::StabilityAudit stability = {};  ///< summed likewise
};

/// References to the data that are written, without a copy of the state.
struct CheckpointView {
  const coupling::State& state;
  const coupling::RestartData& continuation;
  const coupling::EnergyAudit& energy;
  int rejected, shortened;
  const coupling::StabilityAudit& stability;
};

/// The two latest checkpoints of a run: checkpoint/state.h5 and checkpoint/previous.h5.
class CheckpointFolder {
 public:
  /// @param results the folder of the run; nothing is touched before write()
  explicit CheckpointFolder(const std::filesystem::path& results) : root_(results / "checkpoint") {}

  std::filesystem::path latest() const { return root_ / "state.h5"; }
  std::filesystem::path previous() const { return root_ / "previous.h5"; }
  /// Throws InputError on every process when there is none. Collective.
  void require() const;

  /// Writes whole or not at all; the latest one becomes the previous one. Collective. Throws OutputError on
  /// every process.
  void write(const mesh::Mesh& mesh, const Fingerprint& fingerprint, const CheckpointView& checkpoint) const;
  /// The latest one, or with a warning the previous one where the latest cannot be read. Collective.
  /// @param layout a state of this case, of which sizes and padding are taken
  /// Throws InputError on every process: there is none, or it is of another case. The checkpoint's numbers
  /// of processes may differ from the present one; bits are the same only where it does not.
  Checkpoint read(const mesh::Mesh& mesh, const Fingerprint& fingerprint,
                  const coupling::State& layout) const;

 private:
  /// Whether latest() and previous() exist, as process 0 sees it.
  std::pair<bool, bool> there() const;

  std::filesystem::path root_;
};

}  // namespace solidus::results
