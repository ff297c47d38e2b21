/// Makes conditions of heat of the sources that travel.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cases/case_spec.hpp"
#include "heat/loads/thermal_conditions.hpp"
#include "input/travel_path.hpp"

namespace solidus::setup {

/// Checks shapes, paths and what the analysis can do with them. Throws InputError.
void check_sources(const cases::CaseSpec& spec);
/// Checks a path, its file included. Throws InputError.
/// @param owner  for messages: "the source 'torch'"
void check_path(const cases::PathSpec& path, const std::string& owner, const SourceLocation& where,
                int dimension);
/// A path that has been checked, read from its file or made of its line. Throws InputError at `where`.
TravelPath travel_path(const cases::PathSpec& path, int dimension, const SourceLocation& where);
/// The shape of a source with all that it leaves open.
heat::TravellingShape travelling_shape(const cases::SourceSpec& source, int dimension);
/// Adds a source for each of their bodies, a flux for each of their surfaces.
void add_sources(const cases::CaseSpec& spec, heat::ThermalConditions& conditions);
/// The times in (from, to) at which a source is switched or turns, rising: steps end there.
std::vector<double> source_times(const cases::SourceSpec& source, int dimension, double from, double to);

}  // namespace solidus::setup
