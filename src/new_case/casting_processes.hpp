/// The processes that `solidus new` knows: what the mould is made of, how it starts and how it is cooled
/// outside.
#pragma once

#include <string>
#include <vector>

#include "cases/case_spec.hpp"

namespace solidus::new_case {

struct CastingProcess {
  const char* name;
  std::vector<std::string> materials;  ///< of the mould, the first that the library has
  cases::Role mould;
  double mould_start, superheat;  ///< [°C], [K]
  double least_wall;              ///< [m]
  double walls;                   ///< thickness of the mould over that of the casting
  const char* law;                ///< of casting and mould; empty: by the materials
  double film;                    ///< outside [W/(m² K)]
  const char* film_source;
  /// Shots have stages besides solidify [s], and a spray with its film [W/(m² K)] and the source of that.
  double pour = 0, open = 0, eject = 0, spray = 0, close = 0, spray_film = 0;
  const char* spray_source = "";
  /// Of a shell: its thickness [m] and its temperature as a share of the alloy's liquidus, both in °C. A
  /// mould of this kind is an offset of the skin; `walls`, `least_wall` and `mould_start` are not used.
  double shell = 0, preheat = 0;
};

/// A dipped and stuccoed coat in the mean [m]: 6 to 10 mm in six to nine of them.
inline constexpr double k_coat_of_shell = 1.1e-3;

const std::vector<CastingProcess>& casting_processes();
/// Throws InputError with the nearest name where there is none of this name.
const CastingProcess& process_named(const std::string& name);

/// The first of these materials that the library has, else the last.
std::string first_known(const std::vector<std::string>& names);

}  // namespace solidus::new_case
