/// Every structure has a pair of functions that put it into bytes and take it out again in the same order;
/// lengths are checked before memory is taken.
#include "mesh/making/reader_message.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdint>

#include "mesh/making/parametric_meshes.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mesh {

namespace {

constexpr std::size_t k_at_a_time = 8192;  // numbers

template <class T>
void put_number(T value, const PutBytes& put) {
  static_assert(std::is_trivially_copyable_v<T>);
  put(&value, sizeof value);
}

template <class T>
T take_number(const TakeBytes& take) {
  T value{};
  take(&value, sizeof value);
  return value;
}

/// A byte that the other end wrote need not be one that a bool can hold.
template <>
bool take_number<bool>(const TakeBytes& take) {
  static_assert(sizeof(bool) == sizeof(std::uint8_t));
  const auto byte = take_number<std::uint8_t>(take);
  if (byte > 1) throw MessageError("neither yes nor no");
  return byte == 1;
}

template <class T>
void put_list(const std::vector<T>& list, const PutBytes& put) {
  static_assert(std::is_trivially_copyable_v<T>);
  put_number<std::uint64_t>(list.size(), put);
  put(list.data(), list.size() * sizeof(T));
}

/// @param left  bytes that may still come; what is taken is subtracted
template <class T>
std::vector<T> take_list(const TakeBytes& take, double& left) {
  const auto n = take_number<std::uint64_t>(take);
  left -= static_cast<double>(n) * sizeof(T);
  if (left < 0) throw MessageError("the mesh is larger than its limit");
  std::vector<T> list(n);
  take(list.data(), list.size() * sizeof(T));
  return list;
}

/// Some thousand at a time, so that there is no second list of all of them with 8 bytes each.
void put_numbers(const InputNumbers& numbers, const PutBytes& put) {
  put_number<std::uint64_t>(numbers.size(), put);
  for (std::size_t i = 0; i < numbers.size(); i += k_at_a_time) {
    const std::vector<GlobalIndex> some = numbers.part(i, std::min(k_at_a_time, numbers.size() - i));
    put(some.data(), some.size() * sizeof(GlobalIndex));
  }
}

InputNumbers take_numbers(const TakeBytes& take, double& left) {
  const auto n = take_number<std::uint64_t>(take);
  left -= static_cast<double>(n) * sizeof(GlobalIndex);
  if (left < 0) throw MessageError("the mesh is larger than its limit");
  InputNumbers numbers;
  numbers.reserve(n);
  std::vector<GlobalIndex> some;
  while (numbers.size() < n) {
    some.resize(std::min<std::size_t>(k_at_a_time, n - numbers.size()));
    take(some.data(), some.size() * sizeof(GlobalIndex));
    for (const GlobalIndex number : some) numbers.push_back(number);
  }
  return numbers;
}

void put_group_choice(const GeometryGroup& group, const PutBytes& put) {
  put_text(group.name, put);
  put_number(group.bodies, put);
  put_list(group.numbers, put);
  put_text(group.label, put);
  put_number(group.box.has_value(), put);
  if (group.box) put_number(*group.box, put);
}

GeometryGroup take_group_choice(const TakeBytes& take) {
  double enough = 1e9;
  GeometryGroup group;
  group.name = take_text(take);
  group.bodies = take_number<bool>(take);
  group.numbers = take_list<int>(take, enough);
  group.label = take_text(take);
  if (take_number<bool>(take)) group.box = take_number<std::array<Point, 2>>(take);
  return group;
}

/// A block of elements, refused where a number in it could lead out of the mesh.
RawBlock take_block(const TakeBytes& take, double& left, std::size_t n_nodes) {
  const auto shape = take_number<int>(take);
  if (shape < 0 || shape > static_cast<int>(Shape::hex20)) throw MessageError("an element of no shape");
  RawBlock block{static_cast<Shape>(shape), take_list<Index>(take, left), {}};
  block.input_element = take_numbers(take, left);
  const auto per_element = as_size(node_count(block.shape));
  if (block.nodes.size() != per_element * block.input_element.size())
    throw MessageError("elements without their nodes");
  for (const Index node : block.nodes)
    if (node < 0 || as_size(node) >= n_nodes)
      throw MessageError("an element with a node that the mesh does not have");
  return block;
}

}  // namespace

void put_text(const std::string& text, const PutBytes& put) {
  put_number<std::uint64_t>(text.size(), put);
  put(text.data(), text.size());
}

/// A text says its length first; one that is too long is not taken.
std::string take_text(const TakeBytes& take, std::size_t longest) {
  const auto n = take_number<std::uint64_t>(take);
  if (n > longest) throw MessageError("a text is longer than its limit");
  std::string text(n, '\0');
  take(text.data(), n);
  return text;
}

void put_source(const MeshSource& source, const PutBytes& put) {
  put_text(source.path, put);
  put_number(source.unit_in_metres, put);
  put_number(source.element_size, put);
  put_number(source.element_order, put);
  put_number(source.constants.size(), put);
  for (const auto& [name, value] : source.constants) {
    put_text(name, put);
    put_number(value, put);
  }
  put_number(source.geometry.conforming, put);
  put_number(source.geometry.groups.size(), put);
  for (const GeometryGroup& group : source.geometry.groups) put_group_choice(group, put);
  put_number(source.trust_script, put);
  put_number(source.size_factor, put);
}

