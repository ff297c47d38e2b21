/// history.csv: forces, then friction, then heat of each contact, as far as it has them, and the resultant on
/// the master. Around an axis forces balance in every radial direction, and moments altogether.
#include <array>

#include "coupling/columns.hpp"

namespace solidus::coupling {

namespace {

constexpr auto of_all = [](const HistoryPair&) { return true; };
constexpr auto with_friction = [](const HistoryPair& p) { return p.friction; };
constexpr auto with_heat = [](const HistoryPair& p) { return p.heat; };
constexpr auto with_both = [](const HistoryPair& p) { return p.friction && p.heat; };
constexpr auto around_an_axis = [](const HistoryPair& p) { return p.kind == AnalysisKind::axisymmetric; };
constexpr auto in_space = [](const HistoryPair& p) { return p.kind == AnalysisKind::solid; };
constexpr auto not_around_an_axis = [](const HistoryPair& p) { return p.kind != AnalysisKind::axisymmetric; };

constexpr auto k_pairs = std::to_array<PairColumn>({
    {{.name = "_normal_force",
      .unit = "N",
      .label = "normal force",
      .doc = "Integral of the normal pressure over the surface",
      .when = "of each contact"},
     of_all,
     [](const ContactSummary& s) { return s.force; }},
    {{.name = "_friction_force",
      .unit = "N",
      .label = "friction force",
      .doc = "Integral of the magnitude of the tangential traction",
      .when = "with friction"},
     with_friction,
     [](const ContactSummary& s) { return s.friction; }},
    {{.name = "_sticking_fraction",
      .unit = "1",
      .label = "sticking fraction",
      .doc = "Points that stick among those that touch",
      .when = "with friction"},
     with_friction,
     [](const ContactSummary& s) {
       return s.closed_points > 0 ? static_cast<double>(s.sticking_points) / s.closed_points : 0.0;
     }},
    {{.name = "_friction_dissipation",
      .unit = "J",
      .label = "friction dissipation",
      .doc = "Heat of friction since the start",
      .when = "with friction"},
     with_friction,
     [](const ContactSummary& s) { return s.dissipation; }},
    {{.name = "_conducted_heat",
      .unit = "W",
      .label = "conducted heat",
      .doc = "From slave to master by conduction and radiation",
      .when = "with heat through contact"},
     with_heat,
     [](const ContactSummary& s) { return s.heat; }},
    {{.name = "_frictional_heat",
      .unit = "W",
      .label = "frictional heat",
      .doc = "Heat of friction that enters both bodies",
      .when = "with friction and heat through contact"},
     with_both,
     [](const ContactSummary& s) { return s.heat_to_slave + s.heat_to_master; }},
    {{.name = "_heat_to_slave",
      .unit = "W",
      .label = "heat to slave",
      .doc = "Heat that enters the slave, that of friction included",
      .when = "with heat through contact"},
     with_heat,
     [](const ContactSummary& s) { return s.heat_to_slave; }},
    {{.name = "_heat_to_master",
      .unit = "W",
      .label = "heat to master",
      .doc = "Heat that enters the master, that of friction included",
      .when = "with heat through contact"},
     with_heat,
     [](const ContactSummary& s) { return s.heat_to_master; }},
    {{.name = "_force_z",
      .unit = "N",
      .label = "force z",
      .doc = "Axial force on the master",
      .when = "axisymmetric"},
     around_an_axis,
     [](const ContactSummary& s) { return s.resultant[1]; }},
    {{.name = "_force_x",
      .unit = "N",
      .label = "force x",
      .doc = "Resultant force on the master along x",
      .when = "plane strain and solid"},
     not_around_an_axis,
     [](const ContactSummary& s) { return s.resultant[0]; }},
    {{.name = "_force_y",
      .unit = "N",
      .label = "force y",
      .doc = "Resultant force on the master along y",
      .when = "plane strain and solid"},
     not_around_an_axis,
     [](const ContactSummary& s) { return s.resultant[1]; }},
    {{.name = "_force_z",
      .unit = "N",
      .label = "force z",
      .doc = "Resultant force on the master along z",
      .when = "solid"},
     in_space,
     [](const ContactSummary& s) { return s.resultant[2]; }},
    {{.name = "_moment_x",
      .unit = "N m",
      .label = "moment x",
      .doc = "Moment of the forces on the master about the origin, around x",
      .when = "solid"},
     in_space,
     [](const ContactSummary& s) { return s.moment[0]; }},
    {{.name = "_moment_y",
      .unit = "N m",
      .label = "moment y",
      .doc = "Moment of the forces on the master about the origin, around y",
      .when = "solid"},
     in_space,
     [](const ContactSummary& s) { return s.moment[1]; }},
    {{.name = "_moment_z",
      .unit = "N m",
      .label = "moment z",
      .doc = "Moment of the forces on the master about the origin, around z",
      .when = "plane strain and solid"},
     not_around_an_axis,
     [](const ContactSummary& s) { return s.moment[2]; }},
});

}  // namespace

std::span<const PairColumn> pair_columns() {
  return k_pairs;
}

ContactSummary total(const std::vector<ContactSummary>& contacts) {
  ContactSummary sum;
  for (const ContactSummary& contact : contacts) {
    sum.closed_points += contact.closed_points;
    sum.points += contact.points;
    sum.heat += contact.heat;
    sum.force += contact.force;
  }
  return sum;
}

}  // namespace solidus::coupling
