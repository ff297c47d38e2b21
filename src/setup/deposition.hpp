/// Lets bodies of a case grow element by element: when each element is born, and what it brings.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cases/case_spec.hpp"
#include "coupling/growth.hpp"
#include "linear/growing_mesh.hpp"
#include "setup/growing_contacts.hpp"

namespace solidus::setup {

struct Assembly;

/// Checks what a case with depositions may have. Throws InputError.
void check_depositions(const cases::CaseSpec& spec);

/// The growth of a case's bodies. The thermal phase is made on present(), which has what is there at the
/// start.
class Deposition : public coupling::Growth {
 public:
  /// @param a  with its mesh; must outlive this object
  /// Warns of elements that are never born. Throws InputError where a deposition reaches none. Collective.
  Deposition(const cases::CaseSpec& spec, Assembly& a);

  const mesh::Mesh& present() const { return mesh_.present(); }
  /// From here on contacts have the faces that are there; those of the start are set at once. Collective.
  void begin_contacts();
  const std::vector<double>& births() const override { return mesh_.times(); }
  bool due(double time) const override;
  coupling::BodyHeat grow(double time, coupling::State* state) override;
  double mass() const override;
  bool there(std::int64_t input_element) const override { return mesh_.there(input_element); }

 private:
  const cases::CaseSpec& spec_;
  Assembly& a_;
  linear::GrowingMesh mesh_;
  std::vector<char> grows_;                    ///< [body]
  std::unique_ptr<GrowingContacts> contacts_;  ///< null before begin_contacts()
};

}  // namespace solidus::setup
