/// Cards are kept as they come and evaluated at the end, because systems, defaults and names may be
/// anywhere in the file.
#include "mesh/files/nastran_input.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <unordered_map>

#include "mesh/files/abaqus_elements.hpp"
#include "mesh/files/nastran_cards.hpp"
#include "mesh/files/nastran_systems.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mesh {

namespace {

struct ElementCard {
  std::string_view name;
  Shape first, second;  ///< the shape with nodes at corners, and with all of them
};
constexpr std::array k_elements{
    ElementCard{"CTETRA", Shape::tet4, Shape::tet10},
    ElementCard{"CHEXA", Shape::hex8, Shape::hex20},
    ElementCard{"CTRIA3", Shape::tri3, Shape::tri3},
    ElementCard{"CTRIAR", Shape::tri3, Shape::tri3},
    ElementCard{"CTRIA6", Shape::tri6, Shape::tri6},
    ElementCard{"CQUAD4", Shape::quad4, Shape::quad4},
    ElementCard{"CQUADR", Shape::quad4, Shape::quad4},
    ElementCard{"CQUAD8", Shape::quad8, Shape::quad8},
    ElementCard{"CPENTA", Shape::wedge6, Shape::wedge6},
    ElementCard{"CPYRAM", Shape::pyramid5, Shape::pyramid5},
    ElementCard{"CPYRA", Shape::pyramid5, Shape::pyramid5},
};

bool is_any_of(const std::string& name, std::initializer_list<std::string_view> all) {
  return std::ranges::find(all, std::string_view(name)) != all.end();
}

/// Entries of materials, properties, loads, supports, tables and solutions. Links between nodes (RBE2, MPC)
/// and contacts are not among them.
bool says_nothing(const std::string& name) {
  for (const std::string_view begin :
       {"MAT",   "PSOLID", "PSHELL", "PCOMP", "PBAR",   "PBEAM",  "PROD", "PLSOLID", "TEMP",
        "TABLE", "TLOAD",  "RLOAD",  "PLOAD", "FORCE",  "MOMENT", "GRAV", "SPC",     "EIG",
        "FREQ",  "TSTEP",  "NLPARM", "PARAM", "QBDY",   "QHBDY",  "QVOL", "CONV",    "PCONV",
        "CHBDY", "PHBDY",  "RADBC",  "RADM",  "RADSET", "VIEW",   "DAREA"})
    if (name.starts_with(begin)) return true;
  return is_any_of(name, {"LOAD", "DLOAD",  "DELAY",  "DPHASE",  "SUPORT", "ASET",    "ASET1",
                          "USET", "USET1",  "MDLPRM", "NXSTRAT", "TIC",    "PLOTEL",  "SET1",
                          "SET3", "RFORCE", "ACCEL",  "ACCEL1",  "ECHOON", "ECHOOFF", "DESVAR"});
}

class Reader {
 public:
  explicit Reader(double unit) : unit_(unit) {}

  RawMesh mesh(const std::string& path) {
    read_nastran_cards(
        path, [this](const NastranCard& card) { take(card); },
        [this](std::string_view comment) { take_name(comment); });
    place_nodes();
    make_groups(path);
    if (!unread_.empty()) {
      std::string text;
      for (const auto& [name, at] : unread_)
        text += (text.empty() ? "" : ", ") + name + " (" + at.text() + ")";
      mesh_.notes.push_back("entries that are not read and may say something of the mesh: " + text);
    }
    return std::move(mesh_);
  }

 private:
  void take(const NastranCard& card);
  void take_name(std::string_view comment);
  void take_element(const NastranCard& card, const ElementCard& kind);
  void place_nodes();
  Point place(GlobalIndex number, const NastranCard& user);
  void join_without_property();
  void make_groups(const std::string& path);

  struct Grid {
    NastranCard card;
    std::optional<Point> x;  ///< in lengths of the file
    bool being_found = false;
  };
  struct Element {
    Shape shape;
    GlobalIndex number, property;  ///< zero: the entry names none
    std::array<GlobalIndex, 20> nodes;
    SourceLocation at;
  };

