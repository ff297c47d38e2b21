/// The layers of thin elements that lie in sand and other moulds that are lost, on all that is poured.
#pragma once

#include <string>
#include <vector>

#include "new_case/new_case_text.hpp"

namespace solidus::new_case {

/// A surface of a body that surrounds poured metal, on the body's own side of it.
struct HeatedWall {
  std::string surface;  ///< group of the mesh
  std::string body;     ///< name of the body whose surface it is
  std::string poured;   ///< name of the body on the other side
  double area = 0;      ///< [m²]
  double volume = 0;    ///< of `body` [m³]
};

/// How long a poured body stays liquid.
struct PouredTime {
  std::string body;
  double freezing = 0;  ///< [s]; 0: there is no estimate
  double solidus = 0;   ///< [K]
};

/// Whether bodies of a role get layers: those that conduct so badly that heat goes less than an element deep
/// into them for most of the time.
bool has_layers(cases::Role role);

/// The layers of a draft, one section for each wall, as deep as heat goes until the metal is solid: √(a t)
/// with the diffusivity a of the wall's body [m²/s] and the freezing time t of the metal [s]; less where the
/// body is thin. They grow from the wall inwards.
/// @param fineness  so many times as many layers as usual, and never fewer than usual
std::vector<DraftLayers> choose_layers(const Draft& draft, const std::vector<HeatedWall>& walls,
                                       const std::vector<PouredTime>& times, double fineness);

}  // namespace solidus::new_case
