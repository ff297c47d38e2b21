// Warnings and errors that other rooms give and whoever reads the findings looks for: of reading and building
// a case, and of the run. Their numbers are written where they are compared.
#include "check/finding_family.hpp"

namespace solidus::check {

// The place of the family among the others, its search, and the rows of the reference page, whose numbers are
// the thresholds that the search compares with.
FindingFamily findings_other_rooms() {
  return {
      .name = "other rooms",
      .place = 330,
      .rows = {
          {Topic::contacts, "both surfaces of a contact are the same", "they share all their nodes", "error"},
          {Topic::contacts, "a part of the slave faces nothing",
           "less than 98 % of a slave that the case names, or half of one that the program has found, lies "
           "opposite to the master"},
          {Topic::materials, "a field of another place",
           "more than 5 % of the body lies farther than 2 % of its diagonal outside of the grid of the "
           "file that `initial_temperature` names"},
          {Topic::materials, "a property is used outside of its data",
           "by more than 5 % of their range, in the run; properties of the solid up to the solidus, in "
           "bodies that deform"},
          {Topic::pour, "a mould is removed from melt",
           "a stage ends a contact of a casting while more than 10 % of the surface there is below "
           "coherency; found when the stage begins",
           "error, warning in a run of heat alone"},
          {Topic::mesh, "far more nodes than castings have",
           "a geometry that would get some million nodes or more, reported before it is meshed; "
           "an error at once where that takes more memory than the reader may use "
           "([limits](../../SECURITY.md#the-reader))",
           "warning, error"},
          {Topic::mesh, "a body that was forgotten",
           "a group of volume elements (in a plane mesh: of surface elements) has nodes that are on no body "
           "of the case"}}};
}

}  // namespace solidus::check
