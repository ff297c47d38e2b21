#include "mesh/files/abaqus_input.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <deque>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <set>

#include "mesh/files/abaqus_deck.hpp"
#include "mesh/files/abaqus_elements.hpp"
#include "mesh/files/abaqus_generation.hpp"
#include "mesh/files/abaqus_scope.hpp"
#include "mesh/local_system.hpp"
#include "system/errors.hpp"

namespace solidus::mesh {

namespace {

bool is_number(const std::string& text) {
  return !text.empty() && (std::isdigit(static_cast<unsigned char>(text[0])) != 0 || text[0] == '+');
}

class Reader {
 public:
  explicit Reader(double unit) : unit_(unit) { scopes_.emplace_back(); }

  RawMesh mesh(const std::string& path) {
    read(path, false);
    end_keyword();
    end_scope();
    use_parts();
    if (!unread_.empty()) {
      std::string text;
      for (const auto& [keyword, at] : unread_)
        text += (text.empty() ? "*" : ", *") + keyword + " (" + at.text() + ")";
      notes_.push_back("keywords that are not read and may say something of the mesh: " + text);
    }
    return mesh_of_scopes(path, {scopes_.begin(), scopes_.end()}, notes_);
  }

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& allowed = {}) const {
    throw InputError(at_, what, allowed);
  }
  AbaqusScope& scope() { return parts_.open ? *parts_.open : scopes_[instance_]; }
  /// The file beside the one that names it.
  std::string beside(const std::string& name) const {
    return (std::filesystem::path(at_.file).parent_path() / name).string();
  }

  struct Handling;
  /// Of the present keyword; null where it is none of those that are read.
  const Handling* handling() const;
  void read(const std::string& path, bool only_data);
  void read_input();
  void begin();
  void include();
  void begin_nodes();
  void begin_elements();
  void begin_surface();
  void begin_set();
  void begin_scope();
  void end_scope();
  void use_parts();
  void data(std::string_view line);
  void end_keyword();
  void end_element() const {
    if (!pending_.empty())
      fail("an element of " + std::to_string(node_count(shape_)) + " nodes ends after " +
           std::to_string(pending_.size() - 1));
  }
  void node_line(const AbaqusLine& line);
  void element_line(const AbaqusLine& line);
  void set_line(const AbaqusLine& line);
  void keep_line(const AbaqusLine& line);
  void end_generation();
  AbaqusSet& set_of_keyword();
  void nodes_of_elements(AbaqusSet& set);
  void surface_line(const AbaqusLine& line);
  void place_instance();
  void read_system();

  /// The number of a scope by the name of an instance.
  int instance_named(const std::string& name) const;
  std::vector<NumberRange> members(const std::string& text, AbaqusSets AbaqusScope::*sets,
                                   const AbaqusLine& line);

  struct Files {
    int count = 0, depth = 0;
  };
  /// Lines of data that are kept until the keyword ends.
  struct Kept {
    std::deque<SourceLocation> places;
    std::vector<AbaqusLine> lines;
  };
  /// The parts of a deck, and the one that is being read.
  struct Parts {
    std::map<std::string, AbaqusScope> all;
    std::set<std::string> used;
    std::optional<AbaqusScope> open;
  };

  double unit_;
  Files files_;
  SourceLocation at_;
  AbaqusKeyword keyword_;
  Kept kept_;
  Shape shape_ = Shape::point1;       ///< of the *ELEMENT being read
  std::vector<GlobalIndex> pending_;  ///< number and nodes of an element that is not complete

