/// One row for each process: mould, temperatures, cooling and what goes with it.
#include "new_case/casting_processes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cases/case_materials.hpp"
#include "input/keys.hpp"
#include "material/cards/library.hpp"
#include "new_case/new_case.hpp"

namespace solidus::new_case {

const std::vector<CastingProcess>& casting_processes() {
  // For each process: mould materials from the best known on, role and temperature of the mould, superheat
  // [K], walls and allowances, the interface law, films outside with their source, for dies the times of a
  // shot, and for a shell its thickness and how hot it is.
  static const std::vector<CastingProcess> list = {
      {"sand",
       {"green_sand"},
       cases::Role::mould,
       20,
       80,
       0.025,
       1.5,
       "",
       10,
       "still air, 5 to 15 W/(m2 K) with radiation"},
      {"shell",
       {"ceramic_shell"},
       cases::Role::mould,
       20,
       80,
       0.0,
       0.0,
       "",
       10,
       "still air around a hot shell, beside its radiation",
       0,
       0,
       0,
       0,
       0,
       0,
       "",
       0.008,
       0.6},
      {"gravity_die",
       {"h13_tool_steel", "steel_mould"},
       cases::Role::die,
       250,
       70,
       0.02,
       1.5,
       "die_insulating_coating",
       20,
       "air and radiation of a die at 250 degC",
       5,
       5,
       15,
       5,
       15,
       300,
       "compressed air and a little water on the coating: an estimate"},
      {"high_pressure",
       {"h13_tool_steel", "steel_mould"},
       cases::Role::die,
       200,
       40,
       0.025,
       3.0,
       "high_pressure_die_spray",
       200,
       "air and cooling channels, spread over the outside: an estimate",
       0.5,
       3,
       3,
       3,
       5,
       2000,
       "water and lubricant, 500 to 10000 W/(m2 K): an estimate"}};
  return list;
}

const CastingProcess& process_named(const std::string& name) {
  for (const CastingProcess& p : casting_processes())
    if (name == p.name) return p;
  throw InputError({"--process"}, fmt::format("there is no process '{}'", name), one_of(processes(), name));
}

std::vector<std::string> processes() {
  std::vector<std::string> names;
  for (const CastingProcess& p : casting_processes()) names.emplace_back(p.name);
  return names;
}

std::string first_known(const std::vector<std::string>& names) {
  const std::vector<std::string> known = material::material_names(cases::material_folders());
  for (const std::string& name : names)
    if (std::ranges::find(known, name) != known.end()) return name;
  return names.back();
}

}  // namespace solidus::new_case
