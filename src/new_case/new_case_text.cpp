/// Sections of the case file as commented text.
#include "new_case/new_case_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cases/roles.hpp"
#include "new_case/draft_layers.hpp"
#include "new_case/rounding.hpp"

namespace solidus::new_case {

namespace {

constexpr double k_film_of_die = 20;  ///< air and radiation [W/(m² K)]

std::string mm(double metres) {
  return fmt::format("\"{:.6g} mm\"", 1e3 * metres);
}

/// A TOML text with its quotes.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

std::string place_text(const mesh::Point& x) {
  return fmt::format("[{}, {}, {}]", mm(x[0]), mm(x[1]), mm(x[2]));
}

std::string riser_text(const DraftRiser& r) {
  std::string t = "[[mesh.riser]]";
  if (r.modulus > 0 && r.hot_spot)
    t += fmt::format("   # for the hot spot at ({:.4g}, {:.4g}, {:.4g}) mm, of a modulus of {:.3g} mm",
                     1e3 * (*r.hot_spot)[0], 1e3 * (*r.hot_spot)[1], 1e3 * (*r.hot_spot)[2], 1e3 * r.modulus);
  t += fmt::format("\nname = {}\nfoot = {}\ndiameter = {}\nheight = {}\n", quoted(r.name), place_text(r.foot),
                   mm(r.diameter), mm(r.height));
  if (r.neck_diameter > 0) t += fmt::format("neck_diameter = {}\n", mm(r.neck_diameter));
  if (r.neck_height > 0) t += fmt::format("neck_height = {}\n", mm(r.neck_height));
  if (r.neck_to) t += fmt::format("neck_to = {}\n", place_text(*r.neck_to));
  if (r.sleeve > 0) t += fmt::format("sleeve = {}\n", mm(r.sleeve));
  return t + "\n";
}

std::string gating_text(const mesh::GatingSystem& g) {
  return fmt::format(
      "[[mesh.gating]]   # ingate, runner and sprue, in one body\nname = {}\ngate = {}\n"
      "gate_size = [{}, {}]     # width and height\ngate_length = {}\nrunner_size = [{}, {}]\n"
      "sprue = {}   # the middle of its top\nfoot_diameter = {}\ntop_diameter = {}\n\n",
      quoted(g.name), place_text(g.gate), mm(g.gate_width), mm(g.gate_height), mm(g.gate_length),
      mm(g.runner_width), mm(g.runner_height), place_text(g.top), mm(g.foot_diameter), mm(g.top_diameter));
}

/// Sizes of elements in what is poured, and how they grow in what surrounds it.
std::string element_size_text(const Draft& d, const DraftBody& b) {
  // Behind layers of sand elements that grow fast would take up too much heat.
  constexpr double k_growth_of_sand = 0.2, k_growth = 0.6;
  if (cases::is_poured(b.role)) {
    // A riser that is put onto the part has four elements across, or its freezing is that of the mesh.
    const auto riser = std::ranges::find(d.risers, b.group, &DraftRiser::name);
    double most = riser == d.risers.end() ? d.size : two_digits(riser->diameter / 4);
    // Gating has two elements through its thinnest section.
    if (const auto gating = std::ranges::find(d.gatings, b.group, &mesh::GatingSystem::name);
        gating != d.gatings.end())
      most = two_digits(std::min({gating->gate_width, gating->gate_height, gating->runner_width,
                                  gating->runner_height, gating->foot_diameter, gating->top_diameter}) /
                        2);
    return fmt::format(
        "[[mesh.size]]\nbody = {}\nsize = {}\nsmallest = {}\nacross = 2    # through a wall\n\n",
        quoted(b.group), mm(std::min(d.size, most)), mm(std::min(d.smallest, most)));
  }
  return fmt::format(
      "[[mesh.size]]\nbody = {}\nsize = {}\nacross = 0\ngrowth = {}  # away from the metal\n\n",
      quoted(d.shell && b.group == d.shell->name ? d.mould->name : b.group), mm(d.mould_size),
      has_layers(b.role) ? k_growth_of_sand : k_growth);
}

/// The block around the parts, and the shell out of which it is cut.
std::string mould_text(const Draft& d) {
  std::string t;
  if (d.mould) {
    const auto& w = d.mould->walls;
    const bool even = std::all_of(w.begin(), w.end(), [&](double x) { return x == w[0]; });
    t += fmt::format("[mesh.mould]   # a block around the parts{}\nname = {}\nwalls = ",
                     d.shell ? ", out of which the shell is cut" : "", quoted(d.mould->name));
    t += even ? mm(w[0]) + "\n\n"
              : fmt::format(
                    "[{}, {}, {}, {}, {}, {}]   # lowest and highest x, y, z; 0: the parts end there\n\n",
                    mm(w[0]), mm(w[1]), mm(w[2]), mm(w[3]), mm(w[4]), mm(w[5]));
  }
  if (d.shell)
    t += fmt::format(
        "[[mesh.coat]]   # more of them from the metal outward: a face coat of another ceramic, a back-up\n"
        "name = {}\nthickness = {}\n\n",
        quoted(d.shell->name), mm(d.shell->thickness));
  return t;
}

std::string mesh_text(const Draft& d) {
  // The file and its unit, and the way of meshing that was found best.
  std::string t = fmt::format("[mesh]\nfile = {}\n", quoted(d.geometry.filename().string()));
  if (!d.unit.empty()) t += fmt::format("unit = {}\n", quoted(d.unit));
  if (d.way > 0)
    t += fmt::format(
        "way = {}   # of meshing, the best of those tried; without this line all are tried again\n", d.way);
  t += "\n";
  if (d.meshed) return t + "# Elements are those of the file.\n\n";
  t += "# Elements: the largest, and the smallest in thin walls. Half the size is about eight times the "
       "time.\n";
  for (const DraftBody& b : d.bodies) t += element_size_text(d, b);
  // Block, riser, symmetry and layers, as far as the draft has them.
  t += mould_text(d);
  for (const DraftRiser& riser : d.risers) t += riser_text(riser);
  for (const mesh::GatingSystem& gating : d.gatings) t += gating_text(gating);
  for (const DraftChill& chill : d.chills)
    t += fmt::format(
        "[[mesh.chill]]   # what of this box is not metal\nname = {}\nlowest = {}\nhighest = {}\n\n",
        quoted(chill.name), place_text(chill.lowest), place_text(chill.highest));
  if (d.symmetry)
    t += fmt::format("[mesh.symmetry]   # the half below this plane\naxis = \"{}\"\nat = {}\n\n",
                     "xyz"[d.symmetry->axis], mm(d.symmetry->at));
  // Layers are there where heat goes less deep than the elements are long.
  if (!d.layers.empty())
    t += "# Thin elements on what is poured, as deep as heat goes until it is solid: sqrt(a t), by an "
         "estimate.\n";
  for (const DraftLayers& l : d.layers)
    t += fmt::format(
        "[[mesh.layers]]\nname = {}\nsurface = {}\nbody = {}\nnumber = {}\ngrowth = {:g}   # each is so many "
        "times as thick as the one before\nfirst = {}\n\n",
        quoted(l.name), quoted(l.surface), quoted(l.body), l.number, l.growth, mm(l.first));
  return t;
}

/// Whether a body leaves with the casting, and is new in the next shot.
bool leaves(const DraftBody& b) {
  return cases::is_poured(b.role) || b.role == cases::Role::core || b.role == cases::Role::sleeve ||
         b.role == cases::Role::insulation;
}

std::string time_text(const Draft& d) {
  // Without shots the run ends when all is solid. With them the stages of a shot are written, whose times are
  // those of the process and the estimate.
  if (!d.shots)
    return fmt::format(
        "[time]\nuntil = \"solid\"   # ends when all that was poured is; \"end\": goes on, for stress when "
        "cold\nend = \"{:g} s\"    # at the latest: six times an estimate of the time to freeze\n"
        "step = \"{:g} s\"\nadaptive = true\n\n",
        d.end, d.step);
  const DraftShots& s = *d.shots;
  std::string t =
      fmt::format("[time]\nstep = \"{:g} s\"    # the first of every stage\nadaptive = true\n\n", d.step);
  const auto stage = [&](const char* name, double duration, const char* comment) {
    t += fmt::format("[[stage]]\nname = \"{}\"\nduration = \"{:g} s\"{}{}\n", name, duration,
                     *comment != 0 ? "   # " : "", comment);
    if (duration < d.step) t += fmt::format("step = \"{:g} s\"\n", duration);
    t += "\n";
  };
  // The stages of a shot, in their order, with the durations of the process.
  stage("pour", s.pour, "the die is full at once: the flow of the metal is not computed");
  stage("solidify", s.solidify,
        "2.5 times an estimate, which knows of no gaps and of a die that is still cold");
  stage("open", s.open, "");
  stage("eject", s.eject, "the casting has gone; an estimate, like all that follow");
  stage("spray", s.spray, "");
  stage("close", s.close, "");
  return t + fmt::format(
                 "[[cycle]]   # the casting of every shot is new, the die keeps its heat\nname = \"shots\"\n"
                 "stages = [\"pour\", \"solidify\", \"open\", \"eject\", \"spray\", \"close\"]\nrepeat = {}\n"
                 "# periodic = \"1 K\"   # ends the run when the die is as warm as a shot ago, and finds "
                 "that in a "
                 "few shots\n\n",
                 s.number);
}

std::string spray_text(const Draft& d) {
  std::string t;
  for (const std::string& surface : d.cavity)
    t += fmt::format(
        "[[thermal_condition]]\nname = \"air_in_{0}\"\ngroup = \"{0}\"\nkind = \"film\"\n"
        "coefficient = \"{1:g} W/m2/K\"\nambient = \"20 degC\"\nstages = [\"eject\", \"close\"]\n\n"
        "[[thermal_condition]]   # {3}\nname = \"spray_on_{0}\"\ngroup = \"{0}\"\nkind = \"film\"\n"
        "coefficient = \"{2:g} W/m2/K\"\nambient = \"25 degC\"\nstages = \"spray\"\n\n",
        surface, 20.0, d.shots->spray_film, d.shots->spray_source);
  return t;
}

/// The group and the film of a channel.
std::string name_of(const Draft& d, const DieChannel& channel) {
  std::size_t number = 0;
  for (const DieChannel& other : d.channels) {
    if (other.die == channel.die) ++number;
    if (other == channel) break;
  }
  return fmt::format("{}_channel_{}", channel.die, number);
}

std::string channel_groups_text(const Draft& d) {
  std::string t;
  if (!d.channels.empty())
    t += "# Bores of the die that open to no cavity, each the smooth part of its skin nearest to a place.\n";
  for (const DieChannel& c : d.channels)
    t += fmt::format(
        "[[mesh.group]]   # {:.3g} mm wide, {:.3g} mm long\nname = {}\nowner = {}\nnearest = [{}, {}, "
        "{}]\n\n",
        1e3 * c.diameter, 1e3 * c.length, quoted(name_of(d, c)), quoted(c.die), mm(c.place[0]),
        mm(c.place[1]), mm(c.place[2]));
  return t;
}

std::string channel_films_text(const Draft& d) {
  std::string t;
  for (const DieChannel& c : d.channels)
    t += fmt::format(
        "[[thermal_condition]]   # taken for a cooling channel: water at {2:.2g} m/s, Dittus and Boelter\n"
        "name = \"water_in_{0}\"\ngroup = \"{0}\"\nkind = \"film\"\ncoefficient = \"{1:g} W/m2/K\"\n"
        "ambient = \"30 degC\"\n\n",
        name_of(d, c), two_digits(film_of_water(c.diameter)), speed_of_water(c.diameter));
  return t;
}

/// Radiation of a skin in addition to the film of air: of a hot shell, which sees itself and a room, and of
/// the open tops of risers and cups, where at 1500 °C it takes thirty times as much as the air. Melts of
/// iron, copper and their alloys are covered with oxide or slag, those of light metals and zinc with a thin
/// film of oxide.
std::string radiation_text(const Draft& d, const std::string& body) {
  constexpr double k_hot = 850;  // [°C]
  const bool is_shell = d.shell && body == d.shell->name;
  return fmt::format(
      "[[thermal_condition]]   # {1}\nname = \"radiation_of_{0}\"\ngroup = \"{0}_free\"\n"
      "kind = \"radiation\"\n{3}emissivity = {2:g}\nambient = \"20 degC\"\n\n",
      body,
      is_shell ? "a fired shell, which sees itself and a room: an estimate"
               : "an open top radiates: an estimate. With a cover of powder: delete this",
      is_shell || d.liquidus > k_hot ? 0.8 : 0.3, d.shell ? "radiation = \"enclosure\"\n" : "");
}

/// The film on the free skin of a body: that of the air, or for a die that casts shot after shot that of its
/// channels.
std::string film_text(const Draft& d, const std::string& body) {
  const auto found = std::ranges::find(d.bodies, body, &DraftBody::name);
  if (has_channels(d, body))
    return fmt::format(
        "[[thermal_condition]]   # air and radiation of a die at 250 degC\nname = \"air_on_{0}\"\n"
        "group = \"{0}_free\"\nkind = \"film\"\ncoefficient = \"{1:g} W/m2/K\"\nambient = \"20 degC\"\n\n",
        body, k_film_of_die);
  const bool cooled =
      d.shots && d.shots->cooling > d.film && found != d.bodies.end() && found->role == cases::Role::die;
  const std::string source =
      cooled ? fmt::format(
                   "channels and fans of the die, spread over its outside: an estimate, what keeps it "
                   "at {:g} degC in the mean",
                   found->start)
             : d.film_source;
  return fmt::format(
      "[[thermal_condition]]   # {}\nname = \"{}_{}\"\ngroup = \"{}_free\"\nkind = \"film\"\n"
      "coefficient = \"{:g} W/m2/K\"\nambient = \"20 degC\"\n\n",
      source, cooled ? "cooling_of" : "air_on", body, body, cooled ? d.shots->cooling : d.film);
}

std::string body_text(const DraftBody& b, bool shots) {
  std::string t = fmt::format("[[body]]\nname = {}\n", quoted(b.name));
  if (b.group != b.name) t += fmt::format("group = {}\n", quoted(b.group));
  t += fmt::format("role = \"{}\"\nmaterial = {}\ninitial_temperature = \"{:g} degC\"{}\n",
                   cases::name(b.role), quoted(b.material), b.start,
                   b.comment.empty() || b.heat_only ? "" : "   # " + b.comment);
  if (b.heat_only) t += fmt::format("physics = \"heat\"{}\n", b.comment.empty() ? "" : "   # " + b.comment);
  if (shots && leaves(b))
    t += "stages = [\"pour\", \"solidify\", \"open\"]   # then it leaves; the next one is new\n";
  return t + "\n";
}

/// The friction without which nothing determines where a casting lies once it has left its walls.
std::string friction_text(const Draft& d) {
  if (!d.coupled) return "\n";
  return "[interface.friction]   # holds a casting that has left its walls\n"
         "coefficient = 0.3   # an estimate: 0.1 on a coated die to 0.5 on sand\n\n";
}

std::string interface_text(const Draft& d) {
  std::string t;
  if (!d.law.empty() && d.mould)
    for (const DraftBody& b : d.bodies)
      if (cases::is_poured(b.role))
        t += fmt::format(
            "[[interface]]   # the process decides the law: {1} says where its numbers come from\n"
            "bodies = [{2}, {3}]\nlaw = \"{0}\"\n{4}",
            d.law, "interfaces/" + d.law + ".toml", quoted(b.name), quoted(d.mould->name), friction_text(d));
  t += "[[interface]]   # between all bodies that touch; laws from the library by materials and roles\n"
       "bodies = \"all\"\n";
  return t + friction_text(d);
}

}  // namespace

bool has_channels(const Draft& draft, const std::string& body) {
  return std::ranges::count(draft.channels, body, &DieChannel::die) > 0;
}

std::string case_text(const Draft& d) {
  // The case is written section by section in the order of the reference, with comments that say why a value
  // is there.
  std::string t = fmt::format(
      "# Made by `solidus new`. Change what you know better; `solidus check` reads it.\n"
      "title = {}\n\n",
      quoted(d.geometry.stem().string() + " of " + d.alloy + ", " + d.process));
  // Kind and physics, and gravity for what deforms.
  t += "[analysis]\nkind = \"solid\"\n";
  t += d.coupled ? "physics = \"thermomechanical\"   # `solidus run --heat-only` computes heat alone\n"
                 : "physics = \"heat\"   # the alloy has no elastic properties\n";
  t += "gravity = \"9.81 m/s2\"            # along -z\n\n";
  t += mesh_text(d);
  t += channel_groups_text(d);
  t += time_text(d);
  // Each body, then what joins them, then what cools them.
  for (const DraftBody& b : d.bodies) t += body_text(b, d.shots.has_value());
  t += interface_text(d);
  for (const std::string& body : d.films) {
    t += film_text(d, body);
    const auto found = std::ranges::find(d.bodies, body, &DraftBody::name);
    const bool is_open =
        found != d.bodies.end() && (found->role == cases::Role::riser || found->role == cases::Role::gating);
    if (is_open || (d.shell && body == d.shell->name)) t += radiation_text(d, body);
  }
  t += channel_films_text(d);
  if (d.shots) t += spray_text(d);
  for (const std::string& body : d.coupled ? d.symmetric : std::vector<std::string>{})
    t += fmt::format(
        "[[mechanical_condition]]\nname = \"symmetry_of_{0}\"\ngroup = \"{0}_symmetry\"\n"
        "kind = \"displacement\"\nu{1} = \"0 mm\"\n\n",
        body, "xyz"[d.symmetry->axis]);
  // Probes are at the hot spots; risers are named as feeders of the criteria.
  if (!d.hot_spots.empty()) t += "# In the centres of the largest spheres that the metal holds.\n";
  for (std::size_t i = 0; i < d.hot_spots.size(); ++i) {
    const mesh::InscribedSphere& s = d.hot_spots[i];
    t += fmt::format(
        "[[probe]]\nname = \"T_hot_spot_{}\"   # a sphere of {:.3g} mm\nkind = \"point\"\n"
        "field = \"temperature\"\nunit = \"degC\"\npoint = [{}, {}, {}]\n\n",
        i + 1, 2e3 * s.radius, mm(s.centre[0]), mm(s.centre[1]), mm(s.centre[2]));
  }
  if (std::any_of(d.bodies.begin(), d.bodies.end(),
                  [](const DraftBody& b) { return b.role == cases::Role::riser; })) {
    t += "[criteria]\nfeeders = [";
    bool first = true;
    for (const DraftBody& b : d.bodies)
      if (b.role == cases::Role::riser)
        t += fmt::format("{}{}", first ? "" : ", ", quoted(b.group)), first = false;
    t += "]\n\n";
  }
  if (d.filling) {
    t += "[filling]   # `solidus run` fills the mould first, by OpenFOAM: docs/guide/filling.md\n";
    if (d.filling->gate) t += fmt::format("gate_at = {}\n", place_text(*d.filling->gate));
    t += "cells = 10000   # a first answer; more for thin walls\n\n";
  }
  t += fmt::format("[output]\nevery = \"{:g} s\"\n", d.every);
  return t;
}

}  // namespace solidus::new_case
