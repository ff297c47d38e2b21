/// The derivatives of probed temperatures and displacements with respect to parameters, as the run goes:
/// sensitivities.csv.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "coupling/step_sensitivity.hpp"
#include "results/output/csv.hpp"
#include "run/neighbours.hpp"
#include "setup/assembly.hpp"

namespace solidus::run {

class Sensitivities : public coupling::Observer {
 public:
  /// @param base, a   the run, built; must outlive this object
  /// @param file      sensitivities.csv
  /// Of bodies that deform the base is built once more, as its own neighbour with no change: what takes the
  /// steps again must not touch the phases of the run.
  /// Throws InputError for a case without derivatives (steps by their errors, stages, several processes, what
  /// coupling::StepSensitivity names), without a probe of the temperature, or a parameter that changes the
  /// mesh.
  Sensitivities(const setup::Case& base, const setup::Assembly& a, std::vector<Neighbour> neighbours,
                const std::filesystem::path& file);
  ~Sensitivities() override;

  void begin(const coupling::State& state) override;
  void step(const coupling::StepRecord& record, const coupling::State& state) override;
  void stopped(const coupling::Stop&, const coupling::State&) override {}
  void end(const coupling::State&) override {}

 private:
  struct Built;   ///< a neighbour
  struct Reader;  ///< the probes of a case
  void add_row(const coupling::State& state);

  std::unique_ptr<Built> twin_;  ///< of the run, where bodies deform
  std::vector<std::unique_ptr<Built>> built_;
  std::unique_ptr<Reader> reader_;  ///< of the run
  std::optional<coupling::StepSensitivity> steps_;
  std::optional<results::CsvTable> table_;
};

}  // namespace solidus::run
