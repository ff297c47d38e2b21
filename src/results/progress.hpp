/// Progress of a run on the terminal: one line a step, and a bar below it.
#pragma once

#include <functional>
#include <optional>
#include <ostream>
#include <string>

#include "coupling/observer.hpp"
#include "results/remaining_time.hpp"

namespace solidus::results {

/// "850 ms", "12 s", "3 min 05 s", "2 h 10 min".
std::string duration_text(double seconds);

struct ProgressOptions {
  double start = 0, end = 0;  ///< simulated time [s]
  bool until_solid = false;   ///< the run ends when all that was poured is solid, which may be before `end`
  bool heat = true, mechanics = true, contact = true, melting = true;  ///< which columns the run has
  double largest_step = 0;  ///< that an adaptive run may take [s]; 0 where steps are equal
  bool terminal = false;    ///< draw the bar, which rewrites its own line
  int width = 40;           ///< of the bar, in characters
  /// Seconds since some moment; empty: the machine's steady clock. Tests bring their own.
  std::function<double()> clock;
};

/// Writes to a stream the program hands over (the library itself never prints). One process uses it.
class Progress {
 public:
  Progress(std::ostream& out, ProgressOptions options);

  /// The header of the columns.
  /// @param heat_content  as of coupling::heat_content() [J]
  void begin(double heat_content = 0);
  void step(const coupling::StepRecord& record);
  /// A line on a shot that is over.
  void shot(const std::string& text) { line(text); }
  /// Removes the bar and says how it ended: "finished", "stopped: …", with the time it took.
  /// @param profile  lines that say where the time went (system/profile.hpp)
  void end(const std::string& outcome, const std::string& profile = {});

 private:
  void line(const std::string& text);
  void draw_bar(double share, const std::string& left);
  /// How much of the run is behind, 0 to 1: of its time, or of the solidification where that ends it.
  double share_done(const coupling::StepRecord& record);
  /// "12 s", or "-" where nothing is known yet.
  std::string left_text(const coupling::StepRecord& record, double share) const;

  std::ostream& out_;
  ProgressOptions options_;
  double began_ = 0;
  RemainingTime remaining_;
  std::string stage_;                     ///< of the last step
  std::optional<double> solid_at_start_;  ///< share that was solid where a run that goes on began
  bool bar_ = false;                      ///< a bar is on the present line
  coupling::EnergyAudit sum_;             ///< over all steps
  double heat_content_ = 0;               ///< at the start [J]
};

}  // namespace solidus::results
