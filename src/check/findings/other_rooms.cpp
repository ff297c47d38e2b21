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
      .rows = {{Topic::contacts, "the surfaces of a contact are one", "they share all their nodes", "error"},
               {Topic::contacts, "a part of the slave faces nothing",
                "less than 98 % of a slave that the case names, or half of one that the program has found, "
                "has a partner"},
               {Topic::materials, "a field of another place",
                "more than 5 % of the body lies farther than 2 % of its diagonal outside of the grid of the "
                "file that `initial_temperature` names"},
               {Topic::materials, "a property is used outside of its data",
                "by more than 5 % of their range, in the run; properties of the solid up to the solidus, in "
                "bodies that deform"},
               {Topic::pour, "a mould leaves melt",
                "a stage frees a casting of a contact while more than 10 % of the skin there is below "
                "coherency; found when the stage begins",
                "error, warning in a run of heat alone"},
               {Topic::mesh, "far more nodes than castings have",
                "a geometry that is to be meshed with some million nodes or more, said before it is meshed; "
                "an error at once where that takes more memory than the reader may use "
                "([limits](../../SECURITY.md#the-reader))",
                "warning, error"},
               {Topic::mesh, "a body that was forgotten",
                "a group of the mesh of full dimension has nodes on no body of the case"}}};
}

}  // namespace solidus::check
