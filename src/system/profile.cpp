/// A stack of running parts: the innermost one is charged when another begins or ends.
#include "system/profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <string_view>

namespace solidus::profile {

namespace {

constexpr double k_shown = 0.005;  ///< share of the whole

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

struct Node {
  const char* name;
  std::size_t parent;
  double seconds = 0;
};

struct Table {
  std::vector<Node> nodes{{"other", 0}};  ///< the first is the whole
  std::size_t running = 0;
  double started = now(), changed = started;

  void charge() {
    const double time = now();
    nodes[running].seconds += time - changed;
    changed = time;
  }
  void enter(const char* name) {
    charge();
    for (std::size_t i = 1; i < nodes.size(); ++i)
      if (nodes[i].parent == running && std::string_view(nodes[i].name) == name) {
        running = i;
        return;
      }
    nodes.push_back({name, running});
    running = nodes.size() - 1;
  }
  void leave() {
    charge();
    running = nodes[running].parent;
  }
  std::string path(std::size_t i) const {
    const std::size_t parent = nodes[i].parent;
    return (i > 0 && parent > 0 ? path(parent) + ": " : "") + nodes[i].name;
  }
};

Table& table() {
  static Table the_table;
  return the_table;
}

}  // namespace

Part::Part(const char* name) {
  table().enter(name);
}
Part::~Part() {
  table().leave();
}

void begin() {
  Table& t = table();
  for (Node& node : t.nodes) node.seconds = 0;
  t.started = t.changed = now();
}

std::vector<std::pair<std::string, double>> rows() {
  Table& t = table();
  t.charge();
  std::vector<std::pair<std::string, double>> all;
  for (std::size_t i = 1; i < t.nodes.size(); ++i) all.emplace_back(t.path(i), t.nodes[i].seconds);
  all.emplace_back(t.path(0), t.nodes[0].seconds);
  return all;
}

double total() {
  Table& t = table();
  t.charge();
  return t.changed - t.started;
}

std::string text() {
  auto all = rows();
  const double whole = total();
  // Equal times keep the order in which the parts began.
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  std::string lines;
  double rest = 0;
  // Parts in order of their time; what is short is summed up.
  for (const auto& [name, seconds] : all) {
    if (seconds < k_shown * whole || name == "other") {
      rest += seconds;
      continue;
    }
    lines += fmt::format("{:>9.2f} s {:5.1f} %  {}\n", seconds, 100 * seconds / whole, name);
  }
  return lines + fmt::format("{:>9.2f} s {:5.1f} %  other\n{:>9.2f} s          in all\n", rest,
                             100 * rest / whole, whole);
}

}  // namespace solidus::profile
