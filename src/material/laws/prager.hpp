/// No back stress, and one that is never recalled: q = ⅔ K ε^vp (monograph 2.59b; Prager 1956).
#pragma once

#include <string_view>

namespace solidus::material {

struct NoBackStress {
  static constexpr std::string_view name = "none", equation = "q = 0";
};

struct Prager {
  static constexpr std::string_view name = "linear", equation = "dq = 2/3 K d(eps_vp) (2.59b; Prager)";
};

}  // namespace solidus::material
