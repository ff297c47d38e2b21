/// Families become rows, as plain text or as Markdown.
#include "app/findings_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "check/finding_family.hpp"
#include "input/key_docs.hpp"
#include "input/keys.hpp"
#include "system/errors.hpp"

namespace solidus::app {

namespace {

using check::FindingFamily;
using check::FindingRow;
using check::Topic;

constexpr Topic k_topics[] = {Topic::contacts,   Topic::materials, Topic::pour,   Topic::mesh,
                              Topic::conditions, Topic::mechanics, Topic::probes, Topic::effort};

/// The rows of a topic, in the order in which a case is searched for them.
std::vector<const FindingRow*> rows_of(Topic topic) {
  std::vector<const FindingRow*> rows;
  for (const FindingFamily& family : check::finding_families())
    for (const FindingRow& row : family.rows)
      if (row.topic == topic) rows.push_back(&row);
  return rows;
}

}  // namespace

std::string list_of_findings(const std::string& topic) {
  std::string text;
  std::vector<std::string> topics;
  for (const Topic one : k_topics) {
    topics.emplace_back(name(one));
    if (!topic.empty() && topic != name(one)) continue;
    text += fmt::format("{}{}\n", text.empty() ? "" : "\n", name(one));
    for (const FindingRow* row : rows_of(one))
      text += fmt::format("  {}{}{} ({})\n", row->finding, row->when.empty() ? "" : ": ", row->when, row->as);
  }
  if (text.empty())
    throw InputError({}, fmt::format("no findings are about '{}'", topic), one_of(topics, topic));
  return text;
}

std::string page_of_findings() {
  std::string text =
      "# Reference: findings of `check`\n\nFor those who read what `solidus check` and runs find in a case, "
      "and "
      "ask why. An *error* ends both with exit code 1, because no sensible case has it. A *warning* gives "
      "the value found and the usual range.\n";
  // One table for each topic, of the rows of all families.
  for (const Topic topic : k_topics) {
    std::string title(name(topic));
    title[0] = static_cast<char>(title[0] - 'a' + 'A');
    text += fmt::format("\n## {}\n\n| finding | when | as |\n|---|---|---|\n", title);
    for (const FindingRow* row : rows_of(topic))
      text += fmt::format("| {} | {} | {} |\n", row->finding, row->when, row->as);
  }
  return text +
         "\nNext: [what `check` understands](../guide/findings.md) · [what a message "
         "means](../guide/troubleshooting.md) · [add a finding](../developers/add_a_check_finding.md)\n";
}

}  // namespace solidus::app
