#include "material/cards/card_import.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "material/cards/heat_in_capacity.hpp"
#include "material/cards/import_columns.hpp"

namespace solidus::material {
namespace {

using Points = std::vector<std::pair<double, double>>;

/// The rows of the freezing range: from the hottest that is all solid to the coldest that is all melt.
struct Range {
  std::size_t solidus, liquidus;
  bool closed_below = false, closed_above = false;  ///< the first or last interval is none of the table's
  bool added(std::size_t i) const {
    return (closed_below && i == solidus) || (closed_above && i + 1 == liquidus);
  }
};

/// Completes the ends of a curve: a Scheil calculation stops at a few per mille of melt.
Range freezing_range(ImportColumns& c, std::vector<std::string>& remarks) {
  constexpr double k_most_melt = 0.1, k_most_solid = 0.05;
  const auto repeat = [&](std::size_t row, double fraction) {  // the same row again with another fraction
    const auto at = static_cast<std::ptrdiff_t>(row);
    c.temperature.insert(c.temperature.begin() + at, c.temperature[row]);
    c.lines.insert(c.lines.begin() + at, c.lines[row]);
    for (auto& [name, values] : c.values) {
      const double value = name == "solid_fraction" ? fraction : values[row];
      values.insert(values.begin() + at, value);
    }
  };
  Range range{0, 0};
  auto& f = c.values["solid_fraction"];
  if (f.front() < 1) {
    range.closed_below = true;
    if (f.front() < 1 - k_most_melt)
      throw InputError(
          c.place(0),
          fmt::format("the coldest row, {:.6g} K, is {:.1f} % melt", c.temperature[0], 100 * (1 - f.front())),
          "a table down to the end of freezing, or to the last 10 % of melt");
    remarks.push_back(fmt::format("the last {:.3g} % of melt freeze at the coldest temperature, {:.6g} K",
                                  100 * (1 - f.front()), c.temperature[0]));
    repeat(0, 1.0);
  }
  if (f.back() > 0) {
    range.closed_above = true;
    const std::size_t last = f.size() - 1;
    if (f.back() > k_most_solid)
      throw InputError(
          c.place(last),
          fmt::format("the hottest row, {:.6g} K, is {:.1f} % solid", c.temperature[last], 100 * f.back()),
          "a table that begins in the melt");
    remarks.push_back(fmt::format("the first {:.3g} % of solid form at the hottest temperature, {:.6g} K",
                                  100 * f.back(), c.temperature[last]));
    repeat(last, f.back());
    f.back() = 0;
  }
  for (std::size_t i = 0; i < f.size(); ++i)
    if (f[i] == 1) range.solidus = i;
  range.liquidus = static_cast<std::size_t>(std::find(f.begin(), f.end(), 0.0) - f.begin());
  return range;
}

/// ΔH/ΔT of the rows i and i + 1.
double slope(const ImportColumns& c, std::size_t i) {
  return (c.of("enthalpy")[i + 1] - c.of("enthalpy")[i]) / (c.temperature[i + 1] - c.temperature[i]);
}

/// Outside the freezing range a temperature has one enthalpy.
void refuse_jumps(const ImportColumns& c, const Range& range) {
  for (std::size_t i = 0; i + 1 < c.temperature.size(); ++i) {
    const bool freezes = i >= range.solidus && i < range.liquidus;
    if (!freezes && c.temperature[i] == c.temperature[i + 1])
      throw InputError(c.place(i + 1),
                       fmt::format("the enthalpy jumps at {:.6g} K, where nothing freezes", c.temperature[i]),
                       "isothermal rows within the freezing range only");
  }
}

/// The specific heat at a row from the intervals next to it, of [first, last): their mean, and at most one
/// and a half times the smaller, so that the middle of an interval stays above zero.
double nodal_heat(const ImportColumns& c, std::size_t row, std::size_t first, std::size_t last) {
  if (row == first) return slope(c, row);
  if (row == last) return slope(c, row - 1);
  const double before = slope(c, row - 1), behind = slope(c, row);
  return std::min(0.5 * (before + behind), 1.5 * std::min(before, behind));
}

/// Points of the specific heat on the rows [first, last]: lines whose integral over each interval is its ΔH.
/// @param beside  the value at the row `melting`, the end next to the freezing range
void add_sensible(const ImportColumns& c, std::size_t first, std::size_t last, std::size_t melting,
                  double beside, Points& points) {
  const auto at = [&](std::size_t i) { return i == melting ? beside : nodal_heat(c, i, first, last); };
  for (std::size_t i = first; i <= last; ++i) {
    const double here = at(i);
    if (points.empty() || points.back().first < c.temperature[i]) points.emplace_back(c.temperature[i], here);
    if (i == last) return;
    const double next = at(i + 1);
    points.emplace_back(0.5 * (c.temperature[i] + c.temperature[i + 1]),
                        2 * slope(c, i) - 0.5 * (here + next));
  }
}

struct FreezingHeat {
  Points specific_heat;            ///< at the rows between solidus and liquidus
  double latent_heat = 0;          ///< of the solid fraction [J/kg]
  double rest = 0;                 ///< the heat that is left [J/kg]
  std::vector<double> rest_share;  ///< its part still to be absorbed on heating, by row from the solidus on
};

/// Splits the heat of the freezing range. The specific heat is a line from c_s to c_l, lowered where the
/// table's heat is below it; false where it is too much even so.
bool split(const ImportColumns& c, const Range& range, double c_s, double c_l, double lowered,
           FreezingHeat& out) {
  const auto& t = c.temperature;
  const auto& h = c.of("enthalpy");
  const auto& f = c.of("solid_fraction");
  const double width = t[range.liquidus] - t[range.solidus];
  const auto heat = [&](std::size_t i) {
    if (i == range.solidus || t[i] == t[range.solidus]) return c_s;
    if (i == range.liquidus || t[i] == t[range.liquidus]) return c_l;
    return lowered * std::lerp(c_s, c_l, (t[i] - t[range.solidus]) / width);
  };
  out = {};
  double latent = std::numeric_limits<double>::infinity();
  std::vector<double> excess;
  for (std::size_t i = range.solidus; i < range.liquidus; ++i) {
    const double more = h[i + 1] - h[i] - 0.5 * (heat(i) + heat(i + 1)) * (t[i + 1] - t[i]);
    if (more < 0) return false;
    excess.push_back(more);
    if (f[i] > f[i + 1] && !range.added(i)) latent = std::min(latent, more / (f[i] - f[i + 1]));
  }
  out.latent_heat = latent;
  for (std::size_t i = range.solidus; i < range.liquidus; ++i) {
    double& more = excess[i - range.solidus];
    more = std::max(0.0, more - latent * (f[i] - f[i + 1]));
    out.rest += more;
    if (i > range.solidus && t[i] > t[range.solidus] && t[i] < t[range.liquidus] &&
        (out.specific_heat.empty() || out.specific_heat.back().first < t[i]))
      out.specific_heat.emplace_back(t[i], heat(i));
  }
  double left = out.rest;
  for (const double more : excess) {
    out.rest_share.push_back(out.rest > 0 ? left / out.rest : 0.0);
    left -= more;
  }
  if (!out.rest_share.empty()) out.rest_share.front() = 1;
  out.rest_share.push_back(0);
  for (std::size_t i = 1; i < out.rest_share.size(); ++i)
    out.rest_share[i] = std::clamp(out.rest_share[i], 0.0, out.rest_share[i - 1]);
  return true;
}

Value pair_list(const Points& points) {
  Value list = Value::list();
  for (const auto& [x, y] : points) list.items().push_back(Value::list({Value(x), Value(y)}));
  return list;
}

std::string kelvin(double temperature) {
  return fmt::format("{} K", temperature);
}

Value function(const char* unit, const Points& points, const std::string& source) {
  Value value;
  const auto least = std::min_element(points.begin(), points.end()),
             most = std::max_element(points.begin(), points.end());
  value.set("argument_unit", Value("K"));
  value.set("unit", Value(unit));
  value.set("points", pair_list(points));
  value.set("source", Value(source));
  value.set("valid", Value::list({Value(kelvin(least->first)), Value(kelvin(most->first))}));
  return value;
}

Value constant(double number, const char* unit, const std::string& source) {
  Value value;
  value.set("value", Value(fmt::format("{} {}", number, unit)));
  value.set("source", Value(source));
  return value;
}

/// A column as a function of temperature: one value where rows share a temperature, the colder one.
Points points_of(const ImportColumns& c, const std::string& quantity) {
  Points points;
  for (std::size_t i = 0; i < c.temperature.size(); ++i)
    if (points.empty() || points.back().first < c.temperature[i])
      points.emplace_back(c.temperature[i], c.of(quantity)[i]);
  return points;
}

Value phase_change(const std::string& name, bool solidification, double latent_heat, double volume_change,
                   const Points& fraction, const std::string& source) {
  Value value, curve, temperatures = Value::list(), fractions = Value::list();
  for (const auto& [t, f] : fraction) {
    temperatures.items().emplace_back(kelvin(t));
    fractions.items().emplace_back(f);
  }
  value.set("name", Value(name));
  if (solidification) value.set("solidification", Value(true));
  value.set("latent_heat", Value(fmt::format("{} J/kg", latent_heat)));
  value.set("volume_change", Value(volume_change));
  value.set("source", Value(source));
  curve.set("kind", Value("table"));
  curve.set("temperatures", std::move(temperatures));
  curve.set("fractions", std::move(fractions));
  value.set("fraction", std::move(curve));
  return value;
}

/// The rows from the solidus to the liquidus with one value each, from 1 to 0.
Points fraction_points(const ImportColumns& c, const Range& range, const std::vector<double>& values,
                       std::size_t first) {
  Points points;
  for (std::size_t i = range.solidus; i <= range.liquidus; ++i)
    points.emplace_back(c.temperature[i], values[i - first]);
  return points;
}

/// (ρ of the melt)/(ρ of the solid) − 1 at the ends of the range, less the thermal part that the card's
/// expansion has.
std::optional<double> volume_change_of(const ImportColumns& c, const Range& range, const Points& expansion) {
  if (!c.has("density")) return std::nullopt;
  const auto& rho = c.of("density");
  double thermal = 0;
  if (!expansion.empty())
    thermal = 3 * expansion.back().second * (c.temperature[range.liquidus] - c.temperature[range.solidus]);
  return rho[range.liquidus] / rho[range.solidus] - 1 + thermal;
}

/// The mean coefficient of expansion by the densities of the solid, from the coldest row on.
Points expansion_of(const ImportColumns& c, const Range& range) {
  Points points;
  const auto& rho = c.of("density");
  for (std::size_t i = 1; i <= range.solidus; ++i) {
    const double rise = c.temperature[i] - c.temperature[0];
    if (rise > 0 && (points.empty() || points.back().first < c.temperature[i]))
      points.emplace_back(c.temperature[i], (std::cbrt(rho[0] / rho[i]) - 1) / rise);
  }
  return points;
}

class Importer {
 public:
  Importer(ImportColumns columns, const ImportOptions& options, const Material* base)
      : c_(std::move(columns)), options_(options), base_(base), range_(freezing_range(c_, card_.remarks)) {}

