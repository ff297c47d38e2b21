#include "results/answers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "criteria/gather.hpp"
#include "criteria/pools.hpp"
#include "heat/nodal_enthalpy.hpp"
#include "input/units.hpp"
#include "mesh/block_geometry.hpp"
#include "numbers/types.hpp"
#include "parallel/parallel.hpp"

namespace solidus::results {

namespace {

/// The largest value seen so far; of equal ones that with the least number in the input.
class Largest {
 public:
  void see(double value, double number, const mesh::Point& where) {
    if (number_ >= 0 && (value < best_.value || (value == best_.value && number >= number_))) return;
    best_ = {value, where};
    number_ = number;
  }
  /// Over all processes; nothing where none has seen any. Collective.
  std::optional<ValueAt> over_processes() const {
    const double own[] = {best_.value, number_, best_.where[0], best_.where[1], best_.where[2]};
    const std::vector<double> all = criteria::gathered(own);
    Largest largest;
    for (std::size_t k = 0; k + 4 < all.size(); k += 5)
      if (all[k + 1] >= 0) largest.see(all[k], all[k + 1], {all[k + 2], all[k + 3], all[k + 4]});
    return largest.number_ >= 0 ? std::optional(largest.best_) : std::nullopt;
  }

 private:
  ValueAt best_;
  double number_ = -1;
};

/// Values of a field; empty if the run has no such field.
struct Values {
  std::vector<double> storage;
  std::span<const double> values;
  Values(const FieldSet& fields, std::string_view name) {
    if (const Field* field = fields.find(name)) values = field->read(storage);
  }
  bool empty() const { return values.empty(); }
  double operator[](std::size_t i) const { return values[i]; }
};

/// The owned nodes of a body.
std::vector<char> nodes_of(const mesh::Mesh& mesh, int body) {
  std::vector<char> chosen(static_cast<std::size_t>(mesh.n_owned_nodes), 0);
  for (const mesh::Block& block : mesh.blocks)
    if (block.body == body)
      for (const Index node : block.nodes)
        if (node < mesh.n_owned_nodes) chosen[static_cast<std::size_t>(node)] = 1;
  return chosen;
}

template <class See>
std::optional<ValueAt> largest_at(const mesh::Mesh& mesh, const std::vector<char>& nodes, const See& value) {
  Largest largest;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (nodes[i] != 0)
      if (const std::optional<double> v = value(i))
        largest.see(*v, static_cast<double>(mesh.input_node[i]), mesh.x[i]);
  return largest.over_processes();
}

CastAnswer cast_answer(const mesh::Mesh& mesh, const coupling::Phases& phases, const coupling::State& state,
                       const CastBody& cast, const FieldSet& fields) {
  CastAnswer answer;
  answer.cast = cast;
  answer.solid_fraction = phases.heat->mean_solid_fraction(state.heat, cast.body);
  const std::vector<char> nodes = nodes_of(mesh, cast.body);
  const auto last_melt = [&] {
    const Values frozen(fields, "solidified_at");
    return largest_at(mesh, nodes, [&](std::size_t i) {
      return frozen.empty() || frozen[i] < 0 ? std::nullopt : std::optional(frozen[i]);
    });
  };
  if (!std::isfinite(answer.solid_fraction)) {  // without volume: the body has left
    answer.there = false;
    answer.solid_fraction = 0;
    if (time_to_solidify(mesh, fields, {cast})) answer.froze = last_melt();
    return answer;
  }
  constexpr double k_rounding = 1e-12;
  if (answer.solid_fraction >= 1 - k_rounding) {
    answer.solid_fraction = 1;
    answer.froze = last_melt();
    return answer;
  }
  const Values solid(fields, "solid_fraction"), temperature(fields, "temperature");
  const std::optional<ValueAt> softest =
      largest_at(mesh, nodes, [&](std::size_t i) { return std::optional(-solid[i]); });
  if (softest)
    answer.hottest = largest_at(mesh, nodes, [&](std::size_t i) {
      return -solid[i] < softest->value ? std::nullopt : std::optional(temperature[i]);
    });
  return answer;
}

std::optional<Answers::CutOffPools> cut_off_pools(const criteria::State& state) {
  for (const criteria::Record& record : state.records) {
    if (record.name != criteria::Pools::k_name) continue;
    Answers::CutOffPools found;
    for (const criteria::Pool& pool : criteria::Pools::pools(record)) {
      if (pool.closed_off < 0) continue;
      ++found.number;
      if (pool.largest <= found.largest && found.number > 1) continue;
      found.largest = pool.largest;
      found.where = pool.where;
      found.frozen = pool.frozen >= 0 ? std::optional(pool.frozen) : std::nullopt;
    }
    return found;
  }
  return {};
}

std::vector<GapAnswer> open_gaps(const mesh::Mesh& mesh, const coupling::Phases& phases,
                                 const FieldSet& fields) {
  std::vector<GapAnswer> gaps;
  const Values gap(fields, "gap");
  for (const contact::ContactPair* pair : phases.contacts) {
    std::vector<char> nodes(static_cast<std::size_t>(mesh.n_owned_nodes), 0);
    if (const auto slave = mesh.surfaces.find(pair->spec().slave); slave != mesh.surfaces.end())
      for (const Index node : slave->second.nodes)
        if (node < mesh.n_owned_nodes) nodes[static_cast<std::size_t>(node)] = 1;
    const std::optional<ValueAt> largest = largest_at(mesh, nodes, [&](std::size_t i) {
      return gap.empty() || gap[i] <= 0 ? std::nullopt : std::optional(gap[i]);
    });
    if (largest) gaps.push_back({pair->spec().name, *largest});
  }
  return gaps;
}

mesh::Point centre(const mesh::Mesh& mesh, const mesh::Block& block, Index element) {
  mesh::Point sum{};
  const int n = mesh::node_count(block.shape);
  for (int a = 0; a < n; ++a)
    for (std::size_t k = 0; k < 3; ++k)
      sum[k] += mesh.x[static_cast<std::size_t>(block.element(element)[a])][k] / n;
  return sum;
}

/// The largest von Mises stress in some bodies, and which of them has it.
void add_stress(const mesh::Mesh& mesh, const FieldSet& fields, const std::vector<char>& bodies,
                Answers& answers) {
  const Values stress(fields, "von_mises");
  if (stress.empty()) return;
  std::vector<Largest> of_body(mesh.bodies.size());
  std::size_t first = 0;
  for (const mesh::Block& block : mesh.blocks) {
    const auto body = static_cast<std::size_t>(block.body);
    if (bodies[body] != 0)
      for (Index e = 0; e < block.n_counted; ++e)
        of_body[body].see(stress[first + static_cast<std::size_t>(e)],
                          static_cast<double>(block.input_element[static_cast<std::size_t>(e)]),
                          centre(mesh, block, e));
    first += static_cast<std::size_t>(block.size());
  }
  for (std::size_t b = 0; b < of_body.size(); ++b) {
    const std::optional<ValueAt> largest = of_body[b].over_processes();
    if (!largest || largest->value <= 0 || (answers.stress && largest->value <= answers.stress->value))
      continue;
    answers.stress = largest;
    answers.stressed_body = mesh.bodies[b].name;
  }
}

/// The pores of the cast bodies, where any have opened.
std::optional<Answers::Pores> pores(const mesh::Mesh& mesh, AnalysisKind kind, const FieldSet& fields,
                                    const std::vector<char>& bodies) {
  const Values fraction(fields, "pore_fraction");
  if (fraction.empty()) return {};
  Largest densest;
  double volume = 0, whole = 0;
  std::size_t first = 0;
  for (const mesh::Block& block : mesh.blocks) {
    if (bodies[static_cast<std::size_t>(block.body)] != 0) {
      const PackVector<Lane> integrals = mesh::basis_integrals(mesh, block, kind);
      const auto n_nodes = static_cast<std::size_t>(mesh::node_count(block.shape));
      for (Index e = 0; e < block.n_counted; ++e) {
        double of_element = 0;
        for (std::size_t a = 0; a < n_nodes; ++a)
          of_element += integrals[static_cast<std::size_t>(e / k_lanes) * n_nodes + a][e % k_lanes];
        const double value = fraction[first + static_cast<std::size_t>(e)];
        whole += of_element;
        volume += value * of_element;
        densest.see(value, static_cast<double>(block.input_element[static_cast<std::size_t>(e)]),
                    centre(mesh, block, e));
      }
    }
    first += static_cast<std::size_t>(block.size());
  }
  const std::optional<ValueAt> largest = densest.over_processes();
  volume = parallel::global_sum(volume);
  whole = parallel::global_sum(whole);
  if (!largest || !(largest->value > 0)) return {};
  return Answers::Pores{.volume = volume, .share = volume / whole, .densest = *largest};
}

/// Relative defect of the first law beyond which it is not reported as closed.
constexpr double k_closed = 1e-6;

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
  std::string temperature(double kelvin) const {
    return fmt::format("{:.4g} {}", units::to_display(kelvin, "K", units_.temperature), units_.temperature);
  }
  /// Of a change of temperature [K].
  std::string change(double kelvin) const {
    constexpr auto k_difference = units::Temperature::difference;
    const std::string unit = units_.temperature == "degC" ? "K" : units_.temperature;
    return fmt::format("{:.3g} {}", units::to_display(kelvin, "K", unit, k_difference), unit);
  }
  std::string stress(double pascal) const {
    return fmt::format("{:.4g} {}", units::to_display(pascal, "Pa", units_.stress), units_.stress);
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
  return fmt::format("  {:<36}{}\n", what, answer);
}

std::string cast_text(const CastAnswer& answer, double time, const Formatter& format) {
  if (!answer.there)
    return answer.froze ? fmt::format("has left; its last melt froze {:.4g} s after pouring {}",
                                      answer.froze->value, format.place(answer.froze->where))
                        : "has left";
  if (answer.solid_fraction == 1)
    return answer.froze ? fmt::format("solid; its last melt froze {:.4g} s after pouring {}",
                                      answer.froze->value, format.place(answer.froze->where))
                        : "solid";
  // A body that is not solid is never reported as "100 % solid".
  const double percent = std::min(100 * answer.solid_fraction, 99.9);
  std::string text = fmt::format("{:.1f} % solid {:.6g} s after pouring", percent, time);
  if (answer.hottest)
    text += fmt::format("; the melt is hottest, {}, {}", format.temperature(answer.hottest->value),
                        format.place(answer.hottest->where));
  return text;
}

/// What the shots did to casting and die.
std::string shot_lines(const std::vector<ShotRow>& shots, const Formatter& format) {
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
                         : fmt::format("not to see after {}: it changed by up to {} in the last", n,
                                       format.change(last.change)));
  text += line("time to solidify", both(solid(shots.front()), solid(shots.back())));
  text += line("die when a shot begins, mean",
               both(format.temperature(first.at_pour.mean), format.temperature(last.at_pour.mean)));
  text += line("die when a shot begins, hottest",
               both(format.temperature(first.at_pour.highest), format.temperature(last.at_pour.highest)));
  return text;
}

/// Of each riser: whether it fed the castings to the end.
std::string riser_lines(const Answers& answers) {
  bool part_solid = true, any_part = false;
  double part = 0;
  for (const CastAnswer& a : answers.castings) {
    if (a.cast.feeds || (!a.there && !a.froze)) continue;
    any_part = true;
    part_solid = part_solid && a.froze;
    if (a.froze) part = std::max(part, a.froze->value);
  }
  std::string text;
  for (const CastAnswer& riser : answers.castings) {
    if (!riser.cast.feeds || (!riser.there && !riser.froze) || !any_part) continue;
    std::string verdict;
    if (riser.froze && part_solid)
      verdict = riser.froze->value > part
                    ? fmt::format("outlived the part by {:.4g} s", riser.froze->value - part)
                    : fmt::format("froze {:.4g} s before the part: it could not feed to the end",
                                  part - riser.froze->value);
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

std::string pools_text(const Answers::CutOffPools& pools, const Formatter& format) {
  if (pools.number == 0) return "none";
  return fmt::format(
      "{}; the largest had {} and {} {}", pools.number, format.volume(pools.largest),
      pools.frozen ? fmt::format("froze after {:.4g} s", *pools.frozen) : std::string("is still there"),
      format.place(pools.where));
}

/// Line of the printed answers on a criterion, and the name of the finding that it shows.
struct Line {
  std::string_view text, finding, unit;
  double factor;
};
constexpr Line k_lines[] = {{"longest local solidification time", "local_solidification_time_max", "s", 1},
                            {"largest arm spacing", "secondary_arm_spacing_max", "um", 1e6},
                            {"least Niyama", "niyama_min", "K0.5 s0.5/mm", 1e-3},
                            {"least dimensionless Niyama", "dimensionless_niyama_min", "", 1},
                            {"largest estimate of porosity", "shrinkage_porosity_max", "%", 100}};

std::string criteria_lines(const std::vector<criteria::Finding>& found, const Formatter& format) {
  std::string text;
  for (const Line& wanted : k_lines) {
    const auto f = std::find_if(found.begin(), found.end(), [&](const criteria::Finding& finding) {
      return finding.name == wanted.finding;
    });
    if (f == found.end()) continue;
    std::string answer = fmt::format("{:.4g}", f->value * wanted.factor);
    if (!wanted.unit.empty()) answer += fmt::format(" {}", wanted.unit);
    if (f->somewhere) answer += " " + format.place(f->where);
    text += line(wanted.text, answer);
  }
  return text;
}

Json value_json(const ValueAt& value, const std::string& unit) {
  Json json;
  json.add("value[" + unit + "]", value.value)
      .add("at[m]", Json::Array(value.where.begin(), value.where.end()));
  return json;
}

}  // namespace

Answers answers(const mesh::Mesh& mesh, const coupling::Phases& phases, const coupling::State& state,
                const std::vector<CastBody>& castings, const FieldSet& fields, bool mechanical) {
  Answers a;
  a.time = state.time;
  a.poured = state.poured;
  std::vector<char> stressed(mesh.bodies.size(), castings.empty() ? 1 : 0);
  std::vector<char> cast_nodes(static_cast<std::size_t>(mesh.n_owned_nodes), 0);
  for (const CastBody& cast : castings) {
    if (phases.heat != nullptr) a.castings.push_back(cast_answer(mesh, phases, state, cast, fields));
    stressed[static_cast<std::size_t>(cast.body)] = 1;
    const std::vector<char> own = nodes_of(mesh, cast.body);
    for (std::size_t i = 0; i < own.size(); ++i) cast_nodes[i] |= own[i];
  }
  if (!castings.empty()) a.pools = cut_off_pools(state.criteria);
  if (phases.mechanics == nullptr || !mechanical) return a;
  if (!castings.empty()) a.pores = pores(mesh, phases.mechanics->kind(), fields, stressed);
  a.gaps = open_gaps(mesh, phases, fields);
  if (const Field* field = fields.find("distortion"); field != nullptr && !castings.empty()) {
    const Values distortion(fields, "distortion");
    const auto n = static_cast<std::size_t>(field->components);
    a.distortion = largest_at(mesh, cast_nodes, [&](std::size_t i) {
      double square = 0;
      for (std::size_t k = 0; k < n; ++k) square += distortion[i * n + k] * distortion[i * n + k];
      return square > 0 ? std::optional(std::sqrt(square)) : std::nullopt;
    });
  }
  add_stress(mesh, fields, stressed, a);
  for (const CastBody& cast : castings)  // the mesh knows the body by its group
    if (mesh.bodies[static_cast<std::size_t>(cast.body)].name == a.stressed_body) a.stressed_body = cast.name;
  return a;
}

double solid_fraction(const coupling::Phases& phases, const coupling::State& state,
                      const std::vector<CastBody>& castings, const mesh::Mesh& mesh) {
  double solid = 0, whole = 0;
  for (const CastBody& cast : castings) {
    double own = 0;
    for (Index i = 0; i < mesh.n_owned_nodes; ++i) own += phases.heat->storage().volume(i, cast.body);
    const double volume = parallel::global_sum(own);
    if (volume == 0) continue;  // it has left
    whole += volume;
    solid += volume * phases.heat->mean_solid_fraction(state.heat, cast.body);
  }
  return whole > 0 ? solid / whole : 1.0;
}

std::string text(const Answers& a, const std::vector<criteria::Finding>& criteria,
                 const DisplayUnits& units) {
  const Formatter format(units);
  std::string text = shot_lines(a.shots, format);
  for (const CastAnswer& cast : a.castings)
    text += line(fmt::format("{} '{}'", cast.cast.feeds ? "riser" : "casting", cast.cast.name),
                 cast_text(cast, a.time - a.poured, format));
  text += riser_lines(a);
  if (a.pools) text += line("pools of melt cut off", pools_text(*a.pools, format));
  if (!a.castings.empty()) text += criteria_lines(criteria, format);
  if (a.pores)
    text += line("shrinkage that nothing fed (pores)",
                 fmt::format("{:.3g} % of the casting; the densest, {:.3g} %, {}", 100 * a.pores->share,
                             100 * a.pores->densest.value, format.place(a.pores->densest.where)));
  for (const GapAnswer& gap : a.gaps)
    text += line(fmt::format("largest gap of '{}'", gap.contact),
                 fmt::format("{} {}", format.length(gap.gap.value), format.place(gap.gap.where)));
  if (a.distortion)
    text += line("largest distortion",
                 fmt::format("{} {}", format.length(a.distortion->value), format.place(a.distortion->where)));
  if (a.stress)
    text += line("largest von Mises stress", fmt::format("{} in '{}' {}", format.stress(a.stress->value),
                                                         a.stressed_body, format.place(a.stress->where)));
  if (a.energy_defect)
    text += line("energy", fmt::format("{} {:.1e} of the heat exchanged",
                                       std::abs(*a.energy_defect) < k_closed ? "closed to" : "not closed by",
                                       std::abs(*a.energy_defect)));
  return text;
}

Json json(const Answers& a) {
  Json json;
  Json castings;
  for (const CastAnswer& cast : a.castings) {
    Json of_body;
    of_body.add("riser", cast.cast.feeds).add("there", cast.there);
    if (cast.there) of_body.add("solid_fraction", cast.solid_fraction);
    if (cast.froze) of_body.add("last_melt_froze", value_json(*cast.froze, "s"));
    if (cast.hottest) of_body.add("hottest_melt", value_json(*cast.hottest, "K"));
    castings.add(cast.cast.name, std::move(of_body));
  }
  json.add("time[s]", a.time).add("castings", std::move(castings));
  if (a.pools) {
    Json pools;
    pools.add("number", a.pools->number);
    if (a.pools->number > 0) {
      pools.add("largest[m3]", a.pools->largest)
          .add("at[m]", Json::Array(a.pools->where.begin(), a.pools->where.end()));
      if (a.pools->frozen) pools.add("frozen[s]", *a.pools->frozen);
    }
    json.add("pools_cut_off", std::move(pools));
  }
  if (a.pores)
    json.add("pores", value_json(a.pores->densest, "1")
                          .add("volume[m3]", a.pores->volume)
                          .add("share_of_casting", a.pores->share));
  Json gaps;
  for (const GapAnswer& gap : a.gaps) gaps.add(gap.contact, value_json(gap.gap, "m"));
  json.add("largest_gaps", std::move(gaps));
  if (a.distortion) json.add("largest_distortion", value_json(*a.distortion, "m"));
  if (a.stress) json.add("largest_von_mises", value_json(*a.stress, "Pa").add("body", a.stressed_body));
  if (!a.shots.empty()) json.add("shots", results::json(a.shots));
  if (a.energy_defect) json.add("relative_energy_defect", *a.energy_defect);
  return json;
}

}  // namespace solidus::results
