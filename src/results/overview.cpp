/// One set of data, written as aligned text for the terminal and as JSON for summary.json.
#include "results/overview.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace solidus::results {

namespace {

double celsius(double kelvin) {
  return kelvin - k_zero_celsius;
}

/// "0.5", "12", "148.5", "1200": no exponent where a person would write none. The last bits of a sum, which
/// depend on the number of processes, do not decide between two roundings: 2875.5 is 2876 on one and on two.
std::string number(double value) {
  value *= 1 + 1e-12;
  const double size = std::abs(value);
  if (size != 0 && (size < 1e-3 || size >= 1e7)) return fmt::format("{:.2e}", value);
  if (size >= 1000) return fmt::format("{:.0f}", value);
  if (size >= 100) return fmt::format("{:.4g}", value);
  return fmt::format("{:.3g}", value);
}

/// With two digits: of an estimate.
double rounded(double value) {
  if (!(value > 0)) return value;
  const double digit = std::pow(10, std::floor(std::log10(value)) - 1);
  return digit * std::round(value / digit);
}

std::string range(double low, double high, const char* unit) {
  const std::string from = number(low), to = number(high);
  return from == to ? fmt::format("{} {}", from, unit) : fmt::format("{} to {} {}", from, to, unit);
}

std::string extents(const BodyOverview& body) {
  std::string text;
  for (std::size_t d = 0; d < 3; ++d) {
    const double size = body.high[d] - body.low[d];
    if (d == 2 && !(size > 0)) break;  // a mesh of two dimensions
    text += (d > 0 ? " x " : "") + number(1e3 * size);
  }
  return text + " mm";
}

std::string volume(double v, AnalysisKind kind) {
  return kind == AnalysisKind::plane_strain ? number(1e4 * v) + " cm2" : number(1e6 * v) + " cm3";
}
std::string mass(double m, AnalysisKind kind) {
  return number(m) + (kind == AnalysisKind::plane_strain ? " kg/m" : " kg");
}
std::string area(double a, AnalysisKind kind) {
  return kind == AnalysisKind::plane_strain ? number(1e2 * a) + " cm" : number(1e4 * a) + " cm2";
}

std::string duration(double seconds) {
  if (seconds < 120) return number(seconds) + " s";
  if (seconds < 7200) return number(seconds / 60) + " min";
  if (seconds < 172800) return number(seconds / 3600) + " h";
  return number(seconds / 86400) + " d";
}

/// Columns as wide as their widest entry, two blanks between them.
std::vector<std::string> aligned(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> width;
  for (const auto& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c) {
      if (width.size() <= c) width.push_back(0);
      width[c] = std::max(width[c], row[c].size());
    }
  std::vector<std::string> lines;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t c = 0; c < row.size(); ++c)
      line += c + 1 < row.size() ? fmt::format("{:<{}}  ", row[c], width[c]) : row[c];
    lines.push_back(line.substr(0, line.find_last_not_of(' ') + 1));
  }
  return lines;
}

std::string body_table(const Overview& o) {
  std::vector<std::vector<std::string>> rows;
  for (const BodyOverview& b : o.bodies) {
    std::vector<std::string> notes;
    if (b.only_conducts) notes.push_back("only conducts heat");
    if (!b.stages.empty()) notes.push_back(fmt::format("there in {}", fmt::join(b.stages, ", ")));
    rows.push_back({b.name, b.material, extents(b), volume(b.volume, o.kind), mass(b.mass, o.kind),
                    range(celsius(b.start_low), celsius(b.start_high), "degC"),
                    fmt::format("{} elements of {}", b.elements,
                                range(1e3 * b.shortest_edge, 1e3 * b.longest_edge, "mm")),
                    fmt::format("{}", fmt::join(notes, ", "))});
  }
  std::string text;
  for (const std::string& line : aligned(rows)) text += "\n  body        " + line;
  return text;
}

std::string skin_table(const Overview& o) {
  std::vector<std::vector<std::string>> rows;
  for (const SkinOverview& s : o.skins) {
    // Of a contact the gap and the part that has a partner, of a condition neither.
    std::string gap;
    if (s.least_gap && s.largest_gap) {
      const double largest = std::max(std::abs(*s.least_gap), std::abs(*s.largest_gap));
      gap = largest < 1e-8 ? "touches" : "gap " + range(1e3 * *s.least_gap, 1e3 * *s.largest_gap, "mm");
      if (largest >= 1e-8 && s.touches) gap += ", counts as touching";
    }
    // A surface that is faced in part is told with both areas.
    const bool part = s.paired < 0.999 * s.area;
    rows.push_back({s.name, s.surface + (s.body.empty() ? "" : " (" + s.body + ")"), s.faces,
                    area(s.area, o.kind) + (part ? ", faced " + area(s.paired, o.kind) : ""), gap, s.law});
  }
  std::string text;
  for (const std::string& line : aligned(rows)) text += "\n  skin        " + line;
  return text;
}

std::string gravity(const mesh::Point& g) {
  const double size = std::hypot(g[0], g[1], g[2]);
  std::string direction;
  for (std::size_t d = 0; d < 3; ++d)
    if (std::abs(g[d]) > 0.9999 * size) direction = fmt::format("{}{}", g[d] < 0 ? "-" : "+", "xyz"[d]);
  if (direction.empty())
    direction = fmt::format("({:.3g}, {:.3g}, {:.3g})", g[0] / size, g[1] / size, g[2] / size);
  return fmt::format("\n  gravity     {} m/s2 along {}", number(size), direction);
}

