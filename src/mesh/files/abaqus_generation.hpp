/// The keywords of Abaqus that make nodes and elements from others: *NGEN, *NFILL, *NCOPY, *ELGEN, *ELCOPY.
#pragma once

#include "mesh/files/abaqus_deck.hpp"
#include "mesh/files/abaqus_scope.hpp"

namespace solidus::mesh {

/// Whether generate() carries out this keyword.
bool is_generation(const std::string& keyword);

/// Carries out one keyword with all its lines of data. Throws InputError with the line, also for options
/// that are not read (arcs by LINE=P, bias, reflection).
/// @param unit  metres of one unit of length of the file
void generate(const AbaqusKeyword& keyword, const std::vector<AbaqusLine>& lines, double unit,
              AbaqusScope& scope);

}  // namespace solidus::mesh
