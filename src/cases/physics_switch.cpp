/// What only mechanics needs is taken out of the document, so that the rest is checked like any case.
#include "cases/physics_switch.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <string_view>
#include <vector>

#include "coupling/all_fields.hpp"

namespace solidus::cases {

namespace {

/// Whether only mechanics computes the field. Those of contact are left where heat passes.
bool is_mechanical(const std::string& field) {
  const coupling::Quantity* known = coupling::find_field(field);
  return known != nullptr && known->needs.mechanics;
}

std::string text_of(const Value& table, std::string_view key) {
  const Value* value = table.find(key);
  return value != nullptr && value->is_text() ? value->text() : "";
}

/// An interface or contact by its name; one without a name by the bodies between which it is.
std::string name_of(std::string_view kind, const Value& item) {
  if (const std::string name = text_of(item, "name"); !name.empty())
    return fmt::format("{} '{}'", kind, name);
  const Value* bodies = item.find("bodies");
  if (bodies == nullptr || !bodies->is_list()) return fmt::format("{} of all bodies", kind);
  std::vector<std::string> names;
  for (const Value& body : bodies->items())
    if (body.is_text()) names.push_back(fmt::format("'{}'", body.text()));
  return fmt::format("{} of {}", kind, fmt::join(names, " and "));
}

/// Removes sections from a document and notes their names.
class Removal {
 public:
  explicit Removal(Value& document) : document_(document) {}

  void section(std::string_view key) {
    if (erase(document_, key)) said_.push_back(fmt::format("[{}]", key));
  }
  void key(Value& table, std::string_view key, const std::string& of) {
    if (erase(table, key)) said_.push_back(fmt::format("{} of {}", key, of));
  }
  /// Items of a list of sections for which `goes` holds.
  template <class Goes>
  void items(Value& table, std::string_view list, const Goes& goes) {
    Value* all = table.find(list);
    if (all == nullptr || !all->is_list()) return;
    std::vector<std::string> names;
    std::erase_if(all->items(), [&](const Value& item) {
      if (!item.is_table() || !goes(item)) return false;
      names.push_back(fmt::format("'{}'", text_of(item, "name")));
      return true;
    });
    if (names.empty()) return;
    said_.push_back(fmt::format("{} {}", list, fmt::join(names, ", ")));
    if (all->items().empty()) erase(table, list);
  }
  std::string text() const { return fmt::format("{}", fmt::join(said_, "; ")); }
  void note(const std::string& what) { said_.push_back(what); }

  static bool erase(Value& table, std::string_view key) {
    return table.is_table() &&
           std::erase_if(table.entries(), [&](const Value::Entry& e) { return e.key == key; }) > 0;
  }

 private:
  Value& document_;
  std::vector<std::string> said_;
};

void take_out_of_contacts(Value& document, Removal& removal) {
  removal.items(document, "contact", [](const Value& c) { return c.find("heat") == nullptr; });
  for (const char* kind : {"contact", "interface"}) {
    Value* list = document.find(kind);
    if (list == nullptr || !list->is_list()) continue;
    for (Value& item : list->items())
      for (const char* key : {"friction", "wear", "interface"}) removal.key(item, key, name_of(kind, item));
  }
}

/// Wear of dies goes, and with it a [[die_life]] that asks for nothing else.
void take_out_of_dies(Value& document, Removal& removal) {
  Value* dies = document.find("die_life");
  if (dies == nullptr || !dies->is_list()) return;
  for (Value& die : dies->items())
    removal.key(die, "worn_depth", fmt::format("die_life '{}'", text_of(die, "body")));
  removal.items(document, "die_life", [](const Value& die) {
    return text_of(die, "law") == "none" && die.find("soldering_temperature") == nullptr;
  });
}

void take_out_of_probes(Value& document, Removal& removal) {
  // A difference goes with either of its probes, so that names are collected.
  std::set<std::string> gone;
  const auto mechanical = [&](const Value& probe) {
    bool goes = is_mechanical(text_of(probe, "field"));
    if (const Value* of = probe.find("of"); of != nullptr && of->is_list())
      for (const Value& other : of->items()) goes = goes || (other.is_text() && gone.contains(other.text()));
    // Columns of history.csv that mechanics or a contact's force writes.
    for (const char* word : {"work", "force", "moment", "dissipation", "friction", "kinetic", "closed"})
      goes = goes || text_of(probe, "global").find(word) != std::string::npos;
    if (goes) gone.insert(text_of(probe, "name"));
    return goes;
  };
  // First every probe is asked, then those that go are taken out.
  if (const Value* probes = document.find("probe"); probes != nullptr && probes->is_list())
    for (const Value& probe : probes->items())
      if (probe.is_table()) mechanical(probe);
  removal.items(document, "probe", mechanical);
  Value* profiles = document.find("profile");
  if (profiles == nullptr || !profiles->is_list()) return;
  for (Value& profile : profiles->items())
    removal.items(profile, "column", [](const Value& c) { return is_mechanical(text_of(c, "field")); });
  removal.items(document, "profile", [](const Value& p) { return p.find("column") == nullptr; });
}

void take_out_of_output(Value& document, Removal& removal) {
  Value* output = document.find("output");
  Value* fields = output != nullptr ? output->find("fields") : nullptr;
  if (fields == nullptr || !fields->is_list()) return;
  std::vector<std::string> names;
  std::erase_if(fields->items(), [&](const Value& field) {
    if (!field.is_text() || !is_mechanical(field.text())) return false;
    names.push_back(field.text());
    return true;
  });
  if (!names.empty()) removal.note(fmt::format("output.fields {}", fmt::join(names, ", ")));
  if (fields->items().empty()) Removal::erase(*output, "fields");
}

}  // namespace

std::string switch_physics(Value& document, Physics physics) {
  // A document without [analysis] gets one: the command line may say it alone.
  Value* analysis = document.find("analysis");
  if (analysis == nullptr) analysis = &document.set("analysis", Value());
  if (!analysis->is_table()) return {};  // the keys say what is wrong
  const char* name = physics == Physics::heat        ? "heat"
                     : physics == Physics::mechanics ? "mechanics"
                                                     : "thermomechanical";
  // Everything that only mechanics reads goes out of a document that only conducts heat.
  analysis->set("physics", Value(name));
  if (physics != Physics::heat) return {};
  Removal removal(document);
  for (const char* section : {"mechanics", "dynamics", "coupling"}) removal.section(section);
  removal.items(document, "mechanical_condition", [](const Value&) { return true; });
  take_out_of_contacts(document, removal);
  take_out_of_dies(document, removal);
  // Keys of bodies, times and probes that mean nothing without mechanics.
  if (Value* bodies = document.find("body"); bodies != nullptr && bodies->is_list())
    for (Value& body : bodies->items()) {
      const std::string of = fmt::format("body '{}'", text_of(body, "name"));
      Removal::erase(body, "physics");  // all conduct heat: there is nothing to say
      removal.key(body, "initial_velocity", of);
      removal.key(body, "initial_stress", of);
    }
  if (Value* time = document.find("time"); time != nullptr)
    for (const char* key : {"displacement_error", "stress_error", "skin_change"})
      removal.key(*time, key, "[time]");
  take_out_of_probes(document, removal);
  take_out_of_output(document, removal);
  return removal.text();
}

}  // namespace solidus::cases