  std::deque<AbaqusScope> scopes_;  ///< the deck or its assembly, and its instances
  std::size_t instance_ = 0;        ///< the scope being read
  Parts parts_;
  bool moved_ = false;  ///< whether the instance being read is not where its part is
  LocalSystem system_;  ///< of *SYSTEM
  std::map<std::string, SourceLocation> unread_;
  std::vector<std::string> notes_;
};

void Reader::read(const std::string& path, bool only_data) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw InputError({at_.file.empty() ? path : at_.file, at_.line}, at_.file.empty()
                                                                         ? "there is no such file of a mesh"
                                                                         : "there is no file '" + path + "'");
  std::ifstream file(path);
  if (!file) throw InputError({path}, "the mesh file cannot be read");
  if (files_.depth > 20) throw InputError({path}, "*INCLUDE goes around in circles");
  if (++files_.count > 1000) throw InputError({path}, "*INCLUDE asks for more than 1 000 files");
  const SourceLocation outer = at_;
  ++files_.depth;
  at_ = {path, 0, 0};
  std::string line;
  while (std::getline(file, line)) {
    ++at_.line;
    if (line.find('\0') != std::string::npos) fail("this is not a text file");
    const std::string_view text = trimmed(line);
    if (text.empty() || text.starts_with("**")) continue;
    if (!text.starts_with("*")) {
      data(text);
      continue;
    }
    if (only_data) fail("a file of data holds a keyword", "lines of numbers");
    end_keyword();
    // A keyword whose line ends with a comma goes on in the next one.
    std::string whole(text);
    const SourceLocation first = at_;
    while (whole.back() == ',' && std::getline(file, line)) {
      ++at_.line;
      whole += std::string(trimmed(line));
    }
    keyword_ = parse_abaqus_keyword(whole, first);
    begin();
  }
  at_ = outer;
  --files_.depth;
}

/// What is done at the line of a keyword, with each line of its data, and at its end; null: nothing.
struct Reader::Handling {
  std::string_view keyword;
  void (Reader::*begin)() = nullptr;
  void (Reader::*data)(const AbaqusLine& line) = nullptr;
  void (Reader::*end)() = nullptr;
};

const Reader::Handling* Reader::handling() const {
  static constexpr Handling k_handlings[] = {
      {"INCLUDE", &Reader::include},
      {"PART", &Reader::begin_scope},
      {"INSTANCE", &Reader::begin_scope, &Reader::keep_line, &Reader::place_instance},
      {"END PART", &Reader::end_scope},
      {"END INSTANCE", &Reader::end_scope},
      {"NODE", &Reader::begin_nodes, &Reader::node_line},
      {"ELEMENT", &Reader::begin_elements, &Reader::element_line},
      {"NSET", &Reader::begin_set, &Reader::set_line},
      {"ELSET", &Reader::begin_set, &Reader::set_line},
      {"SURFACE", &Reader::begin_surface, &Reader::surface_line},
      {"SYSTEM", nullptr, &Reader::keep_line, &Reader::read_system},
  };
  static constexpr Handling k_generation{"", nullptr, &Reader::keep_line, &Reader::end_generation};
  for (const Handling& one : k_handlings)
    if (one.keyword == keyword_.name) return &one;
  return is_generation(keyword_.name) ? &k_generation : nullptr;
}

void Reader::begin() {
  if (const Handling* known = handling()) {
    if (known->begin != nullptr) (this->*known->begin)();
    return;
  }
  // What would make or move nodes cannot be left out without another mesh, so it is refused; anything else
  // that is not about the mesh is noted.
  if (makes_mesh_unread(keyword_.name))
    fail("*" + keyword_.name + " makes or moves nodes or elements in a way that is not read here",
         "a deck with the nodes and elements themselves, as a mesher or a pre-processor writes it");
  if (!says_nothing_of_mesh(keyword_.name)) unread_.try_emplace(keyword_.name, at_);
}

void Reader::include() {
  read(beside(keyword_.required("INPUT")), false);
}

/// Lines of data may stand in a file of their own.
void Reader::read_input() {
  if (keyword_.has("INPUT")) read(beside(keyword_.required("INPUT")), true);
}

