/// Expected nodes are areas and volumes over sizes; the text says what was measured so that a wrong unit is
/// seen at once.
#include "mesh/making/meshing_outlook.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "system/log.hpp"

namespace solidus::mesh {

namespace {

std::function<void(const MeshingOutlook&)> g_listener;
std::function<void(const std::string&)> g_progress;

std::string length_text(double length) {
  return length >= 1 ? fmt::format("{:.3g} m", length) : fmt::format("{:.3g} mm", 1e3 * length);
}

std::string volume_text(double volume) {
  return volume >= 1      ? fmt::format("{:.3g} m3", volume)
         : volume >= 1e-3 ? fmt::format("{:.3g} dm3", 1e3 * volume)
                          : fmt::format("{:.3g} cm3", 1e6 * volume);
}

std::string count_text(double n) {
  return n >= 1e9   ? fmt::format("{:.2g} billion", 1e-9 * n)
         : n >= 1e6 ? fmt::format("{:.2g} million", 1e-6 * n)
                    : fmt::format("{:.0f} thousand", std::ceil(1e-3 * n));
}

}  // namespace

double expected_nodes(const std::vector<SkinPiece>& skin, double volume, double largest, double growth) {
  constexpr double k_per_cube = 1.5;    // nodes of tetrahedra with edges of one length
  constexpr double k_per_square = 0.6;  // half of those of equilateral triangles: the volume counts the rest
  double area = 0;
  for (const SkinPiece& piece : skin) area += piece.area;
  if (!(area > 0)) return largest > 0 ? k_per_cube * volume / std::pow(largest, 3) : 0;
  const double depth = volume / area;  // of a wall half its thickness, as the skin lies on both of its sides
  // Edges grow with the distance from the skin until they reach the largest; nodes are the integral of their
  // density over that depth and over the rest of the wall.
  double nodes = 0;
  for (const SkinPiece& piece : skin) {
    const double s = std::min(piece.size, largest);
    const double reach = growth > 0 ? std::min(depth, (largest - s) / growth) : 0;
    const double deepest = s + growth * reach;
    const double growing = growth > 0 ? (1 / (s * s) - 1 / (deepest * deepest)) / (2 * growth) : 0;
    const double rest = (depth - reach) / std::pow(growth > 0 ? largest : s, 3);
    nodes += piece.area * (k_per_cube * (growing + rest) + k_per_square / (s * s));
  }
  return nodes;
}

std::string outlook_text(const MeshingOutlook& o) {
  const double longest = *std::ranges::max_element(o.sides), unit = longest >= 1 ? 1 : 1e-3;
  std::string text = fmt::format("{:.3g} x {:.3g} x {:.3g} {}", o.sides[0] / unit, o.sides[1] / unit,
                                 o.sides[2] / unit, longest >= 1 ? "m" : "mm");
  if (o.volume > 0) text += " and " + volume_text(o.volume);
  if (o.smallest > 0)
    text += " in elements of " +
            (o.largest > 1.01 * o.smallest ? length_text(o.smallest) + " to " : std::string()) +
            length_text(o.largest);
  if (o.nodes > 0) text += fmt::format(", some {} nodes", count_text(o.nodes));
  return text;
}

double meshing_memory(const MeshingOutlook& outlook) {
  constexpr double k_bytes = 1500;  // of a node with its tetrahedra, in Gmsh and on the way from it
  return k_bytes * outlook.nodes;
}

void listen_to_outlook(std::function<void(const MeshingOutlook&)> listener) {
  g_listener = std::move(listener);
}

void tell_outlook(const MeshingOutlook& outlook) {
  if (g_listener) g_listener(outlook);
}

void listen_to_progress(std::function<void(const std::string&)> listener) {
  g_progress = std::move(listener);
}

void tell_progress(const std::string& text) {
  if (g_progress) return g_progress(text);
  logging::info("{}", text);
}

}  // namespace solidus::mesh
