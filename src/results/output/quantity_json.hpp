/// The declaration of a field (quantities/quantity.hpp) as JSON: for summary.json, the report and Python.
#pragma once

#include "quantities/quantity.hpp"
#include "results/output/json_document.hpp"

namespace solidus::results {

/// Everything but the list of needs; numbers in SI.
///
///   {"name": "niyama", "unit": "1", "root_unit": "K^0.5 s^0.5/m", "label": …, "group": "criteria",
///    "rank": "scalar", "place": "node", "no_value": 0, "written": "always", "worst": "least",
///    "headline": …, "threshold": 1, "colours": "sequential", "compared": true, "pictured": true,
///    "shown": {"unit": "K0.5 s0.5/mm", "text": "√(K s)/mm", "factor": 0.001, "offset": 0}}
///
/// without the members that a row leaves empty.
Json json(const quantities::Quantity& quantity);
/// Units that people read, by the SI unit: {"K": {"unit": "degC", "text": "°C", "factor": 1, "offset":
/// -273.15}}.
Json shown_units_json();
/// {"unit": "degC", "text": "°C", "factor": 1, "offset": -273.15}.
Json json(const quantities::ShownUnit& shown);
/// Names of units by the unit: {"m2": {"text": "m²", "measures": "Area"}}.
Json unit_names_json();

}  // namespace solidus::results
