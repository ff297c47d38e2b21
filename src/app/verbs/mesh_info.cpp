/// The verb `mesh-info`: groups, sizes and the worst elements of a mesh.
#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/case_arguments.hpp"
#include "app/python_tools.hpp"
#include "app/verb.hpp"
#include "mesh/files/body_partition.hpp"
#include "mesh/files/file_unit.hpp"
#include "mesh/quality.hpp"
#include "mesh/surfaces/face_rules.hpp"
#include "results/output/output_error.hpp"
#include "results/output/output_file.hpp"
#include "setup/case_file.hpp"
#include "setup/geometry_bodies.hpp"
#include "setup/mesh_input.hpp"
#include "system/errors.hpp"

namespace solidus::app {

namespace {

using mesh::RawMesh;

/// A case gives its mesh; anything else is taken for a mesh file.
bool is_case(const std::filesystem::path& path) {
  return std::filesystem::is_directory(path) || path.extension() == ".toml";
}

/// A mesh, and the names that a case gives to the groups of its bodies.
struct NamedMesh {
  RawMesh mesh;
  std::map<std::string, std::string> bodies;
  std::optional<mesh::LengthUnit> unit = {};  ///< that the file says itself
  int refine = 0;                             ///< how often a run halves its edges
};

NamedMesh read(const CaseArguments& arguments, const std::string& unit) {
  if (is_case(arguments.path)) {
    const setup::Case given = load_case(arguments);
    NamedMesh named{setup::raw_mesh(given.spec), {}};
    for (const cases::BodySpec& body : given.spec.bodies) named.bodies[body.mesh_group()] = body.name;
    named.refine = given.spec.mesh.refine;
    return named;
  }
  mesh::MeshSource source{arguments.path, mesh::metres_of_unit(arguments.path, unit, "m", {"--unit", 0, 0})};
  source.trust_script = arguments.trust_script;
  RawMesh mesh = mesh::read_mesh(source);
  mesh::validate_and_orient(mesh, arguments.path);
  return {std::move(mesh), {}, mesh::unit_of_file(arguments.path)};
}

/// The groups that are bodies. What others are left out, or that sets overlap, is added to `text`.
std::vector<std::string> bodies_of(const NamedMesh& named, const std::string& path, std::string& text) {
  try {
    const mesh::BodyPartition partition = mesh::partition_of(named.mesh, path, [&](const std::string& group) {
      return named.bodies.contains(group) ? 3 : setup::body_preference(group);
    });
    for (const std::string& note : partition.notes) text += note + "\n";
    return partition.bodies;
  } catch (const InputError& error) {
    text += std::string(error.what()) + "\n";
    std::vector<std::string> all;
    for (const auto& [name, group] : named.mesh.groups)
      if (group.dimension == named.mesh.dimension) all.push_back(name);
    return all;
  }
}

constexpr const char* k_faces = "faces.vtk";

/// Files of the faces that are written in addition to the table; empty paths: none.
struct FaceFiles {
  std::filesystem::path pictures;  ///< folder for pictures of the faces by number, and for their file
  std::filesystem::path faces;     ///< the file alone
};

/// The faces as a file for ParaView, from which the pictures are drawn.
void write_faces(const RawMesh& mesh, const std::vector<mesh::SkinPatch>& patches, const FaceFiles& files) {
  const char* const option = files.faces.empty() ? "--pictures" : "--faces";
  if (mesh.dimension != 3)
    throw InputError({option, 0, 0}, "the mesh is plane", "the table: it has places and neighbours");
  // The folder of the pictures is made where it is missing; that of the single file has to be there.
  std::error_code error;
  if (!files.pictures.empty()) std::filesystem::create_directories(files.pictures, error);
  if (error)
    throw results::OutputError(files.pictures.string(), "cannot make this folder: " + error.message(),
                               "--pictures names another one");
  const std::string text = mesh::to_vtk(patches);
  if (!files.pictures.empty()) results::write_file(files.pictures / k_faces, text);
  if (!files.faces.empty()) results::write_file(files.faces, text);
}

/// @param unit   of the lengths of a mesh file; empty: what the file says, else m
/// @param files  what is written of the faces
ExitCode mesh_info(const CaseArguments& arguments, const std::string& unit, const FaceFiles& files) {
  std::string text;
  results::on_first_process([&] {
    const NamedMesh named = read(arguments, unit);
    const RawMesh& mesh = named.mesh;
    // The unit that the file itself names goes first, since everything below is in it.
    if (named.unit) text = fmt::format("the file says that its lengths are in {}\n", named.unit->name);
    text += mesh::to_text(mesh::assess(mesh));
    // The table is of the mesh that a run begins with; halving its edges is the run's own work.
    if (named.refine > 0)
      text += fmt::format("mesh.refine = {}: a run has {} times as many elements, of 1/{} of the size\n",
                          named.refine, 1LL << (named.mesh.dimension * named.refine), 1 << named.refine);
    const std::vector<std::string> bodies = bodies_of(named, arguments.path, text);
    // Faces of the bodies are numbered by where their skin has an edge.
    constexpr double k_edge = std::numbers::pi / 6;  // neighbours that bend by more begin a face
    std::vector<mesh::SkinPatch> patches = mesh::skin_patches(mesh, bodies, k_edge);
    for (mesh::SkinPatch& patch : patches)
      if (const auto name = named.bodies.find(patch.body); name != named.bodies.end())
        patch.body = name->second;
    text += mesh::to_text(patches);
    if (!files.pictures.empty() || !files.faces.empty()) write_faces(mesh, patches, files);
  });
  print(text);
  if (files.pictures.empty()) return k_done;
  return run_python("faces", {(files.pictures / k_faces).string()});
}

class MeshInfo final : public Verb {
 public:
  explicit MeshInfo(CLI::App& program)
      : Verb(program, "mesh-info", "Report groups, sizes and quality of a mesh") {
    command().add_option("CASE", arguments_.path, "A mesh file, or a case")->required();
    command()
        .add_option("--set", arguments_.set, "Change a key of the case")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
    command()
        .add_option("--unit", unit_,
                    "Unit of length of a mesh file, for example mm; default what the file says, else m")
        ->type_name("UNIT");
    command()
        .add_option(
            "--pictures", files_.pictures,
            "Folder for pictures of every body's faces by their numbers, and for faces.vtk (ParaView)")
        ->type_name("FOLDER");
    command()
        .add_option("--faces", files_.faces,
                    "File for the faces by their numbers (ParaView), without pictures of them")
        ->type_name("FILE");
    add_trust(command(), arguments_.trust_script);
  }
  ExitCode run() override { return mesh_info(arguments_, unit_, files_); }

 private:
  CaseArguments arguments_;
  std::string unit_;
  FaceFiles files_;
};

}  // namespace

std::unique_ptr<Verb> mesh_info_verb(CLI::App& program) {
  return std::make_unique<MeshInfo>(program);
}

}  // namespace solidus::app