/// Coordinates in another system than Cartesian or cylindrical ones are refused.
void Reader::begin_nodes() {
  if (const std::string* system = keyword_.find("SYSTEM");
      system != nullptr && upper(*system) != "R" && upper(*system) != "C")
    fail("*NODE with SYSTEM=" + *system + " is not read here",
         "SYSTEM=R, or SYSTEM=C with angles in degrees");
  read_input();
}

void Reader::begin_elements() {
  const std::string type = upper(keyword_.required("TYPE"));
  const auto shape = shape_of_abaqus_type(type);
  if (!shape)
    fail("elements of the type '" + type + "' are not supported",
         "triangles, quads, tetrahedra and hexahedra of first and second order, trusses and beams");
  shape_ = *shape;
  read_input();
}

/// Surfaces of nodes are read as sets, and combined surfaces are remembered as unread.
void Reader::begin_surface() {
  keyword_.required("NAME");
  const std::string* type = keyword_.find("TYPE");
  const std::string kind = type == nullptr ? "ELEMENT" : upper(*type);
  if (kind == "NODE")
    set_of(scope().node_sets, keyword_.required("NAME"), at_);
  else if (kind != "ELEMENT" || keyword_.has("COMBINE") || keyword_.has("CROP"))
    unread_.try_emplace("SURFACE, NAME=" + keyword_.required("NAME"), at_);
}

AbaqusSet& Reader::set_of_keyword() {
  const std::string& name = keyword_.name;
  return set_of(name == "NSET" ? scope().node_sets : scope().element_sets, keyword_.required(name), at_);
}

/// Sets may be added to by several lines, and nodes may come from a set of elements.
void Reader::begin_set() {
  AbaqusSet& set = set_of_keyword();
  set.internal = set.internal || keyword_.has("INTERNAL");
  set.unsorted = set.unsorted || keyword_.has("UNSORTED");
  if (keyword_.name == "NSET" && keyword_.has("ELSET")) nodes_of_elements(set);
  read_input();
}

void Reader::begin_scope() {
  if (parts_.open || instance_ != 0) fail("*" + keyword_.name + " stands inside of another part or instance");
  // A part is kept until instances ask for it; an instance begins as a copy of its part, which is moved at
  // its end.
  system_ = {};
  moved_ = false;
  if (keyword_.name == "PART") {
    parts_.open.emplace();
    parts_.open->name = keyword_.required("NAME");
    parts_.open->at = at_;
    if (parts_.all.contains(upper(parts_.open->name)))
      fail("there are two parts '" + parts_.open->name + "'");
    return;
  }
  if (keyword_.has("LIBRARY"))
    fail("an *INSTANCE of a library cannot be read", "a deck that holds the part itself");
  const std::string& name = keyword_.required("NAME");
  const auto part = parts_.all.find(upper(keyword_.required("PART")));
  if (part == parts_.all.end()) fail("there is no part '" + keyword_.required("PART") + "' up to here");
  for (const AbaqusScope& other : scopes_)
    if (upper(other.name) == upper(name)) fail("there are two instances '" + name + "'");
  parts_.used.insert(part->first);
  instance_ = scopes_.size();
  scopes_.push_back(part->second);
  scopes_.back().name = name;
  scopes_.back().at = at_;
}

void Reader::end_scope() {
  if (parts_.open) {
    std::string key = upper(parts_.open->name);
    parts_.all.emplace(std::move(key), std::move(*parts_.open));
    parts_.open.reset();
  }
  instance_ = 0;
  system_ = {};
}

// Parts of which there is no instance: in a deck without an assembly each is there once.
void Reader::use_parts() {
  for (const auto& [key, part] : parts_.all) {
    if (parts_.used.contains(key)) continue;
    if (parts_.used.empty())
      scopes_.push_back(part);
    else if (!part.elements.empty())
      notes_.push_back(part.at.text() + ": the part '" + part.name +
                       "' has no *INSTANCE in the assembly and is left out");
  }
}

