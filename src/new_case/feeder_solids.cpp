#include "new_case/feeder_solids.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "mesh/raw_mesh.hpp"
#include "system/errors.hpp"

namespace solidus::new_case {

namespace {

/// A script of Gmsh that draws the solids one after the other, by numbers alone: nothing of a foreign file
/// gets into it, so that it may run without the checks of those.
class Script {
 public:
  void add(const DraftRiser& r) {
    const double wide = r.foot[2] + r.neck_height, top = r.foot[2] + r.height;
    const bool neck = r.neck_diameter > 0 && r.neck_diameter < r.diameter;
    if (r.neck_to) {
      const double half = std::min(0.5 * r.neck_diameter, 0.5 * r.height);
      const double z = std::clamp((*r.neck_to)[2], r.foot[2] + half, r.foot[2] + r.height - half);
      const mesh::Point& to = *r.neck_to;
      cylinder({r.foot[0], r.foot[1], z}, {to[0] - r.foot[0], to[1] - r.foot[1], to[2] - z}, r.neck_diameter);
      upright(r, r.foot[2], top, r.diameter);
      unite();
    } else if (neck) {
      upright(r, r.foot[2], wide, r.neck_diameter);
      upright(r, wide, top, r.diameter);
      unite();
    } else {
      upright(r, r.foot[2], top, r.diameter);
    }
    // The sleeve is a tube: a second cylinder of the riser's width is taken out of it, from the end of the
    // neck upwards.
    if (!(r.sleeve > 0)) return;
    upright(r, wide, top, r.diameter + 2 * r.sleeve);
    upright(r, wide, top, r.diameter);
    combine("Difference");
  }
  void add(const mesh::GatingSystem& g) {
    const double along = std::hypot(g.top[0] - g.gate[0], g.top[1] - g.gate[1]);
    const double beyond = 0.5 * std::max(g.foot_diameter, g.runner_width), floor = g.floor();
    box({g.gate[0], g.gate[1] - 0.5 * g.gate_width, floor}, {g.gate_length, g.gate_width, g.gate_height});
    box({g.gate[0] + g.gate_length, g.gate[1] - 0.5 * g.runner_width, floor},
        {along + beyond - g.gate_length, g.runner_width, g.runner_height});
    unite();
    // Ingate and runner were drawn along x.
    text_ += fmt::format("Rotate {{ {{0, 0, 1}}, {{{}}}, {:.17g} }} {{ Volume{{{}}}; }}\n",
                         place({g.gate[0], g.gate[1], floor}),
                         std::atan2(g.top[1] - g.gate[1], g.top[0] - g.gate[0]), next_ - 1);
    const mesh::Point foot{g.top[0], g.top[1], floor}, up{0, 0, g.top[2] - floor};
    // The kernel makes no cone of two equal ends.
    if (g.foot_diameter == g.top_diameter)
      cylinder(foot, up, g.top_diameter);
    else
      text_ += fmt::format("Cone({}) = {{{}, {}, {:.9g}, {:.9g}}};\n", next_++, place(foot), place(up),
                           500 * g.foot_diameter, 500 * g.top_diameter);
    unite();
  }
  void add(const DraftChill& c) {
    box(c.lowest, {c.highest[0] - c.lowest[0], c.highest[1] - c.lowest[1], c.highest[2] - c.lowest[2]});
  }
  const std::string& text() const { return text_; }

 private:
  // Lengths of the script are in millimetres, with nine digits.
  static std::string place(const mesh::Point& x) {
    return fmt::format("{:.9g}, {:.9g}, {:.9g}", 1e3 * x[0], 1e3 * x[1], 1e3 * x[2]);
  }
  void cylinder(const mesh::Point& from, const mesh::Point& along, double diameter) {
    text_ += fmt::format("Cylinder({}) = {{{}, {}, {:.9g}}};\n", next_++, place(from), place(along),
                         500 * diameter);
  }
  void box(const mesh::Point& lowest, const mesh::Point& size) {
    text_ += fmt::format("Box({}) = {{{}, {}}};\n", next_++, place(lowest), place(size));
  }
  void upright(const DraftRiser& r, double low, double high, double diameter) {
    cylinder({r.foot[0], r.foot[1], low}, {0, 0, high - low}, diameter);
  }
  void unite() { combine("Union"); }
  /// The last two solids become one.
  void combine(const char* how) {
    text_ += fmt::format("Boolean{}({}) = {{ Volume{{{}}}; Delete; }}{{ Volume{{{}}}; Delete; }};\n", how,
                         next_, next_ - 2, next_ - 1);
    ++next_;
  }

  std::string text_ = "SetFactory(\"OpenCASCADE\");\n";
  int next_ = 1;
};

}  // namespace

void write_feeder_solids(const Draft& draft, const std::filesystem::path& file) {
  if (draft.risers.empty() && draft.gatings.empty() && draft.chills.empty()) return;
  Script script;
  for (const DraftRiser& riser : draft.risers) script.add(riser);
  for (const mesh::GatingSystem& gating : draft.gatings) script.add(gating);
  for (const DraftChill& chill : draft.chills) script.add(chill);
  // The path is in quotes in the script, and a sign that ends them would let it run on as a command.
  const std::string path = std::filesystem::absolute(file).string();
  if (path.find_first_of("\"\\\n") != std::string::npos)
    throw InputError({path}, "the solids of risers cannot be written to a path with such signs",
                     "a folder without quotes and backslashes: -o FOLDER");
  // The reader runs the script, which saves the solids. As a reader answers with a mesh, the script leaves a
  // cube for that in their place, which any size of elements suits.
  const std::filesystem::path source = path + ".geo";
  std::ofstream(source) << script.text() << "Save \"" << path << "\";\n"
                        << "Recursive Delete { Volume{:}; }\nBox(1) = {0, 0, 0, 1, 1, 1};\n";
  mesh::MeshSource asked{source.string(), 1e-3, 1};
  asked.trust_script = true;
  try {
    mesh::read_mesh(asked);
  } catch (...) {
    std::filesystem::remove(source);
    throw;
  }
  std::filesystem::remove(source);
  if (!std::filesystem::exists(file))
    throw InputError({path}, "the solids of risers could not be written", "a folder that can be written to");
}

}  // namespace solidus::new_case
