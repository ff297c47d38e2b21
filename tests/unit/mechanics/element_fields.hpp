/// All fields of elements at once, by blocks, as tests compare them.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "mechanics/state/mechanical_state.hpp"

namespace solidus::test {

/// The fields of one mesh block, [element].
struct ElementFields {
  using Tensors = std::vector<std::array<double, 6>>;
  Tensors stress, strain, viscous_strain, plastic_strain, back_stress;
  std::vector<double> equivalent_plastic_strain, flow_stress, dissipation, von_mises, pressure,
      intermediate_temperature;
};

/// [block]
inline std::vector<ElementFields> element_fields(const mesh::Mesh& mesh,
                                                 const mechanics::MechanicalState& state) {
  using mechanics::ElementField;
  const std::vector<mesh::ElementBlock>& blocks = mesh.blocks;
  std::vector<ElementFields> fields(blocks.size());
  const auto take = [&](ElementField which, auto ElementFields::*member, const auto& copy) {
    const std::vector<double> values = mechanics::element_field(mesh, state, which);
    const double* from = values.data();
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      auto& to = fields[b].*member;
      to.resize(static_cast<std::size_t>(blocks[b].size()));
      for (auto& value : to) from = copy(from, value);
    }
  };
  const auto tensors = [&](ElementField which, auto member) {
    take(which, member, [](const double* from, std::array<double, 6>& to) {
      std::copy_n(from, 6, to.begin());
      return from + 6;
    });
  };
  const auto scalars = [&](ElementField which, auto member) {
    take(which, member, [](const double* from, double& to) {
      to = *from;
      return from + 1;
    });
  };
  tensors(ElementField::stress, &ElementFields::stress);
  tensors(ElementField::strain, &ElementFields::strain);
  tensors(ElementField::viscous_strain, &ElementFields::viscous_strain);
  tensors(ElementField::plastic_strain, &ElementFields::plastic_strain);
  tensors(ElementField::back_stress, &ElementFields::back_stress);
  scalars(ElementField::equivalent_plastic_strain, &ElementFields::equivalent_plastic_strain);
  scalars(ElementField::flow_stress, &ElementFields::flow_stress);
  scalars(ElementField::dissipation, &ElementFields::dissipation);
  scalars(ElementField::von_mises, &ElementFields::von_mises);
  scalars(ElementField::pressure, &ElementFields::pressure);
  scalars(ElementField::intermediate_temperature, &ElementFields::intermediate_temperature);
  return fields;
}

}  // namespace solidus::test