void Reader::data(std::string_view text) {
  const AbaqusLine line{at_, pieces(text)};
  // The data of other keywords say nothing of the mesh, or begin() has said it.
  const Handling* known = handling();
  if (!line.parts.empty() && known != nullptr && known->data != nullptr) (this->*known->data)(line);
}

void Reader::keep_line(const AbaqusLine& line) {
  kept_.places.push_back(at_);
  kept_.lines.push_back({kept_.places.back(), line.parts});
}

void Reader::end_generation() {
  generate(keyword_, kept_.lines, unit_, scope());
}

void Reader::end_keyword() {
  end_element();
  if (const Handling* known = handling(); known != nullptr && known->end != nullptr) (this->*known->end)();
  kept_ = {};
  keyword_ = {};
}

void Reader::node_line(const AbaqusLine& line) {
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

void Reader::element_line(const AbaqusLine& line) {
  // The nodes of an element may go on in the next line; it is complete with all of them.
  for (std::size_t i = 0; i < line.parts.size(); ++i) pending_.push_back(line.integer(i));
  const auto nn = static_cast<std::size_t>(node_count(shape_));
  if (pending_.size() < nn + 1) return;
  if (pending_.size() > nn + 1)
    line.fail("element " + std::to_string(pending_[0]) + " has more than the " + std::to_string(nn) +
              " nodes of its type");
  AbaqusElement e{shape_, {}, pending_[0]};
  const auto order = abaqus_node_order(shape_);
  for (std::size_t a = 0; a < nn; ++a)
    e.nodes.push_back(
        scope().node(pending_[1 + (order.empty() ? a : static_cast<std::size_t>(order[a]))], at_));
  if (shape_ == Shape::line3) {  // trusses and beams differ in where they put the mid node
    const auto off_middle = [&](std::size_t mid) {
      double d = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const auto c = [&](std::size_t a) { return scope().x[static_cast<std::size_t>(e.nodes[a % 3])][i]; };
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

int Reader::instance_named(const std::string& name) const {
  for (std::size_t s = 1; s < scopes_.size(); ++s)
    if (upper(scopes_[s].name) == upper(name)) return static_cast<int>(s);
  fail("there is no instance '" + name + "' up to here");
}

/// A number, the name of a set, or either behind the name of its instance: "part-1.17", "part-1.left".
std::vector<NumberRange> Reader::members(const std::string& text, AbaqusSets AbaqusScope::*sets,
                                         const AbaqusLine& line) {
  int of = 0;
  if (const std::string* instance = keyword_.find("INSTANCE")) of = instance_named(*instance);
  std::string member = text;
  const auto own = [&](const std::string& name) {
    const AbaqusSets& there = of == 0 ? scope().*sets : scopes_[static_cast<std::size_t>(of)].*sets;
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

void Reader::set_line(const AbaqusLine& line) {
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
void Reader::nodes_of_elements(AbaqusSet& set) {
  const AbaqusLine line{at_, {}};
  std::set<std::pair<int, GlobalIndex>> numbers;
  for (const NumberRange& r : members(keyword_.required("ELSET"), &AbaqusScope::element_sets, line)) {
    const AbaqusScope& of = r.scope == 0 ? scope() : scopes_[static_cast<std::size_t>(r.scope)];
    for (const AbaqusElement& e : of.elements)
      if (e.number >= r.first && e.number <= r.last && (e.number - r.first) % r.step == 0)
        for (const Index n : e.nodes) numbers.insert({r.scope, of.node_number[static_cast<std::size_t>(n)]});
  }
  for (const auto& [of, number] : numbers) set.add(number, of);
}

void Reader::surface_line(const AbaqusLine& line) {
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
void Reader::place_instance() {
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
void Reader::read_system() {
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

}  // namespace

RawMesh read_abaqus_input(const std::string& path, double unit_in_metres) {
  return Reader(unit_in_metres).mesh(path);
}

}  // namespace solidus::mesh
