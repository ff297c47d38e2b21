/// A ball pressed on a block, both cylinders of radius and height W about the axis y, as a mesh file of Gmsh.
///
///          │ upper  ╱      upper_far on top, upper_axis, upper_face below
///   x = 0  │     _╱
///          ├───''────────  lower_face on top, lower_axis, lower_far below
///          │ lower
#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace solidus::verification {

struct BallOnBlock {
  double radius = 1;   ///< of the ball [m]
  double width = 0.2;  ///< W [m]
  int n = 32;          ///< elements along a side of the ball; the block has an eighth less across

  /// Positions fine at the contact: sinh(5 s)/sinh 5 of the width.
  double graded(double s) const { return width * std::sinh(5 * s) / std::sinh(5.0); }

  std::string mesh() const {
    const std::array names{"lower_axis", "lower_face", "lower_far", "upper_axis", "upper_face", "upper_far"};
    std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n8\n";
    for (std::size_t i = 0; i < names.size(); ++i) text += fmt::format("1 {} \"{}\"\n", i + 1, names[i]);
    text += "2 7 \"lower\"\n2 8 \"upper\"\n$EndPhysicalNames\n";
    std::string nodes, elements;
    int n_nodes = 0, n_elements = 0;
    for (const bool upper : {false, true}) {
      const int across = upper ? n : n - n / 8, first = n_nodes + 1;
      const auto node = [&](int i, int j) { return first + j * (across + 1) + i; };
      for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= across; ++i) {
          const double x = graded(1.0 * i / across), depth = graded(1.0 * j / n);
          const double arc = radius - std::sqrt(radius * radius - x * x);
          // The arc fades out towards the far face.
          const double y = upper ? depth + arc * (1 - depth / width) : -depth;
          nodes += fmt::format("{} {:.15g} {:.15g} 0\n", ++n_nodes, 1e3 * x, 1e3 * y);
        }
      const auto line = [&](int group, int a, int b) {
        elements += fmt::format("{} 1 2 {} {} {} {}\n", ++n_elements, group, group, a, b);
      };
      const int groups = upper ? 4 : 1;
      for (int j = 0; j < n; ++j) line(groups, node(0, j), node(0, j + 1));
      for (int i = 0; i < across; ++i) line(groups + 1, node(i, 0), node(i + 1, 0));
      for (int i = 0; i < across; ++i) line(groups + 2, node(i, n), node(i + 1, n));
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < across; ++i) {
          int b = node(i + 1, j), d = node(i, j + 1);
          if (!upper) std::swap(b, d);
          elements += fmt::format("{} 3 2 {} {} {} {} {} {}\n", ++n_elements, upper ? 8 : 7, upper ? 8 : 7,
                                  node(i, j), b, node(i + 1, j + 1), d);
        }
    }
    return text + fmt::format("$Nodes\n{}\n{}$EndNodes\n$Elements\n{}\n{}$EndElements\n", n_nodes, nodes,
                              n_elements, elements);
  }
};

}  // namespace solidus::verification
