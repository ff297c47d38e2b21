/// Headers of the tables of thermodynamic programs.
#pragma once

#include "input/column_table.hpp"

namespace solidus::material {

using HeaderParts = HeaderText;

/// The name of a column's quantity and its unit. JMatPro writes "Density (g/(cm)^3)-TOTAL-1.0(C/s)", the
/// quantity, the phase, and the cooling rate: of all phases it is the quantity, and "Phases wt%-LIQUID" is
/// the liquid in per cent; of one phase the name keeps that phase. Thermo-Calc writes "Density of system".
HeaderParts parts_of_header(const ColumnTable::Column& column);

}  // namespace solidus::material
