#include "heat/conduction/conduction_elements.hpp"

#include <algorithm>
#include <utility>

#include "mesh/block_part.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::heat {

ConductionElements::ConductionElements(const mesh::Mesh& mesh, AnalysisKind kind, bool closed,
                                       bool correct_edges, bool pattern_stays,
                                       const std::vector<material::Material>& materials)
    : mesh_(mesh), kind_(kind), closed_(closed), pattern_stays_(pattern_stays), active_(mesh) {
  // Factors of re-entrant edges are needed by the blocks, which are built at their first use.
  if (correct_edges) edges_ = EdgeConduction(mesh);
  for (const material::Material& m : materials) potentials_.emplace_back(m.conductivity);
  fields_.resize(materials.size());
  blocks_.resize(mesh.blocks.size());
  shares_.resize(mesh.blocks.size());
  for (std::size_t body = 0; body < fields_.size(); ++body) find_field_nodes(body);
  nodal_ = std::make_unique<NodalPotential>(mesh, potentials_, active_);
}

void ConductionElements::set_active(const linear::ActiveSet& active) {
  // Bodies that have left give back the memory of their elements, and their nodes are no longer evaluated.
  for (std::size_t b = 0; b < blocks_.size(); ++b)
    if (!active.body(mesh_.blocks[b].body)) blocks_[b].reset();
  for (std::size_t body = 0; body < fields_.size(); ++body) {
    fields_[body].nodes.clear();
    if (active.body(static_cast<int>(body))) find_field_nodes(body);
  }
  active_ = active;
  nodal_ = std::make_unique<NodalPotential>(mesh_, potentials_, active_);
}

void ConductionElements::set_shares(std::size_t block, std::vector<double> share) {
  shares_[block] = std::move(share);
  if (blocks_[block]) blocks_[block]->set_shares(shares_[block]);
}

void ConductionElements::find_field_nodes(std::size_t body) {
  // A constant conductivity needs no values at nodes: it is a factor of the block.
  if (potentials_[body].constant()) return;
  std::vector<char> of_body(mesh_.x.size(), 0);
  for (const mesh::ElementBlock& block : mesh_.blocks)
    if (as_size(block.body) == body)
      for (const Index node : block.nodes) of_body[as_size(node)] = 1;
  Field& u = fields_[body];
  u.nodes.reserve(as_size(std::count(of_body.begin(), of_body.end(), 1)));
  for (std::size_t i = 0; i < of_body.size(); ++i)
    if (of_body[i] != 0) u.nodes.push_back(as_index(i));
}

void ConductionElements::bind(linear::BlockMatrix& matrix) {
  matrix_ = &matrix;
  for (const auto& block : blocks_)
    if (block) block->bind(matrix);
}

ConductionBlock& ConductionElements::block(std::size_t number) {
  // Geometry, factors of growth and places in the matrix are set once for each block.
  if (!blocks_[number]) {
    blocks_[number] = make_conduction_block(mesh_, mesh_.blocks[number], kind_, closed_, edges_);
    if (!shares_[number].empty()) blocks_[number]->set_shares(shares_[number]);
    blocks_[number]->bind(*matrix_);
  }
  return *blocks_[number];
}

const double* ConductionElements::potential(std::size_t body, std::span<const double> temperature) {
  // A body without an element here, which has yet to grow, conducts nothing: any field will do.
  Field& field = fields_[body];
  if (potentials_[body].constant() || field.nodes.empty()) return temperature.data();
  field.value.resize(mesh_.x.size());
  for (const Index node : field.nodes) {
    const auto i = as_size(node);
    field.value[i] = potentials_[body].value(temperature[i]);
  }
  return field.value.data();
}

void ConductionElements::add_tangent(std::span<const double> temperature) {
  // Conductivities are evaluated once for the nodes of each body whose table needs it.
  for (std::size_t b = 0; b < fields_.size(); ++b) {
    if (!fields_[b].nodes.empty()) fields_[b].value.resize(mesh_.x.size());
    for (const Index node : fields_[b].nodes) {
      const auto i = as_size(node);
      fields_[b].value[i] = potentials_[b].conductivity(temperature[i]);
    }
  }
  // A constant conductivity is a factor of the whole block.
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const auto body = as_size(mesh_.blocks[b].body);
    if (!active_.body(static_cast<int>(body))) continue;
    if (potentials_[body].constant())
      block(b).add_tangent(potentials_[body].reference(), {}, *matrix_);
    else
      block(b).add_tangent(1.0, fields_[body].value, *matrix_);
  }
}

void ConductionElements::add_unit(int body) {
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    if (mesh_.blocks[b].body != body || !active_.body(body)) continue;
    // Where the result is all that is wanted, the geometry is made for some elements at a time.
    if (pattern_stays_ && !blocks_[b] && shares_[b].empty())
      mesh::for_parts(mesh_.blocks[b], [&](const mesh::ElementBlock& part, Index) {
        make_conduction_block(mesh_, part, kind_, closed_, edges_)->add_tangent_once(1.0, *matrix_);
      });
    else
      block(b).add_tangent_once(1.0, *matrix_);
  }
}

void ConductionElements::release_work() {
  for (Field& u : fields_) std::vector<double>().swap(u.value);
}

std::size_t ConductionElements::bytes() const {
  std::size_t total = nodal_->bytes();
  for (const auto& block : blocks_)
    if (block) total += block->bytes();
  for (const Field& u : fields_)
    total += u.nodes.capacity() * sizeof(Index) + u.value.capacity() * sizeof(double);
  return total;
}

}  // namespace solidus::heat
