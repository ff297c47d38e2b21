/// What the lines below a keyword of a deck say: nodes, elements, members of sets, faces of surfaces, where
/// an instance lies and what system its coordinates have.
#include <algorithm>
#include <cctype>
#include <cmath>

#include "mesh/files/abaqus_elements.hpp"
#include "mesh/files/abaqus_generation.hpp"
#include "mesh/files/abaqus_reader.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mesh {

namespace {

bool is_number(const std::string& text) {
  return !text.empty() && (std::isdigit(static_cast<unsigned char>(text[0])) != 0 || text[0] == '+');
}

}  // namespace

void AbaqusReader::node_line(const AbaqusLine& line) {
  if (line.parts.size() < 3) line.fail("a node needs its number and at least two coordinates");
  if (instance_ != 0 && moved_)
    line.fail("nodes inside of an *INSTANCE that is moved are not read here", "nodes in its *PART");
  const GlobalIndex number = line.integer(0);
  Point x{line.real(1), line.real(2), line.real(3)};
  if (const std::string* system = keyword_.find("SYSTEM"))
    x = rectangular(x, upper(*system) == "C" ? Coordinates::cylindrical : Coordinates::rectangular);
  for (double& c : x) c *= unit_;
  scope().add_node(number, system_.global(x), at_);
  if (const std::string* set = keyword_.find("NSET")) set_of(scope().node_sets, *set, at_).add(number);
}

void AbaqusReader::element_line(const AbaqusLine& line) {
  // The nodes of an element may go on in the next line; it is complete with all of them.
  for (std::size_t i = 0; i < line.parts.size(); ++i) pending_.push_back(line.integer(i));
  const auto nn = as_size(node_count(shape_));
  if (pending_.size() < nn + 1) return;
  if (pending_.size() > nn + 1)
    line.fail("element " + std::to_string(pending_[0]) + " has more than the " + std::to_string(nn) +
              " nodes of its type");
  AbaqusElement e{shape_, {}, pending_[0]};
  const auto order = abaqus_node_order(shape_);
  for (std::size_t a = 0; a < nn; ++a)
    e.nodes.push_back(scope().node(pending_[1 + (order.empty() ? a : as_size(order[a]))], at_));
  if (shape_ == Shape::line3) {  // trusses and beams differ in where they put the mid node
    const auto off_middle = [&](std::size_t mid) {
      double d = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const auto c = [&](std::size_t a) { return scope().x[as_size(e.nodes[a % 3])][i]; };
        d += std::abs(c(mid) - 0.5 * (c(mid + 1) + c(mid + 2)));
      }
      return d;
    };
    if (off_middle(1) < off_middle(2)) std::swap(e.nodes[1], e.nodes[2]);
  }
  if (const std::string* set = keyword_.find("ELSET")) set_of(scope().element_sets, *set, at_).add(e.number);
  scope().add_element(std::move(e), at_);
  pending_.clear();
}

int AbaqusReader::instance_named(const std::string& name) const {
  for (std::size_t s = 1; s < scopes_.size(); ++s)
    if (upper(scopes_[s].name) == upper(name)) return static_cast<int>(s);
  fail("there is no instance '" + name + "' up to here");
}

/// A number, the name of a set, or either behind the name of its instance: "part-1.17", "part-1.left".
std::vector<NumberRange> AbaqusReader::members(const std::string& text, AbaqusSets AbaqusScope::*sets,
                                               const AbaqusLine& line) {
  int of = 0;
  if (const std::string* instance = keyword_.find("INSTANCE")) of = instance_named(*instance);
  std::string member = text;
  const auto own = [&](const std::string& name) {
    const AbaqusSets& there = of == 0 ? scope().*sets : scopes_[as_size(of)].*sets;
    const auto set = there.find(upper(name));
    return set == there.end() ? nullptr : &set->second;
  };
  const std::size_t dot = text.find('.');
  if (!is_number(text) && dot != std::string::npos && own(text) == nullptr) {
    of = instance_named(text.substr(0, dot));
    member = std::string(trimmed(std::string_view(text).substr(dot + 1)));
  }
  if (is_number(member)) {
    const GlobalIndex n = AbaqusLine{line.at, {member}}.integer(0);
    return {{of, n, n, 1}};
  }
  const AbaqusSet* set = own(member);
  if (set == nullptr) line.fail("there is no set '" + text + "' up to here");
  std::vector<NumberRange> ranges = set->ranges;
  for (NumberRange& r : ranges)
    if (r.scope == 0) r.scope = of;
  return ranges;
}

