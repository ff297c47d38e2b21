/// A shared object that is loaded at run time, and its symbols.
#pragma once

#include <string>

#include "system/errors.hpp"

namespace solidus::material {

/// Stays loaded until the program ends: a library may have left threads or handlers behind.
class SharedObject {
 public:
  /// Runs the library's initialisers. Throws InputError at `where`.
  SharedObject(const std::string& file, const SourceLocation& where);

  /// Null where the library has no such symbol.
  void* find(const std::string& symbol) const;
  /// Throws InputError with file and symbol where the library has none.
  /// @param what  the symbol is for
  void* get(const std::string& symbol, const std::string& what) const;
  const std::string& file() const { return file_; }
  const SourceLocation& where() const { return where_; }

 private:
  std::string file_;
  SourceLocation where_;
  void* handle_;
};

}  // namespace solidus::material
