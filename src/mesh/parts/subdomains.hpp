/// Cuts a whole mesh into the parts of the processes: packed on process 0, unpacked by the receiving process.
#pragma once

#include <string>
#include <vector>

#include "mesh/mesh.hpp"
#include "mesh/parts/global_mesh.hpp"

namespace solidus::mesh {

class Packer;

/// Sorts elements, faces and sets by process in one go, so that the parts together cost what the mesh does
/// and not a search through all of it for each.
class Subdomains {
 public:
  /// Keeps references.
  Subdomains(const RawMesh& raw, const GlobalMesh& whole, const std::vector<std::string>& bodies);
  /// Packs the part of a process for unpack_part(). Each process' part can be packed once.
  std::vector<char> pack(int process);

 private:
  struct Elements {
    std::vector<Index> counted, others;  ///< places in the raw block, in the order of their lowest numbers
  };
  /// Elements of every block that each process holds, [block][process].
  using OfBlocks = std::vector<std::vector<Elements>>;

  std::vector<Elements> sort_out(const RawBlock& block, bool for_all) const;
  std::vector<Index> nodes_of(int process) const;
  std::size_t element_bytes(int process) const;
  /// Packs the elements of a block that this process counts, others behind them, and forgets them.
  void put_block(const RawBlock& block, int body, Elements& elements, Packer& p) const;
  void find_sets();

  const RawMesh& raw_;
  const GlobalMesh& whole_;
  const std::vector<std::string>& bodies_;
  OfBlocks volumes_;
  std::vector<OfBlocks> faces_;   ///< of every surface
  std::vector<Index> local_;      ///< [raw node], −1 between two packings
  std::vector<Index> first_set_;  ///< of each raw node in sets_; one more at the end
  std::vector<int> sets_;         ///< that the node belongs to
};

/// @param buffer  of Subdomains::pack
Mesh unpack_part(const std::vector<char>& buffer);

}  // namespace solidus::mesh
