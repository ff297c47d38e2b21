/// The laws of the closed interface and of the gap that every program has, in the order of the reference
/// page.
#include "contact/laws/constant_gap.hpp"
#include "contact/laws/gas_gap.hpp"
#include "contact/laws/power_contact.hpp"
#include "contact/laws/sided_contact.hpp"
#include "contact/laws/spots_contact.hpp"
#include "contact/laws/tabulated.hpp"

namespace solidus::contact {

Kinds<ContactLaw>& contact_laws() {
  static Kinds<ContactLaw> laws = [] {
    Kinds<ContactLaw> all("law of the closed interface");
    all.add(kind_of<ContactLaw, ContactLawOf<PowerContact>>());
    all.add(kind_of<ContactLaw, ContactLawOf<SpotsContact>>());
    all.add(kind_of<ContactLaw, ContactLawOf<TableContact>>());
    all.add(kind_of<ContactLaw, ContactLawOf<SidedContact>>());
    return all;
  }();
  return laws;
}

Kinds<GapLaw>& gap_laws() {
  static Kinds<GapLaw> laws = [] {
    Kinds<GapLaw> all("law of the gap");
    all.add(kind_of<GapLaw, GapLawOf<ConstantGap>>());
    all.add(kind_of<GapLaw, GapLawOf<TableGap>>());
    all.add(kind_of<GapLaw, GapLawOf<GasGap>>());
    return all;
  }();
  return laws;
}

}  // namespace solidus::contact
