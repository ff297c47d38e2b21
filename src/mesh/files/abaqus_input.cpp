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
    read(path, 0, false);
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
  AbaqusScope& scope() { return part_ ? *part_ : scopes_[instance_]; }
  /// The file beside the one that names it.
  std::string beside(const std::string& name) const {
    return (std::filesystem::path(at_.file).parent_path() / name).string();
  }

  void read(const std::string& path, int depth, bool only_data);
  void begin(int depth);
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
  void set_line(const AbaqusLine& line, AbaqusSet& set, bool nodes);
  void nodes_of_elements(AbaqusSet& set);
  void surface_line(const AbaqusLine& line);
  void place_instance();
  void read_system();

  /// The number of a scope by the name of an instance.
  int instance_named(const std::string& name) const;
  std::vector<NumberRange> members(const std::string& text, AbaqusSets AbaqusScope::*sets,
                                   const AbaqusLine& line);

  double unit_;
  int n_files_ = 0;
  SourceLocation at_;
  AbaqusKeyword keyword_;
  std::deque<SourceLocation> places_;  ///< of the lines of data that are kept until the keyword ends
  std::vector<AbaqusLine> lines_;
  Shape shape_ = Shape::point1;       ///< of the *ELEMENT being read
  std::vector<GlobalIndex> pending_;  ///< number and nodes of an element that is not complete

  std::deque<AbaqusScope> scopes_;  ///< the deck or its assembly, and its instances
  std::size_t instance_ = 0;        ///< the scope being read
  std::map<std::string, AbaqusScope> parts_;
  std::set<std::string> used_parts_;
  std::optional<AbaqusScope> part_;  ///< the part being read
  bool moved_ = false;               ///< whether the instance being read is not where its part is
  LocalSystem system_;               ///< of *SYSTEM
  std::map<std::string, SourceLocation> unread_;
  std::vector<std::string> notes_;
};

void Reader::read(const std::string& path, int depth, bool only_data) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw InputError({at_.file.empty() ? path : at_.file, at_.line}, at_.file.empty()
                                                                         ? "there is no such file of a mesh"
                                                                         : "there is no file '" + path + "'");
  std::ifstream file(path);
  if (!file) throw InputError({path}, "the mesh file cannot be read");
  if (depth > 20) throw InputError({path}, "*INCLUDE goes around in circles");
  if (++n_files_ > 1000) throw InputError({path}, "*INCLUDE asks for more than 1 000 files");
  const SourceLocation outer = at_;
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
    begin(depth);
  }
  at_ = outer;
}

void Reader::begin(int depth) {
  // A keyword line decides how the data lines that follow are read. Included files and parts are entered at
  // once.
  const std::string& name = keyword_.name;
  if (name == "INCLUDE") {
    read(beside(keyword_.required("INPUT")), depth + 1, false);
    return;
  }
  if (name == "PART" || name == "INSTANCE") return begin_scope();
  if (name == "END PART" || name == "END INSTANCE") return end_scope();
  // Elements need a known type; surfaces of nodes are read as sets, and combined surfaces are remembered as
  // unread.
  if (name == "ELEMENT") {
    const std::string type = upper(keyword_.required("TYPE"));
    const auto shape = shape_of_abaqus_type(type);
    if (!shape)
      fail("elements of the type '" + type + "' are not supported",
           "triangles, quads, tetrahedra and hexahedra of first and second order, trusses and beams");
    shape_ = *shape;
  } else if (name == "SURFACE") {
    keyword_.required("NAME");
    const std::string* type = keyword_.find("TYPE");
    const std::string kind = type == nullptr ? "ELEMENT" : upper(*type);
    if (kind == "NODE")
      set_of(scope().node_sets, keyword_.required("NAME"), at_);
    else if (kind != "ELEMENT" || keyword_.has("COMBINE") || keyword_.has("CROP"))
      unread_.try_emplace("SURFACE, NAME=" + keyword_.required("NAME"), at_);
    // Sets may be added to by several lines, and nodes may come from a set of elements.
  } else if (name == "NSET" || name == "ELSET") {
    AbaqusSet& set =
        set_of(name == "NSET" ? scope().node_sets : scope().element_sets, keyword_.required(name), at_);
    set.internal = set.internal || keyword_.has("INTERNAL");
    set.unsorted = set.unsorted || keyword_.has("UNSORTED");
    if (name == "NSET" && keyword_.has("ELSET")) nodes_of_elements(set);
    // What would make or move nodes cannot be left out without another mesh, so it is refused; anything else
    // that is not about the mesh is noted.
  } else if (makes_mesh_unread(name)) {
    fail("*" + name + " makes or moves nodes or elements in a way that is not read here",
         "a deck with the nodes and elements themselves, as a mesher or a pre-processor writes it");
  } else if (name != "NODE" && name != "SYSTEM" && !is_generation(name) && !says_nothing_of_mesh(name)) {
    unread_.try_emplace(name, at_);
  }
  // Coordinates in another system than Cartesian or cylindrical ones are refused.
  if (const std::string* system = keyword_.find("SYSTEM");
      name == "NODE" && system != nullptr && upper(*system) != "R" && upper(*system) != "C")
    fail("*NODE with SYSTEM=" + *system + " is not read here",
         "SYSTEM=R, or SYSTEM=C with angles in degrees");
  if ((name == "NODE" || name == "ELEMENT" || name == "NSET" || name == "ELSET") && keyword_.has("INPUT"))
    read(beside(keyword_.required("INPUT")), depth + 1, true);
}