MeshSource take_source(const TakeBytes& take) {
  MeshSource source;
  source.path = take_text(take);
  source.unit_in_metres = take_number<double>(take);
  source.element_size = take_number<double>(take);
  source.element_order = take_number<int>(take);
  for (auto n = take_number<std::size_t>(take); n > 0; --n) {
    const std::string name = take_text(take);
    source.constants[name] = take_number<double>(take);
  }
  source.geometry.conforming = take_number<bool>(take);
  for (auto n = take_number<std::size_t>(take); n > 0; --n)
    source.geometry.groups.push_back(take_group_choice(take));
  source.trust_script = take_number<bool>(take);
  source.size_factor = take_number<double>(take);
  return source;
}

namespace {

void put_feeders(const CastingGeometry& casting, const PutBytes& put) {
  put_number(casting.risers.size(), put);
  for (const RiserCylinder& r : casting.risers) {
    put_text(r.name, put);
    put_number(r.foot, put);
    put_number(std::array{r.diameter, r.height, r.neck_diameter, r.neck_height, r.sleeve}, put);
    put_number(r.neck_to.has_value(), put);
    if (r.neck_to) put_number(*r.neck_to, put);
  }
  put_number(casting.chills.size(), put);
  for (const ChillBlock& chill : casting.chills) {
    put_text(chill.name, put);
    put_number(chill.low, put);
    put_number(chill.high, put);
  }
  put_number(casting.gatings.size(), put);
  for (const GatingSystem& g : casting.gatings) {
    put_text(g.name, put);
    put_number(g.gate, put);
    put_number(g.top, put);
    put_number(std::array{g.gate_width, g.gate_height, g.gate_length, g.runner_width, g.runner_height,
                          g.foot_diameter, g.top_diameter},
               put);
  }
}

void take_feeders(const TakeBytes& take, CastingGeometry& casting) {
  for (auto n = take_number<std::size_t>(take); n > 0; --n) {
    RiserCylinder& riser = casting.risers.emplace_back();
    riser.name = take_text(take);
    riser.foot = take_number<Point>(take);
    const auto sizes = take_number<std::array<double, 5>>(take);
    riser.diameter = sizes[0], riser.height = sizes[1];
    riser.neck_diameter = sizes[2], riser.neck_height = sizes[3], riser.sleeve = sizes[4];
    if (take_number<bool>(take)) riser.neck_to = take_number<Point>(take);
  }
  for (auto n = take_number<std::size_t>(take); n > 0; --n) {
    ChillBlock& chill = casting.chills.emplace_back();
    chill.name = take_text(take);
    chill.low = take_number<Point>(take);
    chill.high = take_number<Point>(take);
  }
  for (auto n = take_number<std::size_t>(take); n > 0; --n) {
    GatingSystem& gating = casting.gatings.emplace_back();
    gating.name = take_text(take);
    gating.gate = take_number<Point>(take);
    gating.top = take_number<Point>(take);
    const auto sizes = take_number<std::array<double, 7>>(take);
    gating.gate_width = sizes[0], gating.gate_height = sizes[1], gating.gate_length = sizes[2];
    gating.runner_width = sizes[3], gating.runner_height = sizes[4];
    gating.foot_diameter = sizes[5], gating.top_diameter = sizes[6];
  }
}

}  // namespace

void put_casting(const CastingGeometry& casting, const PutBytes& put) {
  put_number(casting.sizes.size(), put);
  for (const BodySize& s : casting.sizes) {
    put_text(s.body, put);
    put_number(std::array{s.size, s.smallest, s.across, s.growth}, put);
  }
  put_number(casting.mould.has_value(), put);
  if (casting.mould) {
    put_text(casting.mould->name, put);
    put_text(casting.mould->core, put);
    put_number(casting.mould->walls, put);
  }
  put_feeders(casting, put);
  put_number(casting.symmetry.has_value(), put);
  if (casting.symmetry) put_number(*casting.symmetry, put);
  put_number(casting.attempt, put);
}

CastingGeometry take_casting(const TakeBytes& take) {
  CastingGeometry casting;
  for (auto n = take_number<std::size_t>(take); n > 0; --n) {
    BodySize& s = casting.sizes.emplace_back();
    s.body = take_text(take);
    const auto numbers = take_number<std::array<double, 4>>(take);
    s.size = numbers[0], s.smallest = numbers[1], s.across = numbers[2], s.growth = numbers[3];
  }
  if (take_number<bool>(take)) {
    MouldBlock& mould = casting.mould.emplace();
    mould.name = take_text(take);
    mould.core = take_text(take);
    mould.walls = take_number<std::array<double, 6>>(take);
  }
  take_feeders(take, casting);
  if (take_number<bool>(take)) casting.symmetry = take_number<HalfSpace>(take);
  casting.attempt = take_number<int>(take);
  return casting;
}

