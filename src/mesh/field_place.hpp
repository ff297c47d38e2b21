/// Where the values of a field of numbers are.
#pragma once

namespace solidus::mesh {

enum class FieldPlace { node, cell };

}  // namespace solidus::mesh
