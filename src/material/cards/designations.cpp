/// Names are compared by letters and digits alone, so that spelling does not matter.
#include "material/cards/designations.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <optional>

#include "input/document.hpp"
#include "input/keys.hpp"
#include "system/errors.hpp"

namespace solidus::material {
namespace {

namespace fs = std::filesystem;

/// The letters and digits of a name, in lower case.
std::string letters(std::string_view name) {
  std::string out;
  for (const char c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
      out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

struct Label {
  std::string title;
  std::vector<std::string> designations;
};

/// The title and the designations that the file of a material gives itself; nothing for a file that cannot be
/// read.
std::optional<Label> label_of(const std::string& name, std::span<const fs::path> library) {
  for (const fs::path& folder : library) {
    const fs::path file = folder / (name + ".toml");
    std::error_code unreadable;
    if (!fs::exists(file, unreadable)) continue;
    try {
      const Value document = load_document(file);
      Label label;
      if (const Value* title = document.find("title"); title != nullptr && title->is_text())
        label.title = title->text();
      if (const Value* given = document.find("designations"); given != nullptr && given->is_list())
        for (const Value& item : given->items())
          if (item.is_text()) label.designations.push_back(item.text());
      return label;
    } catch (const InputError&) {
      return std::nullopt;
    }
  }
  return std::nullopt;
}

/// Whether a name means a material: 2 where a designation is that name, 1 where one contains the other, 0
/// not.
int likeness(const std::string& wanted, const Label& label) {
  constexpr std::size_t k_distinct = 4;  // "H13" in "H1300" says less than "A356" in "A356-T6"
  int best = letters(label.title).find(wanted) != std::string::npos ? 1 : 0;
  for (const std::string& designation : label.designations) {
    const std::string known = letters(designation);
    if (known == wanted) return 2;
    if (known.find(wanted) != std::string::npos ||
        (known.size() >= k_distinct && wanted.find(known) != std::string::npos))
      best = 1;
  }
  return best;
}

}  // namespace

std::vector<std::string> designations(const std::string& name, std::span<const fs::path> library) {
  const std::optional<Label> label = label_of(name, library);
  return label ? label->designations : std::vector<std::string>{};
}

std::vector<std::string> designated(std::string_view name, const std::vector<std::string>& names,
                                    std::span<const fs::path> library) {
  const std::string wanted = letters(name);
  std::vector<std::string> found;
  if (wanted.size() < 2) return found;  // "7" means none
  // One letter in common is no likeness.
  int best = 1;
  // All that are as like as the best one.
  for (const std::string& each : names) {
    const std::optional<Label> label = label_of(each, library);
    const int like = label ? likeness(wanted, *label) : 0;
    if (like > best) found.clear(), best = like;
    if (like == best) found.push_back(each);
  }
  return found;
}

std::string materials_meant(std::string_view name, const std::vector<std::string>& names,
                            std::span<const fs::path> library) {
  constexpr std::size_t k_most_candidates = 6;
  const std::vector<std::string> found = designated(name, names, library);
  if (found.empty() || found.size() > k_most_candidates) return one_of(names, name);
  std::vector<std::string> titled;
  for (const std::string& each : found) {
    const std::optional<Label> label = label_of(each, library);
    titled.push_back(fmt::format("'{}' ({})", each, label ? label->title : ""));
  }
  return fmt::format("did you mean {}? `solidus materials` lists all", fmt::join(titled, " or "));
}

}  // namespace solidus::material