void put_outlook(const MeshingOutlook& o, const PutBytes& put) {
  put_number(std::array{o.sides[0], o.sides[1], o.sides[2], o.volume, o.smallest, o.largest, o.nodes}, put);
  put_text(o.overlap, put);
}

MeshingOutlook take_outlook(const TakeBytes& take) {
  const auto numbers = take_number<std::array<double, 7>>(take);
  for (const double number : numbers)
    if (!std::isfinite(number) || number < 0) throw MessageError("an outlook that is no number");
  return {
      {numbers[0], numbers[1], numbers[2]}, numbers[3], numbers[4], numbers[5], numbers[6], take_text(take)};
}

void put_mesh(const RawMesh& mesh, const PutBytes& put) {
  put_number(mesh.dimension, put);
  put_list(mesh.x, put);
  put_list(mesh.input_node, put);
  put_number(mesh.groups.size(), put);
  for (const auto& [name, group] : mesh.groups) {
    put_text(name, put);
    put_number(group.dimension, put);
    put_number(group.blocks.size(), put);
    for (const RawBlock& block : group.blocks) {
      put_number(static_cast<int>(block.shape), put);
      put_list(block.nodes, put);
      put_numbers(block.input_element, put);
    }
  }
  put_number(mesh.notes.size(), put);
  for (const std::string& note : mesh.notes) put_text(note, put);
  put_number(mesh.centre_of_volume.has_value(), put);
  if (mesh.centre_of_volume) put_number(*mesh.centre_of_volume, put);
  put_number(mesh.drawn_faces.size(), put);
  for (const DrawnFace& face : mesh.drawn_faces) {
    put_list(face.facets, put);
    put_number(face.radius, put);
  }
}

RawMesh take_mesh(const TakeBytes& take, double most_bytes) {
  // What another process sends is not trusted: each list says its size beforehand and is taken only as long
  // as the sum stays below the most that a mesh may hold, and every number is checked before it is used.
  RawMesh mesh;
  double left = most_bytes;
  // Nodes come first, then groups of blocks, notes, the centre of volume, and the faces of the drawing.
  mesh.dimension = take_number<int>(take);
  mesh.x = take_list<Point>(take, left);
  mesh.input_node = take_list<GlobalIndex>(take, left);
  if (mesh.dimension < 2 || mesh.dimension > 3 || mesh.input_node.size() != mesh.x.size())
    throw MessageError("nodes without their numbers");
  for (auto n = take_number<std::size_t>(take); n > 0; --n) {
    const std::string name = take_text(take);
    RawGroup group{take_number<int>(take), {}};
    if (group.dimension < 0 || group.dimension > 3) throw MessageError("a group of no dimension");
    for (auto blocks = take_number<std::size_t>(take); blocks > 0; --blocks)
      group.blocks.push_back(take_block(take, left, mesh.x.size()));
    mesh.groups.emplace(name, std::move(group));
  }
  constexpr std::size_t k_most_notes = 10000;
  const auto n_notes = take_number<std::size_t>(take);
  if (n_notes > k_most_notes) throw MessageError("more notes than a mesh has");
  for (std::size_t i = 0; i < n_notes; ++i) mesh.notes.push_back(take_text(take));
  if (take_number<bool>(take)) {
    mesh.centre_of_volume = take_number<Point>(take);
    for (const double x : *mesh.centre_of_volume)
      if (!std::isfinite(x)) throw MessageError("a centre that is no place");
  }
  // A facet refers to nodes of the mesh, or to none (-1).
  for (auto n = take_number<std::size_t>(take); n > 0; --n) {
    DrawnFace& face = mesh.drawn_faces.emplace_back();
    face.facets = take_list<std::array<Index, 4>>(take, left);
    face.radius = take_number<double>(take);
    if (face.facets.empty()) throw MessageError("a face without facets");
    if (!std::isfinite(face.radius) || face.radius < 0) throw MessageError("a radius that is none");
    for (const auto& facet : face.facets)
      for (const Index node : facet)
        if (node < -1 || (node >= 0 && as_size(node) >= mesh.x.size()))
          throw MessageError("a facet with a node that the mesh does not have");
  }
  return mesh;
}

/// Writes all bytes to a pipe, in as many pieces as it takes.
void put_all(int descriptor, const void* bytes, std::size_t n) {
  const char* at = static_cast<const char*>(bytes);
  while (n > 0) {
    const ssize_t written = ::write(descriptor, at, n);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) throw MessageError("the other end of the pipe has gone");
    at += written;
    n -= as_size(written);
  }
}

/// Reads all bytes from a pipe; its end before is an error.
void take_all(int descriptor, void* bytes, std::size_t n) {
  char* at = static_cast<char*>(bytes);
  while (n > 0) {
    const ssize_t read = ::read(descriptor, at, n);
    if (read < 0 && errno == EINTR) continue;
    if (read <= 0) throw MessageError("the other end of the pipe has gone");
    at += read;
    n -= as_size(read);
  }
}

}  // namespace solidus::mesh
