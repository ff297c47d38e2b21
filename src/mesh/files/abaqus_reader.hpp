/// Reads the keywords and lines of a deck of Abaqus one after the other into scopes: the deck or its
/// assembly, and its instances. abaqus_input.cpp has the keywords, abaqus_lines.cpp the lines of data below
/// them.
#pragma once

#include <deque>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "mesh/files/abaqus_deck.hpp"
#include "mesh/files/abaqus_scope.hpp"
#include "mesh/local_system.hpp"
#include "system/errors.hpp"

namespace solidus::mesh {

class AbaqusReader {
 public:
  explicit AbaqusReader(double unit) : unit_(unit) { scopes_.emplace_back(); }

  RawMesh mesh(const std::string& path) {
    read(path, false);
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
  AbaqusScope& scope() { return parts_.open ? *parts_.open : scopes_[instance_]; }
  /// The file next to the one that names it.
  std::string beside(const std::string& name) const {
    return (std::filesystem::path(at_.file).parent_path() / name).string();
  }

  struct Handling;
  /// Of the present keyword; null where it is none of those that are read.
  const Handling* handling() const;
  void read(const std::string& path, bool only_data);
  void read_input();
  void begin();
  void include();
  void begin_nodes();
  void begin_elements();
  void begin_surface();
  void begin_set();
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
  void set_line(const AbaqusLine& line);
  void keep_line(const AbaqusLine& line);
  void end_generation();
  AbaqusSet& set_of_keyword();
  void nodes_of_elements(AbaqusSet& set);
  void surface_line(const AbaqusLine& line);
  void place_instance();
  void read_system();

  /// The number of a scope by the name of an instance.
  int instance_named(const std::string& name) const;
  std::vector<NumberRange> members(const std::string& text, AbaqusSets AbaqusScope::*sets,
                                   const AbaqusLine& line);

  struct Files {
    int count = 0, depth = 0;
  };
  /// Lines of data that are kept until the keyword ends.
  struct Kept {
    std::deque<SourceLocation> places;
    std::vector<AbaqusLine> lines;
  };
  /// The parts of a deck, and the one that is being read.
  struct Parts {
    std::map<std::string, AbaqusScope> all;
    std::set<std::string> used;
    std::optional<AbaqusScope> open;
  };

  double unit_;
  Files files_;
  SourceLocation at_;
  AbaqusKeyword keyword_;
  Kept kept_;
  Shape shape_ = Shape::point1;       ///< of the *ELEMENT being read
  std::vector<GlobalIndex> pending_;  ///< number and nodes of an element that is not complete

  std::deque<AbaqusScope> scopes_;  ///< the deck or its assembly, and its instances
  std::size_t instance_ = 0;        ///< the scope being read
  Parts parts_;
  bool moved_ = false;  ///< whether the instance being read is not where its part is
  LocalSystem system_;  ///< of *SYSTEM
  std::map<std::string, SourceLocation> unread_;
  std::vector<std::string> notes_;
};

}  // namespace solidus::mesh
