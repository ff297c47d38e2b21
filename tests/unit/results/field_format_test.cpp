// Formats of fields describe themselves: what two of them share, or one lacks, is refused when the program
// starts.
#include "results/output/field_format.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "results/output/run_folder.hpp"

namespace solidus::results {
namespace {

std::unique_ptr<FieldWriter> none(const RunFolder&, const mesh::Mesh&, std::optional<double>) {
  return nullptr;
}

TEST(FieldFormats, ComeInTheOrderOfTheirPlacesVtuFirst) {
  const std::vector<FieldFormat>& formats = field_formats();
  ASSERT_GE(formats.size(), 2U);
  EXPECT_EQ(formats.front().name, "vtu");
  EXPECT_TRUE(formats.front().doc.empty()) << "every run writes it";
  for (std::size_t i = 1; i < formats.size(); ++i) {
    EXPECT_LT(formats[i - 1].place, formats[i].place);
    EXPECT_FALSE(formats[i].doc.empty()) << formats[i].name;
  }
}

TEST(FieldFormats, OneWithTheNamePlaceOrFileOfAnotherIsRefused) {
  for (const FieldFormat& format :
       {FieldFormat{.name = "vtu", .place = 7, .make = &none},
        FieldFormat{.name = "other", .place = 20, .make = &none},
        FieldFormat{.name = "other", .place = 7, .files = {"fields.pvd"}, .make = &none},
        FieldFormat{.name = "other", .place = 7}})
    EXPECT_THROW(add_field_format(format), std::logic_error) << format.name << format.place;
  EXPECT_EQ(field_formats().front().name, "vtu") << "none was added";
}

TEST(FieldFormats, TheirFilesAreThoseOfARun) {
  for (const FieldFormat& format : field_formats())
    for (const std::string_view file : format.files) EXPECT_TRUE(RunFolder::is_taken(file)) << file;
  EXPECT_FALSE(RunFolder::is_taken("mine.csv"));
}

}  // namespace
}  // namespace solidus::results
