/// The observer that fills a run's folder: fields, history, steps, progress and the summary.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "coupling/phases.hpp"
#include "results/answers/answer_errors.hpp"
#include "results/answers/answers.hpp"
#include "results/answers/shot_table.hpp"
#include "results/answers/stage_table.hpp"
#include "results/checkpoint/checkpoint.hpp"
#include "results/fields/state_fields.hpp"
#include "results/formats/field_output.hpp"
#include "results/output/run_folder.hpp"
#include "results/progress.hpp"
#include "results/summary.hpp"
#include "results/tables/feeding_table.hpp"
#include "results/tables/pool_table.hpp"
#include "results/tables/probes.hpp"
#include "results/tables/profile_table.hpp"
#include "results/tables/step_columns.hpp"

namespace solidus::results {

struct RecorderOptions {
  AnalysisKind kind = AnalysisKind::plane_strain;
  std::vector<Probe> probes;
  std::vector<Profile> profiles;
  std::vector<std::string> fields;   ///< to write; empty: all
  std::vector<std::string> formats;  ///< of field_formats(), which are written besides
  std::ostream* progress = nullptr;  ///< process 0; null: none
  ProgressOptions progress_options;
  bool melting = true;                     ///< a material can melt
  std::vector<std::string> stages = {};    ///< names of the stages of the case; empty: it has none
  std::vector<double> stage_ends = {};     ///< of all its stages, in their order [s]
  bool shots = false;                      ///< some of them are shots
  std::vector<std::string> sources = {};   ///< that travel, whose power is shown
  std::vector<std::string> channels = {};  ///< that cool, whose fluid is shown
  bool fixed_steps = false;                ///< steps do not follow their errors, which the answers then tell
  bool steady = false;                     ///< one state without a time: fields of it alone
  bool profile = false;                    ///< print where the wall time went
  /// The bodies that are poured, whose solid fraction is shown; empty: of all that can melt.
  std::vector<CastBody> castings;
  DisplayUnits units;                       ///< of the printed answers
  Fingerprint fingerprint;                  ///< of the case, for checkpoints
  std::optional<Checkpoint> continue_from;  ///< the tables and fields of the run so far go on
  Summary summary;                          ///< known before the run: names, mesh, seconds of setting up
};

/// Throws the exceptions that Recorder would throw: InputError for probes, profiles and fields that do not
/// fit. Collective.
void check_output(const mesh::Mesh& mesh, const coupling::Phases& phases, const RecorderOptions& options);

class Recorder : public coupling::Observer {
 public:
  /// Finds probes and opens the tables. Collective. Throws InputError (probes), OutputError.
  Recorder(const RunFolder& folder, const mesh::Mesh& mesh, const coupling::Phases& phases,
           RecorderOptions options);

  void begin(const coupling::State& state) override;
  void step(const coupling::StepRecord& record, const coupling::State& state) override;
  void shot(const coupling::ShotRecord& record, const coupling::State& state) override;
  void checkpoint(const coupling::RestartData& continuation, const coupling::State& state) override;
  void stopped(const coupling::Stop& stop, const coupling::State& state) override;
  void end(const coupling::State& state) override;
  /// What the run left in summary.json, once it has ended; final values are known to process 0.
  const Summary& summary() const { return options_.summary; }

 private:
  StepTable step_table() const;
  std::vector<Reading> readings() const;
  std::vector<double> history_row(const coupling::State& state);
  void add_history_row(const coupling::State& state);
  double heat_of_bodies(const coupling::State& state) const;
  void write_fields(const coupling::State& state);
  /// The solid fraction of what is cast, instead of that of all that can melt.
  void measure_internal_energy(coupling::StepEffort& effort, const coupling::State& state) const;
  void show_castings(coupling::StepEffort& effort, const coupling::State& state) const;
  void add_pools(const coupling::State& state);
  void add_stage(const coupling::StepRecord& record, const coupling::State& state);
  void note_left_walls(const coupling::StepRecord& record);
  void note_unsettled_augmentations(const coupling::StepRecord& record);
  /// Prints and writes the conclusion at the end of a run, or at its stop.
  /// @param mechanical  stresses and gaps are those of the state
  void conclude(const std::string& outcome, const coupling::State& state, bool mechanical);
  void write_summary_file(const std::string& outcome, const coupling::State& state);

  /// On process 0, but for profiles.
  struct Tables {
    std::optional<CsvTable> history, steps;
    std::vector<ProfileTable> profiles;
    std::optional<PoolTable> pools;       ///< where pools are followed
    std::optional<FeedingTable> feeding;  ///< where feeding is followed
    std::optional<ShotTable> shots;       ///< in a run with shots
    std::optional<StageTable> stages;     ///< in a run with stages
  };
  /// What the last row tells.
  struct Last {
    std::vector<double> row;
    LastStep step;
    int stage = 0, cycle = 0;               ///< as in StepRecord
    int shot = 0;                           ///< as in State
    double since_pouring = 0;               ///< [s]
    std::array<double, 2> largest_error{};  ///< Answers::step_error, of the run so far
  };
  struct Seconds {
    double heat = 0, mechanics = 0, output = 0, began = 0;
  };

  const RunFolder& folder_;
  const mesh::Mesh& mesh_;
  const coupling::Phases& phases_;
  RecorderOptions options_;
  int rank_ = 0;
  StateFields fields_;
  Probes probes_;
  GlobalHistory globals_;
  FieldOutput output_;
  CheckpointFolder checkpoints_;
  bool criteria_probed_ = false;      ///< a probe samples a field of a criterion
  std::optional<Progress> progress_;  // on process 0
  Tables tables_;
  Last last_;
  Seconds seconds_;
};

}  // namespace solidus::results
