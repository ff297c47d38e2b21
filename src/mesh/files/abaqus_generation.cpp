// Abaqus Keywords Reference Guide: *NGEN, *NFILL, *NCOPY, *ELGEN, *ELCOPY.
#include "mesh/files/abaqus_generation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "mesh/local_system.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mesh {

namespace {

constexpr GlobalIndex k_most = 50'000'000;  // nodes or elements of one line: a slip of the pen makes more

/// Throws InputError where a keyword has an option that is not read.
void refuse_options(const AbaqusKeyword& keyword, const std::vector<std::string>& known) {
  for (const auto& [name, value] : keyword.parameters)
    if (std::ranges::find(known, name) == known.end()) {
      std::string allowed;
      for (const std::string& each : known) allowed += (allowed.empty() ? "" : ", ") + each;
      throw InputError(keyword.at,
                       "*" + keyword.name + " has the option '" + name + "', which is not read here",
                       allowed + "; or a deck with the nodes and elements themselves");
    }
}

/// The numbers of a set in its own order, or rising.
std::vector<GlobalIndex> numbers_of(const AbaqusSets& sets, const std::string& name, bool in_order,
                                    const SourceLocation& at) {
  const auto set = sets.find(upper(name));
  if (set == sets.end()) throw InputError(at, "there is no set '" + name + "' up to here");
  std::vector<GlobalIndex> numbers;
  for (const NumberRange& r : set->second.ranges) {
    if (r.count() > k_most) throw InputError(at, "the set '" + name + "' has too many members to copy");
    for (GlobalIndex n = r.first; n <= r.last; n += r.step) numbers.push_back(n);
  }
  if (!in_order || !set->second.unsorted) {
    std::ranges::sort(numbers);
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  }
  return numbers;
}

class Generator {
 public:
  Generator(const AbaqusKeyword& keyword, double unit, AbaqusScope& scope)
      : keyword_(keyword), unit_(unit), scope_(scope) {}

  void run(const std::vector<AbaqusLine>& lines) {
    // Each keyword refuses options that would change what it makes and that are not read.
    if (keyword_.name == "NGEN") {
      refuse_options(keyword_, {"NSET", "LINE"});
      for (const AbaqusLine& line : lines) nodes_between(line);
    } else if (keyword_.name == "NFILL") {
      refuse_options(keyword_, {"NSET"});
      for (const AbaqusLine& line : lines) fill(line);
    } else if (keyword_.name == "NCOPY") {
      refuse_options(keyword_, {"CHANGE NUMBER", "OLD SET", "NEW SET", "SHIFT", "MULTIPLE"});
      copy_nodes(lines);
    } else if (keyword_.name == "ELGEN") {
      refuse_options(keyword_, {"ELSET", "ALL NODES"});
      for (const AbaqusLine& line : lines) rows_of_elements(line);
    } else {
      refuse_options(keyword_, {"ELEMENT SHIFT", "OLD SET", "NEW SET", "SHIFT NODES"});
      copy_elements();
    }
  }

 private:
  const Point& place(GlobalIndex number, const SourceLocation& at) const {
    return scope_.x[as_size(scope_.node(number, at))];
  }
  GlobalIndex number_of(const std::string& parameter) const {
    return AbaqusLine{keyword_.at, {keyword_.required(parameter)}}.integer(0);
  }
  void add_node(GlobalIndex number, const Point& x, const char* set, const SourceLocation& at) {
    // A node that is there already is given its place once more: the same place changes nothing.
    const auto there = scope_.node_at.find(number);
    if (there == scope_.node_at.end())
      scope_.add_node(number, x, at);
    else if (length_of(difference(scope_.x[as_size(there->second)], x)) > 1e-9 * (length_of(x) + unit_))
      throw InputError(at, "*" + keyword_.name + " makes node " + std::to_string(number) +
                               ", which is there already at another place");
    add_to(scope_.node_sets, set, number);
  }
  void add_to(AbaqusSets& sets, const char* parameter, GlobalIndex number) {
    if (const std::string* set = keyword_.find(parameter)) set_of(sets, *set, keyword_.at).add(number);
  }

  void nodes_between(const AbaqusLine& line);
  Point on_arc(const AbaqusLine& line, const Point& a, const Point& b, double share) const;
  void fill(const AbaqusLine& line);
  void copy_nodes(const std::vector<AbaqusLine>& lines);
  void rows_of_elements(const AbaqusLine& line);
  void copy_element(const AbaqusElement& original, GlobalIndex node_shift, GlobalIndex element_shift,
                    const char* set, const SourceLocation& at);
  void copy_elements();

