/// The page of `solidus report`: how numbers are packed, what a folder becomes, what is refused.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "mesh/making/parametric_meshes.hpp"
#include "mesh/raw_mesh.hpp"
#include "results/formats/field_output.hpp"
#include "results/formats/pvd.hpp"
#include "results/formats/vtu.hpp"
#include "results/output/csv.hpp"
#include "results/output/run_folder.hpp"
#include "results/report/body_mesh.hpp"
#include "results/report/moments.hpp"
#include "results/report/pack.hpp"
#include "results/report/report_page.hpp"
#include "results/report/report_table.hpp"
#include "sample.hpp"
#include "system/errors.hpp"
#include "system/processes.hpp"
#include "vtu_reader.hpp"

namespace solidus::results {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();

// The reader's side, written for the tests alone.
std::string unpack(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string packed;
  unsigned bits = 0;
  int n = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = (bits << 6U) | static_cast<unsigned>(digits.find(c));
    if ((n += 6) >= 8) packed += static_cast<char>((bits >> static_cast<unsigned>(n -= 8)) & 0xffU);
  }
  std::string out(std::size_t{1} << 22, '\0');
  z_stream stream{};
  inflateInit2(&stream, -MAX_WBITS);
  stream.next_in = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
  out.resize(stream.total_out);
  inflateEnd(&stream);
  return out;
}

std::vector<std::vector<double>> unpacked(const Packed16& p, std::size_t n) {
  const std::size_t total = p.words.size() / 2;
  std::vector<std::vector<double>> out;
  std::vector<std::uint16_t> last(n, 0), now(n, 0);
  for (std::size_t at = 0; at < total;) {
    out.emplace_back();
    std::uint16_t beside = 0;
    for (std::size_t i = 0; i < n; ++i, ++at) {
      const unsigned word =
          static_cast<unsigned char>(p.words[at]) + 256U * static_cast<unsigned char>(p.words[total + at]);
      const int r = static_cast<int>(word >> 1U) ^ -static_cast<int>(word & 1U);
      now[i] = static_cast<std::uint16_t>(last[i] + beside + r);
      beside = static_cast<std::uint16_t>(now[i] - last[i]);
      const bool none = !p.mask.empty() && p.mask[at] != 0;
      out.back().push_back(none ? k_nan : p.low + (p.high - p.low) * now[i] / k_steps);
    }
    last.swap(now);
  }
  return out;
}

TEST(ReportPacking, KeepsValuesToHalfAStepAndPlacesWithoutOne) {
  std::vector<std::vector<float>> moments(3, std::vector<float>(500));
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < 500; ++i)
      moments[k][i] = (i + k) % 7 == 0
                          ? std::numeric_limits<float>::quiet_NaN()
                          : static_cast<float>(300 + 1e3 * std::sin(0.1 * static_cast<double>(i * (k + 1))));
  const Packed16 packed = pack16(moments);
  const auto back = unpacked(packed, 500);
  ASSERT_EQ(back.size(), 3U);
  const double half = 0.5001 * (packed.high - packed.low) / k_steps;
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < 500; ++i)
      if (std::isnan(moments[k][i]))
        EXPECT_TRUE(std::isnan(back[k][i])) << k << " " << i;
      else
        EXPECT_NEAR(back[k][i], static_cast<double>(moments[k][i]), half + 1e-4) << k << " " << i;
}

TEST(ReportPacking, TellsOneValueEverywhereFromNone) {
  EXPECT_TRUE(pack16({{3, 3}, {3, 3}}).uniform);
  EXPECT_TRUE(pack16({{3, 3}, {3, 3}}).words.empty());
  EXPECT_FALSE(pack16({{static_cast<float>(k_nan)}}).any);
  const Packed16 some = pack16({{3, static_cast<float>(k_nan)}});
  EXPECT_FALSE(some.uniform);
  EXPECT_DOUBLE_EQ(unpacked(some, 2)[0][0], 3);
}

TEST(ReportPacking, BytesComeBackWhateverTheyAreLike) {
  for (const std::size_t n : {0UL, 1UL, 2UL, 3UL, 100000UL}) {
    std::string bytes;
    for (std::size_t i = 0; i < n; ++i) bytes += static_cast<char>((i * i * 31) >> 3U);
    for (const Bytes like : {Bytes::mixed, Bytes::noise, Bytes::mask})
      EXPECT_EQ(unpack(packed_text(bytes, like)), bytes) << n;
  }
}

