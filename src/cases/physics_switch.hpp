/// One case for heat alone and for heat coupled with mechanics: `--heat-only` and `--coupled`.
#pragma once

#include <string>

#include "cases/case_spec.hpp"
#include "input/document.hpp"

namespace solidus::cases {

/// Sets analysis.physics of a case as it is written, before its defaults are filled in, and takes out what
/// does not apply then. For heat alone: [mechanics], [dynamics], [coupling], mechanical conditions, friction,
/// wear and stored heat of contacts, contacts through which no heat passes, physics and velocities of bodies,
/// limits of steps by displacement, and fields, probes and columns of mechanics.
/// Heat and mechanics need nothing taken out.
/// @return  a line that names what was left out; empty: nothing was
std::string switch_physics(Value& document, Physics physics);

}  // namespace solidus::cases
