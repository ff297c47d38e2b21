#include "run/neighbours.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>
#include <utility>

#include "input/document.hpp"
#include "input/keys.hpp"
#include "system/errors.hpp"

namespace solidus::run {

namespace {

struct ParameterSpec {
  std::string name;
  double change = 0;
  std::vector<std::string> set;
  SourceLocation where;
};

struct ParameterList {
  std::vector<ParameterSpec> parameters;
};

Section<ParameterList> list_keys() {
  // The keys are read like those of a case, so that a slip of spelling is told with its line and with the
  // names that are allowed.
  Section<ParameterSpec> parameter("parameter", "A parameter with respect to which derivatives are wanted.");
  parameter.key("name", &ParameterSpec::name).doc("What columns call it.");
  parameter.key("change", &ParameterSpec::change).doc("By how much it differs in the case that `set` makes.");
  parameter.key("set", &ParameterSpec::set).doc("Assignments as of --set.");
  parameter.place(&ParameterSpec::where);
  Section<ParameterList> list("sensitivities", "The parameters of a run with derivatives.");
  list.sections("parameter", &ParameterList::parameters, parameter);
  return list;
}

}  // namespace

std::vector<Neighbour> read_neighbours(
    const std::filesystem::path& file,
    const std::function<setup::Case(const std::vector<std::string>&)>& load) {
  const ParameterList list = list_keys().read(load_document(file));
  // An empty list would give a run with a table that has no columns, and is more likely a wrong file.
  if (list.parameters.empty())
    throw InputError({file.string(), 0, 0}, "the file has no parameter",
                     "[[parameter]] with name, change and set");
  std::vector<Neighbour> neighbours;
  std::set<std::string> names;
  // Names head the columns of the table, and have to be different; a change of zero would divide by zero, and
  // one that is not a number is refused with it.
  for (const ParameterSpec& p : list.parameters) {
    if (!names.insert(p.name).second)
      throw InputError(p.where, fmt::format("there are two parameters '{}'", p.name));
    if (!(p.change != 0))
      throw InputError(p.where, fmt::format("the change of '{}' is zero", p.name), "a small number");
    // The case is loaded with the assignments of this parameter alone: the neighbours differ from the run in
    // one parameter each.
    neighbours.push_back({p.name, p.change, load(p.set)});
  }
  return neighbours;
}

}  // namespace solidus::run
