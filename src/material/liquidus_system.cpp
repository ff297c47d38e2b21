/// Reads a corner of a phase diagram and an alloy, finds the valley that the melt meets, and samples the
/// freezing path to straight lines within a tolerance.
#include "material/liquidus_system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <optional>

#include "input/document.hpp"

namespace solidus::material {
namespace {

namespace fs = std::filesystem;
using Solute = LiquidusSystem::Solute;

constexpr double k_least_melt = 1e-6;  ///< where no eutectic is met, the melt ends there

std::vector<std::string> names_of(const LiquidusSystem& system) {
  std::vector<std::string> names;
  for (const Solute& s : system.solutes) names.push_back(s.name);
  return names;
}

const Solute& solute(const LiquidusSystem& system, const std::string& name, const SourceLocation& where) {
  for (const Solute& s : system.solutes)
    if (s.name == name) return s;
  throw InputError(where, fmt::format("'{}' is no solute of {}", name, system.solvent),
                   one_of(names_of(system), name));
}

void check(const LiquidusSystem& system) {
  // A solute that lowers the liquidus is rejected by the solid and the reverse; a eutectic lies below the
  // melting point.
  for (const Solute& s : system.solutes)
    if (!(s.slope * (s.partition - 1) > 0))
      throw InputError(
          s.where, fmt::format("slope and partition of '{}' contradict each other", s.name),
          "a falling liquidus with a partition below 1, or a rising one with a partition above 1");
  for (const auto& eutectic : system.eutectics) {
    solute(system, eutectic.solute, eutectic.where);
    if (eutectic.temperature >= system.melting_point)
      throw InputError(eutectic.where, "the eutectic lies above the melting point of the solvent");
    for (const auto& other : eutectic.other)
      if (solute(system, other.name, other.where).partition >= 1)
        throw InputError(other.where,
                         fmt::format("'{}' has a partition above 1: the melt loses it", other.name),
                         "solutes with a partition below 1");
  }
  for (const auto& last : system.last)
    for (const std::string& name : last.solutes) solute(system, name, last.where);
}

/// The melt of an alloy as it freezes.
class Freezing {
 public:
  Freezing(const LiquidusSystem& system, const Composition& alloy, SolidificationRule rule)
      : system_(system), rule_(rule) {
    for (const auto& [name, percent] : alloy.solutes)
      if (percent > 0) alloy_.push_back({&solute(system, name, {}), percent});
    for (const auto& last : system.last)
      if (!last_ && std::all_of(last.solutes.begin(), last.solutes.end(),
                                [&](const std::string& name) { return holds(name); }))
        last_ = last.temperature;
    find_valley();
  }

  bool holds(const std::string& name) const {
    return std::any_of(alloy_.begin(), alloy_.end(),
                       [&](const Part& part) { return part.solute->name == name; });
  }
  /// The temperature of the liquidus of the primary solid [K] at the liquid fraction f.
  double primary(double f) const {
    double t = system_.melting_point;
    for (const Part& part : alloy_) t += part.solute->slope * concentration(part, f);
    return t;
  }
  /// The temperature of the valley [K] at the liquid fraction f, at most start().
  double valley(double f) const {
    double t = valley_->temperature;
    for (const auto& other : valley_->other)
      for (const Part& part : alloy_)
        if (part.solute->name == other.name) t += other.slope * concentration_in_valley(part, f);
    return t;
  }
  bool has_valley() const { return valley_ != nullptr; }
  bool valley_falls() const {
    return valley_ != nullptr &&
           std::any_of(valley_->other.begin(), valley_->other.end(), [&](const LiquidusSystem::Slope& other) {
             return other.slope < 0 && holds(other.name);
           });
  }
  const LiquidusSystem::Eutectic& eutectic() const { return *valley_; }
  /// The liquid fraction where the valley is met.
  double start() const { return start_; }
  std::optional<double> last() const { return last_; }

  /// The liquid fraction between `low` and `high` at which the temperature has fallen to t.
  static double root(const std::function<double(double)>& temperature, double t, double low, double high) {
    constexpr int k_halvings = 200;
    for (int i = 0; i < k_halvings && low < high; ++i) {
      const double middle = 0.5 * (low + high);
      if (middle <= low || middle >= high) break;
      (temperature(middle) <= t ? low : high) = middle;
    }
    return low;
  }

 private:
  struct Part {
    const Solute* solute;
    double percent;
  };