std::string pour_lines(const PourOverview& p) {
  std::string text =
      fmt::format("\n  poured      {}: at {:.0f} degC, {:.0f} K {} its liquidus of {:.0f} degC", p.body,
                  celsius(p.pouring), std::abs(p.pouring - p.liquidus),
                  p.pouring < p.liquidus ? "below" : "above", celsius(p.liquidus));
  // When it freezes and what governs that, then the numbers behind the estimate.
  if (!p.no_estimate.empty()) return text + "\n  freezes     " + p.body + ": no estimate, " + p.no_estimate;
  // A time with its rule, or that it never freezes.
  if (p.freezing_time)
    text += fmt::format(
        "\n  freezes     {}: in about {}, by Chvorinov {} s/mm2 x (V/A = {} mm{})^2; governed by {}", p.body,
        duration(rounded(*p.freezing_time)), number(1e-6 * p.chvorinov()), number(1e3 * p.freezing_modulus()),
        p.local_modulus > 0 ? " around its thickest place" : "", p.governed_by);
  else
    text += fmt::format("\n  freezes     {}: not at all", p.body);
  text += "\n  numbers     " + p.body;
  text += p.depth > 0 ? fmt::format(": {} mm from its skin to its centre, {} elements", number(1e3 * p.depth),
                                    number(p.elements_across))
                      : std::string(": no node below its skin, one element through its walls");
  // Numbers that describe the freezing, as far as the case has them.
  if (p.biot) text += fmt::format("; Biot {}", number(*p.biot));
  if (p.fourier) text += fmt::format(", Fourier {} at the end", number(*p.fourier));
  if (p.mould_reach > 0)
    text += fmt::format("; heat goes {} mm deep into the mould", number(1e3 * p.mould_reach));
  return text;
}

Json list(const mesh::Point& p) {
  return Json::Array{p[0], p[1], p[2]};
}

Json json(const PourOverview& p) {
  Json j;
  j.add("body", p.body)
      .add("pouring[K]", p.pouring)
      .add("liquidus[K]", p.liquidus)
      .add("solidus[K]", p.solidus)
      .add("modulus[m]", p.modulus)
      .add("local_modulus[m]", p.local_modulus)
      .add("depth[m]", p.depth);
  // Only what the estimate knows is written.
  if (p.biot) j.add("biot[1]", *p.biot);
  if (p.fourier) j.add("fourier[1]", *p.fourier);
  if (p.freezing_time)
    j.add("freezing_time[s]", *p.freezing_time)
        .add("chvorinov[s/m2]", p.chvorinov())
        .add("governed_by", p.governed_by);
  if (!p.no_estimate.empty()) j.add("no_estimate", p.no_estimate);
  return j;
}

std::string lag_line(double step, double end) {
  std::string text =
      "\n  lag         displacements and stresses belong to the temperatures a step before (mechanics_first)";
  if (step > 0 && end > 0)
    text += fmt::format(": {} of {}, {} % of what changes evenly", duration(step), duration(end),
                        number(100 * step / end));
  return text;
}

std::string heat_lag_line(double heat_lag, double steps) {
  return fmt::format(
      "\n  lag         temperatures are late by {} of a step, where deformation takes up heat: {} % of what "
      "changes evenly",
      number(heat_lag), number(100 * heat_lag / steps));
}

}  // namespace

std::string text(const Overview& o) {
  std::string text = body_table(o) + skin_table(o);
  if (o.gravity) text += gravity(*o.gravity);
  for (const PourOverview& pour : o.pours) text += pour_lines(pour);
  text +=
      fmt::format("\n  effort      {}{} steps, about {} and {:.2g} GB", o.effort.steps_known ? "" : "about ",
                  number(o.effort.steps_known ? o.effort.steps : rounded(o.effort.steps)),
                  duration(rounded(o.effort.seconds)), 1e-9 * o.effort.bytes);
  if (o.lag) text += lag_line(*o.lag, o.end);
  constexpr double k_worth_a_line = 1e-3;  // of what changes evenly
  if (o.heat_lag > k_worth_a_line * o.effort.steps) text += heat_lag_line(o.heat_lag, o.effort.steps);
  return text;
}

Json json(const Overview& o) {
  // What the case was understood to be, for summary.json and the report: bodies, skins of contact, what is
  // poured, and the effort that is expected. Lengths are in metres.
  Json::Array bodies, skins, pours;
  for (const BodyOverview& b : o.bodies) {
    Json j;
    j.add("name", b.name)
        .add("material", b.material)
        .add("low[m]", list(b.low))
        .add("high[m]", list(b.high))
        .add("volume[m3]", b.volume)
        .add("mass[kg]", b.mass)
        .add("skin[m2]", b.skin)
        .add("shortest_edge[m]", b.shortest_edge)
        .add("longest_edge[m]", b.longest_edge);
    bodies.push_back(std::move(j));
  }
  // Skins with the area that found a partner, and gaps where any did.
  for (const SkinOverview& s : o.skins) {
    Json j;
    j.add("name", s.name).add("surface", s.surface).add("faces", s.faces).add("area[m2]", s.area);
    j.add("paired[m2]", s.paired);
    if (s.least_gap && s.largest_gap)
      j.add("least_gap[m]", *s.least_gap).add("largest_gap[m]", *s.largest_gap);
    skins.push_back(std::move(j));
  }
  for (const PourOverview& p : o.pours) pours.push_back(json(p));
  // What the run is expected to cost.
  Json effort, all;
  effort.add("steps", o.effort.steps).add("seconds", o.effort.seconds).add("memory[bytes]", o.effort.bytes);
  all.add("bodies", std::move(bodies))
      .add("skins", std::move(skins))
      .add("poured", std::move(pours))
      .add("expected", std::move(effort));
  return all;
}

}  // namespace solidus::results
