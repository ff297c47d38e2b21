#include "mesh/files/abaqus_input.hpp"

#include <algorithm>
#include <fstream>

#include "mesh/files/abaqus_elements.hpp"
#include "mesh/files/abaqus_generation.hpp"
#include "mesh/files/abaqus_reader.hpp"

namespace solidus::mesh {

void AbaqusReader::read(const std::string& path, bool only_data) {
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
struct AbaqusReader::Handling {
  std::string_view keyword;
  void (AbaqusReader::*begin)() = nullptr;
  void (AbaqusReader::*data)(const AbaqusLine& line) = nullptr;
  void (AbaqusReader::*end)() = nullptr;
};

const AbaqusReader::Handling* AbaqusReader::handling() const {
  static constexpr Handling k_handlings[] = {
      {"INCLUDE", &AbaqusReader::include},
      {"PART", &AbaqusReader::begin_scope},
      {"INSTANCE", &AbaqusReader::begin_scope, &AbaqusReader::keep_line, &AbaqusReader::place_instance},
      {"END PART", &AbaqusReader::end_scope},
      {"END INSTANCE", &AbaqusReader::end_scope},
      {"NODE", &AbaqusReader::begin_nodes, &AbaqusReader::node_line},
      {"ELEMENT", &AbaqusReader::begin_elements, &AbaqusReader::element_line},
      {"NSET", &AbaqusReader::begin_set, &AbaqusReader::set_line},
      {"ELSET", &AbaqusReader::begin_set, &AbaqusReader::set_line},
      {"SURFACE", &AbaqusReader::begin_surface, &AbaqusReader::surface_line},
      {"SYSTEM", nullptr, &AbaqusReader::keep_line, &AbaqusReader::read_system},
  };
  static constexpr Handling k_generation{"", nullptr, &AbaqusReader::keep_line,
                                         &AbaqusReader::end_generation};
  for (const Handling& one : k_handlings)
    if (one.keyword == keyword_.name) return &one;
  return is_generation(keyword_.name) ? &k_generation : nullptr;
}

void AbaqusReader::begin() {
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

void AbaqusReader::include() {
  read(beside(keyword_.required("INPUT")), false);
}

/// Lines of data may be in a file of their own.
void AbaqusReader::read_input() {
  if (keyword_.has("INPUT")) read(beside(keyword_.required("INPUT")), true);
}

/// Coordinates in another system than Cartesian or cylindrical ones are refused.
void AbaqusReader::begin_nodes() {
  if (const std::string* system = keyword_.find("SYSTEM");
      system != nullptr && upper(*system) != "R" && upper(*system) != "C")
    fail("*NODE with SYSTEM=" + *system + " is not read here",
         "SYSTEM=R, or SYSTEM=C with angles in degrees");
  read_input();
}

void AbaqusReader::begin_elements() {
  const std::string type = upper(keyword_.required("TYPE"));
  const auto shape = shape_of_abaqus_type(type);
  if (!shape)
    fail("elements of the type '" + type + "' are not supported",
         "triangles, quads, tetrahedra and hexahedra of first and second order, trusses and beams");
  shape_ = *shape;
  read_input();
}

/// Surfaces of nodes are read as sets, and combined surfaces are remembered as unread.
void AbaqusReader::begin_surface() {
  keyword_.required("NAME");
  const std::string* type = keyword_.find("TYPE");
  const std::string kind = type == nullptr ? "ELEMENT" : upper(*type);
  if (kind == "NODE")
    set_of(scope().node_sets, keyword_.required("NAME"), at_);
  else if (kind != "ELEMENT" || keyword_.has("COMBINE") || keyword_.has("CROP"))
    unread_.try_emplace("SURFACE, NAME=" + keyword_.required("NAME"), at_);
}

AbaqusSet& AbaqusReader::set_of_keyword() {
  const std::string& name = keyword_.name;
  return set_of(name == "NSET" ? scope().node_sets : scope().element_sets, keyword_.required(name), at_);
}

/// Sets may be added to by several lines, and nodes may come from a set of elements.
void AbaqusReader::begin_set() {
  AbaqusSet& set = set_of_keyword();
  set.internal = set.internal || keyword_.has("INTERNAL");
  set.unsorted = set.unsorted || keyword_.has("UNSORTED");
  if (keyword_.name == "NSET" && keyword_.has("ELSET")) nodes_of_elements(set);
  read_input();
}

void AbaqusReader::begin_scope() {
  if (parts_.open || instance_ != 0) fail("*" + keyword_.name + " is inside of another part or instance");
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

void AbaqusReader::end_scope() {
  if (parts_.open) {
    std::string key = upper(parts_.open->name);
    parts_.all.emplace(std::move(key), std::move(*parts_.open));
    parts_.open.reset();
  }
  instance_ = 0;
  system_ = {};
}

// Parts of which there is no instance: in a deck without an assembly each is there once.
void AbaqusReader::use_parts() {
  for (const auto& [key, part] : parts_.all) {
    if (parts_.used.contains(key)) continue;
    if (parts_.used.empty())
      scopes_.push_back(part);
    else if (!part.elements.empty())
      notes_.push_back(part.at.text() + ": the part '" + part.name +
                       "' has no *INSTANCE in the assembly and is left out");
  }
}

void AbaqusReader::data(std::string_view text) {
  const AbaqusLine line{at_, pieces(text)};
  // The data of other keywords say nothing of the mesh, or begin() has said it.
  const Handling* known = handling();
  if (!line.parts.empty() && known != nullptr && known->data != nullptr) (this->*known->data)(line);
}

void AbaqusReader::keep_line(const AbaqusLine& line) {
  kept_.places.push_back(at_);
  kept_.lines.push_back({kept_.places.back(), line.parts});
}

void AbaqusReader::end_generation() {
  generate(keyword_, kept_.lines, unit_, scope());
}

void AbaqusReader::end_keyword() {
  end_element();
  if (const Handling* known = handling(); known != nullptr && known->end != nullptr) (this->*known->end)();
  kept_ = {};
  keyword_ = {};
}

RawMesh read_abaqus_input(const std::string& path, double unit_in_metres) {
  return AbaqusReader(unit_in_metres).mesh(path);
}

}  // namespace solidus::mesh
