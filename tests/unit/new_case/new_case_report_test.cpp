// What `solidus new` says on the terminal, and its notes on what is doubtful.
#include "new_case/new_case_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace solidus::new_case {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// A sound draft: walls of 10 mm, elements of 5 mm.
struct Report {
  Draft draft;
  PartMeasures part;
  DraftEstimate estimate;
  NewCaseOptions options;

  Report() {
    draft.geometry = "part.step";
    draft.process = "sand";
    draft.alloy = "aluminium_alsi7mg";
    draft.pouring = 695;
    draft.bodies = {{.name = "casting",
                     .group = "body_1",
                     .material = draft.alloy,
                     .comment = "",
                     .role = cases::Role::casting,
                     .start = 695}};
    draft.size = 6e-3;
    draft.smallest = 5e-3;
    draft.end = 600;
    part.high = {0.1, 0.06, 0.04};
    part.volume = 1e-4;
    part.area = 2e-2;
    part.thickness = {10e-3, 10e-3, 20e-3};
    estimate.nodes = 9000;
    estimate.metal_nodes = 2100;
    estimate.shortest_edge = 2.1e-3;
    estimate.longest_edge = 8.4e-3;
    estimate.freezing = 104;
  }
  std::string text() const { return report_text(draft, part, estimate, options); }
};

TEST(NewCaseReport, OfASoundDraftSaysWhatWasMeasuredAndNotesNothing) {
  const std::string text = Report().text();
  EXPECT_THAT(text, HasSubstr("part.step: aluminium_alsi7mg at 695 degC, process sand"));
  EXPECT_THAT(text,
              HasSubstr("walls       10 mm (a tenth is thinner) to 10 mm (a tenth is thicker), V/A 5 mm"));
  EXPECT_THAT(text, HasSubstr("9000 nodes, 2100 of them in metal; edges of 2.1 to 8.4 mm there"));
  EXPECT_THAT(
      text, HasSubstr("in about 100 s by an estimate of one dimension; the run ends when it has, at 600 s"));
  EXPECT_THAT(text, Not(HasSubstr("note")));
}

TEST(NewCaseReport, NotesARiserThatStandsOnAHandle) {
  Report report;
  report.draft.risers = {DraftRiser{.diameter = 0.1, .height = 0.15, .hollow = 0.062}};
  EXPECT_THAT(report.text(), HasSubstr("above the thickest place, with 62 mm of mould between them"));
  report.draft.risers[0].hollow.reset();
  EXPECT_THAT(report.text(), Not(HasSubstr("note")));
}

TEST(NewCaseReport, NotesThePoorestElementAndItsPlace) {
  Report report;
  report.estimate.least_quality = 0.0712;
  report.estimate.worst_element = "at (1, 2, 3) mm in 'body_1'";
  EXPECT_THAT(report.text(),
              HasSubstr("note        the least quality of elements is 0.071 (0.15 is sound), the worst "
                        "at (1, 2, 3) mm in 'body_1': results there are rough"));
  report.estimate.least_quality = 0.16;
  EXPECT_THAT(report.text(), Not(HasSubstr("note")));
}

TEST(NewCaseReport, NotesWallsWithOneElementThroughThem) {
  Report report;
  report.part.thickness = {4e-3, 4e-3, 4e-3};
  EXPECT_THAT(report.text(),
              HasSubstr("thin walls have one element through them: enough for when and where it "
                        "freezes last, not for temperatures within the wall, of which `check` warns; "
                        "--fineness 2.5 gives two"));
  report.part.thickness = {1e-3, 1e-3, 1e-3};  // finer than --fineness goes
  EXPECT_THAT(report.text(), HasSubstr("thin walls have one element through them"));
  EXPECT_THAT(report.text(), Not(HasSubstr("--fineness")));
  report.draft.meshed = true;  // its elements are the user's
  EXPECT_THAT(report.text(), Not(HasSubstr("note")));
}

TEST(NewCaseReport, NotesHowANewSkinDiffersFromTheFacets) {
  Report report;
  report.estimate.skin_notes = {"a new skin stands for the facets"};
  EXPECT_THAT(report.text(), HasSubstr("note        a new skin stands for the facets"));
}

TEST(NewCaseReport, NotesBodiesThatArePouredForWantOfAName) {
  Report report;
  report.draft.bodies.push_back(report.draft.bodies.front());
  report.draft.bodies.back().name = report.draft.bodies.back().group = "body_2";
  EXPECT_THAT(report.text(),
              HasSubstr("no name says what these are, so they are poured: casting, body_2; else, for "
                        "example: --as body_2=core"));
  report.options.as = {"body_1=casting", "body_2=casting"};
  EXPECT_THAT(report.text(), Not(HasSubstr("note")));
}

TEST(NewCaseReport, NotesARiserBesideThePlaneOfSymmetry) {
  Report report;
  report.draft.risers = {DraftRiser{.foot = {0.02, 0.01, 0.04}, .diameter = 0.04, .height = 0.06}};
  report.draft.symmetry = DraftSymmetry{1, 0.03};
  EXPECT_THAT(report.text(), HasSubstr("the part is thickest 20 mm off the plane of symmetry"));
  report.draft.risers[0].foot[1] = 0.03;
  EXPECT_THAT(report.text(), HasSubstr("halved by the plane of symmetry on which it stands"));
  EXPECT_THAT(report.text(), Not(HasSubstr("note")));
}

TEST(NewCaseReport, NotesPartsSoLargeThatTheirUnitIsInDoubt) {
  Report report;
  report.part.high = {100, 60, 40};
  EXPECT_THAT(report.text(),
              HasSubstr("100 m large, for lengths of the file in mm: --unit takes another unit"));
}

}  // namespace
}  // namespace solidus::new_case
