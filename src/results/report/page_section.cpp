/// Sections in the order in which they were added; the page sorts them by their places.
#include "results/report/page_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace solidus::results {

namespace {

/// Made when it is first asked for: objects at namespace scope add to it before main() begins.
std::vector<PageSection>& added() {
  static std::vector<PageSection> all;
  return all;
}

Json numbers(const std::vector<double>& values) {
  return Json::Array(values.begin(), values.end());
}

struct ToJson {
  Json operator()(const PageText& block) const { return Json().add("text", block.text); }
  Json operator()(const PageTable& block) const {
    Json::Array rows;
    for (const auto& row : block.rows) {
      Json::Array cells;
      for (const auto& cell : row) std::visit([&](const auto& value) { cells.emplace_back(value); }, cell);
      rows.emplace_back(std::move(cells));
    }
    Json of_table;
    of_table.add("head", Json::Array(block.head.begin(), block.head.end())).add("rows", std::move(rows));
    return Json().add("table", std::move(of_table));
  }
  Json operator()(const PageCurves& block) const {
    Json::Array lines;
    for (const PageCurves::Line& line : block.lines)
      lines.push_back(Json().add("label", line.label).add("values", numbers(line.values)));
    Json x;
    x.add("label", block.x.label).add("unit", block.x_unit).add("values", numbers(block.x.values));
    Json of_chart;
    of_chart.add("title", block.title)
        .add("unit", block.unit)
        .add("x", std::move(x))
        .add("lines", std::move(lines));
    return Json().add("chart", std::move(of_chart));
  }
};

}  // namespace

std::optional<ReportTable> SectionSource::table(std::string_view name) const {
  const std::filesystem::path file = folder / (std::string(name) + ".csv");
  if (!std::filesystem::exists(file)) return std::nullopt;
  return read_table(file, k_most_rows);
}

void add_page_section(PageSection section) {
  if (std::ranges::count(added(), section.id, &PageSection::id) > 0)
    throw std::logic_error(fmt::format("two sections of the report are called '{}'", section.id));
  added().push_back(section);
}

Json page_sections_json(const SectionSource& run) {
  Json::Array sections;
  for (const PageSection& section : added()) {
    Json::Array blocks;
    for (const PageBlock& block : section.make(run)) blocks.push_back(std::visit(ToJson{}, block));
    if (blocks.empty()) continue;
    Json one;
    one.add("id", std::string(section.id))
        .add("title", std::string(section.title))
        .add("place", section.place)
        .add("blocks", std::move(blocks));
    sections.push_back(std::move(one));
  }
  return sections;
}

}  // namespace solidus::results
