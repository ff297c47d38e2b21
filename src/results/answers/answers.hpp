/// Answers of a run to a foundry engineer's questions: is it solid, where was the last melt, did the riser
/// outlive the part, which pools were cut off, gaps, distortion, stress, and whether the energy balance is
/// closed. Printed at the end of a run, also of one that stops, and "answers" of summary.json.
///
/// Times count from pouring, in a run with shots from that of the last shot.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "coupling/phases.hpp"
#include "coupling/state.hpp"
#include "criteria/criterion.hpp"
#include "results/answers/shot_table.hpp"
#include "results/answers/stage_table.hpp"
#include "results/fields/field.hpp"
#include "results/output/display_units.hpp"
#include "results/output/json_document.hpp"

namespace solidus::results {

/// A body that is poured as melt. Everything else, a chill of the same iron included, is no casting.
struct CastBody {
  int body = 0;  ///< in Mesh::bodies
  std::string name;
  bool feeds = false;  ///< it is a riser: it should be the last to freeze
  bool gates = false;  ///< it is gating, which is cut off: it need not be sound
  bool is_part() const { return !feeds && !gates; }
};

/// The error of an answer, in its unit: it is expected within ± total() of the answer without steps and mesh.
struct ErrorBand {
  double step = 0, mesh = 0;
  /// What it comes from: the run itself (answer_errors.hpp), or further runs (run/error_runs.hpp).
  bool step_compared = false, mesh_compared = false;
  double total() const { return step + mesh; }
};

/// A value and where it is.
struct ValueAt {
  double value = 0;
  mesh::Point where{};  ///< of the nominal shape [m]
  std::optional<ErrorBand> error = {};
};

/// Shrinkage pores in mixed elements (mechanics/elements/pores.hpp).
struct Pores {
  double volume = 0;                    ///< of all [m³], in two dimensions per depth or radian
  double share = 0;                     ///< of the volume of what is looked at
  ValueAt densest;                      ///< the largest pore fraction
  std::optional<ErrorBand> error = {};  ///< of the share
};

/// Volumes that a body has lost by feeding with heat alone (criteria/feeding.hpp) [m³], in two dimensions per
/// depth or revolution.
struct Shrinkage {
  double volume = 0;             ///< of the body as poured
  double holes = 0;              ///< pipe, sinks and cavities
  double unfed = 0, of_gas = 0;  ///< pores that melt did not feed, and of gas
};

/// Progress of the freezing of a cast body, and how sound it is.
struct CastAnswer {
  CastBody cast;
  bool there = true;                         ///< false: it has left by now
  double solid_fraction = 0;                 ///< by volume
  double mass = 0;                           ///< [kg]; in plane strain of a metre of depth
  std::optional<ValueAt> least_niyama = {};  ///< [K^½ s^½/m]
  std::optional<Pores> pores = {};           ///< where any have opened
  std::optional<Shrinkage> shrinkage = {};   ///< where feeding is followed
  /// When and where its last melt froze [s since pouring]; also of one that left as a solid.
  std::optional<ValueAt> froze = {};
  std::optional<ValueAt> hottest = {};  ///< where it is not solid: temperature of the least solid node [K]
};

struct GapAnswer {
  std::string contact;
  ValueAt gap;  ///< the largest now [m]; of an overlap its depth
};

struct Answers {
  double time = 0;    ///< of the state [s]
  double poured = 0;  ///< when the castings were poured [s]
  std::vector<CastAnswer> castings;
  /// Pools that were closed off from what feeds them; absent where no pools are followed.
  struct CutOffPools {
    int number = 0;
    double largest = 0;            ///< volume [m³]
    mesh::Point where{};           ///< of the largest: its last melt
    std::optional<double> frozen;  ///< when that one froze [s]
  };
  std::optional<CutOffPools> pools;
  /// Of the parts, or where nothing but risers and gating is cast of these; absent where there are none.
  std::optional<Pores> pores;
  std::vector<GapAnswer> gaps;        ///< by contact, those that are open somewhere
  std::vector<GapAnswer> overlaps;    ///< by contact, those whose bodies overlap somewhere
  std::optional<ValueAt> distortion;  ///< of cast bodies, the largest [m]
  std::optional<ValueAt> stress;      ///< von Mises, the largest: of cast bodies, else of all [Pa]
  std::string stressed_body;
  std::vector<ShotRow> shots;  ///< those that are over; known to the process that writes
  StageAnswers stages;         ///< known to the same process
  /// Of a run with fixed steps: the largest error of temperature that a step is estimated to have made [K],
  /// and the time of its end [s].
  std::optional<std::array<double, 2>> step_error;
  std::optional<double> energy_defect;  ///< relative, as relative_energy_defect of the summary
  /// Errors of findings of criteria, by their names.
  std::vector<std::pair<std::string, ErrorBand>> criteria_errors;
};

/// Collective; the same on every process.
/// @param fields      of the bodies, those of criteria up to date
/// @param mechanical  whether fields of deformation are those of the state
Answers answers(const mesh::Mesh& mesh, const coupling::Phases& phases, const coupling::State& state,
                const std::vector<CastBody>& castings, const FieldSet& fields, bool mechanical);

/// The solid fraction of all castings, by volume; 1 where nothing of it is there. Collective.
double solid_fraction(const coupling::Phases& phases, const coupling::State& state,
                      const std::vector<CastBody>& castings, const mesh::Mesh& mesh);

/// The yield: the mass of the parts over that of all that is poured; nothing where there is no riser and no
/// gating, or no part, or a body has left.
std::optional<double> poured_share_of_parts(const Answers& answers);

/// Lines for people, times in s since pouring.
/// @param criteria  what the criteria found, for the lines on solidification times, arm spacing and Niyama
std::string text(const Answers& answers, const std::vector<criteria::CriterionResult>& criteria,
                 const DisplayUnits& units = {});
/// For summary.json, SI.
Json json(const Answers& answers);

}  // namespace solidus::results
