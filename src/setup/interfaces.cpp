#include "setup/interfaces.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "cases/case_materials.hpp"
#include "cases/interface_library.hpp"
#include "cases/roles.hpp"
#include "contact/points/parameters.hpp"
#include "material/cards/library.hpp"
#include "mesh/surfaces/face_rules.hpp"
#include "mesh/surfaces/skin.hpp"
#include "numbers/index_casts.hpp"
#include "system/log.hpp"

namespace solidus::setup {

namespace {

using mesh::BodyPair;

int number_of(const cases::CaseSpec& spec, const std::string& body) {
  const auto found = std::ranges::find(spec.bodies, body, &cases::BodySpec::name);
  return static_cast<int>(found - spec.bodies.begin());
}

BodyPair pair_of(const cases::CaseSpec& spec, const cases::BodyInterfaceSpec& i) {
  const int a = number_of(spec, i.bodies[0]), b = number_of(spec, i.bodies[1]);
  return {std::min(a, b), std::max(a, b)};
}

/// Roles of the bodies whose materials can be read; load_materials() reports those that cannot.
std::vector<cases::Role> roles_of(const cases::CaseSpec& spec) {
  std::vector<cases::Role> roles;
  for (const cases::BodySpec& body : spec.bodies)
    roles.push_back(
        cases::role_of(body, material::find_material(body.material, cases::material_folders(), body.where)));
  return roles;
}

/// The bodies whose skins a contact of the user joins.
std::set<BodyPair> pairs_with_contacts(const cases::CaseSpec& spec, const mesh::RawMesh& mesh) {
  std::set<BodyPair> pairs;
  std::vector<std::set<Index>> nodes(spec.bodies.size());
  if (spec.contacts.empty()) return pairs;
  for (std::size_t b = 0; b < spec.bodies.size(); ++b)
    for (const mesh::RawBlock& block : mesh.groups.at(spec.bodies[b].mesh_group()).blocks)
      nodes[b].insert(block.nodes.begin(), block.nodes.end());
  for (const cases::ContactSpec& contact : spec.contacts) {
    std::array<std::set<int>, 2> of_side;
    for (std::size_t s = 0; s < 2; ++s) {
      const auto group = mesh.groups.find(contact.sides()[s]);
      if (group == mesh.groups.end()) continue;
      for (std::size_t b = 0; b < nodes.size(); ++b)
        for (const mesh::RawBlock& block : group->second.blocks)
          if (!block.nodes.empty() && nodes[b].contains(block.nodes.front()))
            of_side[s].insert(static_cast<int>(b));
    }
    for (const int a : of_side[0])
      for (const int b : of_side[1])
        if (a != b) pairs.insert({std::min(a, b), std::max(a, b)});
  }
  return pairs;
}

/// Returns the pairs of bodies, each with the section that it belongs to.
std::vector<std::pair<BodyPair, std::size_t>> wanted_pairs(const cases::CaseSpec& spec,
                                                           const mesh::RawMesh& mesh,
                                                           const std::vector<cases::Role>& roles,
                                                           const std::vector<mesh::SplitNodes>& shared) {
  std::vector<std::pair<BodyPair, std::size_t>> wanted;
  std::set<BodyPair> taken = pairs_with_contacts(spec, mesh);
  for (std::size_t i = 0; i < spec.interfaces.size(); ++i)
    if (!spec.interfaces[i].all()) {
      const BodyPair pair = pair_of(spec, spec.interfaces[i]);
      wanted.emplace_back(pair, i);
      taken.insert(pair);
    }
  const auto metal = [&](int b) { return cases::is_poured(roles[as_size(b)]); };
  // Metal that was drawn as several bodies is one where they share nodes.
  for (const mesh::SplitNodes& s : shared)
    if (metal(s.bodies.first) && metal(s.bodies.second)) taken.insert(s.bodies);
  const auto n = static_cast<int>(spec.bodies.size());
  for (std::size_t i = 0; i < spec.interfaces.size(); ++i) {
    if (!spec.interfaces[i].all()) continue;
    for (int a = 0; a < n; ++a)
      for (int b = a + 1; b < n; ++b)
        if (taken.insert({a, b}).second) wanted.emplace_back(BodyPair{a, b}, i);
  }
  return wanted;
}

std::string law_of(const cases::CaseSpec& spec, const cases::BodyInterfaceSpec& section, int a, int b,
                   cases::ContactSpec& contact) {
  // The law of heat of an interface is what the section gives, or a card of the library: that which is named,
  // or the one that fits both materials and roles best.
  if (section.heat) {
    contact.heat = section.heat;
    return "";
  }
  if (!spec.has_heat()) return "";
  const std::vector<cases::InterfaceCard> cards = cases::interface_cards();
  const std::vector<cases::Role> roles = roles_of(spec);
  const cases::BodySpec &one = spec.bodies[as_size(a)], &two = spec.bodies[as_size(b)];
  const cases::InterfaceCard* card = nullptr;
  std::vector<std::string> names;
  for (const cases::InterfaceCard& c : cards) {
    names.push_back(c.name);
    if (c.name == section.law) card = &c;
  }
  // A name that the library does not have is refused with similar ones.
  if (!section.law.empty() && card == nullptr)
    throw InputError(section.where, fmt::format("the library has no interface law '{}'", section.law),
                     one_of(names, section.law));
  if (section.law.empty())
    card = cases::best_card(cards, {one.material, roles[as_size(a)]}, {two.material, roles[as_size(b)]});
  // Without a fitting card the user has to choose.
  if (card == nullptr)
    throw InputError(
        section.where,
        fmt::format("the library has no interface law for '{}' ({}) and '{}' ({})", one.name, one.material,
                    two.name, two.material),
        "law = one of: " + fmt::format("{}", fmt::join(names, ", ")) + "; or a section [interface.heat]");
  contact.heat = card->heat;
  return card->name;
}

/// Throws InputError for a section of two bodies no faces of which face each other.
void refuse_sections_without_faces(const cases::CaseSpec& spec, const std::vector<FoundInterface>& found) {
  for (std::size_t i = 0; i < spec.interfaces.size(); ++i) {
    const cases::BodyInterfaceSpec& section = spec.interfaces[i];
    if (std::any_of(found.begin(), found.end(), [&](const FoundInterface& f) { return f.section == i; }))
      continue;
    if (!section.all())
      throw InputError(section.where,
                       fmt::format("no face of '{}' faces one of '{}'", section.bodies[0], section.bodies[1]),
                       "bodies that touch, or a larger 'distance'");
    // Pairs may all have a section or a contact of their own, as casting and die of `solidus new` have.
    if (found.empty() && spec.contacts.empty())
      logging::warn("{}: no two bodies face each other", section.where.text());
  }
}

}  // namespace

std::vector<FoundInterface> find_interfaces(const cases::CaseSpec& spec, mesh::RawMesh& mesh,
                                            const std::string& source) {
  if (spec.interfaces.empty()) return {};
  std::vector<std::string> groups, names;
  for (const cases::BodySpec& body : spec.bodies) {
    groups.push_back(body.mesh_group());
    names.push_back(body.name);
  }
  const std::vector<mesh::SplitNodes> shared = mesh::shared_by(mesh, groups);
  const std::vector<cases::Role> roles = roles_of(spec);
  const auto wanted = wanted_pairs(spec, mesh, roles, shared);
  std::set<BodyPair> apart;
  std::vector<mesh::FacingWish> wishes;
  for (const auto& [pair, section] : wanted) {
    apart.insert(pair);
    wishes.push_back({pair, spec.interfaces[section].distance.value_or(0)});
  }
  std::vector<std::string> split;
  for (const mesh::SplitNodes& s : shared)
    if (apart.contains(s.bodies))
      split.push_back(fmt::format("{} and {} ({} nodes)", names[as_size(s.bodies.first)],
                                  names[as_size(s.bodies.second)], s.nodes));
  if (!split.empty()) {
    mesh::split_nodes(mesh, groups, apart);
    logging::info("bodies that shared nodes have their own now: {}", fmt::join(split, ", "));
  }
  std::optional<mesh::HalfSpace> cut;
  if (spec.mesh.symmetry) cut = {spec.mesh.symmetry->axis[0] - 'x', spec.mesh.symmetry->at};
  const std::vector<mesh::Facing> facings = mesh::find_facing(mesh, groups, names, wishes, cut, source);
  // Round an axis faces are lines in the section: lengths, not areas.
  const auto size = [&](double area) {
    const bool lines = spec.analysis.kind == AnalysisKind::axisymmetric;
    return lines ? fmt::format("{:.4g} mm", 1e3 * area) : fmt::format("{:.4g} cm2", 1e4 * area);
  };
  std::vector<FoundInterface> found;
  for (const mesh::Facing& f : facings) {
    std::size_t section = 0;
    for (const auto& [pair, number] : wanted)
      if (pair == f.bodies) section = number;
    found.push_back({section, f.bodies.first, f.bodies.second, f.surface_a, f.surface_b, f.distance});
    // Faces that touch are apart by the rounding of their coordinates.
    const auto gap_in_mm = [&](double gap) { return gap < 1e-6 * f.distance ? 0.0 : 1e3 * gap; };
    logging::info(
        "interface {} / {}: {} of {} and {} of {} face each other, gap {:.2g} mm in the mean, {:.2g} mm at "
        "most (looked within {:.2g} mm)",
        names[as_size(f.bodies.first)], names[as_size(f.bodies.second)], size(f.covered_a), size(f.area_a),
        size(f.covered_b), size(f.area_b), gap_in_mm(f.mean_gap), gap_in_mm(f.largest_gap), 1e3 * f.distance);
  }
  std::vector<std::string> free;
  for (const std::string& body : names)
    if (const double area = mesh::area_of(mesh, body + "_free"); area > 0)
      free.push_back(fmt::format("{0} {1} ({0}_free)", body, size(area)));
  if (!free.empty()) logging::info("skins that face no other body: {}", fmt::join(free, ", "));
  refuse_sections_without_faces(spec, found);
  return found;
}

void add_contacts(const std::vector<FoundInterface>& found, cases::CaseSpec& spec) {
  const contact::ContactParameters usual;
  for (const FoundInterface& f : found) {
    // A contact of the usual parameters for each pair of bodies that meet; what the section of the case says
    // is in it, the law of heat by the roles of the two bodies.
    const cases::BodyInterfaceSpec& section = spec.interfaces[f.section];
    cases::ContactSpec contact;
    const std::string pair = spec.bodies[as_size(f.a)].name + "_" + spec.bodies[as_size(f.b)].name;
    contact.name = section.name.empty() || section.all() ? pair : section.name;
    contact.surfaces = {f.surface_a, f.surface_b};
    contact.stabilisation = usual.stabilisation;
    contact.gauss_degree = usual.gauss_degree;
    contact.penetration_tolerance = usual.penetration_tolerance;
    contact.touching = section.touching;
    contact.search_distance = 2 * f.distance;
    contact.wet = section.wet;
    contact.friction = section.friction;
    contact.stages = section.stages;
    contact.where = section.where;
    contact.law = law_of(spec, section, f.a, f.b, contact);
    spec.contacts.push_back(std::move(contact));
  }
}

void add_rule_groups(const cases::CaseSpec& spec, mesh::RawMesh& mesh, const std::string& source) {
  std::vector<std::string> groups, names;
  for (const cases::BodySpec& body : spec.bodies) {
    groups.push_back(body.mesh_group());
    names.push_back(body.name);
  }
  const auto point = [](const std::vector<double>& x) { return mesh::Point{x[0], x[1], x[2]}; };
  // A rule finds faces by owner, angle, direction and place; what is not given bounds nothing.
  for (const cases::MeshGroupSpec& g : spec.mesh.groups) {
    if (!g.by_rule()) continue;
    mesh::FaceRule rule;
    rule.name = g.name;
    if (!g.owner.empty()) {  // the name of the body, or that of its group
      const auto body = std::ranges::find(spec.bodies, g.owner, &cases::BodySpec::name);
      if (body == spec.bodies.end() && std::ranges::find(groups, g.owner) == groups.end())
        throw InputError({source}, fmt::format("the group '{}': there is no body '{}'", g.name, g.owner),
                         one_of(names, g.owner));
      rule.owner = body != spec.bodies.end() ? body->mesh_group() : g.owner;
    }
    rule.angle = g.angle;
    if (!g.normal.empty()) rule.normal = point(g.normal);
    if (!g.plane.empty()) rule.plane = point(g.plane);
    if (!g.nearest.empty()) rule.nearest = point(g.nearest);
    if (!g.lowest.empty()) rule.box = {point(g.lowest), point(g.highest)};
    mesh::add_faces_by_rule(mesh, groups, rule, source);
  }
}

}  // namespace solidus::setup
