/// Meshes of triangles on a grid of squares, two bodies with nodes of their own, in Gmsh's format 2.2 [mm].
#pragma once

#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace solidus::testing {

/// Bodies 1 'cast' and 2 'die'; lines 'c_skin' and 'd_in' that face each other, 'd_out', and on planes of
/// symmetry or supports 'cx', 'cy', 'dx', 'dy'.
class TriangleGrid {
 public:
  enum Group { cast = 1, die, c_skin, d_in, d_out, cx, cy, dx, dy };
  enum class Diagonal { rising, falling };

  /// @param h  the side of a square [mm]
  explicit TriangleGrid(double h) : h_(h) {}

  /// The square from (i, j) to (i + 1, j + 1) as two triangles.
  void square(Group body, int i, int j, Diagonal diagonal = Diagonal::rising) {
    const int p = node(body, i, j), q = node(body, i + 1, j), r = node(body, i + 1, j + 1),
              s = node(body, i, j + 1);
    if (diagonal == Diagonal::rising) {
      triangles_.push_back({body, {p, q, r}});
      triangles_.push_back({body, {p, r, s}});
    } else {
      triangles_.push_back({body, {p, q, s}});
      triangles_.push_back({body, {q, r, s}});
    }
  }
  /// A line of a body from (i, j) to (k, l), with the body on its left.
  void line(Group group, Group body, int i, int j, int k, int l) {
    lines_.push_back({group, {node(body, i, j), node(body, k, l)}});
  }
  /// The same where the casting meets the die: one line of each.
  void wall(int i, int j, int k, int l) {
    line(c_skin, cast, i, j, k, l);
    line(d_in, die, k, l, i, j);
  }

  std::string text() const {
    std::ostringstream out;
    out.precision(17);
    out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n9\n2 1 \"cast\"\n2 2 \"die\"\n"
           "1 3 \"c_skin\"\n1 4 \"d_in\"\n1 5 \"d_out\"\n1 6 \"cx\"\n1 7 \"cy\"\n1 8 \"dx\"\n1 9 \"dy\"\n"
           "$EndPhysicalNames\n$Nodes\n"
        << places_.size() << "\n";
    for (std::size_t i = 0; i < places_.size(); ++i)
      out << i + 1 << " " << places_[i].first << " " << places_[i].second << " 0\n";
    out << "$EndNodes\n$Elements\n" << lines_.size() + triangles_.size() << "\n";
    int n = 0;
    for (const auto* list : {&lines_, &triangles_})
      for (const Element& e : *list) {
        out << ++n << (list == &lines_ ? " 1 2 " : " 2 2 ") << e.group << " " << e.group;
        for (const int v : e.nodes) out << " " << v;
        out << "\n";
      }
    out << "$EndElements\n";
    return out.str();
  }

 private:
  struct Element {
    int group;
    std::vector<int> nodes;
  };

  int node(Group body, int i, int j) {
    const auto [found, fresh] =
        number_[body == cast ? 0 : 1].try_emplace({i, j}, static_cast<int>(places_.size()) + 1);
    if (fresh) places_.emplace_back(i * h_, j * h_);
    return found->second;
  }

  double h_;
  std::map<std::pair<long, long>, int> number_[2];
  std::vector<std::pair<double, double>> places_;
  std::vector<Element> lines_, triangles_;
};

}  // namespace solidus::testing