void Reader::begin_scope() {
  if (part_ || instance_ != 0) fail("*" + keyword_.name + " stands inside of another part or instance");
  // A part is kept until instances ask for it; an instance begins as a copy of its part, which is moved at
  // its end.
  system_ = {};
  moved_ = false;
  if (keyword_.name == "PART") {
    part_.emplace();
    part_->name = keyword_.required("NAME");
    part_->at = at_;
    if (parts_.contains(upper(part_->name))) fail("there are two parts '" + part_->name + "'");
    return;
  }
  if (keyword_.has("LIBRARY"))
    fail("an *INSTANCE of a library cannot be read", "a deck that holds the part itself");
  const std::string& name = keyword_.required("NAME");
  const auto part = parts_.find(upper(keyword_.required("PART")));
  if (part == parts_.end()) fail("there is no part '" + keyword_.required("PART") + "' up to here");
  for (const AbaqusScope& other : scopes_)
    if (upper(other.name) == upper(name)) fail("there are two instances '" + name + "'");
  used_parts_.insert(part->first);
  instance_ = scopes_.size();
  scopes_.push_back(part->second);
  scopes_.back().name = name;
  scopes_.back().at = at_;
}

void Reader::end_scope() {
  if (part_) {
    std::string key = upper(part_->name);
    parts_.emplace(std::move(key), std::move(*part_));
    part_.reset();
  }
  instance_ = 0;
  system_ = {};
}

// Parts of which there is no instance: in a deck without an assembly each is there once.
void Reader::use_parts() {
  for (const auto& [key, part] : parts_) {
    if (used_parts_.contains(key)) continue;
    if (used_parts_.empty())
      scopes_.push_back(part);
    else if (!part.elements.empty())
      notes_.push_back(part.at.text() + ": the part '" + part.name +
                       "' has no *INSTANCE in the assembly and is left out");
  }
}

void Reader::data(std::string_view text) {
  const AbaqusLine line{at_, pieces(text)};
  if (line.parts.empty()) return;
  const std::string& name = keyword_.name;
  if (name == "NODE") {
    node_line(line);
  } else if (name == "ELEMENT") {
    element_line(line);
  } else if (name == "NSET") {
    set_line(line, set_of(scope().node_sets, keyword_.required("NSET"), at_), true);
  } else if (name == "ELSET") {
    set_line(line, set_of(scope().element_sets, keyword_.required("ELSET"), at_), false);
  } else if (name == "SURFACE") {
    surface_line(line);
  } else if (name == "INSTANCE" || name == "SYSTEM" || is_generation(name)) {
    places_.push_back(at_);
    lines_.push_back({places_.back(), line.parts});
  }  // the data of other keywords say nothing of the mesh, or begin() has said it
}

void Reader::end_keyword() {
  end_element();
  const std::string name = keyword_.name;
  if (is_generation(name))
    generate(keyword_, lines_, unit_, scope());
  else if (name == "INSTANCE")
    place_instance();
  else if (name == "SYSTEM")
    read_system();
  lines_.clear();
  places_.clear();
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

void Reader::set_line(const AbaqusLine& line, AbaqusSet& set, bool nodes) {
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
  if (lines_.empty()) return;
  const AbaqusLine& move = lines_[0];
  const Point shift{unit_ * move.real(0), unit_ * move.real(1), unit_ * move.real(2)};
  Point a{}, b{};
  double angle = 0;
  if (lines_.size() > 1) {
    const AbaqusLine& rotation = lines_[1];
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
  if (lines_.empty()) return;
  const AbaqusLine& first = lines_[0];
  Point a{}, b{}, c{};
  for (std::size_t i = 0; i < 3; ++i) {
    a[i] = unit_ * first.real(i);
    b[i] = unit_ * first.real(3 + i);
  }
  system_.origin = a;
  if (!first.has(3) && !first.has(4) && !first.has(5)) return;
  if (lines_.size() > 1)
    for (std::size_t i = 0; i < 3; ++i) c[i] = unit_ * lines_[1].real(i);
  const Point along = difference(b, a);
  // Without c the system is turned around the third global axis.
  const Point towards = lines_.size() > 1 ? difference(c, a) : cross_product({0, 0, 1}, along);
  const auto axes = axes_along(along, towards);
  if (!axes) first.fail("the points of *SYSTEM lie on one line", "three points that span a plane");
  system_.axes = *axes;
}

}  // namespace

RawMesh read_abaqus_input(const std::string& path, double unit_in_metres) {
  return Reader(unit_in_metres).mesh(path);
}

}  // namespace solidus::mesh