  ImportedCard card() {
    note_columns();
    if (!c_.has("enthalpy") && c_.has("specific_heat"))
      if (const std::string said =
              take_heat_once(c_, range_.solidus, range_.liquidus, options_.latent_heat.has_value());
          !said.empty())
        card_.remarks.push_back(said);
    Value& document = card_.document;
    document.set("title", Value(options_.title.empty() ? "Imported from " + file_name() : options_.title));
    if (!options_.like.empty()) document.set("like", Value(options_.like));
    if (base_ != nullptr)
      for (const PhaseChange& change : base_->phase_changes)
        if (!change.solidification)
          card_.remarks.push_back(fmt::format("'{}' of {} is not taken over", change.name, base_->name));
    if (c_.has("density"))
      document.set("density", constant(c_.of("density")[0], "kg/m3",
                                       source("density") + fmt::format(", at {:.6g} K", c_.temperature[0])));
    if (c_.has("conductivity"))
      document.set("conductivity", function("W/m/K", points_of(c_, "conductivity"), source("conductivity")));
    Value changes = Value::list();
    if (c_.has("enthalpy"))
      add_heat_by_enthalpy(changes);
    else
      add_heat_by_capacity(changes);
    add_elastic();
    document.set("phase_change", std::move(changes));
    check_complete();
    return std::move(card_);
  }