TEST(ReportPacking, KeepsEqualBlocksOnce) {
  Blocks blocks;
  EXPECT_EQ(blocks.add("one"), 0);
  EXPECT_EQ(blocks.add("two"), 1);
  EXPECT_EQ(blocks.add("one"), 0);
  EXPECT_EQ(blocks.texts().size(), 2U);
}

TEST(ReportFields, LargestPrincipalValueOfATensor) {
  const auto largest = [](std::array<double, 6> t) { return largest_principal(t.data()); };
  EXPECT_NEAR(largest({5, 5, 5, 0, 0, 0}), 5, 1e-12);
  EXPECT_NEAR(largest({-3, 2, 1, 0, 0, 0}), 2, 1e-12);
  EXPECT_NEAR(largest({0, 0, 0, 4, 0, 0}), 4, 1e-12);
  EXPECT_NEAR(largest({1, 1, 1, 2, 2, 2}), 5, 1e-12);  // (1, 1, 1) is its direction
  EXPECT_NEAR(largest({0, 0, 0, 0, 0, -3}), 3, 1e-12);
}

TEST(ReportMesh, SimplicesFillABlockAndItsSkinIsClosed) {
  using mesh::Shape;
  for (const Shape shape : {Shape::tri3, Shape::tri6, Shape::quad4, Shape::quad8, Shape::tet4, Shape::tet10,
                            Shape::hex8, Shape::hex20}) {
    const test::SharedFolder folder;
    const bool plane = mesh::dimension(shape) == 2;
    const int rank = processes::rank();
    mesh::RawMesh raw;
    if (rank == 0)
      raw = plane ? mesh::make_block({{2, 3}, {}, {2, 2}, "part"}, shape)
                  : mesh::make_block({{2, 3, 4}, {}, {2, 2, 2}, "part"}, shape);
    const mesh::Mesh mesh = mesh::distribute(raw, {"part"}, {});
    const results::RunFolder run(folder.path, "");
    results::FieldOutput(run, mesh).write(0, {}, {});
    test::on_first([&] {
      const int size = processes::count();
      const FieldFile file(folder.path / "fields" / (size == 1 ? "fields_00000.vtu" : "fields_00000.pvtu"));
      const Bodies bodies(file);
      ASSERT_EQ(bodies.all().size(), 1U);
      const BodyMesh& body = bodies.all()[0];
      const auto at = [&](std::int32_t node) { return body.x[static_cast<std::size_t>(node)]; };
      double measure = 0;
      const auto n = static_cast<std::size_t>(body.corners);
      for (std::size_t c = 0; c < body.cells.size(); c += n) {
        const auto a = at(body.cells[c]), b = at(body.cells[c + 1]), d = at(body.cells[c + 2]);
        const double u[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]},
                     v[3] = {d[0] - a[0], d[1] - a[1], d[2] - a[2]};
        const double normal[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                                  u[0] * v[1] - u[1] * v[0]};
        if (plane) {
          EXPECT_GT(normal[2], 0) << mesh::name(shape);
          measure += normal[2] / 2;
        } else {
          const auto e = at(body.cells[c + 3]);
          measure +=
              std::fabs(normal[0] * (e[0] - a[0]) + normal[1] * (e[1] - a[1]) + normal[2] * (e[2] - a[2])) /
              6;
        }
      }
      EXPECT_NEAR(measure, plane ? 6 : 24, 1e-12) << mesh::name(shape);
      // By the divergence theorem the skin, seen from outside, holds the same volume.
      double inside = 0;
      for (std::size_t t = 0; t < body.triangles.size(); t += 3) {
        const auto a = at(body.triangles[t]), b = at(body.triangles[t + 1]), c = at(body.triangles[t + 2]);
        inside += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                   a[2] * (b[0] * c[1] - b[1] * c[0])) /
                  6;
      }
      EXPECT_NEAR(inside, plane ? 0 : 24, 1e-12) << mesh::name(shape);
    });
  }
}

TEST(ReportTables, ReadTextsInQuotesAndLeaveOutARowThatWasNotFinished) {
  const test::TemporaryFolder folder;
  const fs::path file = folder.path / "steps.csv";
  std::ofstream(file) << "time[s],reason\n1,\"a, \"\"b\"\"\"\n2,plain\n3,cut of";
  const ReportTable table = read_table(file, 100);
  ASSERT_EQ(table.n_rows, 2U);
  EXPECT_EQ(table.columns[0].numbers, (std::vector<double>{1, 2}));
  EXPECT_EQ(table.columns[1].texts, (std::vector<std::string>{"a, \"b\"", "plain"}));
}

