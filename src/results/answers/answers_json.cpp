/// The answers of a run for summary.json.
#include "results/answers/answer_rows.hpp"
#include "results/answers/answers.hpp"

namespace solidus::results {

namespace {

std::string member(const AnswerRow& row) {
  return std::string(row.column.name);
}

/// The error of an answer, as members of what holds it.
void add_error(Json& json, const std::optional<ErrorBand>& error, const std::string& unit) {
  if (!error) return;
  json.add("error[" + unit + "]", error->total())
      .add("error_of_step[" + unit + "]", error->step)
      .add("error_of_mesh[" + unit + "]", error->mesh)
      .add("step_compared", error->step_compared)
      .add("mesh_compared", error->mesh_compared);
}

Json value_json(const ValueAt& value, const std::string& unit) {
  Json json;
  json.add("value[" + unit + "]", value.value)
      .add("at[m]", Json::Array(value.where.begin(), value.where.end()));
  add_error(json, value.error, unit);
  return json;
}

/// An answer with its place, in the unit of its row.
Json value_json(const ValueAt& value, const AnswerRow& row) {
  return value_json(value, std::string(row.column.unit));
}

Json pores_json(const Pores& pores) {
  Json json = value_json(pores.densest, "1");
  json.add("volume[m3]", pores.volume).add(std::string(answer::k_pores.number), pores.share);
  add_error(json, pores.error, "1");
  return json;
}

/// Bodies one by one, under their names; a casting that has left has no present values.
Json castings_json(const Answers& a) {
  Json castings;
  for (const CastAnswer& cast : a.castings) {
    Json of_body;
    of_body.add("riser", cast.cast.feeds).add("gating", cast.cast.gates).add("there", cast.there);
    if (cast.there)
      of_body.add(member(answer::k_solid_fraction), cast.solid_fraction).add("mass[kg]", cast.mass);
    if (cast.least_niyama) of_body.add("least_niyama", value_json(*cast.least_niyama, "K^0.5 s^0.5/m"));
    if (cast.pores) of_body.add(member(answer::k_pores), pores_json(*cast.pores));
    if (cast.shrinkage)
      of_body.add("holes[m3]", cast.shrinkage->holes)
          .add("unfed_pores[m3]", cast.shrinkage->unfed)
          .add("gas_pores[m3]", cast.shrinkage->of_gas);
    if (cast.froze)
      of_body.add(member(answer::k_last_melt_froze), value_json(*cast.froze, answer::k_last_melt_froze));
    if (cast.hottest)
      of_body.add(member(answer::k_hottest_melt), value_json(*cast.hottest, answer::k_hottest_melt));
    castings.add(cast.cast.name, std::move(of_body));
  }
  return castings;
}

/// How many pools were cut off from their feeders, with the largest.
Json pools_json(const Answers::CutOffPools& cut_off) {
  Json pools;
  pools.add(std::string(answer::k_pools_cut_off.number), cut_off.number);
  if (cut_off.number > 0) {
    pools.add("largest[m3]", cut_off.largest)
        .add("at[m]", Json::Array(cut_off.where.begin(), cut_off.where.end()));
    if (cut_off.frozen) pools.add("frozen[s]", *cut_off.frozen);
  }
  return pools;
}

}  // namespace

Json json(const Answers& a) {
  // The answers as summary.json has them. What is not known is left out rather than written as null, and
  // every value that has one carries its error and its place.
  Json json;
  json.add("time[s]", a.time).add("castings", castings_json(a));
  if (a.pools) json.add(member(answer::k_pools_cut_off), pools_json(*a.pools));
  // The yield is known only where bodies have roles.
  if (const std::optional<double> share = poured_share_of_parts(a)) json.add(member(answer::k_yield), *share);
  if (a.pores) json.add(member(answer::k_pores), pores_json(*a.pores));
  // Contacts by their names, with the widest gap and the deepest overlap of each.
  Json gaps;
  for (const GapAnswer& gap : a.gaps) gaps.add(gap.contact, value_json(gap.gap, answer::k_largest_gap));
  json.add(member(answer::k_largest_gap), std::move(gaps));
  Json overlaps;
  for (const GapAnswer& overlap : a.overlaps) overlaps.add(overlap.contact, value_json(overlap.gap, "m"));
  json.add("deepest_overlaps", std::move(overlaps));
  // What deforms has a largest distortion and a largest stress.
  if (a.distortion)
    json.add(member(answer::k_largest_distortion), value_json(*a.distortion, answer::k_largest_distortion));
  if (a.stress)
    json.add(member(answer::k_largest_von_mises),
             value_json(*a.stress, answer::k_largest_von_mises).add("body", a.stressed_body));
  Json of_criteria;
  for (const auto& [name, error] : a.criteria_errors) {
    Json of_one;
    add_error(of_one, error, "SI");
    of_criteria.add(name, std::move(of_one));
  }
  if (!a.criteria_errors.empty()) json.add("errors_of_criteria", std::move(of_criteria));
  // At last what says how far the answers are right: shots, the error of fixed steps, and the
  // balance of energy.
  if (!a.shots.empty()) json.add("shots", results::json(a.shots));
  if (!a.stages.rows.empty()) json.add("stages", results::json(a.stages));
  if (a.step_error)
    json.add("largest_step_error",
             Json().add("temperature[K]", (*a.step_error)[0]).add("time[s]", (*a.step_error)[1]));
  if (a.energy_defect) json.add("relative_energy_defect", *a.energy_defect);
  return json;
}

}  // namespace solidus::results
