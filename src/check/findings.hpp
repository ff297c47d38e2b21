/// Findings: values of a case that are possible but not sensible, and that no check of a single key detects.
/// One file per family.
#pragma once

#include <string>
#include <vector>

#include "case/case_spec.hpp"
#include "check/case_measures.hpp"
#include "setup/assembly.hpp"

namespace solidus::model {

struct Finding {
  bool is_error = false;  ///< no sensible case looks so; else a warning
  SourceLocation where;
  std::string what;   ///< the finding, with its number
  std::string usual;  ///< the usual range, or the value that was perhaps meant
};
using Findings = std::vector<Finding>;

/// Whether a quantity is one number, everywhere and always.
inline bool is_number(const Function& f) {
  return f.place == nullptr && f.of == Argument::constant;
}

/// Whether two lists of stages have one in common; an empty list means all stages.
bool share_a_stage(const std::vector<std::string>& a, const std::vector<std::string>& b);

/// Contacts that are given twice, that no heat passes, or that are missing; films on surfaces in contact and
/// several films on one surface; conductances. Collective.
void find_in_interfaces(const CaseSpec& spec, const Assembly& a, Findings& findings);
/// Cards of the library of interface laws that were chosen by name and are for other bodies.
void find_in_interface_laws(const CaseSpec& spec, const Assembly& a, const CaseMeasures& m,
                            Findings& findings);
/// Properties that no metal, mould or gas has.
void find_in_materials(const CaseSpec& spec, const Assembly& a, Findings& findings);
/// Latent heat, strength and criteria of what freezes.
void find_in_alloys(const CaseSpec& spec, const Assembly& a, Findings& findings);
/// Pouring temperature, and bodies that are poured.
void find_in_pour(const CaseSpec& spec, const Assembly& a, Findings& findings);
/// Surroundings, coefficients and gravity; the length of the run in steps. Collective: size of the mesh.
void find_in_conditions(const CaseSpec& spec, const Assembly& a, const CaseMeasures& m, Findings& findings);

/// Bodies that overlap, share nodes or are too coarsely meshed.
void find_in_geometry(const CaseSpec& spec, const Assembly& a, const CaseMeasures& m, Findings& findings);
/// Conditions that keep a casting from freezing, runs that end before it has frozen, steps that are too long
/// for it, feeders and chills. Collective.
void find_in_freezing(const CaseSpec& spec, const Assembly& a, const CaseMeasures& m, Findings& findings);
/// Bodies that can move as a whole, at the start or in a later stage, in a direction in which neither a
/// support nor a contact holds them: whole groups of bodies, and single ones that fall. Translations alone.
/// Collective.
void find_loose_bodies(const CaseSpec& spec, const Assembly& a, const CaseMeasures& m, Findings& findings);
/// Bodies that supports keep from moving, but not from turning. Collective.
void find_turning_bodies(const CaseSpec& spec, const Assembly& a, const CaseMeasures& m, Findings& findings);
/// Parts of the skin of a casting that lie on another body where neither a contact nor a common face passes
/// heat on. Collective.
void find_bare_skins(const CaseSpec& spec, const Assembly& a, const CaseMeasures& m, Findings& findings);
/// Free skins of what is poured: those that face down while none faces up, and those that supports hold in
/// all directions. Collective.
void find_in_free_skins(const CaseSpec& spec, const Assembly& a, const CaseMeasures& m, Findings& findings);
/// Stages in which nothing cools a casting, or a part of the skin that contacts cooled. Collective.
void find_in_stages(const CaseSpec& spec, const Assembly& a, const CaseMeasures& m, Findings& findings);
/// Moulds that leave melt behind or come too late, stages of pouring in which nothing is poured, dies that
/// come back new, and searches for a periodic state in two rounds. Collective.
void find_in_leaving(const CaseSpec& spec, const Assembly& a, const CaseMeasures& m, Findings& findings);
/// Steps of stages that are too long or too short, and tables of time that count from another moment than
/// their stage.
void find_in_stage_times(const CaseSpec& spec, const Assembly& a, const CaseMeasures& m, Findings& findings);
/// Castings that shrink in elements without pores and feeding. Collective.
void find_in_elements(const CaseSpec& spec, const Assembly& a, Findings& findings);
/// Thin bodies that bend, of elements that cannot. Collective.
void find_in_bending(const CaseSpec& spec, const Assembly& a, const CaseMeasures& m, Findings& findings);
/// Supports and loads. Collective.
void find_in_mechanics(const CaseSpec& spec, const Assembly& a, const CaseMeasures& m, Findings& findings);
/// Conditions that share a surface with another one, or with a contact; castings held at both ends.
/// Collective.
void find_on_surfaces(const CaseSpec& spec, const Assembly& a, const CaseMeasures& m, Findings& findings);
/// Conditions on surfaces of which a part lies in a contact. Collective.
void find_partly_in_contact(const CaseSpec& spec, const Assembly& a, Findings& findings);
/// Iterations, cuts of the step, the search of contacts and the sizes of their faces.
void find_in_numerics(const CaseSpec& spec, const Assembly& a, const CaseMeasures& m, Findings& findings);
/// Chills, moulds, risers and criteria that do not fit what they are to the foundry.
void find_in_roles(const CaseSpec& spec, const Assembly& a, const CaseMeasures& m, Findings& findings);
/// Moulds of coating, walls of metres, and thin walls of sand that a condition holds cold. Collective.
void find_in_moulds(const CaseSpec& spec, const Assembly& a, const CaseMeasures& m, Findings& findings);
/// Risers that freeze before what they feed, stand apart, below it or are larger, cores and chills that are
/// swapped, moulds as hot as melt, sand that is too hot and moulds in kelvins, melt that does not deform
/// beside melt that does, and pressures that no sand stands. Collective.
void find_in_risers(const CaseSpec& spec, const Assembly& a, const CaseMeasures& m, Findings& findings);
/// Risers that are open beside and not on top, as gravity acts, and open ones that nothing cools. Collective.
void find_in_open_risers(const CaseSpec& spec, const Assembly& a, const CaseMeasures& m, Findings& findings);
/// Sleeves that burn: what, where and when.
void find_in_burning(const CaseSpec& spec, const Assembly& a, const CaseMeasures& m, Findings& findings);
/// Probes that measure nothing, or the other of two bodies. Collective.
void find_in_probes(const CaseSpec& spec, const Assembly& a, const CaseMeasures& m, Findings& findings);
/// Schemes whose temperatures lag where deformation takes up much of the heat. Collective.
void find_in_coupling(const CaseSpec& spec, const Assembly& a, const CaseMeasures& m, Findings& findings);
/// Bodies of a steady analysis in which nothing has a temperature of its own.
void find_in_steady(const CaseSpec& spec, const CaseMeasures& m, Findings& findings);
/// Runs that do not fit into the machine or the year, and outputs without number.
void find_in_effort(const CaseSpec& spec, const CaseMeasures& m, Findings& findings);

/// All of them, of a case that is built. Collective.
Findings findings(const CaseSpec& spec, const Assembly& a, const CaseMeasures& m);

/// Warns of the findings, once of those that several bodies or contacts share (system/alike_texts.hpp);
/// throws InputError for the first error.
void report(const Findings& findings);

}  // namespace solidus::model
