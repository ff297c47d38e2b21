/// Slips of the elements of a mesh.
#include <string>

#include "casting.hpp"

namespace {

using namespace solidus::check::test;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

/// A cold strip of steel that bends.
std::string strip(const std::string& element, const std::string& divisions) {
  return "title = \"strip\"\n[analysis]\nkind = \"plane_strain\"\nphysics = \"mechanics\"\n[mesh]\n"
         "shape = \"block\"\nelement = \"" +
         element + "\"\n[mesh.block]\nsize = [\"100 mm\", \"2 mm\"]\ndivisions = " + divisions +
         "\n[time]\nend = \"1 s\"\nstep = \"1 s\"\n[[body]]\nname = \"block\"\nmaterial = \"steel_mould\"\n"
         "initial_temperature = \"20 degC\"\n[[mechanical_condition]]\nname = \"clamp\"\ngroup = \"x_min\"\n"
         "kind = \"displacement\"\nux = \"0 mm\"\nuy = \"0 mm\"\n[[mechanical_condition]]\nname = \"load\"\n"
         "group = \"y_max\"\nkind = \"pressure\"\npressure = \"1 kPa\"\n";
}

TEST_F(FindingsTest, AThinBodyOfOneElementOfFirstOrderThroughItsWallIsNamed) {
  const auto named = Contains(HasSubstr("100 % of the thin body 'block' are elements of first order"));
  EXPECT_THAT(said_of(strip("quad4", "[50, 1]")), named);
  EXPECT_THAT(said_of(strip("tri3", "[50, 1]")), named);
  EXPECT_THAT(said_of(strip("quad8", "[50, 1]")), Not(named));
  EXPECT_THAT(said_of(strip("quad4", "[50, 4]")), Not(Contains(HasSubstr("elements of first order"))));
  EXPECT_THAT(said_of(changed(strip("quad4", "[5, 1]"), "\"100 mm\"", "\"10 mm\"")),
              Not(Contains(HasSubstr("elements of first order"))));
}

}  // namespace
