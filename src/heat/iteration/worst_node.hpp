/// Finds the node with the largest value of a quantity, for messages.
#pragma once

#include <cmath>
#include <span>
#include <string>

#include "mesh/mesh.hpp"
#include "numbers/types.hpp"

namespace solidus::heat {

/// The node where something is largest or not a number, over all processes.
struct WorstNode {
  double size = -HUGE_VAL;
  std::size_t node = 0;

  void look(std::size_t i, double value) {
    if (std::isnan(value)) value = HUGE_VAL;
    if (value <= size) return;
    size = value;
    node = i;
  }
  /// The node on the process that owns it, −1 on the others; collective.
  Index owned() const;
  /// Its number, place and values, for a message; collective.
  std::string text(const mesh::Mesh& mesh, std::span<const double> temperature,
                   std::span<const double> residual) const;
};

}  // namespace solidus::heat
