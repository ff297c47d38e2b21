/// The keys of the files that a user writes; the fields that a run can have, as a list, one by one, as a page
/// and as JSON; the columns of tables in the same forms; the findings of `check`, as a list and as a page.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>
#include <vector>

#include "app/case_arguments.hpp"
#include "app/declared_files.hpp"
#include "app/findings_page.hpp"
#include "app/tables_page.hpp"
#include "app/verb.hpp"
#include "coupling/all_fields.hpp"
#include "input/key_docs.hpp"
#include "input/keys.hpp"
#include "mechanics/quantities.hpp"
#include "quantities/names.hpp"
#include "results/output/quantity_json.hpp"
#include "results/tables/all_tables.hpp"
#include "system/errors.hpp"

namespace solidus::app {

namespace {

using quantities::name;
using quantities::Quantity;

std::string shown_text(const Quantity& field) {
  const std::string_view text = field.shown().text;
  return text.empty() ? "–" : std::string(text);
}

/// "velocity" exists with inertia alone, for example; empty: with every analysis that has its room.
std::string needs_of(const Quantity& field) {
  std::vector<std::string_view> words;
  const quantities::Needs& n = field.needs;
  if (n.heat) words.emplace_back("heat");
  if (n.mechanics) words.emplace_back("mechanics");
  if (n.inertia) words.emplace_back("inertia");
  if (n.plasticity) words.emplace_back("plastic flow");
  if (n.melting) words.emplace_back("metal that melts");
  if (n.isentropic) words.emplace_back("the isentropic split");
  if (n.friction) words.emplace_back("friction");
  return fmt::format("{}", fmt::join(words, ", "));
}

std::string place_of(const Quantity& field) {
  switch (field.place) {
    case quantities::Place::node:
      return "nodes";
    case quantities::Place::element:
      return "elements";
    case quantities::Place::contact:
      break;
  }
  return "nodes of contact surfaces";
}

/// A text for a cell of a table in Markdown, whose columns are told apart by |.
std::string cell(std::string_view text) {
  std::string out;
  for (const char c : text) out += c == '|' ? std::string("\\|") : std::string(1, c);
  return out;
}

std::string list_of_fields() {
  std::string text;
  for (const Quantity* field : coupling::all_fields())
    text += fmt::format("{:26} {:10} {}\n", field->name, field->exact_unit(), field->doc);
  return text;
}

std::string details(const Quantity& field) {
  std::string text = fmt::format("{} [{}]  {}, at {}\n  {}.\n", field.name, field.exact_unit(),
                                 name(field.rank), place_of(field), field.doc);
  text += fmt::format("  called {}, shown in {}\n", field.label, shown_text(field));
  if (const std::string needs = needs_of(field); !needs.empty()) text += fmt::format("  needs {}\n", needs);
  if (field.no_value) text += fmt::format("  {:g} says that there is no value\n", *field.no_value);
  if (field.written == quantities::Written::on_request)
    text += "  written to field files where [output] fields names it\n";
  return text;
}

std::string page_of_fields() {
  std::string text =
      "# Reference: fields\n\nFor those who choose probes and fields, and who read files of results. Files "
      "hold the "
      "unit in the second column; the report and pictures show the one in the third.\n";
  // A table for each group of fields, in the order of the fields in the program.
  for (const quantities::Group group : {quantities::Group::heat, quantities::Group::mechanics,
                                        quantities::Group::contact, quantities::Group::criteria}) {
    std::string title(name(group));
    title[0] = static_cast<char>(title[0] - 'a' + 'A');
    text += fmt::format(
        "\n## {}\n\n| field | unit | shown in | what | at | needs | no value "
        "|\n|---|---|---|---|---|---|---|\n",
        title);
    for (const Quantity* field : coupling::all_fields()) {
      // Each field is in the table of its group, with what it needs of a case.
      if (field->group != group) continue;
      const bool asked = field->written == quantities::Written::on_request;
      text += fmt::format(
          "| `{}` | {} | {} | {}{} | {}{} | {} | {} |\n", field->name, field->exact_unit(),
          shown_text(*field), cell(field->doc), asked ? "; where `[output] fields` names it" : "",
          field->rank == quantities::Rank::scalar ? "" : fmt::format("{}, ", name(field->rank)),
          place_of(*field), needs_of(*field), field->no_value ? fmt::format("{:g}", *field->no_value) : "");
    }
  }
  return text +
         "\nNext: [results](../guide/results.md) · [criteria of a casting](../guide/criteria.md) · [add a "
         "criterion](../developers/add_a_criterion.md)\n";
}

std::string json_of_fields() {
  results::Json::Array rows{results::json(mechanics::fields::k_first_principal_stress)};
  for (const Quantity* field : coupling::all_fields()) rows.push_back(results::json(*field));
  results::Json document;
  document.add("fields", std::move(rows))
      .add("units", results::shown_units_json())
      .add("unit_names", results::unit_names_json());
  return document.text();
}

enum class ExplainedAs { text, manual, json };

/// The fields that a run can have (coupling/all_fields.hpp).
/// @param field  one of them; empty: all
ExitCode explain_fields(const std::string& field, ExplainedAs form) {
  if (!field.empty()) {
    const Quantity* known = coupling::find_field(field);
    if (known == nullptr)
      throw InputError({}, fmt::format("there is no field '{}'", field),
                       one_of(coupling::field_names(true), field));
    print(details(*known));
  } else {
    print(form == ExplainedAs::manual ? page_of_fields()
          : form == ExplainedAs::json ? json_of_fields()
                                      : list_of_fields());
  }
  return k_done;
}

class Explain final : public Verb {
 public:
  explicit Explain(CLI::App& program)
      : Verb(program, "explain", "Explain a key of the case file, or list all") {
    command().add_option("KEY", key_, "For example time.step");
    command().add_flag("--manual", manual_, "The reference manual of all keys, in Markdown");
    CLI::Option* of_fields =
        command().add_flag("--fields", fields_, "Fields of results instead of keys; KEY is one of them");
    CLI::Option* of_tables =
        command().add_flag("--tables", tables_,
                           "Columns of the tables of a run instead of keys; KEY is a table, such as history");
    CLI::Option* json = command().add_flag("--json", json_, "With --fields or --tables: for other programs");
    file_.add_options(command());
    CLI::Option* of_findings =
        command().add_flag("--findings", findings_,
                           "Findings of check instead of keys; KEY is what they are about, such as contacts");
    of_findings->excludes(of_fields)->excludes(of_tables)->excludes(json);
    of_tables->excludes(of_fields);
    for (const char* other : {"--material", "--point"})
      for (CLI::Option* option : {of_fields, of_findings, of_tables, json})
        option->excludes(command().get_option(other));
  }
  ExitCode run() override {
    if (fields_)
      return explain_fields(key_, json_     ? ExplainedAs::json
                                  : manual_ ? ExplainedAs::manual
                                            : ExplainedAs::text);
    if (tables_) {
      print(json_                     ? results::tables_json().text()
            : manual_ && key_.empty() ? page_of_tables()
                                      : list_of_tables(key_));
      return k_done;
    }
    if (json_) throw InputError({}, "--json is for fields and tables alone", "--fields or --tables");
    if (findings_) {
      print(manual_ && key_.empty() ? page_of_findings() : list_of_findings(key_));
      return k_done;
    }
    const ChosenFile::Declared of = file_.declared();
    print(manual_ ? reference_manual(of.keys, of.reference) : solidus::explain(of.keys, key_));
    return k_done;
  }

 private:
  std::string key_;
  bool manual_ = false, fields_ = false, tables_ = false, findings_ = false, json_ = false;
  ChosenFile file_;
};

}  // namespace

std::unique_ptr<Verb> explain_verb(CLI::App& program) {
  return std::make_unique<Explain>(program);
}

}  // namespace solidus::app
