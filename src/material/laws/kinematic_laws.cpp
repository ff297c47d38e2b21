/// The list of kinematic hardening laws.
#include "material/laws/armstrong_frederick.hpp"
#include "material/laws/prager.hpp"

namespace solidus::material {
namespace {

const KinematicLawOf<NoBackStress> k_none;
const KinematicLawOf<Prager> k_prager;
const KinematicLawOf<ArmstrongFrederick> k_armstrong_frederick;

}  // namespace

// The order of KinematicHardening.
constinit LawList<KinematicLaw> detail::kinematic_list{
    "law of kinematic hardening", k_kinematic_parameters, {&k_none, &k_prager, &k_armstrong_frederick}, 3};

std::span<const KinematicLaw* const> kinematic_laws() {
  return detail::kinematic_list.all();
}
KinematicHardening add_kinematic_law(const KinematicLaw& law) {
  return static_cast<KinematicHardening>(detail::kinematic_list.add(law));
}

}  // namespace solidus::material
