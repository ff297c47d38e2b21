/// Profile of the wall time of this process by parts of the program: every moment counts for the innermost
/// part that is running, so the parts add up to the whole.
///
///   const profile::Part part("solve");    // until the end of the block, within the parts around it
///
/// One table a process, as there is one log; for the thread that starts phases and solvers.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace solidus::profile {

/// Time from here to the end of the scope belongs to this part. A part has another row for each part around
/// it: "heat: solve" and "mechanics: solve".
class Part {
 public:
  /// @param name  lives as long as the program
  explicit Part(const char* name);
  ~Part();
  Part(const Part&) = delete;
  Part& operator=(const Part&) = delete;
};

/// Starts again from zero; nothing but the caller's own parts may be running.
void begin();
/// A row for each part in the order of their first time, with its time less that of the parts within it, and
/// "other" for what no part has taken [s]. The running parts count up to now. The rows add up to total().
std::vector<std::pair<std::string, double>> rows();
/// Since begin(), or since the first use [s].
double total();

/// A few lines for people: the rows that take more than half a per cent, the longest first, the rest in one.
std::string text();

}  // namespace solidus::profile
