/// Every property of a quantity under the name that readers in Python use.
#include "results/output/quantity_json.hpp"

#include "quantities/names.hpp"
#include "quantities/shown_units.hpp"

namespace solidus::results {

Json json(const quantities::ShownUnit& shown) {
  Json json;
  json.add("unit", std::string(shown.unit))
      .add("text", std::string(shown.text))
      .add("factor", shown.factor)
      .add("offset", shown.offset);
  return json;
}

Json json(const quantities::Quantity& q) {
  using quantities::name;
  Json json;
  // Only what the quantity declares is written.
  const auto text = [&](const char* key, std::string_view value) {
    if (!value.empty()) json.add(key, std::string(value));
  };
  // Names and units, then what the value means, then how it is shown.
  text("name", q.name);
  text("unit", q.unit);
  text("root_unit", q.root_unit);
  text("label", q.label);
  text("group", name(q.group));
  text("rank", name(q.rank));
  text("place", name(q.place));
  if (q.no_value) json.add("no_value", *q.no_value);
  text("written", name(q.written));
  text("worst", name(q.worst));
  text("headline", q.headline);
  text("answer", q.answer);
  if (q.threshold) json.add("threshold", *q.threshold);
  text("colours", name(q.colours));
  json.add("compared", q.compared).add("pictured", q.pictured).add("shown", results::json(q.shown()));
  return json;
}

Json shown_units_json() {
  Json json;
  for (const quantities::UnitRow& row : quantities::shown_units())
    json.add(std::string(row.si), results::json(row.shown));
  return json;
}

Json unit_names_json() {
  Json json;
  for (const quantities::UnitName& row : quantities::unit_names()) {
    Json one;
    one.add("text", std::string(row.text)).add("measures", std::string(row.measures));
    json.add(std::string(row.unit), std::move(one));
  }
  return json;
}

}  // namespace solidus::results