  const AbaqusKeyword& keyword_;
  double unit_;
  AbaqusScope& scope_;
};

Point between(const Point& a, const Point& b, double share) {
  Point x{};
  for (std::size_t i = 0; i < 3; ++i) x[i] = (1 - share) * a[i] + share * b[i];
  return x;
}

void Generator::nodes_between(const AbaqusLine& line) {
  // Numbers go from the first to the last in equal steps; so do the places, on a line or an arc.
  const GlobalIndex first = line.integer(0), last = line.integer(1), step = line.integer(2, 1);
  const GlobalIndex span = last - first;
  if (step == 0 || span == 0 || span % step != 0 || span / step < 0)
    line.fail("*NGEN cannot go from node " + std::to_string(first) + " to node " + std::to_string(last) +
                  " in steps of " + std::to_string(step),
              "a difference of the numbers that is a multiple of the step");
  const GlobalIndex n = span / step;
  if (n > k_most) line.fail("*NGEN makes " + std::to_string(n - 1) + " nodes in one line");
  // Straight lines are the default; other curves than arcs are refused by their name.
  const std::string* kind = keyword_.find("LINE");
  const bool arc = kind != nullptr && upper(*kind) == "C";
  if (kind != nullptr && !arc)
    line.fail("*NGEN with LINE=" + *kind + " is not read here", "straight lines, and arcs with LINE=C");
  // The end nodes exist already; what lies between is made.
  const Point a = place(first, line.at), b = place(last, line.at);
  add_to(scope_.node_sets, "NSET", first);
  for (GlobalIndex i = 1; i < n; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(n);
    add_node(first + i * step, arc ? on_arc(line, a, b, share) : between(a, b, share), "NSET", line.at);
  }
  add_to(scope_.node_sets, "NSET", last);
}

Point Generator::on_arc(const AbaqusLine& line, const Point& a, const Point& b, double share) const {
  const Point centre = line.has(3) ? place(line.integer(3), line.at)
                                   : Point{unit_ * line.real(4), unit_ * line.real(5), unit_ * line.real(6)};
  const Point from = difference(a, centre), to = difference(b, centre);
  if (!(length_of(from) > 0) || std::abs(length_of(from) - length_of(to)) > 1e-6 * length_of(from))
    line.fail("the ends of an arc of *NGEN do not lie on one circle around its centre");
  // Without a normal the arc is the shorter one.
  Point normal = cross_product(from, to);
  const bool given = line.has(7) || line.has(8) || line.has(9);
  if (given) normal = {line.real(7), line.real(8), line.real(9)};
  if (!(length_of(normal) > (given ? 0.0 : 1e-9 * length_of(from) * length_of(to))))
    line.fail("the ends of an arc of *NGEN and its centre lie on one line", "the normal of the arc");
  double angle = std::atan2(length_of(cross_product(from, to)), dot_product(from, to));
  if (dot_product(cross_product(from, to), normal) < 0) angle = 2 * std::acos(-1.0) - angle;
  const Point end{centre[0] + normal[0], centre[1] + normal[1], centre[2] + normal[2]};
  return turned(a, centre, end, share * angle * 180 / std::acos(-1.0)).value();
}

void Generator::fill(const AbaqusLine& line) {
  if (line.parts.size() < 3) line.fail("*NFILL needs two sets of nodes, and a number of lines");
  // Both sets in the order in which they were written, since rows run from member to member.
  const auto one = numbers_of(scope_.node_sets, line.parts[0], true, line.at),
             other = numbers_of(scope_.node_sets, line.parts[1], true, line.at);
  // As many members in both sets, and a bounded number of nodes.
  const GlobalIndex lines = line.integer(2), step = line.integer(3, 1);
  if (one.size() != other.size() || lines < 1 || step == 0)
    line.fail("*NFILL has sets of " + std::to_string(one.size()) + " and " + std::to_string(other.size()) +
                  " nodes and goes in " + std::to_string(lines) + " steps of " + std::to_string(step),
              "as many nodes in both, and at least one step of numbers other than zero");
  if (lines > k_most) line.fail("*NFILL makes too many nodes in one line");
  // Between each pair of both sets lie equal steps.
  const auto give = [&](GlobalIndex number) { add_to(scope_.node_sets, "NSET", number); };
  for (std::size_t k = 0; k < one.size(); ++k) {
    const Point a = place(one[k], line.at), b = place(other[k], line.at);
    give(one[k]);
    for (GlobalIndex i = 1; i < lines; ++i)
      add_node(one[k] + i * step, between(a, b, static_cast<double>(i) / static_cast<double>(lines)), "NSET",
               line.at);
    give(other[k]);
  }
}

void Generator::copy_nodes(const std::vector<AbaqusLine>& lines) {
  // *NCOPY makes nodes from a set by shifting it, or by turning it about a line, once or several times.
  if (!keyword_.has("SHIFT"))
    throw InputError(keyword_.at, "*NCOPY without SHIFT is not read here",
                     "SHIFT, or a deck with the nodes themselves");
  const GlobalIndex change = number_of("CHANGE NUMBER");
  const GlobalIndex times = keyword_.has("MULTIPLE") ? number_of("MULTIPLE") : 1;
  if (times < 1 || times > k_most || change == 0)
    throw InputError(
        keyword_.at,
        "*NCOPY makes " + std::to_string(times) + " copies with numbers changed by " + std::to_string(change),
        "at least one copy, and other numbers");
  // The first data line is the shift, the second the axis by two points and the angle.
  const auto old = numbers_of(scope_.node_sets, keyword_.required("OLD SET"), false, keyword_.at);
  Point shift{}, a{}, b{};
  double angle = 0;
  // Coordinates are in the unit of the deck; everything of the mesh is in metres.
  if (!lines.empty())
    for (std::size_t i = 0; i < 3; ++i) shift[i] = unit_ * lines[0].real(i);
  if (lines.size() > 1) {
    for (std::size_t i = 0; i < 3; ++i) {
      a[i] = unit_ * lines[1].real(i);
      b[i] = unit_ * lines[1].real(3 + i);
    }
    angle = lines[1].real(6);
    if (angle != 0 && length_of(difference(b, a)) == 0)
      lines[1].fail("*NCOPY turns around a line of no length");
    if (angle != 0 && length_of(shift) > 0)
      lines[1].fail("*NCOPY shifts and turns at once, which is not read here",
                    "two *NCOPY, one that shifts and one that turns");
  }
  // Each copy starts from the one before, so that shift and turn add up, and its numbers rise by the same
  // change.
  for (const GlobalIndex number : old) {
    Point x = place(number, keyword_.at);
    for (GlobalIndex copy = 1; copy <= times; ++copy) {
      if (angle != 0) x = turned(x, a, b, angle).value();
      for (std::size_t i = 0; i < 3; ++i) x[i] += shift[i];
      add_node(number + copy * change, x, "NEW SET", keyword_.at);
    }
  }
}

void Generator::copy_element(const AbaqusElement& original, GlobalIndex node_shift, GlobalIndex element_shift,
                             const char* set, const SourceLocation& at) {
  AbaqusElement copy{original.shape, {}, original.number + element_shift};
  for (const Index n : original.nodes)
    copy.nodes.push_back(scope_.node(scope_.node_number[as_size(n)] + node_shift, at));
  add_to(scope_.element_sets, set, copy.number);
  scope_.add_element(std::move(copy), at);
}

void Generator::rows_of_elements(const AbaqusLine& line) {
  const GlobalIndex number = line.integer(0);
  const auto found = scope_.element_at.find(number);
  if (found == scope_.element_at.end())
    line.fail("there is no element " + std::to_string(number) + " up to here");
  // The master element is copied by value, because the list grows meanwhile.
  const AbaqusElement master = scope_.elements[as_size(found->second)];
  // For the elements of a row, the rows of a layer and the layers the line gives their number, and by how
  // much the numbers of nodes and elements rise from one to the next.
  std::array<std::array<GlobalIndex, 3>, 3> rise{};
  double all = 1;
  for (std::size_t d = 0; d < 3; ++d) {
    // By default the numbers of elements rise by one in a row, and from row to row by the length of a row.
    const GlobalIndex usual = d == 0 ? 1 : rise[d - 1][0] * rise[d - 1][2];
    rise[d] = {line.integer(1 + 3 * d, 1), line.integer(2 + 3 * d, 1), line.integer(3 + 3 * d, usual)};
    if (rise[d][0] < 1) line.fail("*ELGEN makes rows of " + std::to_string(rise[d][0]) + " elements");
    all *= static_cast<double>(rise[d][0]);
  }
  // Each copy has the master's nodes raised by the steps of its row, its rows and its layers.
  if (all > static_cast<double>(k_most)) line.fail("*ELGEN makes too many elements in one line");
  for (GlobalIndex k = 0; k < rise[2][0]; ++k)
    for (GlobalIndex j = 0; j < rise[1][0]; ++j)
      for (GlobalIndex i = 0; i < rise[0][0]; ++i) {
        if (i + j + k == 0) {
          add_to(scope_.element_sets, "ELSET", number);
          continue;
        }
        copy_element(master, i * rise[0][1] + j * rise[1][1] + k * rise[2][1],
                     i * rise[0][2] + j * rise[1][2] + k * rise[2][2], "ELSET", line.at);
      }
}

void Generator::copy_elements() {
  const GlobalIndex element_shift = number_of("ELEMENT SHIFT"), node_shift = number_of("SHIFT NODES");
  for (const GlobalIndex number :
       numbers_of(scope_.element_sets, keyword_.required("OLD SET"), false, keyword_.at)) {
    const auto found = scope_.element_at.find(number);
    if (found == scope_.element_at.end())
      throw InputError(keyword_.at, "there is no element " + std::to_string(number) + " up to here");
    const AbaqusElement original = scope_.elements[as_size(found->second)];
    copy_element(original, node_shift, element_shift, "NEW SET", keyword_.at);
  }
}

}  // namespace

bool is_generation(const std::string& keyword) {
  constexpr std::array k_keywords{"NGEN", "NFILL", "NCOPY", "ELGEN", "ELCOPY"};
  return std::ranges::any_of(k_keywords, [&](const char* each) { return keyword == each; });
}

void generate(const AbaqusKeyword& keyword, const std::vector<AbaqusLine>& lines, double unit,
              AbaqusScope& scope) {
  Generator(keyword, unit, scope).run(lines);
}

}  // namespace solidus::mesh