  double unit_;
  NastranSystems systems_;
  std::optional<NastranCard> defaults_;  ///< GRDSET
  std::vector<Grid> grids_;
  std::unordered_map<GlobalIndex, Index> grid_at_;
  std::vector<Element> elements_;
  std::map<GlobalIndex, std::string> names_;  ///< of properties
  std::map<std::string, SourceLocation> unread_;
  RawMesh mesh_;
};

void Reader::take(const NastranCard& card) {
  // Nodes are kept as cards, since a system that moves them may come later in the file.
  const std::string& name = card.name;
  if (name == "GRID") {
    const GlobalIndex number = card.integer(0);
    if (number <= 0) card.fail("a GRID has no number above zero");
    if (!grid_at_.emplace(number, as_index(grids_.size())).second)
      card.fail("GRID " + std::to_string(number) + " is defined twice");
    grids_.push_back({card, {}, false});
    return;
  }
  if (name == "GRDSET") {
    defaults_ = card;
    return;
  }
  // Coordinate systems and elements have readers of their own; entries that would make or move nodes unseen
  // are refused, all others say nothing about the mesh.
  if (systems_.take(card)) return;
  for (const ElementCard& kind : k_elements)
    if (name == kind.name) return take_element(card, kind);
  // Elements that would be read wrongly are refused by name.
  if (is_any_of(name, {"CTRIAX", "CTRIAX6", "CQUADX", "CQUAD", "CQUAD9", "CPLSTN3", "CPLSTN4", "CPLSTN6",
                       "CPLSTN8"}))
    card.fail("elements of the type '" + name + "' are not supported",
              "CTETRA, CHEXA, CPENTA, CPYRAM, CTRIA3, CTRIA6, CQUAD4 and CQUAD8");
  if (is_any_of(name, {"CORD3G", "CORD3R", "GMCORD", "SEBULK", "SELOC", "SEMPLN", "GRIDB", "GRIDF", "GRIDS",
                       "EGRID"}))
    card.fail("the entry " + name + " makes or moves nodes in a way that is not read here",
              "GRID in systems CORD1 and CORD2");
  if (!says_nothing(name)) unread_.try_emplace(name, card.at);
}

/// "ANSA_NAME_COMMENT;7;PSOLID;casting;", "HMNAME COMP 7\"casting\"", "HMNAME PROP 7\"casting\"" and
/// " Femap Property 7 : casting".
void Reader::take_name(std::string_view comment) {
  const std::string text(comment.substr(0, comment.find_last_not_of(" \r\t") + 1));
  // Each program writes its comment in a form of its own: number and name are picked out of it.
  const auto number_in = [](const std::string& from) {
    const auto first = from.find_first_of("0123456789");
    GlobalIndex n = 0;
    for (std::size_t i = first; i < from.size() && from[i] >= '0' && from[i] <= '9' && n < 1'000'000'000; ++i)
      n = 10 * n + (from[i] - '0');
    return n;
  };
  // A name without letters, or of no property, is no name.
  const auto give = [this](GlobalIndex number, std::string name) {
    const auto first = name.find_first_not_of(' ');
    if (number > 0 && first != std::string::npos) names_[number] = name.substr(first);
  };
  // Three programs have a form of their own; any other comment says nothing.
  if (text.starts_with("ANSA_NAME_COMMENT;")) {
    std::vector<std::string> parts;
    for (std::size_t from = 0; from <= text.size();) {
      const auto end = std::min(text.find(';', from), text.size());
      parts.push_back(text.substr(from, end - from));
      from = end + 1;
    }
    if (parts.size() > 3 && (parts[2] == "PSOLID" || parts[2] == "PSHELL"))
      give(number_in(parts[1]), parts[3]);
  } else if (text.starts_with("HMNAME PROP") || text.starts_with("HMNAME COMP")) {
    const auto quote = text.find('"'), end = text.rfind('"');
    if (quote != std::string::npos && end > quote)
      give(number_in(text.substr(0, quote)), text.substr(quote + 1, end - quote - 1));
  } else if (const auto at = text.find("Femap Property "); at != std::string::npos) {
    if (const auto colon = text.find(':', at); colon != std::string::npos)
      give(number_in(text.substr(at, colon - at)), text.substr(colon + 1));
  }
}

/// Gmsh writes all nodes of a hexahedron of 27, or of elements of third order, where the format has 20 or
/// fewer. Behind the nodes of a solid nothing may come; behind those of a face comes an angle or a system,
/// but at CQUAD8, and then lengths, which are no whole numbers.
void check_no_more_nodes(const NastranCard& card, const ElementCard& kind) {
  const std::size_t all = as_size(node_count(kind.second)), behind = 2 + all;
  const bool solid = mesh::dimension(kind.first) == 3;
  const std::size_t first = solid || kind.second == Shape::quad8 ? behind : behind + 1;
  if (!card.has(first)) return;
  const std::string& field = card.fields[first];
  const bool node = field != "0" && field.find_first_not_of("0123456789") == std::string::npos;
  if (!solid && !node) return;
  const std::string corners = std::to_string(node_count(kind.first));
  card.fail(card.name + " " + card.fields[0] + " has more than " + std::to_string(all) + " nodes",
            (kind.first == kind.second ? corners : corners + " or " + std::to_string(all)) +
                " nodes; in Gmsh Mesh.SecondOrderIncomplete = 1 before setOrder(2)");
}

void Reader::take_element(const NastranCard& card, const ElementCard& kind) {
  Element e{kind.first, card.integer(0), card.integer(1, 0), {}, card.at};
  // How many nodes the card has decides between first and second order.
  const auto corners = as_size(node_count(kind.first)), all = as_size(node_count(kind.second));
  // The second order needs all of its nodes; without any the element is of first order.
  std::size_t given = 0;
  for (std::size_t a = 0; a < all; ++a)
    if (card.has(2 + a)) {
      e.nodes[a] = card.integer(2 + a);
      ++given;
    }
  // Wedges and pyramids are split into tetrahedra later, which only those of first order can be.
  const bool is_split = kind.first == Shape::wedge6 || kind.first == Shape::pyramid5;
  if (is_split && card.has(2 + all))
    card.fail(card.name + " " + std::to_string(e.number) + " is of second order",
              card.name + " with its " + std::to_string(all) + " corner nodes");
  check_no_more_nodes(card, kind);
  if (given == all)
    e.shape = kind.second;
  else if (given != corners || !card.has(1 + corners))
    card.fail(card.name + " " + std::to_string(e.number) + " has " + std::to_string(given) + " nodes",
              std::to_string(corners) + (all == corners ? "" : " or " + std::to_string(all)));
  elements_.push_back(e);
}

Point Reader::place(GlobalIndex number, const NastranCard& user) {
  const auto found = grid_at_.find(number);
  if (found == grid_at_.end()) user.fail(user.name + ": there is no GRID " + std::to_string(number));
  Grid& grid = grids_[as_size(found->second)];
  if (grid.x) return *grid.x;
  if (grid.being_found) grid.card.fail("GRID " + std::to_string(number) + " is given in a system of its own");
  grid.being_found = true;
  const NastranCard& card = grid.card;
  const GlobalIndex system = card.integer(1, defaults_ ? defaults_->integer(1) : 0);
  const LocalSystem& in =
      systems_.find(system, card, [this](GlobalIndex n, const NastranCard& c) { return place(n, c); });
  grid.x = in.global({card.real(2), card.real(3), card.real(4)});
  return *grid.x;
}

void Reader::place_nodes() {
  for (Grid& grid : grids_) {
    const GlobalIndex number = grid.card.integer(0);
    const Point x = place(number, grid.card);
    mesh_.x.push_back({unit_ * x[0], unit_ * x[1], unit_ * x[2]});
    mesh_.input_node.push_back(number);
  }
}

// The nodes between corners of a hexahedron go round the bottom, then up, then round the top; those of
// Abaqus, whose order of ours is known, round the bottom, round the top, then up.
std::size_t nastran_place(Shape shape, std::size_t of_abaqus) {
  if (shape != Shape::hex20 || of_abaqus < 12) return of_abaqus;
  return of_abaqus < 16 ? of_abaqus + 4 : of_abaqus - 4;
}

/// An entry without a property has that of its element's number, says the format; programs that leave it out,
/// as meshio does, have none in mind. Several such elements of a dimension are one body or surface.
void Reader::join_without_property() {
  std::map<int, GlobalIndex> without;  // by dimension
  for (const Element& e : elements_)
    if (e.property == 0) ++without[mesh::dimension(e.shape)];
  for (Element& e : elements_)
    if (e.property == 0 && without.at(mesh::dimension(e.shape)) == 1) e.property = e.number;
  for (const auto& [dimension, n] : without)
    if (n > 1 && dimension >= mesh_.dimension - 1)
      mesh_.notes.push_back(std::to_string(n) + (dimension == mesh_.dimension ? " elements" : " faces") +
                            " name no property: they are one " +
                            (dimension == mesh_.dimension ? "body" : "surface") +
                            ", not one each as the format has it");
}

void Reader::make_groups(const std::string& path) {
  // Elements become groups by dimension and property. The highest dimension is that of the mesh.
  mesh_.dimension = 0;
  for (const Element& e : elements_) mesh_.dimension = std::max(mesh_.dimension, mesh::dimension(e.shape));
  if (mesh_.dimension < 2)
    throw InputError(
        {path}, "the mesh has no triangles, quads, tetrahedra or hexahedra: empty, cut off or not a mesh",
        "a bulk data file of Nastran with GRID and CTETRA, CHEXA, CTRIA3, …");
  // Elements without a property are one body if all of them are.
  join_without_property();
  std::map<std::pair<int, GlobalIndex>, RawGroup> groups;  // by dimension and property
  // Nodes are put from Nastran's order into ours by way of that of Abaqus, which differs less.
  for (const Element& e : elements_) {
    // The block of this shape in the group of its property.
    RawGroup& group = groups[{mesh::dimension(e.shape), e.property}];
    group.dimension = mesh::dimension(e.shape);
    auto block = std::find_if(group.blocks.begin(), group.blocks.end(),
                              [&](const RawBlock& b) { return b.shape == e.shape; });
    if (block == group.blocks.end())
      block = group.blocks.insert(group.blocks.end(), RawBlock{e.shape, {}, {}});
    const auto order = abaqus_node_order(e.shape);
    for (std::size_t a = 0; a < as_size(node_count(e.shape)); ++a) {
      const std::size_t of_abaqus = order.empty() ? a : as_size(order[a]);
      const GlobalIndex node = e.nodes[nastran_place(e.shape, of_abaqus)];
      const auto found = grid_at_.find(node);
      if (found == grid_at_.end())
        throw InputError(
            e.at, "element " + std::to_string(e.number) + ": there is no GRID " + std::to_string(node));
      block->nodes.push_back(found->second);
    }
    block->input_element.push_back(e.number);
  }
  // Groups get the names of comments where they have them, else a name by their kind and property.
  for (auto& [key, group] : groups) {
    const auto told = names_.find(key.second);
    const std::string kind = key.first == mesh_.dimension ? "body_" : "surface_";
    std::string name = key.second == 0        ? kind + "without_property"
                       : told != names_.end() ? told->second
                                              : kind + std::to_string(key.second);
    if (mesh_.groups.contains(name)) name += "_" + std::to_string(key.second);
    mesh_.groups.emplace(name, std::move(group));
  }
}

}  // namespace

RawMesh read_nastran(const std::string& path, double unit_in_metres) {
  return Reader(unit_in_metres).mesh(path);
}

}  // namespace solidus::mesh
