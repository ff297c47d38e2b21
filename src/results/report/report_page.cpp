/// The viewer's page with its data blocks put in.
#include "results/report/report_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <stdexcept>

#include "results/formats/vtk_data.hpp"
#include "results/output/output_file.hpp"
#include "results/report/pack.hpp"
#include "results/report/run_data.hpp"
#include "results/report/viewer.hpp"
#include "system/version.hpp"

namespace solidus::results {

using results::Json;

namespace {

constexpr std::string_view k_title = "<title>Solidus report</title>", k_data = "<!--SOLIDUS-DATA-->";

std::string now() {
  const std::time_t time = std::time(nullptr);
  std::tm parts{};
  localtime_r(&time, &parts);
  char text[32] = "";
  std::strftime(text, sizeof text, "%Y-%m-%d %H:%M", &parts);
  return text;
}

/// The viewer in three parts: before the title, up to the data, behind them.
struct Frame {
  std::string_view head, middle, tail;
};

Frame frame() {
  const std::string_view page = viewer();
  const std::size_t title = page.find(k_title), data = page.find(k_data);
  if (title == std::string_view::npos || data == std::string_view::npos || data < title)
    throw std::logic_error("the viewer has no place for the title or the data");
  return {page.substr(0, title), page.substr(title + k_title.size(), data - title - k_title.size()),
          page.substr(data + k_data.size())};
}

}  // namespace

ReportText report_text(const std::vector<ReportedRun>& runs, const ReportOptions& options) {
  ReportText page;
  Blocks blocks;
  Json meta;
  meta.add("format", 1).add("solidus", program_version()).add("made", now());
  Json::Array all;
  const auto [head, middle, tail] = frame();
  const std::size_t room = options.most_bytes - std::min(options.most_bytes, viewer().size());
  // The room is shared out so that each run may use what those before it have left.
  for (std::size_t i = 0; i < runs.size(); ++i)
    all.push_back(run_data(runs[i], options, room * (i + 1) / runs.size(), blocks, page.notes));
  meta.add("runs", std::move(all));

  // The title names the cases, by the folders of their results.
  std::string title;
  for (const ReportedRun& run : runs)
    title += (title.empty() ? "" : ", ") + std::filesystem::absolute(run.folder / "")
                                               .lexically_normal()
                                               .parent_path()
                                               .parent_path()
                                               .filename()
                                               .string();
  std::string& text = page.text;
  text.reserve(viewer().size() + blocks.size() + (std::size_t{1} << 16));
  // The page is one file: frame, data in blocks of text, and the viewer.
  text += head;
  text += fmt::format("<title>{} · Solidus</title>", results::xml_text(title));
  text += middle;
  // Text of the user is in these blocks alone, and base64 has no character that HTML knows.
  text += fmt::format("<script type=\"text/plain\" id=\"meta\">{}</script>\n", packed_text(meta.text()));
  for (std::size_t i = 0; i < blocks.texts().size(); ++i)
    text += fmt::format("<script type=\"text/plain\" id=\"b{}\">{}</script>\n", i, blocks.texts()[i]);
  text += tail;
  return page;
}

WrittenReport write_report(const std::vector<ReportedRun>& runs, const std::filesystem::path& page,
                           const ReportOptions& options) {
  ReportText written = report_text(runs, options);
  results::write_file(page, written.text);
  return {written.text.size(), std::move(written.notes)};
}

}  // namespace solidus::results
