/// The answers of a run as lines for people.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "coupling/all_fields.hpp"
#include "criteria/quantities.hpp"
#include "input/units.hpp"
#include "results/answers/answers.hpp"
#include "results/answers/tearing_text.hpp"

namespace solidus::results {

namespace {

/// Relative defect of the first law beyond which it is not reported as closed.
constexpr double k_closed = 1e-6;
/// A gap of so many times the largest distortion was not made by solid metal: the free end of a bar that is
/// held at the other one leaves its wall by twice the distortion, which is counted from its middle.
constexpr double k_sunk = 3;
/// Share of the largest distortion beyond which an overlap of two bodies is reported.
constexpr double k_overlap = 0.05;

/// A number with so many digits that count, without a power of ten where a person reads it more easily so:
/// 140, not 1.4e+02.
std::string digits(double value, int number) {
  constexpr double k_powers_from = 1e6;
  const double size = std::abs(value);
  if (size < std::pow(10.0, number) || size >= k_powers_from) return fmt::format("{:.{}g}", value, number);
  const double unit = std::pow(10.0, std::floor(std::log10(size)) + 1 - number);
  return fmt::format("{:.0f}", unit * std::round(value / unit));
}

/// A value with its error where it has one: "36.7 ± 1.6 s (step 0.4, mesh 1.2)".
/// @param factor  from SI to the unit shown
std::string with_error(double value, const std::optional<ErrorBand>& error, double factor,
                       const std::string& unit) {
  const std::string space = unit.empty() ? "" : " ";
  // A value of less than a thousandth of its error is printed as zero, for none of its digits is known.
  if (error && 1000 * std::abs(value) < error->total()) value = 0;
  if (!error || !(error->total() > 0)) return digits(value * factor, 4) + space + unit;
  return fmt::format("{} ± {}{}{} (step {}, mesh {})", digits(value * factor, 4),
                     digits(error->total() * factor, 2), space, unit, digits(error->step * factor, 2),
                     digits(error->mesh * factor, 2));
}

/// Values in the units that the user wants to read.
class Formatter {
 public:
  explicit Formatter(const DisplayUnits& units) : units_(units) {}

  std::string place(const mesh::Point& p) const {
    const auto shown = [this](double x) {
      return std::abs(x) < 1e-9 ? 0.0 : units::to_display(x, "m", units_.length);
    };
    return fmt::format("at ({:.4g}, {:.4g}, {:.4g}) {}", shown(p[0]), shown(p[1]), shown(p[2]),
                       units_.length);
  }
  std::string length(double metres) const {
    return fmt::format("{:.4g} {}", units::to_display(metres, "m", units_.length), units_.length);
  }
  std::string length(const ValueAt& metres) const {
    return with_error(metres.value, metres.error, units::to_display(1, "m", units_.length), units_.length);
  }
  std::string stress(const ValueAt& pascal) const {
    return with_error(pascal.value, pascal.error, units::to_display(1, "Pa", units_.stress), units_.stress);
  }
  std::string temperature(double kelvin) const {
    return fmt::format("{:.4g} {}", units::to_display(kelvin, "K", units_.temperature), units_.temperature);
  }
  /// Writes a change of temperature, given in kelvin.
  std::string change(double kelvin) const {
    constexpr auto k_difference = units::Temperature::difference;
    const std::string unit = units_.temperature == "degC" ? "K" : units_.temperature;
    return fmt::format("{:.3g} {}", units::to_display(kelvin, "K", unit, k_difference), unit);
  }
  std::string stress(double pascal) const {
    return fmt::format("{:.4g} {}", units::to_display(pascal, "Pa", units_.stress), units_.stress);
  }
  std::string mass(double kilograms) const {
    return kilograms < 1 ? fmt::format("{:.3g} g", 1e3 * kilograms) : fmt::format("{:.4g} kg", kilograms);
  }
  std::string volume(double cubic_metres) const {
    return units_.length == "mm"
               ? fmt::format("{:.4g} cm3", 1e6 * cubic_metres)
               : fmt::format("{:.4g} {}3",
                             cubic_metres * std::pow(units::to_display(1, "m", units_.length), 3),
                             units_.length);
  }

