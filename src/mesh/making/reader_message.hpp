/// Requests to a reader and meshes from it, as bytes through a pipe (mesh/making/reader_process.hpp). Both
/// ends are of the same build on the same machine.
#pragma once

#include <cstddef>
#include <functional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "mesh/making/casting_geometry.hpp"
#include "mesh/making/meshing_outlook.hpp"
#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {

/// Descriptors of files by which the reader knows its ends of the pipes.
inline constexpr int k_request_descriptor = 3, k_answer_descriptor = 4;
/// The first word of an answer. A mesh follows, or a text where it is an error with one. An outlook precedes
/// the answer, where a geometry is meshed. A copy of the program leaves some files to the reader.
enum class ReaderAnswer : int { mesh, unusable_geometry, input_error, memory, internal, outlook, elsewhere };

/// Thrown where the other end sent none of these messages, or has gone.
class MessageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Writes and reads all of `n` bytes, whatever the pipe holds at once. Throw MessageError where the other end
/// has gone.
void put_all(int descriptor, const void* bytes, std::size_t n);
void take_all(int descriptor, void* bytes, std::size_t n);

/// Functions that send and receive bytes. Both throw if the connection ends too soon. What is received throws
/// MessageError where it is no message.
using PutBytes = std::function<void(const void* bytes, std::size_t n)>;
using TakeBytes = std::function<void(void* bytes, std::size_t n)>;

void put_source(const MeshSource& source, const PutBytes& put);
MeshSource take_source(const TakeBytes& take);

void put_casting(const CastingGeometry& casting, const PutBytes& put);
CastingGeometry take_casting(const TakeBytes& take);

void put_outlook(const MeshingOutlook& outlook, const PutBytes& put);
/// Throws MessageError for numbers that are none, or negative.
MeshingOutlook take_outlook(const TakeBytes& take);

void put_mesh(const RawMesh& mesh, const PutBytes& put);
/// Throws MessageError for data that are no mesh: an unknown shape, a node that is not there, more than
/// `most_bytes`.
RawMesh take_mesh(const TakeBytes& take, double most_bytes);

void put_text(const std::string& text, const PutBytes& put);
std::string take_text(const TakeBytes& take, std::size_t longest = 1 << 20);

}  // namespace solidus::mesh