 private:
  void note_columns() {
    std::string unused;
    for (const std::string& header : c_.unused) unused += (unused.empty() ? "'" : ", '") + header + "'";
    if (c_.has("enthalpy") && c_.has("specific_heat"))
      unused += (unused.empty() ? "'" : ", '") + c_.headers["specific_heat"] + "' (the enthalpy tells it)";
    if (!unused.empty())
      card_.remarks.push_back("columns that are not used: " + unused +
                              "; --column QUANTITY=HEADER names one");
  }

  std::string file_name() const { return std::filesystem::path(c_.file).filename().string(); }

  std::string source(const std::string& quantity) const {
    const auto header = c_.headers.find(quantity);
    return (options_.source.empty() ? file_name() : options_.source) +
           (header == c_.headers.end() ? "" : ", column '" + header->second + "'");
  }

  void add_heat_by_enthalpy(Value& changes) {
    // The table of the enthalpy is split into sensible heat outside the freezing range and the heat of
    // freezing within. Jumps outside of the range could be neither.
    refuse_jumps(c_, range_);
    const std::size_t last = c_.temperature.size() - 1;
    const bool solid = range_.solidus > 0, melt = range_.liquidus < last;
    if (!solid && !melt)
      throw InputError(c_.place(0),
                       "the table has no row of the solid alone or of the melt alone, so that its "
                       "enthalpy does not tell the specific heat",
                       "a table that begins in the melt or goes on below the solidus");
    double c_s = solid ? slope(c_, range_.solidus - 1) : slope(c_, range_.liquidus);
    double c_l = melt ? slope(c_, range_.liquidus) : c_s;
    if (c_.temperature[range_.solidus] == c_.temperature[range_.liquidus])  // a curve without a jump
      c_s = c_l = std::min(0.5 * (c_s + c_l), 1.5 * std::min(c_s, c_l));
    FreezingHeat heat;
    double lowered = 1;
    constexpr double k_least = 1e-3;
    while (!split(c_, range_, c_s, c_l, lowered, heat) && lowered > k_least) lowered *= 0.7;
    if (lowered <= k_least)
      throw InputError(
          c_.place(range_.solidus),
          fmt::format("between {:.6g} and {:.6g} K the enthalpy rises by less than the specific heat of "
                      "the solid and the melt next to it",
                      c_.temperature[range_.solidus], c_.temperature[range_.liquidus]),
          "an enthalpy with the heat of freezing");
    Points points;
    if (solid)
      add_sensible(c_, 0, range_.solidus, range_.solidus, c_s, points);
    else
      points.emplace_back(c_.temperature[0], c_s);
    for (const auto& point : heat.specific_heat) points.push_back(point);
    if (melt) {
      Points hot;
      add_sensible(c_, range_.liquidus, last, range_.liquidus, c_l, hot);
      for (const auto& point : hot)
        if (points.back().first < point.first) points.push_back(point);
    } else if (points.back().first < c_.temperature[last]) {
      points.emplace_back(c_.temperature[last], c_l);
    }
    // It goes into the card with its source; the latent heat is that of the solid fraction, and what it does
    // not explain becomes a phase change of its own with the same points.
    card_.document.set("specific_heat",
                       function("J/kg/K", points, source("enthalpy") + ", without the heat of freezing"));
    changes.items().push_back(solidification(heat.latent_heat, source("enthalpy")));
    constexpr double k_nothing = 1e-9;  // [J/kg]
    if (heat.rest > k_nothing)
      changes.items().push_back(
          phase_change("heat of freezing in addition to the solid fraction", false, heat.rest, 0,
                       fraction_points(c_, range_, heat.rest_share, range_.solidus),
                       source("enthalpy") + ": what the solid fraction times one latent heat does not give"));
    card_.remarks.push_back(
        fmt::format("heat of freezing {:.6g} kJ/kg, of which {:.6g} follow the solid fraction",
                    1e-3 * (heat.latent_heat + heat.rest), 1e-3 * heat.latent_heat));
  }

