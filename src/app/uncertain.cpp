/// Lists the uncertain parameters of a case with their spreads, as JSON for `solidus uncertain`.
#include <array>

#include "app/verbs.hpp"
#include "results/json_document.hpp"
#include "run/session.hpp"

namespace solidus::app {

namespace {

using model::UncertainParameter;
using results::Json;

const char* text(UncertainParameter::Origin origin) {
  constexpr std::array<const char*, 3> k_texts = {"stated", "estimate", "usual"};
  return k_texts.at(static_cast<std::size_t>(origin));
}

const char* text(UncertainParameter::Group group) {
  constexpr std::array<const char*, 5> k_texts = {"casting", "mould", "interface", "start", "surroundings"};
  return k_texts.at(static_cast<std::size_t>(group));
}

Json json(const UncertainParameter& p) {
  Json::Array places;
  for (const UncertainParameter::Place& place : p.places) {
    Json at;
    at.add("key", place.key).add("value", place.value);
    places.push_back(std::move(at));
  }
  Json json;
  json.add("label", p.label)
      .add("quantity", p.quantity)
      .add("of", p.of)
      .add("group", text(p.group))
      .add("mechanical", p.mechanical)
      .add("places", std::move(places));
  if (p.spread.relative) json.add("relative", *p.spread.relative);
  if (p.spread.factor) json.add("factor", *p.spread.factor);
  if (p.spread.shift) json.add("shift[K]", *p.spread.shift);
  return json.add("spread", spread_text(p.spread))
      .add("origin", text(p.origin))
      .add("source", p.spread.source);
}

}  // namespace

ExitCode list_uncertain(const CaseArguments& arguments) {
  const model::Case c = load_case(arguments);
  const model::CheckedRun checked = model::check_run(c);
  Json::Array parameters, fixed;
  for (const UncertainParameter& p : checked.uncertain.list) parameters.push_back(json(p));
  for (const std::string& what : checked.uncertain.fixed) fixed.emplace_back(what);
  Json document;
  document.add("title", c.spec.title)
      .add("parameters", std::move(parameters))
      .add("not_varied", std::move(fixed));
  print(document.text() + "\n");
  return k_done;
}

}  // namespace solidus::app