  double concentration(const Part& part, double f) const {
    const double k = part.solute->partition;
    return rule_ == SolidificationRule::scheil ? part.percent * std::pow(f, k - 1)
                                               : part.percent / (f + k * (1 - f));
  }
  double partition_in_valley(const Part& part) const {
    for (const auto& other : valley_->other)
      if (other.name == part.solute->name && other.partition > 0) return other.partition;
    return part.solute->partition;
  }
  /// Returns the concentration of a solute in the melt along the valley, where the share w of the metal that
  /// freezes is the primary solid and the second phase takes up no solute.
  double concentration_in_valley(const Part& part, double f) const {
    const double k = part.solute->partition, w = valley_->solvent_share;
    if (rule_ == SolidificationRule::scheil)
      return concentration(part, start_) * std::pow(f / start_, partition_in_valley(part) * w - 1);
    return part.percent / (f + k * (1 - start_ + w * (start_ - f)));
  }
  /// The valley that the melt meets first, and where.
  void find_valley() {
    // Each eutectic whose solute is there has a valley; the melt meets that with the largest liquid
    // fraction first.
    for (const auto& eutectic : system_.eutectics) {
      if (!holds(eutectic.solute)) continue;
      const auto excess = [&](double f) {  // of the primary liquidus over the valley
        double t = eutectic.temperature;
        for (const auto& other : eutectic.other)
          for (const Part& part : alloy_)
            if (part.solute->name == other.name) t += other.slope * concentration(part, f);
        return primary(f) - t;
      };
      // The primary liquidus lies above the valley at first; where it crosses, the second solid
      // appears.
      double at = 1.0;
      if (excess(1.0) > 0) {
        if (excess(k_least_melt) > 0) continue;  // never
        at = root(excess, 0.0, k_least_melt, 1.0);
      }
      if (valley_ == nullptr || at > start_) {
        valley_ = &eutectic;
        start_ = at;
      }
    }
  }

  const LiquidusSystem& system_;
  SolidificationRule rule_;
  std::vector<Part> alloy_;
  const LiquidusSystem::Eutectic* valley_ = nullptr;
  double start_ = 0;
  std::optional<double> last_;
};

/// Appends points of (T(f), 1 − f) from the liquid fraction a, whose point is there, to b < a.
void sample(const std::function<double(double)>& temperature, double a, double b, double tolerance, int depth,
            std::vector<std::pair<double, double>>& points) {
  // The curve is T over f, so that the chord is compared in f: its error in fraction is what the
  // tolerance bounds.
  const double ta = temperature(a), tb = temperature(b);
  bool fits = true;
  for (const double share : {0.25, 0.5, 0.75}) {
    const double f = a + share * (b - a);
    const double chord = ta > tb ? a + (b - a) * (ta - temperature(f)) / (ta - tb) : f;
    fits = fits && std::abs(chord - f) <= tolerance;
  }
  if (fits || depth == 0) {
    points.emplace_back(tb, 1 - b);
    return;
  }
  // Both halves from hot to cold.
  const double middle = 0.5 * (a + b);
  sample(temperature, a, middle, tolerance, depth - 1, points);
  sample(temperature, middle, b, tolerance, depth - 1, points);
}

void remark_on(const LiquidusSystem& system, const Composition& alloy, const Freezing& freezing,
               std::vector<std::string>& remarks) {
  // Alloys beyond the lines of a solute, and solutes that a eutectic does not know.
  for (const auto& [name, percent] : alloy.solutes) {
    const Solute& s = solute(system, name, {});
    if (percent > s.up_to)
      remarks.push_back(fmt::format("{} % {} lie beyond the line of {}, which is meant to {} %", percent,
                                    name, name, s.up_to));
    // Once two solids freeze together, solutes that the eutectic does not list play no part any
    // more.
    if (!freezing.has_valley() || name == freezing.eutectic().solute || percent <= 0) continue;
    const auto& other = freezing.eutectic().other;
    if (std::none_of(other.begin(), other.end(), [&, &n = name](const auto& o) { return o.name == n; }))
      remarks.push_back(fmt::format("{} is left out once {} freezes with its second phase", name,
                                    freezing.eutectic().solute));
  }
}

}  // namespace

LiquidusSystem load_liquidus_system(const fs::path& file) {
  LiquidusSystem system = liquidus_section().read(load_document(file));
  check(system);
  return system;
}

LiquidusSystem find_liquidus_system(const std::string& solvent, std::span<const fs::path> library) {
  std::vector<std::string> solvents;
  for (const fs::path& folder : library) {
    std::error_code unreadable;
    // Files in order of their names, so that the answer does not depend on the disk.
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder / "liquidus", unreadable))
      if (entry.path().extension() == ".toml") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const fs::path& file : files) {
      LiquidusSystem system = load_liquidus_system(file);
      if (system.solvent == solvent) return system;
      solvents.push_back(system.solvent);
    }
  }
  throw InputError({}, fmt::format("there is no liquidus of alloys of '{}'", solvent),
                   one_of(solvents, solvent) + ", or a file of your own with --system");
}