  void add_heat_by_capacity(Value& changes) {
    double latent = 0;
    std::string from;
    if (options_.latent_heat) {
      latent = *options_.latent_heat;
      from = source("") + ", latent heat as given with --latent-heat";
    } else if (base_ != nullptr && base_->solidification() != nullptr) {
      latent = base_->solidification()->latent_heat;
      from = "estimate: latent heat of " + base_->name;
    } else {
      throw InputError({c_.file, 0, 0}, "the table has no enthalpy, so that the latent heat is not known",
                       "--latent-heat \"390 kJ/kg\", or --like CARD to take that of another card");
    }
    if (c_.has("specific_heat"))
      card_.document.set("specific_heat",
                         function("J/kg/K", points_of(c_, "specific_heat"), source("specific_heat")));
    changes.items().push_back(solidification(latent, from));
    card_.remarks.push_back(fmt::format("latent heat {:.6g} kJ/kg", 1e-3 * latent));
  }

  Value solidification(double latent_heat, const std::string& heat_source) {
    Points expansion;
    if (c_.has("expansion"))
      expansion = points_of(c_, "expansion");
    else if (c_.has("density") && range_.solidus > 0)
      expansion = expansion_of(c_, range_);
    double change = 0;
    std::string from;
    if (options_.volume_change) {
      change = *options_.volume_change;
    } else if (const auto by_density = volume_change_of(c_, range_, expansion)) {
      change = *by_density;
      from = "; volume change by the densities";
    } else if (base_ != nullptr && base_->solidification() != nullptr) {
      change = base_->solidification()->volume_change;
      from = "; volume change of " + base_->name;
    } else {
      card_.remarks.emplace_back("no volume change: the table has no density; give --volume-change");
    }
    return phase_change("solidification", true, latent_heat, change,
                        fraction_points(c_, range_, c_.of("solid_fraction"), 0),
                        source("solid_fraction") + "; " + heat_source + from);
  }

