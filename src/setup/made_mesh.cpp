#include "setup/made_mesh.hpp"

#include <string>
#include <type_traits>
#include <utility>

#include "system/errors.hpp"

namespace solidus::setup {

namespace {

template <class T>
void put_number(const T& number, const mesh::PutBytes& put) {
  // Bytes go as they are: both ends are the same program on the same machine, so that neither order nor width
  // differs.
  static_assert(std::is_trivially_copyable_v<T>);
  put(&number, sizeof number);
}

template <class T>
T take_number(const mesh::TakeBytes& take) {
  T number{};
  take(&number, sizeof number);
  return number;
}

}  // namespace

void put_made_mesh(const MadeMesh& made, const mesh::PutBytes& put) {
  mesh::put_mesh(made.mesh, put);
  // What is wrong with the mesh is told later, in the words that it has already.
  // A flag goes first, which says whether a text follows.
  put_number(made.mesh.unsound.has_value(), put);
  if (made.mesh.unsound) mesh::put_text(made.mesh.unsound->what(), put);
  // The number of interfaces goes ahead of them, as the reader has no other way to know where they end.
  put_number(made.interfaces.size(), put);
  for (const FoundInterface& found : made.interfaces) {
    put_number(found.section, put);
    put_number(found.a, put);
    put_number(found.b, put);
    mesh::put_text(found.surface_a, put);
    mesh::put_text(found.surface_b, put);
    put_number(found.distance, put);
  }
  put_number(made.seconds, put);
}

MadeMesh take_made_mesh(const mesh::TakeBytes& take, double most_bytes) {
  MadeMesh made;
  // Everything is taken in the order in which put_made_mesh() has put it; a change there is a change here.
  made.mesh = mesh::take_mesh(take, most_bytes);
  if (take_number<bool>(take)) made.mesh.unsound = InputError({}, mesh::take_text(take));
  for (auto n = take_number<std::size_t>(take); n > 0; --n) {
    FoundInterface& found = made.interfaces.emplace_back();
    found.section = take_number<std::size_t>(take);
    found.a = take_number<int>(take);
    found.b = take_number<int>(take);
    found.surface_a = mesh::take_text(take);
    found.surface_b = mesh::take_text(take);
    found.distance = take_number<double>(take);
  }
  made.seconds = take_number<double>(take);
  return made;
}

}  // namespace solidus::setup
