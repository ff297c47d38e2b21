/// Headers are read from their end: cooling rate, phase, unit; what is left is the quantity.
#include "material/cards/column_headers.hpp"

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>

namespace solidus::material {

namespace {

std::string trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" -");
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(" -") - first + 1));
}

std::string lower(std::string_view text) {
  std::string small(text);
  std::ranges::transform(small, small.begin(), [](unsigned char c) { return std::tolower(c); });
  return small;
}

/// Takes "-1.0(C/s)" off the end of a header.
void take_cooling_rate(std::string& header) {
  const std::string small = lower(header);
  for (const std::string_view rate : {"(c/s)", "(k/s)", " c/s", " k/s"}) {
    if (!small.ends_with(rate)) continue;
    const auto dash = header.rfind('-', header.size() - rate.size());
    if (dash == std::string::npos) continue;
    const std::string number = header.substr(dash + 1, header.size() - rate.size() - dash - 1);
    if (number.find_first_not_of("0123456789.eE+ ") == std::string::npos) header.resize(dash);
    return;
  }
}

/// Takes a phase behind the last dash outside of brackets; empty where there is none.
std::string take_phase(std::string& header) {
  const auto closed = header.rfind(')');
  const auto dash = header.find('-', closed == std::string::npos ? 0 : closed);
  if (dash == std::string::npos) return {};
  std::string phase = trimmed(header.substr(dash));
  const std::string small = lower(phase);
  const bool whole = small.empty() || small == "total" || small == "system" || small == "all";
  // A dash within a name, as of "Al-Si", is none of JMatPro's, which has a blank or TOTAL, or the bracket.
  if (!whole && closed == std::string::npos && small != "liquid" && small != "solid") return {};
  header.resize(dash);
  return whole ? std::string() : phase;
}

}  // namespace

HeaderParts parts_of_header(const ColumnTable::Column& column) {
  // JMatPro appends the cooling rate and the phase to the header; both are taken off from the end.
  std::string header = column.header;
  take_cooling_rate(header);
  const std::string small = lower(header);
  std::string phase;
  if (header != column.header || small.ends_with("-total") || small.ends_with("%-liquid") ||
      small.ends_with("%-solid"))
    phase = take_phase(header);
  // A header that had neither is that of another program, which may say of what system the value
  // is.
  if (header == column.header) {
    HeaderParts parts{column.name, column.unit};
    for (const char* suffix : {" per gram of system", " of the system", " of system"})
      if (lower(parts.name).ends_with(suffix))
        parts.name.resize(parts.name.size() - std::char_traits<char>::length(suffix));
    return parts;
  }
  // What is left is the quantity with its unit; phases are quantities by themselves.
  HeaderParts parts = split_header(trimmed(header));
  const std::string base = lower(parts.name);
  if (base.starts_with("phases") || base.starts_with("phase")) {
    const bool percent = header.find('%') != std::string::npos;
    return {phase.empty() ? parts.name : phase, percent ? "%" : parts.unit};
  }
  if (!phase.empty()) parts.name += " of " + phase;
  return parts;
}

}  // namespace solidus::material