TEST(ReportTables, ThinOutLongOnesAndKeepTheLastRow) {
  const test::TemporaryFolder folder;
  const fs::path file = folder.path / "history.csv";
  std::string text = "time[s]\n";
  for (int i = 0; i < 1000; ++i) text += fmt::format("{}\n", i);
  std::ofstream(file) << text;
  const ReportTable table = read_table(file, 100);
  EXPECT_EQ(table.n_in_file, 1000U);
  EXPECT_LE(table.n_rows, 101U);
  EXPECT_EQ(table.columns[0].numbers.back(), 999);
}

TEST(ReportTables, NameTheLineWithAnotherNumberOfCells) {
  const test::TemporaryFolder folder;
  std::ofstream(folder.path / "history.csv") << "time[s],T[degC]\n1,2\n3\n";
  EXPECT_THAT([&] { read_table(folder.path / "history.csv", 10); },
              ::testing::ThrowsMessage<InputError>(HasSubstr("history.csv:3: the row has 1 cells")));
}

/// A folder as a run leaves it: two moments on two bodies.
struct Report : ::testing::Test {
  test::TemporaryFolder folder;
  fs::path page = folder.path / "report.html";

  void write_run(const std::string& title = "A plate", bool summary = true) {
    std::ofstream(folder.path / "case.toml")
        << "title = '''" << title << "'''\n[analysis]\nkind = \"plane_strain\"\nphysics = \"heat\"\n"
        << "[[body]]\nname = \"part\"\nmaterial = \"iron\"\n[[body]]\nname = \"mould\"\nmaterial = "
           "\"sand\"\n";
    std::ofstream(folder.path / "history.csv") << "time[s],T[degC]\n0,700\n1,650\n";
    if (summary) std::ofstream(folder.path / "summary.json") << "{\"outcome\": \"finished\"}\n";
    fs::create_directories(folder.path / "fields");
    const mesh::Mesh mesh = test::triangles_and_quad();
    results::PvdCollection collection(folder.path / "fields.pvd");
    for (int moment = 0; moment < 2; ++moment) {
      const std::vector<double> temperature = {300, 400, 500, 600, 700.0 - moment, 800},
                                stress = {1e6, 2e6, 4e6};
      results::FieldSet fields;
      fields.add({"temperature", "K", 1, mesh::FieldPlace::node, temperature});
      fields.add({"von_mises", "Pa", 1, mesh::FieldPlace::cell, stress});
      const std::string file = fmt::format("fields/fields_{:05}.vtu", moment);
      results::write_vtu(folder.path / file, mesh, fields, moment);
      collection.add(moment, file);
    }
  }
  WrittenReport write() const { return write_report({{folder.path}}, page); }
  std::string meta() const {
    const std::string text = test::read_text(page);
    const std::size_t begin = text.find("id=\"meta\">") + 10;
    return unpack(text.substr(begin, text.find('<', begin) - begin));
  }
};

TEST_F(Report, HoldsMeshMomentsFieldsAndTables) {
  write_run();
  EXPECT_TRUE(write().notes.empty());
  const std::string text = meta();
  for (const char* part :
       {"\"title\": \"A plate\"", "\"dimension\": 2", "\"name\": \"mould\"", "\"material\": \"sand\"",
        "\"name\": \"temperature\"", "\"of_elements\": true", "\"header\": \"T[degC]\"", "\"time\": 1"})
    EXPECT_THAT(text, HasSubstr(part));
}

TEST_F(Report, IsOnePageThatAsksForNothing) {
  write_run();
  write();
  const std::string text = test::read_text(page);
  EXPECT_THAT(text, HasSubstr("default-src 'none'"));
  EXPECT_THAT(text, Not(::testing::ContainsRegex("<(link|img|iframe|script[^>]* src)")));
  EXPECT_THAT(text, HasSubstr("Permission is hereby granted"));  // the licences of its packages
}

TEST_F(Report, TakesTextsOfTheUserAsTexts) {
  write_run("</script><script>alert(1)</script><img src=x onerror=alert(2)>");
  write();
  const std::string text = test::read_text(page);
  EXPECT_THAT(text, Not(HasSubstr("alert(1)")));
  EXPECT_THAT(text, Not(HasSubstr("onerror=alert")));
  EXPECT_THAT(meta(), HasSubstr("<script>alert(1)"));  // it is there, as a text
}

TEST_F(Report, OfARunThatWasKilledShowsHowFarItCame) {
  write_run("A plate", false);
  std::ofstream(folder.path / "history.csv", std::ios::app) << "2,64";  // in the middle of a row
  fs::remove(folder.path / "fields" / "fields_00001.vtu");
  const WrittenReport written = write();
  ASSERT_EQ(written.notes.size(), 2U);
  EXPECT_THAT(written.notes[0], HasSubstr("the run goes on, or it was killed"));
  EXPECT_THAT(written.notes[1],
              HasSubstr("1 of the field files that fields.pvd lists are not there any more"));
  EXPECT_THAT(meta(), HasSubstr("\"rows\": 2"));
}