Composition parse_composition(const std::string& text) {
  // The text is read from left to right: solvent, then a number and a symbol for each solute.
  const std::string form = "the solvent, then weight per cent and symbol of each solute: Al-9Si-3Cu-0.3Mg";
  Composition alloy;
  std::size_t at = std::min(text.find('-'), text.size());
  alloy.solvent = text.substr(0, at);
  double sum = 0;
  const auto letters = [](const std::string& name) {
    return !name.empty() && name.size() <= 2 &&
           std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isalpha(c) != 0; });
  };
  if (!letters(alloy.solvent)) throw InputError({}, fmt::format("'{}' is no alloy", text), form);
  // Every part is checked by itself, so that the message can name it.
  while (at < text.size()) {
    const std::size_t next = std::min(text.find('-', at + 1), text.size());
    const std::string part = text.substr(at + 1, next - at - 1);
    double percent = 0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), percent);
    const std::string name(end, part.data() + part.size());
    if (error != std::errc{} || !letters(name) || !(percent >= 0) || percent > 100)
      throw InputError({}, fmt::format("'{}' in '{}' is no solute", part, text), form);
    for (const auto& [other, amount] : alloy.solutes)
      if (other == name) throw InputError({}, fmt::format("'{}' names {} twice", text, name), form);
    if (name == alloy.solvent)
      throw InputError({}, fmt::format("'{}' names its solvent as a solute", text), form);
    alloy.solutes.emplace_back(name, percent);
    sum += percent;
    at = next;
  }
  // An alloy needs a solute, and has to lie in the corner of its solvent, where the system's lines hold.
  if (alloy.solutes.empty() || !(sum > 0))
    throw InputError({}, fmt::format("'{}' has no solute, so that it freezes at one temperature", text),
                     form);
  if (sum >= 50)
    throw InputError({}, fmt::format("'{}' holds {} % of solutes: no corner of {}", text, sum, alloy.solvent),
                     form);
  return alloy;
}

SolidificationPath solidification_path(const LiquidusSystem& system, const Composition& alloy,
                                       SolidificationRule rule, double tolerance) {
  // The path is followed by the fraction f of melt from 1 down: first along the primary surface, then along
  // the valley of the eutectic, down to the last reaction.
  constexpr int k_depth = 20;
  const Freezing freezing(system, alloy, rule);
  const auto primary = [&](double f) { return freezing.primary(f); };
  const auto valley = [&](double f) { return freezing.valley(f); };
  SolidificationPath path;
  remark_on(system, alloy, freezing, path.remarks);
  path.liquidus = primary(1.0);
  if (freezing.has_valley() && freezing.start() == 1.0 && primary(1.0) < valley(1.0))
    throw InputError(
        {},
        fmt::format("the alloy lies beyond the eutectic of {} and {}: another phase freezes first",
                    system.solvent, freezing.eutectic().solute),
        fmt::format("alloys whose first solid is that of {}", system.solvent));
  // Points of the curve are placed where straight lines between them would be off by more than the tolerance.
  auto& points = path.points;  // falling temperature until the end
  points.emplace_back(path.liquidus, 0.0);

  const bool all_solid = rule == SolidificationRule::lever_rule;  // f = 0 has a temperature
  double end_of_primary = freezing.has_valley() ? freezing.start() : (all_solid ? 0.0 : k_least_melt);
  // The primary crystals end at the valley, at the last reaction, or with the melt; the lever rule goes on to
  // f = 0, Scheil's to a least rest of melt.
  bool at_last = false;
  if (freezing.last() && primary(end_of_primary) < *freezing.last() && path.liquidus > *freezing.last()) {
    end_of_primary = Freezing::root(primary, *freezing.last(), end_of_primary, 1.0);
    at_last = true;
  }
  if (end_of_primary < 1) sample(primary, 1.0, end_of_primary, tolerance, k_depth, points);
  path.primary_fraction = 1 - end_of_primary;
  path.primary_end = points.back().first;

  // Along the valley two phases freeze together until its end.
  if (!at_last && freezing.valley_falls() && freezing.start() > 0) {
    double end = all_solid ? 0.0 : k_least_melt;
    if (freezing.last() && valley(end) < *freezing.last() && valley(freezing.start()) > *freezing.last())
      end = Freezing::root(valley, *freezing.last(), end, freezing.start());
    sample(valley, freezing.start(), end, tolerance, k_depth, points);
  }
  // What is left freezes at one temperature.
  path.end = points.back().first;
  path.last_fraction = 1 - points.back().second;
  if (points.back().second < 1) points.emplace_back(path.end, 1.0);
  if (path.last_fraction < 1e-9) path.last_fraction = 0;
  std::reverse(points.begin(), points.end());
  return path;
}

}  // namespace solidus::material