void AbaqusReader::set_line(const AbaqusLine& line) {
  AbaqusSet& set = set_of_keyword();
  const bool nodes = keyword_.name == "NSET";
  if (keyword_.has("GENERATE")) {
    if (line.parts.size() < 2) line.fail("GENERATE needs the first and the last number");
    const GlobalIndex first = line.integer(0), last = line.integer(1), step = line.integer(2, 1);
    if (step < 1 || last < first) line.fail("GENERATE needs rising numbers and a step of at least one");
    const std::string* instance = keyword_.find("INSTANCE");
    set.ranges.push_back({instance == nullptr ? 0 : instance_named(*instance), first, last, step});
    return;
  }
  AbaqusSets AbaqusScope::*kind = nodes ? &AbaqusScope::node_sets : &AbaqusScope::element_sets;
  for (const std::string& part : line.parts) {
    if (part.empty()) continue;
    for (const NumberRange& r : members(part, kind, line))
      if (r.first == r.last)
        set.add(r.first, r.scope);
      else
        set.ranges.push_back(r);
  }
}

/// *NSET, ELSET=…: the nodes of the elements of a set.
void AbaqusReader::nodes_of_elements(AbaqusSet& set) {
  const AbaqusLine line{at_, {}};
  std::set<std::pair<int, GlobalIndex>> numbers;
  for (const NumberRange& r : members(keyword_.required("ELSET"), &AbaqusScope::element_sets, line)) {
    const AbaqusScope& of = r.scope == 0 ? scope() : scopes_[as_size(r.scope)];
    for (const AbaqusElement& e : of.elements)
      if (e.number >= r.first && e.number <= r.last && (e.number - r.first) % r.step == 0)
        for (const Index n : e.nodes) numbers.insert({r.scope, of.node_number[as_size(n)]});
  }
  for (const auto& [of, number] : numbers) set.add(number, of);
}

void AbaqusReader::surface_line(const AbaqusLine& line) {
  const std::string* type = keyword_.find("TYPE");
  const std::string kind = type == nullptr ? "ELEMENT" : upper(*type);
  if (kind == "NODE") {
    AbaqusSet& set = set_of(scope().node_sets, keyword_.required("NAME"), at_);
    for (const NumberRange& r : members(line.parts[0], &AbaqusScope::node_sets, line))
      set.ranges.push_back(r);
    return;
  }
  if (kind != "ELEMENT" || keyword_.has("COMBINE") || keyword_.has("CROP")) return;  // begin() has said it
  if (line.parts.size() < 2) line.fail("a surface needs a face for every element or set: 'part, S1'");
  AbaqusSurface& surface = scope().surfaces[upper(keyword_.required("NAME"))];
  if (surface.name.empty()) surface.name = keyword_.required("NAME");
  surface.faces.push_back(
      {members(line.parts[0], &AbaqusScope::element_sets, line), upper(line.parts[1]), at_});
}

// Abaqus Keywords Reference Guide, *INSTANCE: first the translation, then the rotation about the line ab.
void AbaqusReader::place_instance() {
  if (kept_.lines.empty()) return;
  const AbaqusLine& move = kept_.lines[0];
  const Point shift{unit_ * move.real(0), unit_ * move.real(1), unit_ * move.real(2)};
  Point a{}, b{};
  double angle = 0;
  if (kept_.lines.size() > 1) {
    const AbaqusLine& rotation = kept_.lines[1];
    for (std::size_t i = 0; i < 3; ++i) {
      a[i] = unit_ * rotation.real(i);
      b[i] = unit_ * rotation.real(3 + i);
    }
    angle = rotation.real(6);
    if (angle != 0 && length_of(difference(b, a)) == 0)
      rotation.fail("the instance turns around a line of no length");
  }
  moved_ = length_of(shift) > 0 || angle != 0;
  for (Point& x : scope().x) {
    for (std::size_t i = 0; i < 3; ++i) x[i] += shift[i];
    if (angle != 0) x = turned(x, a, b, angle).value();
  }
}

// An origin a, a point b on the first axis and a point c in the plane of the first two.
void AbaqusReader::read_system() {
  system_ = {};
  if (kept_.lines.empty()) return;
  const AbaqusLine& first = kept_.lines[0];
  Point a{}, b{}, c{};
  for (std::size_t i = 0; i < 3; ++i) {
    a[i] = unit_ * first.real(i);
    b[i] = unit_ * first.real(3 + i);
  }
  system_.origin = a;
  if (!first.has(3) && !first.has(4) && !first.has(5)) return;
  if (kept_.lines.size() > 1)
    for (std::size_t i = 0; i < 3; ++i) c[i] = unit_ * kept_.lines[1].real(i);
  const Point along = difference(b, a);
  // Without c the system is turned around the third global axis.
  const Point towards = kept_.lines.size() > 1 ? difference(c, a) : cross_product({0, 0, 1}, along);
  const auto axes = axes_along(along, towards);
  if (!axes) first.fail("the points of *SYSTEM lie on one line", "three points that span a plane");
  system_.axes = *axes;
}

}  // namespace solidus::mesh
