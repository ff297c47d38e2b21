#include "new_case/feeders_file.hpp"

#include "cases/feeder_keys.hpp"
#include "input/document.hpp"

namespace solidus::new_case {

namespace {

struct FeedersSpec {
  std::vector<cases::RiserBlockSpec> risers;
  std::vector<cases::ChillBlockSpec> chills;
};

struct GatingFileSpec {
  std::vector<cases::GatingBlockSpec> gatings;
};

mesh::Point point_of(const std::vector<double>& x) {
  return {x[0], x[1], x[2]};
}

}  // namespace

Feeders read_feeders(const std::filesystem::path& file) {
  Section<FeedersSpec> section("", "Risers and chills.");
  section.sections("riser", &FeedersSpec::risers, cases::riser_keys());
  section.sections("chill", &FeedersSpec::chills, cases::chill_keys());
  const FeedersSpec spec = section.read(load_document(file));
  cases::check_feeders(spec.risers, {}, spec.chills);
  Feeders feeders;
  for (const cases::RiserBlockSpec& r : spec.risers) {
    DraftRiser& riser = feeders.risers.emplace_back();
    riser.name = r.name;
    riser.foot = point_of(r.foot);
    riser.diameter = r.diameter;
    riser.height = r.height;
    riser.neck_diameter = r.neck_diameter.value_or(0);
    riser.neck_height = r.neck_height;
    if (!r.neck_to.empty()) riser.neck_to = point_of(r.neck_to);
    riser.sleeve = r.sleeve;
  }
  for (const cases::ChillBlockSpec& c : spec.chills)
    feeders.chills.push_back({c.name, point_of(c.lowest), point_of(c.highest)});
  return feeders;
}

std::vector<mesh::GatingSystem> read_gating(const std::filesystem::path& file) {
  Section<GatingFileSpec> section("", "Gating.");
  section.sections("gating", &GatingFileSpec::gatings, cases::gating_keys());
  const GatingFileSpec spec = section.read(load_document(file));
  if (spec.gatings.empty())
    throw InputError({file.string()}, "the file has no gating",
                     "[[gating]], with the keys of [[mesh.gating]]");
  cases::check_feeders({}, spec.gatings, {});
  std::vector<mesh::GatingSystem> gatings;
  for (const cases::GatingBlockSpec& g : spec.gatings)
    gatings.push_back({g.name, point_of(g.gate), g.gate_size[0], g.gate_size[1], g.gate_length,
                       g.runner_size[0], g.runner_size[1], point_of(g.sprue), g.foot_diameter,
                       g.top_diameter});
  return gatings;
}

}  // namespace solidus::new_case
