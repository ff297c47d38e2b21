/// Contact of bodies that grow: which faces of the pairs are there, and what begins at those that come.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cases/case_spec.hpp"
#include "contact/pair.hpp"
#include "coupling/state.hpp"
#include "mesh/mesh.hpp"

namespace solidus::setup {

/// Names those surfaces of a pair that have nodes of bodies that grow (ContactParameters::growing).
/// Collective.
void set_growing_surfaces(const cases::CaseSpec& spec, const mesh::Mesh& mesh,
                          contact::ContactParameters& pair);

class GrowingContacts {
 public:
  using Pairs = std::vector<std::unique_ptr<contact::ContactPair>>;
  /// Both must outlive this object. Collective.
  /// @param whole  with all elements
  GrowingContacts(const mesh::Mesh& whole, const Pairs& pairs);
  /// Brings the pairs in line with the surfaces that are there at a time. Collective.
  /// @param state  gets the history of the points that come; null: it has it, or there is none yet
  void follow(const mesh::Mesh& present, double time, coupling::State* state) const;

 private:
  /// A surface whose faces come and go; null where all of it is there.
  struct Side {
    std::string name;
    std::unique_ptr<contact::ContactSurface> faces;
  };
  struct Growing {
    std::size_t number = 0;  ///< of the pair
    Side slave, master;
  };
  Side side(const contact::ContactPair& pair, const std::string& name) const;
  std::vector<char> there(const Side& side, const mesh::Mesh& present) const;

  const mesh::Mesh& whole_;
  const Pairs& pairs_;
  std::vector<Growing> growing_;
};

}  // namespace solidus::setup