  void add_elastic() {
    Value& document = card_.document;
    if (c_.has("young_modulus"))
      document.set("young_modulus", function("Pa", solid_points("young_modulus"), source("young_modulus")));
    if (c_.has("poisson_ratio"))
      document.set("poisson_ratio", function("1", solid_points("poisson_ratio"), source("poisson_ratio")));
    if (c_.has("expansion")) {
      document.set("expansion", function("1/K", solid_points("expansion"), source("expansion")));
    } else if (c_.has("density") && c_.has("young_modulus") && range_.solidus > 1) {
      document.set("expansion", function("1/K", expansion_of(c_, range_), source("density")));
      document.set("expansion_reference", Value(kelvin(c_.temperature[0])));
    }
  }

  /// Cuts a column at the solidus: values that programs print for the melt are no property of a solid.
  Points solid_points(const std::string& quantity) const {
    Points points = points_of(c_, quantity);
    const double solidus = c_.temperature[range_.solidus];
    if (points.front().first < solidus)
      std::erase_if(points, [&](const auto& point) { return point.first > solidus; });
    return points;
  }

  void check_complete() const {
    if (!options_.like.empty()) return;
    std::string missing;
    for (const char* key : {"density", "conductivity", "specific_heat"})
      if (card_.document.find(key) == nullptr) missing += (missing.empty() ? "" : ", ") + std::string(key);
    if (!missing.empty())
      throw InputError({c_.file, 0, 0}, "the table does not hold what a card needs: " + missing,
                       "--like CARD to take the rest from another card");
  }

  ImportColumns c_;
  const ImportOptions& options_;
  const Material* base_;
  ImportedCard card_;
  Range range_;
};

}  // namespace

ImportedCard import_card(const ColumnTable& table, const ImportOptions& options, const Material* base) {
  return Importer(import_columns(table, options), options, base).card();
}

}  // namespace solidus::material