TEST_F(Report, WithoutFieldsHasItsTables) {
  write_run();
  fs::remove(folder.path / "fields.pvd");
  EXPECT_THAT(write().notes.at(0), HasSubstr("The run has written no fields"));
  EXPECT_THAT(meta(), Not(HasSubstr("\"mesh\"")));
}

TEST_F(Report, StaysBelowTheSizeThatIsAskedFor) {
  write_run();
  ReportOptions options;
  options.most_bytes = 1;
  const WrittenReport written = write_report({{folder.path}}, page, options);
  EXPECT_TRUE(written.notes.empty()) << "the first and the last moment stay";
}

TEST_F(Report, RefusesWhatIsNoFolderOfResults) {
  const auto refuses = [&](const std::string& what) {
    EXPECT_THAT([&] { write(); }, ::testing::ThrowsMessage<InputError>(HasSubstr(what)));
    EXPECT_FALSE(fs::exists(page));
  };
  EXPECT_THAT([&] { write_report({{folder.path / "none"}}, page); },
              ::testing::ThrowsMessage<InputError>(HasSubstr("there is no such folder")));
  refuses("the folder has no case.toml");
  std::ofstream(folder.path / "case.toml") << "title = \"x\"\n";
  refuses("the folder has no results: neither history.csv nor fields.pvd");
  write_run();
  std::ofstream(folder.path / "summary.json") << "{\"outcome\": ";
  refuses("summary.json:1: the file is no JSON");
  std::ofstream(folder.path / "summary.json") << "{\"\\\"{\": " << std::string(70, '[');
  refuses("the JSON of the file is nested too deep");
  write_run();
  std::ofstream(folder.path / "fields.pvd")
      << "<Collection>\n<DataSet timestep=\"inf\" part=\"0\" file=\"fields/fields_00001.vtu\"/>\n";
  refuses("the collection of fields was not written by Solidus");
  write_run();
  std::ofstream(folder.path / "fields" / "fields_00001.vtu") << "<VTKFile";
  refuses("the file is no XML");
  write_run();
  fs::resize_file(folder.path / "fields" / "fields_00001.vtu",
                  fs::file_size(folder.path / "fields" / "fields_00001.vtu") - 200);
  refuses("fields_00001.vtu");
}

TEST_F(Report, HoldsTheFillingWhereItsFilesAre) {
  write_run();
  const std::string bytes = "0123456789";
  EXPECT_TRUE(write().notes.empty());
  EXPECT_THAT(test::read_text(page), Not(HasSubstr(packed_text(bytes))));
  fs::create_directories(folder.path / "filling");
  std::ofstream(folder.path / "filling/report.json") << R"({"cubes": 4})";
  std::ofstream(folder.path / "filling/report.bin") << bytes;
  // The bytes are a block of their own, in base64 as any other.
  EXPECT_TRUE(write().notes.empty());
  EXPECT_THAT(test::read_text(page), HasSubstr(packed_text(bytes)));
  EXPECT_THAT(meta(), HasSubstr("filling_text"));
  // Files of another origin are told, and do not make the page large.
  std::ofstream(folder.path / "filling/report.bin") << std::string(9'000'000, 'x');
  const WrittenReport large = write();
  ASSERT_EQ(large.notes.size(), 1U);
  EXPECT_THAT(large.notes[0], HasSubstr("too large for a page"));
}

TEST(RunFolder, TakesAwayTheReportOfTheRunBefore) {
  const test::SharedFolder folder;
  { const results::RunFolder run(folder.path, "title = \"x\"\n"); }
  test::on_first([&] {
    std::ofstream(folder.path / "report.html") << "<!doctype html>\n<!-- Written by Solidus: a report. -->\n";
    std::ofstream(folder.path / "plan.html") << "mine";
  });
  { const results::RunFolder run(folder.path, "title = \"x\"\n"); }
  test::on_first([&] {
    EXPECT_FALSE(fs::exists(folder.path / "report.html"));
    EXPECT_TRUE(fs::exists(folder.path / "plan.html"));
    std::ofstream(folder.path / "report.html") << "<html>mine</html>";
  });
  { const results::RunFolder run(folder.path, "title = \"x\"\n"); }
  test::on_first([&] { EXPECT_TRUE(fs::exists(folder.path / "report.html")); });
}

}  // namespace
}  // namespace solidus::results
