/// Check of Gmsh scripts (.geo) from untrusted sources, before Gmsh runs them.
///
/// A script is a program. Gmsh's language starts other programs, writes files and ends the process; a script
/// that makes a geometry needs none of it. The script and all that it includes is read token by token and
/// refused unless it keeps to geometry, mesh sizes and arithmetic. The lists name what is allowed, not what
/// is dangerous: a word that a later Gmsh adds is refused until it has been examined.
#pragma once

#include <string>

namespace solidus::mesh {

/// Throws InputError with file, line and column for the first thing in the script, or in a file that it
/// includes, that is not allowed: commands of the system, output to files, files outside the script's own
/// folder, ONELAB, options that are not of the mesh or the geometry, plugins and fields that write or run
/// something, the end of the process, and anything that Gmsh could read otherwise than this check does.
void check_gmsh_script(const std::string& path);

/// Gmsh runs PATH.opt, if there is one, after it has read any file PATH: InputError if there is one.
void refuse_options_file(const std::string& path);

}  // namespace solidus::mesh
