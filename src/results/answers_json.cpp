/// The answers of a run for summary.json.
#include "results/answers.hpp"

namespace solidus::results {

namespace {

Json value_json(const ValueAt& value, const std::string& unit) {
  Json json;
  json.add("value[" + unit + "]", value.value)
      .add("at[m]", Json::Array(value.where.begin(), value.where.end()));
  return json;
}

}  // namespace

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
  Json overlaps;
  for (const GapAnswer& overlap : a.overlaps) overlaps.add(overlap.contact, value_json(overlap.gap, "m"));
  json.add("deepest_overlaps", std::move(overlaps));
  if (a.distortion) json.add("largest_distortion", value_json(*a.distortion, "m"));
  if (a.stress) json.add("largest_von_mises", value_json(*a.stress, "Pa").add("body", a.stressed_body));
  if (!a.shots.empty()) json.add("shots", results::json(a.shots));
  if (a.energy_defect) json.add("relative_energy_defect", *a.energy_defect);
  return json;
}

}  // namespace solidus::results
