/// One line for a step, and a bar whose length is the share that is done.
#include "results/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "coupling/energy_scale.hpp"
#include "numbers/index_casts.hpp"
#include "system/terminal.hpp"

namespace solidus::results {

/// Two units at most, as long as people read them.
std::string duration_text(double seconds) {
  if (seconds < 1) return fmt::format("{:.0f} ms", 1000 * std::max(seconds, 0.0));
  if (seconds < 10) return fmt::format("{:.1f} s", seconds);
  const auto whole = static_cast<long long>(std::llround(seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

Progress::Progress(std::ostream& out, ProgressOptions options)
    : out_(out), options_(std::move(options)), remaining_(options_.start, options_.largest_step) {
  if (!options_.clock)
    options_.clock = [] {
      return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
    };
}

void Progress::begin(double heat_content) {
  heat_content_ = heat_content;
  began_ = options_.clock();
  remaining_.step(options_.start, began_);
  std::string head = fmt::format("{:>6} {:>11} {:>9}", "step", "time [s]", "dt [s]");
  if (options_.heat) head += fmt::format(" {:>4} {:>8}", "heat", "residual");
  if (options_.mechanics) head += fmt::format(" {:>4} {:>8}", "mech", "residual");
  if (options_.melting) head += fmt::format(" {:>7}", "solid");
  if (options_.contact) head += fmt::format(" {:>11}", "contact");
  if (options_.heat) head += fmt::format(" {:>8}", "defect");
  line(head + fmt::format(" {:>12}  {}", "left", "why this step"));
}

/// The fraction of the run that is done: of its time, or of the melt that was there at the start where the
/// run ends with it, whichever is more.
double Progress::share_done(const coupling::StepRecord& record) {
  const double span = options_.end - options_.start;
  const double of_time = span > 0 ? std::clamp((record.time - options_.start) / span, 0.0, 1.0) : 1.0;
  if (!options_.until_solid) return of_time;
  if (!solid_at_start_) solid_at_start_ = options_.start > 0 ? record.solid_fraction : 0;
  const double liquid_at_start = 1 - *solid_at_start_;
  const double of_melt =
      liquid_at_start > 0 ? (record.solid_fraction - *solid_at_start_) / liquid_at_start : 1.0;
  return std::clamp(of_melt, of_time, 1.0);
}

/// An estimate of the computing time that is left, from the last steps.
std::string Progress::left_text(const coupling::StepRecord& record, double share) const {
  const double done = record.time - options_.start;
  const double end = share > 0 ? options_.start + done / share : options_.end;
  double seconds = remaining_.seconds_until(end);
  // The steps of a die begin again with every shot: those of the whole run tell more than the last ones.
  if (record.cycle > 0 && share > 0) seconds = (options_.clock() - began_) * (1 - share) / share;
  return seconds < 0 ? "-" : duration_text(seconds);
}

void Progress::step(const coupling::StepRecord& record) {
  // One line for a step, in the columns of the head: number, time and size, iterations and residuals, solid
  // part, closed points, defect of the first law over the run so far, and the time that is left.
  sum_ += record.energy;
  std::string text = fmt::format("{:>6} {:>11.6g} {:>9.4g}", record.number, record.time, record.dt);
  const auto phase = [&](const coupling::PhaseEffort& effort) {
    text += fmt::format(" {:>4} {:>8.1e}", effort.iterations, effort.residual);
  };
  if (options_.heat) phase(record.heat);
  if (options_.mechanics) phase(record.mechanics);
  if (options_.melting) text += fmt::format(" {:>5.1f} %", 100 * record.solid_fraction);
  if (options_.contact) {
    int closed = 0, points = 0;
    for (const auto& contact : record.contacts) closed += contact.closed_points, points += contact.points;
    text += fmt::format(" {:>11}", fmt::format("{}/{}", closed, points));
  }
  if (options_.heat)  // of all steps together
    text += fmt::format(" {:>8.1e}", coupling::relative_defect(sum_, heat_content_));
  // Steps of another stage take another time, so the estimate begins again.
  if (record.stage != stage_) remaining_.begin_anew();
  stage_ = record.stage;
  remaining_.step(record.time, options_.clock());
  const double share = share_done(record);
  const std::string left = left_text(record, share);
  text += fmt::format(" {:>12}  {}", left, record.reason);
  if (!record.stage.empty()) text += ", " + record.stage;
  if (record.cycle > 0) text += fmt::format(" {}", record.cycle);
  // Tries in vain are told with the reason of the last one.
  if (record.rejected + record.shortened > 0) {
    std::string tries;
    if (record.rejected > 0) tries = fmt::format("{} rejected", record.rejected);
    if (record.shortened > 0)
      tries += fmt::format("{}{} shortened", tries.empty() ? "" : ", ", record.shortened);
    text += fmt::format(" ({}: {})", tries, record.rejection);
  }
  line(text);
  if (options_.terminal) draw_bar(share, left);
}

void Progress::end(const std::string& outcome, const std::string& profile) {
  const Colour colour = outcome == "finished" ? Colour::green : Colour::red;
  const std::string text = painted(outcome, colour, options_.terminal && has_colours(STDOUT_FILENO));
  line(fmt::format("{} after {}", text, duration_text(options_.clock() - began_)));
  out_ << profile << std::flush;
}

/// Removes the bar, which is the last line on a terminal, and writes below what is there.
void Progress::line(const std::string& text) {
  if (bar_) out_ << "\r\033[K";
  bar_ = false;
  out_ << text << '\n' << std::flush;
}

void Progress::draw_bar(double share, const std::string& left) {
  const auto full = static_cast<std::size_t>(std::lround(share * options_.width));
  const auto rest = as_size(options_.width) - full;
  out_ << fmt::format("[{}{}] {:3.0f} %  {} left", std::string(full, '='), std::string(rest, ' '),
                      100 * share, left)
       << std::flush;
  bar_ = true;
}

}  // namespace solidus::results
