/// One row for each process: mould, temperatures, cooling and what goes with it.
#include "new_case/casting_processes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cases/case_materials.hpp"
#include "input/keys.hpp"
#include "material/cards/library.hpp"
#include "new_case/new_case.hpp"

namespace solidus::new_case {

namespace {

/// What `new` knows of each process, temperatures in °C: the mould materials from the best known on.
const std::vector<CastingProcess> k_casting_processes = {
    {.name = "sand",
     .materials = {"green_sand"},
     .mould = cases::Role::mould,
     .mould_start = 20,
     .superheat = 80,
     .least_wall = 0.025,
     .walls = 1.5,
     .law = "",
     .film = 10,
     .film_source = "still air, 5 to 15 W/(m2 K) with radiation"},
    {.name = "shell",
     .materials = {"ceramic_shell"},
     .mould = cases::Role::mould,
     .mould_start = 20,
     .superheat = 80,
     .least_wall = 0.0,
     .walls = 0.0,
     .law = "",
     .film = 10,
     .film_source = "still air around a hot shell, in addition to its radiation",
     .shell = 0.008,
     .preheat = 0.6},
    {.name = "gravity_die",
     .materials = {"h13_tool_steel", "steel_mould"},
     .mould = cases::Role::die,
     .mould_start = 250,
     .superheat = 70,
     .least_wall = 0.02,
     .walls = 1.5,
     .law = "die_insulating_coating",
     .film = 20,
     .film_source = "air and radiation of a die at 250 degC",
     .pour = 5,
     .open = 5,
     .eject = 15,
     .spray = 5,
     .close = 15,
     .spray_film = 300,
     .spray_source = "compressed air and a little water on the coating: an estimate"},
    {.name = "high_pressure",
     .materials = {"h13_tool_steel", "steel_mould"},
     .mould = cases::Role::die,
     .mould_start = 200,
     .superheat = 40,
     .least_wall = 0.025,
     .walls = 3.0,
     .law = "high_pressure_die_spray",
     .film = 200,
     .film_source = "air and cooling channels, spread over the outside: an estimate",
     .pour = 0.5,
     .open = 3,
     .eject = 3,
     .spray = 3,
     .close = 5,
     .spray_film = 2000,
     .spray_source = "water and lubricant, 500 to 10000 W/(m2 K): an estimate"}};

}  // namespace

const std::vector<CastingProcess>& casting_processes() {
  return k_casting_processes;
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