 private:
  const DisplayUnits& units_;
};

std::string line(std::string_view what, const std::string& answer) {
  return fmt::format("  {:<35} {}\n", what, answer);
}

std::string cast_text(const CastAnswer& answer, double time, const Formatter& format) {
  // A body that has left, or is solid, is told by when its last melt froze.
  if (!answer.there)
    return answer.froze ? fmt::format("has left; its last melt froze {} after pouring {}",
                                      with_error(answer.froze->value, answer.froze->error, 1, "s"),
                                      format.place(answer.froze->where))
                        : "has left";
  if (answer.solid_fraction == 1)
    return answer.froze ? fmt::format("solid; its last melt froze {} after pouring {}",
                                      with_error(answer.froze->value, answer.froze->error, 1, "s"),
                                      format.place(answer.froze->where))
                        : "solid";
  // A body that is not solid is never reported as "100 % solid".
  const double percent = std::min(100 * answer.solid_fraction, 99.9);
  std::string text = fmt::format("{:.1f} % solid {:.6g} s after pouring", percent, time);
  if (answer.hottest)
    text += fmt::format("; the melt is hottest, {}, {}", format.temperature(answer.hottest->value),
                        format.place(answer.hottest->where));
  return text;
}

/// The answers of a run of shots: casting and die from shot to shot.
std::string shot_lines(const std::vector<ShotRow>& shots, const Formatter& format) {
  // What is told of the first and of the last shot is told once where there is one shot only.
  if (shots.empty()) return "";
  const coupling::ShotRecord &first = shots.front().shot, &last = shots.back().shot;
  const auto both = [&](const std::string& of_first, const std::string& of_last) {
    return shots.size() == 1
               ? of_last
               : fmt::format("{} in shot {}, {} in shot {}", of_first, first.number, of_last, last.number);
  };
  const auto solid = [](const ShotRow& row) {
    return row.time_to_solidify ? fmt::format("{:.4g} s", *row.time_to_solidify)
                                : std::string("(not solid when it left)");
  };
  const std::string n = shots.size() == 1 ? "1 shot" : fmt::format("{} shots", shots.size());
  std::string text =
      line("the die is periodic",
           last.periodic ? fmt::format("after {}: within {} from shot to shot", n, format.change(last.change))
                         : fmt::format("not yet: after {} it changed by up to {} in the last", n,
                                       format.change(last.change)));
  // Casting first, then the die when a shot begins, in the mean and at its hottest place.
  text += line("time to solidify", both(solid(shots.front()), solid(shots.back())));
  text += line("die when a shot begins, mean",
               both(format.temperature(first.at_pour.mean), format.temperature(last.at_pour.mean)));
  text += line("die when a shot begins, hottest",
               both(format.temperature(first.at_pour.highest), format.temperature(last.at_pour.highest)));
  return text;
}

double error_of(const std::optional<ValueAt>& value) {
  return value && value->error ? value->error->total() : 0;
}

/// The verdict on a riser that froze so much later than the part [s]. The times of both come of one mesh and
/// one run and are wrong in the same sense: the larger of both errors is taken for that of their difference.
std::string margin_text(double later, double error) {
  const std::string band = error > 0 ? " ± " + digits(error, 2) : "";
  if (std::abs(later) < error)
    return fmt::format("froze {}{} s {} the part: too close to tell whether it fed to the end",
                       digits(std::abs(later), 4), band, later > 0 ? "after" : "before");
  return later > 0 ? fmt::format("outlived the part by {}{} s", digits(later, 4), band)
                   : fmt::format("froze {}{} s before the part: it could not feed to the end",
                                 digits(-later, 4), band);
}

/// Says of each riser whether it fed the castings to the end.
std::string riser_lines(const Answers& answers) {
  // The part counts as solid when all of its bodies are; its last melt and the error of that decide
  // the margin.
  bool part_solid = true, any_part = false;
  double part = 0, part_error = 0;
  for (const CastAnswer& a : answers.castings) {
    if (!a.cast.is_part() || (!a.there && !a.froze)) continue;
    any_part = true;
    part_solid = part_solid && a.froze;
    if (!a.froze) continue;
    part = std::max(part, a.froze->value);
    part_error = std::max(part_error, error_of(a.froze));
  }
  std::string text;
  for (const CastAnswer& riser : answers.castings) {
    if (!riser.cast.feeds || (!riser.there && !riser.froze) || !any_part) continue;
    // A riser that outlives the part has done its work; one that is solid first has not, which is
    // told plainly.
    std::string verdict;
    if (riser.froze && part_solid)
      verdict = margin_text(riser.froze->value - part, std::max(part_error, error_of(riser.froze)));
    else if (part_solid)
      verdict = "outlived the part";
    else if (riser.froze)
      verdict = "is solid while the part is not: it cannot feed any more";
    else
      verdict = "still has melt, as the part has";
    text += line(fmt::format("riser '{}'", riser.cast.name), verdict);
  }
  return text;
}

/// The reason of a gap that is wider than the solid metal can have made it; empty where it is not.
std::string sunk_text(double gap, const std::optional<ValueAt>& distortion) {
  if (!distortion || gap <= k_sunk * distortion->value) return "";
  return ", more than solid metal has deformed: the skin sank while it was soft";
}

std::string pools_text(const Answers::CutOffPools& pools, const Formatter& format) {
  if (pools.number == 0) return "none";
  return fmt::format(
      "{}; the largest had {} and {} {}", pools.number, format.volume(pools.largest),
      pools.frozen ? fmt::format("froze after {:.4g} s", *pools.frozen) : std::string("is still there"),
      format.place(pools.where));
}

/// The name of the finding that holds the worst value of a criterion.
std::string worst_of(const quantities::Quantity& field) {
  return field.worst == quantities::Extreme::least ? criteria::least_of(field) : criteria::largest_of(field);
}

/// A unit that every terminal can show: UDUNITS' form of it, a root in words.
std::string printed(const quantities::ShownUnit& shown) {
  std::string unit(shown.unit == "1" ? "" : shown.unit);
  constexpr std::string_view k_root = "K0.5 s0.5";
  if (unit.starts_with(k_root)) unit.replace(0, k_root.size(), "sqrt(K s)");
  return unit;
}

/// What a body is to the foundry.
std::string_view kind_of(const CastBody& cast) {
  return cast.feeds ? "riser" : cast.gates ? "gating" : "casting";
}

/// A volume in a body and its share of it; what is less than a millionth is rounding of the balance.
std::string volume_in(double volume, double whole, const Formatter& format) {
  constexpr double k_told = 1e-6;
  if (!(volume > k_told * whole)) return "none";
  return fmt::format("{}, {} %", format.volume(volume), digits(100 * volume / whole, 2));
}

/// How sound a body is, where several are cast: mass, holes, pores, least Niyama.
std::string soundness(const CastAnswer& cast, const Formatter& format) {
  std::string text = format.mass(cast.mass);
  if (const std::optional<Shrinkage>& lost = cast.shrinkage)
    text += fmt::format("; holes {}; pores {}", volume_in(lost->holes, lost->volume, format),
                        volume_in(lost->unfed + lost->of_gas, lost->volume, format));
  if (cast.least_niyama)
    text += fmt::format("; least Niyama {:.3g} sqrt(K s)/mm {}", 1e-3 * cast.least_niyama->value,
                        format.place(cast.least_niyama->where));
  if (cast.pores)
    text += fmt::format("; pores {}, {}, densest {:.3g} % {}", format.volume(cast.pores->volume),
                        with_error(cast.pores->share, cast.pores->error, 100, "%"),
                        100 * cast.pores->densest.value, format.place(cast.pores->densest.where));
  return text;
}

/// The least Niyama value of the parts; nothing where the castings do not tell it.
const ValueAt* least_niyama_of_parts(const Answers& answers) {
  const ValueAt* least = nullptr;
  for (const CastAnswer& cast : answers.castings)
    if (cast.cast.is_part() && cast.least_niyama &&
        (least == nullptr || cast.least_niyama->value < least->value))
      least = &*cast.least_niyama;
  return least;
}

std::string criteria_lines(const std::vector<criteria::CriterionResult>& found, const Answers& answers,
                           const Formatter& format) {
  std::string text;
  // Fields that have an answer, in the order of the fields.
  for (const quantities::Quantity* field : coupling::all_fields()) {
    if (field->answer.empty()) continue;
    // What the criterion has found, by the name of its extreme; without it no line is written.
    const std::string wanted = worst_of(*field);
    const bool low = field->worst == quantities::Extreme::least;
    const auto f = std::find_if(found.begin(), found.end(), [&](const criteria::CriterionResult& finding) {
      return finding.name == wanted;
    });
    if (f == found.end()) continue;
    // The error comes with the answers, by the same name.
    std::optional<ErrorBand> error;
    for (const auto& [name, of_finding] : answers.criteria_errors)
      if (name == wanted) error = of_finding;
    ValueAt value{f->value, f->where, error};
    // Where a runner freezes does not matter.
    if (const ValueAt* of_parts = least_niyama_of_parts(answers);
        of_parts && field == &criteria::fields::k_niyama)
      value = *of_parts;
    std::string answer = cut_tendency(*field, value.value);
    const bool cut = !answer.empty();
    if (!cut) answer = with_error(value.value, value.error, field->shown().factor, printed(field->shown()));
    // The value, with its error, and where it is, unless it is the same everywhere.
    const auto other =
        std::ranges::find(found, low ? criteria::largest_of(*field) : criteria::least_of(*field),
                          &criteria::CriterionResult::name);
    if (other != found.end() && other->value == f->value && field->threshold == std::nullopt)
      answer += " everywhere";
    else if (f->somewhere && !cut)
      answer += " " + format.place(value.where);
    // Where the field has a threshold the share beyond it comes first, for one value of the worst
    // spot says little.
    const auto share = std::ranges::find(found, criteria::beyond(*field), &criteria::CriterionResult::name);
    if (field->threshold && share != found.end())
      answer = fmt::format("{} {:g} in {} % of what was cast{}; {} {}", low ? "below" : "above",
                           *field->threshold * field->shown().factor, digits(100 * share->value, 3),
                           by_shrinkage(*field, found), low ? "least" : "largest", answer);
    text += line(field->answer, answer);
  }
  return text;
}

/// Pores of gas, and by how much the mould gave way to graphite.
std::string gas_lines(const std::vector<criteria::CriterionResult>& found, const Formatter& format) {
  // Results are looked up by name, since a run may have any of them.
  const auto result = [&](const std::string& name) {
    const auto f = std::ranges::find(found, name, &criteria::CriterionResult::name);
    return f == found.end() ? nullptr : &*f;
  };
  std::string text;
  const criteria::CriterionResult* room = result("gas_pores_room");
  // Gas is told even where no pore has opened: it stays in solution then.
  const criteria::CriterionResult* densest = result(criteria::largest_of(criteria::fields::k_gas_pores));
  if (room != nullptr && room->value > 0 && densest != nullptr) {
    const double volume = result("gas_pores_volume")->value;
    text += line("gas pores", volume > 0
                                  ? fmt::format("{}, {} % of what was cast; the densest, {:.3g} %, {}",
                                                format.volume(volume), digits(100 * volume / room->value, 3),
                                                100 * densest->value, format.place(densest->where))
                                  : std::string("none: the gas stays in solution"));
  }
  if (const criteria::CriterionResult* wall = result("feeding_wall"))
    text += line("mould gives way to graphite", format.volume(wall->value));
  return text;
}

/// Pipes, cavities, sinks and pores of feeding with heat alone.
std::string feeding_lines(const std::vector<criteria::CriterionResult>& found, const Answers& answers,
                          const Formatter& format) {
  const auto result = [&](const std::string& name) {
    const auto f = std::ranges::find(found, name, &criteria::CriterionResult::name);
    return f == found.end() ? nullptr : &*f;
  };
  const criteria::CriterionResult* room = result("feeding_room");
  if (room == nullptr || !(room->value > 0)) return "";
  // Volumes are told as shares too, because a share compares castings of different size.
  const auto share = [&](double volume) {
    return digits(100 * volume / room->value, 3) + " % of what was cast";
  };
  const auto body_of = [&](const std::string& hole) -> std::string {
    const auto body = std::ranges::find(answers.castings, static_cast<int>(result(hole + "_body")->value),
                                        [](const CastAnswer& a) { return a.cast.body; });
    return body == answers.castings.end() ? "casting" : body->cast.name;
  };
  // Holes are numbered by size; each gets a line with its place.
  const auto places = [&](const char* kind) {
    std::string lines;
    for (int k = 1; const criteria::CriterionResult* hole = result(fmt::format("{}_{}_volume", kind, k)); ++k)
      lines += line(fmt::format("{} in '{}'", kind, body_of(fmt::format("{}_{}", kind, k))),
                    fmt::format("{} {}", format.volume(hole->value), format.place(hole->where)));
    return lines;
  };
  // The lines begin with what is seen first when the casting is cut: pipes, cavities, sinks, swelling, pores.
  std::string text;
  for (int k = 1; const criteria::CriterionResult* pipe = result(fmt::format("pipe_{}_volume", k)); ++k) {
    const auto of_pipe = [&](const char* what) { return result(fmt::format("pipe_{}_{}", k, what))->value; };
    const std::string name = body_of(fmt::format("pipe_{}", k));
    text += line(fmt::format("pipe in '{}'", name),
                 fmt::format("{}, {} deep {}; {} of '{}' are left below it", format.volume(pipe->value),
                             format.length(of_pipe("depth")), format.place(pipe->where),
                             format.length(std::max(0.0, of_pipe("left"))), name));
  }
  // Closed cavities next, then what is seen only from outside or under a microscope.
  text += places("cavity");
  // What is less than a hundred-thousandth of the casting is rounding of the balance.
  constexpr double k_told = 1e-5;  // of what was cast
  if (const double sink = result("feeding_sink")->value; sink > k_told * room->value)
    text += line("sinks of the soft skin", fmt::format("{}, {}", format.volume(sink), share(sink))) +
            places("sink");
  if (const double swollen = -result("feeding_sink")->value - result("feeding_pipe")->value;
      swollen > k_told * room->value)
    text += line("melt that swells", fmt::format("{} more than its room, {}: it rises, or the mould yields",
                                                 format.volume(swollen), share(swollen)));
  if (const criteria::CriterionResult* densest = result("feeding_densest_pores")) {
    const double pores = result("feeding_pores")->value;
    text += line("pores that melt did not feed",
                 fmt::format("{}, {}; the densest, {:.3g} %, {}", format.volume(pores), share(pores),
                             100 * densest->value, format.place(densest->where)));
  }
  return text;
}

}  // namespace

std::string text(const Answers& a, const std::vector<criteria::CriterionResult>& criteria,
                 const DisplayUnits& units) {
  // The answers as the terminal shows them, line by line in a fixed order: shots, stages, castings, risers
  // and soundness, pools, criteria, pores, gaps, distortion, stress, and what says how far they are right.
  // Lines whose answer does not exist are left out.
  const Formatter format(units);
  std::string text = shot_lines(a.shots, format) + stage_lines(a.stages, units);
  for (const CastAnswer& cast : a.castings)
    text += line(fmt::format("{} '{}'", kind_of(cast.cast), cast.cast.name),
                 cast_text(cast, a.time - a.poured, format));
  text += riser_lines(a);
  if (a.castings.size() > 1)
    for (const CastAnswer& cast : a.castings)
      if (cast.there) text += line(fmt::format("soundness of '{}'", cast.cast.name), soundness(cast, format));
  if (const std::optional<double> share = poured_share_of_parts(a))
    text += line("yield", fmt::format("{:.3g} % of what is poured is part", 100 * *share));
  if (a.pools) text += line("pools of melt cut off", pools_text(*a.pools, format));
  // What was cast decides whether soundness is a question at all.
  if (!a.castings.empty())
    text += criteria_lines(criteria, a, format) + feeding_lines(criteria, a, format) +
            gas_lines(criteria, format);
  if (a.pores)
    text += line("shrinkage that nothing fed (pores)",
                 fmt::format("{} of the casting; the densest, {:.3g} %, {}",
                             with_error(a.pores->share, a.pores->error, 100, "%"),
                             100 * a.pores->densest.value, format.place(a.pores->densest.where)));
  for (const GapAnswer& gap : a.gaps)
    text += line(fmt::format("largest gap of '{}'", gap.contact),
                 fmt::format("{} {}{}", format.length(gap.gap), format.place(gap.gap.where),
                             sunk_text(gap.gap.value, a.distortion)));
  // An overlap that is small against the distortion says nothing to a user, and is left out.
  for (const GapAnswer& overlap : a.overlaps)
    if (a.distortion && overlap.gap.value > k_overlap * a.distortion->value)
      text += line(
          fmt::format("deepest overlap of '{}'", overlap.contact),
          fmt::format(
              "{} {}: the penalty lets metal shrink into its wall; stresses are too low where that is rigid",
              format.length(overlap.gap.value), format.place(overlap.gap.where)));
  // Mechanics' own answers, then the numbers by which the user judges the run.
  if (a.distortion)
    text += line("largest distortion",
                 fmt::format("{} {}", format.length(*a.distortion), format.place(a.distortion->where)));
  if (a.stress)
    text += line("largest von Mises stress", fmt::format("{} in '{}' {}", format.stress(*a.stress),
                                                         a.stressed_body, format.place(a.stress->where)));
  if (a.step_error)
    text += line("largest error of a fixed step",
                 fmt::format("some {} in the step to {:.4g} s (temperature_error in steps.csv)",
                             format.change((*a.step_error)[0]), (*a.step_error)[1]));
  if (a.energy_defect)
    text += line("energy", fmt::format("{} {:.1e} of the heat exchanged",
                                       std::abs(*a.energy_defect) < k_closed ? "closed to" : "not closed by",
                                       std::abs(*a.energy_defect)));
  return text;
}

}  // namespace solidus::results
