/// summary.json: the summary of a run, for people and for tests that check time and memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "criteria/criterion.hpp"
#include "mesh/mesh.hpp"
#include "quantities/quantity.hpp"
#include "results/answers/answers.hpp"
#include "results/load_balance.hpp"
#include "results/overview.hpp"

namespace solidus::results {

/// Sizes over all processes, each element counted once.
struct MeshCounts {
  GlobalIndex nodes = 0;
  std::vector<std::pair<std::string, GlobalIndex>> elements_of_shape;  ///< "tri3"; only shapes that occur
  std::vector<std::pair<std::string, GlobalIndex>> elements_of_body;   ///< in the order of Mesh::bodies
};
/// Collective.
MeshCounts count(const mesh::Mesh& mesh);

/// The largest resident memory so far: of one process, of process 0, which reads the mesh, and the sum over
/// the processes' peaks [bytes].
struct PeakMemory {
  double largest = 0, first = 0, sum = 0;
};
/// Collective.
PeakMemory peak_memory();

/// The stiffness of a melt whose viscosity the program chose.
struct ChosenMelt {
  std::string body;
  double modulus = 0;   ///< 2Ĝ [Pa]
  double time = 0;      ///< t_r [s]
  std::string against;  ///< the quantity it was measured against
};

/// Liquid metal that left its wall, over the steps since the run began or went on.
struct LeftWall {
  std::string contact;
  double gap = 0;           ///< the largest [m]
  double area = 0;          ///< the largest [m²]
  double from = 0, to = 0;  ///< the first and the last time [s]
};

/// Steps whose augmentations of the Lagrangian ended early, since the run began or went on.
struct UnsettledAugmentations {
  std::string contact;
  int steps = 0;
  double penetration = 0;  ///< the largest that was left, as a share of the mean size of the slave's faces
};

/// Everything summary.json says. Lists keep their order; `final_values` pairs a header of history.csv with
/// the last value of that column.
struct Summary {
  std::string case_file, variant, title;
  std::string outcome;  ///< "finished", or "stopped: " with the reason
  int processes = 1;
  MeshCounts mesh;
  int steps = 0, rejected = 0, shortened = 0;           ///< StepRecord
  double end_time = 0;                                  ///< time reached [s]
  std::vector<std::pair<std::string, double>> seconds;  ///< by phase; "total" is the wall time
  /// Wall time of process 0 by parts of the program, which add up to `profile_total` (system/profile.hpp)
  /// [s].
  std::vector<std::pair<std::string, double>> profile;
  double profile_total = 0;
  PeakMemory memory;
  Balance balance;
  std::vector<std::pair<std::string, std::size_t>> table_bytes;  ///< of process 0
  std::optional<double> relative_energy_defect;                  ///< absent without heat
  std::vector<std::pair<std::string, double>> final_values;
  std::vector<criteria::CriterionResult> criteria;
  std::vector<const quantities::Quantity*> fields;  ///< that the field files have
  std::optional<Answers> answers;                   ///< absent in steady runs
  std::vector<ChosenMelt> melt;
  std::vector<LeftWall> left_walls;
  std::vector<UnsettledAugmentations> unsettled;
  std::optional<Overview> overview;  ///< the case as it was understood
  std::vector<std::string> warnings;
};

std::string summary_json(const Summary& summary);

/// Writes it atomically, from one process. Throws OutputError, NotFiniteError.
void write_summary(const std::filesystem::path& path, const Summary& summary);

}  // namespace solidus::results
