#include "results/tables/profile_table.hpp"

#include <gtest/gtest.h>

#include "mesh/making/parametric_meshes.hpp"
#include "mesh/raw_mesh.hpp"
#include "sample.hpp"
#include "system/processes.hpp"
#include "vtu_reader.hpp"

namespace solidus::results {
namespace {

// A block 3 x 1 m of six elements with a temperature that is linear in space and a displacement.
struct Profiles : ::testing::Test {
  test::SharedFolder folder;
  mesh::Mesh mesh;
  std::vector<double> temperature, displacement, cells;
  FieldSet fields;

  Profiles() {
    const int rank = processes::rank();
    mesh::RawMesh raw;
    if (rank == 0) raw = mesh::make_block({{3, 1}, {}, {3, 2}, "part"}, mesh::Shape::quad4);
    mesh = mesh::distribute(raw, {"part"}, {});
    for (const mesh::Point& x : mesh.x) {
      temperature.push_back(300 + 10 * x[0]);
      displacement.insert(displacement.end(), {0.75 * x[0], x[0]});
    }
    cells.assign(value_count(mesh, mesh::FieldPlace::cell, 1), 0.0);
    fields.add({"temperature", "K", 1, mesh::FieldPlace::node, temperature});
    fields.add({"displacement", "m", 2, mesh::FieldPlace::node, displacement});
    fields.add({"von_mises", "Pa", 1, mesh::FieldPlace::cell, cells});
  }
  Profile profile(const std::string& group, const std::string& field = "temperature",
                  const std::string& unit = "K") const {
    return {"top",
            group,
            "cm",
            {{{"T", unit}, field, 0, {}}, {{"u", "mm"}, "displacement", k_magnitude, {}}},
            {}};
  }
  std::string message(const Profile& p) const {
    try {
      ProfileTable(mesh, AnalysisKind::plane_strain, p, fields);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }
};

TEST_F(Profiles, ListTheNodesOfAGroupInOrderHoweverTheMeshIsCut) {
  ProfileTable(mesh, AnalysisKind::plane_strain, profile("y_max"), fields).write(folder.path, fields);
  test::on_first([&] {
    EXPECT_EQ(test::read_text(folder.path / "top.csv"),
              "x[cm],y[cm],T[K],u[mm]\n0,100,300,0\n100,100,310,1250\n200,100,320,2500\n300,100,330,3750\n");
  });
}

TEST_F(Profiles, SayWhatDoesNotFit) {
  EXPECT_NE(message(profile("y_top")).find("there is no group 'y_top'"), std::string::npos);
  EXPECT_NE(message(profile("y_max", "wear")).find("there is no field 'wear' at nodes"), std::string::npos);
  EXPECT_NE(message(profile("y_max", "von_mises", "Pa")).find("'von_mises' at nodes"), std::string::npos);
  EXPECT_NE(message(profile("y_max", "temperature", "mm")).find("the unit 'mm' does not fit"),
            std::string::npos);
}

}  // namespace
}  // namespace solidus::results
